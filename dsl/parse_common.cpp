#include <algorithm>
#include <array>

#include "dsl/parser_state.h"

namespace rg::dsl {
namespace {

using Words = std::initializer_list<std::string_view>;

constexpr std::string_view kDeclarations[] = {"module",  "import", "target",  "private",   "const", "extent", "struct",    "interface",
                                              "sampler", "state",  "feature", "condition", "set",   "graph",  "technique", "spectrum"};
constexpr std::string_view kItems[] = {"image", "buffer", "pass", "bundle", "for", "when", "if", "use", "fuse", "assert", "warn", "allow"};
constexpr std::string_view kStatements[] = {"read",       "write",    "update",   "atomic", "color",    "depth",     "stencil",
                                            "resolve",    "params",   "shader",   "state",  "dispatch", "draw",      "bind",
                                            "copy",       "blit",     "clear",    "fill",   "host",     "after",     "keep",
                                            "fullscreen", "features", "spectrum", "with",   "block",    "multiview", "allow"};

template <class List>
bool contains(const List& words, std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

std::string found(const Parser& parser) {
  const Token& token = parser.peek();
  if (token.kind == TokenKind::end_of_file) return describe(token.kind);
  const std::string_view shown = parser.word().substr(0, 40);
  return token.kind == TokenKind::string ? std::string(shown) : "`" + std::string(shown) + "`";
}

}  // namespace

bool begins_declaration(std::string_view word) { return contains(kDeclarations, word); }
bool begins_item(std::string_view word) { return contains(kItems, word); }
bool begins_statement(std::string_view word) { return contains(kStatements, word); }

Guess closest_declaration(std::string_view word) { return closest(word, {std::begin(kDeclarations), std::end(kDeclarations)}); }
Guess closest_item(std::string_view word) { return closest(word, {std::begin(kItems), std::end(kItems)}); }
Guess closest_statement(std::string_view word) { return closest(word, {std::begin(kStatements), std::end(kStatements)}); }

Span Parser::since(uint32_t begin) const { return {file, begin, std::max(begin, previous_end())}; }

bool Parser::accept(TokenKind kind) {
  if (!is(kind)) return false;
  take();
  return true;
}

bool Parser::accept_word(std::string_view spelling) {
  if (!is_word(spelling)) return false;
  take();
  return true;
}

bool Parser::expect(TokenKind kind) {
  if (accept(kind)) return true;
  expected(describe(kind));
  return false;
}

ast::Name Parser::take_name() {
  const ast::Name name{word(), here()};
  take();
  return name;
}

// A new line that begins like a statement is one, not the rest of the last.
bool Parser::next_begins() const {
  if (!peek().starts_line || !is(TokenKind::identifier)) return false;
  const bool keyword = begins_statement(word()) || begins_item(word()) || begins_declaration(word());
  const Token& next = peek(1);
  const bool operand =
      next.kind == TokenKind::identifier || next.kind == TokenKind::string || next.kind == TokenKind::integer || next.kind == TokenKind::left_brace;
  return keyword && (operand || next.starts_line);
}

ast::Name Parser::expect_name(const char* what) {
  if (is(TokenKind::identifier) && !next_begins()) return take_name();
  expected(what);
  return {{}, here()};
}

ast::Name Parser::expect_one_of(const char* what, Words words) {
  if (is(TokenKind::identifier) && contains(words, word())) return take_name();
  const bool is_name = is(TokenKind::identifier) && !peek().starts_line;
  if (!is_name) {
    expected(what);
    return {{}, here()};
  }
  Diagnostic diagnostic(DiagnosticKind::UnexpectedToken, here(), {what, found(*this)});
  const Guess guess = closest(word(), words);
  suggest(diagnostic, here(), guess);
  complain(std::move(diagnostic));
  const ast::Name name{{}, here()};
  take();
  return name;
}

// A brace where none belongs: what follows will not match either.
void Parser::complain(Diagnostic diagnostic) {
  any_error = true;
  if (diagnostic.kind == DiagnosticKind::UnexpectedToken && is(TokenKind::semicolon)) diagnostic.fix(here(), "");  // nothing ends a statement
  const bool brace = is(TokenKind::left_brace) || is(TokenKind::right_brace);
  if (brace && diagnostic.span == here()) lost_structure = true;
  if (!silent) diagnostics.report(std::move(diagnostic));
  silent = true;
}

// What is missing at the end of a line is shown there, not at the beginning of the next.
void Parser::expected(const std::string& what) {
  if (is(TokenKind::invalid)) {  // the lexer has complained
    any_error = silent = true;
    return;
  }
  if (at == 0 || !peek().starts_line) return complain({DiagnosticKind::UnexpectedToken, here(), {what, found(*this)}});
  const Token& last = tokens[at - 1];
  complain({DiagnosticKind::ExpectedAfter, span(last), {what, std::string(text_of(last, text).substr(0, 40))}});
}

void Parser::unexpected(const std::string& what) {
  if (is(TokenKind::invalid)) return expected(what);
  complain({DiagnosticKind::UnexpectedToken, here(), {what, found(*this)}});
}

AllowScope::~AllowScope() {
  for (size_t i = first_; i < parser_.allows.size(); ++i)
    if (!parser_.allows[i].scope.file.valid()) parser_.allows[i].scope = parser_.since(begin_);
}

void parse_allow(Parser& parser) {
  const uint32_t begin = parser.peek().begin;
  parser.take();
  const ast::Name code = parser.expect_name("the code of a warning");
  if (!code.empty()) parser.allows.push_back({code, parser.since(begin), {}});
}

Nested::Nested(Parser& parser_) : parser(parser_), fits(++parser_.nesting <= kMaxNesting) {
  if (!fits) parser.complain({DiagnosticKind::NestingTooDeep, parser.here(), {std::to_string(kMaxNesting)}});
}

// A word at the start of a line that belongs further out: the block was not closed.
bool starts_outer(const Parser& parser, Level level) {
  if (level == Level::file || !parser.peek().starts_line || !parser.is(TokenKind::identifier)) return false;
  const std::string_view word = parser.word();
  const bool named = parser.is(TokenKind::identifier, 1);
  if (level == Level::fields) return named && (begins_declaration(word) || begins_item(word)) && !parser.is(TokenKind::colon, 1);
  const bool opens_state = word == "state" && parser.is(TokenKind::left_brace, 2);
  if (begins_statement(word) && !opens_state) return false;
  if (level == Level::graph) return begins_declaration(word) && (named || parser.is(TokenKind::string, 1));
  return (begins_item(word) || begins_declaration(word)) && named;
}

// `pass NAME :`, `image NAME[`: never inside a pass, however many braces seem to be open.
bool starts_named_item(const Parser& parser) {
  const bool declares = parser.is_word("pass") || parser.is_word("image") || parser.is_word("buffer");
  return declares && parser.is(TokenKind::identifier, 1) && (parser.is(TokenKind::colon, 2) || parser.is(TokenKind::left_bracket, 2));
}

void resynchronise(Parser& parser, Level level) {
  parser.lost_names |= level != Level::pass;
  uint32_t depth = 0;
  for (; !parser.done(); parser.take()) {
    if (parser.is(TokenKind::left_brace)) ++depth;
    if (parser.is(TokenKind::right_brace) && depth-- == 0) break;
    if (!parser.peek().starts_line || !parser.is(TokenKind::identifier)) continue;
    if (starts_outer(parser, level) || (level == Level::graph && starts_named_item(parser))) break;
    if (depth > 0) continue;
    const std::string_view word = parser.word();
    if (level == Level::file && begins_declaration(word)) break;
    if (level == Level::graph && begins_item(word)) break;
    if (level == Level::pass && begins_statement(word)) break;
    if (level == Level::fields && (parser.is(TokenKind::colon, 1) || begins_statement(word))) break;
  }
  parser.silent = false;
}

// To the `{` on this line, if there is one.
bool skip_to_block(Parser& parser) {
  size_t ahead = 0;
  while (!parser.is(TokenKind::left_brace, ahead) && !parser.is(TokenKind::end_of_file, ahead) && !parser.is(TokenKind::right_brace, ahead) &&
         !(ahead > 0 && parser.peek(ahead).starts_line))
    ++ahead;
  if (!parser.is(TokenKind::left_brace, ahead)) return false;
  parser.at += ahead;
  return true;
}

// A line that can only stand inside the block: its `{` was forgotten.
bool block_follows(const Parser& parser) {
  if (!parser.peek().starts_line || !parser.is(TokenKind::identifier)) return false;
  return begins_statement(parser.word()) || begins_item(parser.word()) || parser.is(TokenKind::colon, 1);
}

void forgot_brace(Parser& parser) {
  const Token& last = parser.tokens[parser.at - 1];
  Diagnostic diagnostic(DiagnosticKind::ExpectedAfter, parser.span(last), {"`{`", std::string(text_of(last, parser.text).substr(0, 40))});
  diagnostic.fix({parser.file, last.end, last.end}, " {");
  parser.complain(std::move(diagnostic));
  parser.silent = false;
}

// After a wrong heading the block, if it follows, is still worth reading.
bool open_block(Parser& parser) {
  if (parser.silent && !skip_to_block(parser)) return false;
  if (!parser.silent && parser.at > 0 && block_follows(parser)) return forgot_brace(parser), true;
  const bool opened = parser.expect(TokenKind::left_brace) || (skip_to_block(parser) && parser.accept(TokenKind::left_brace));
  const bool follows = opened || (parser.is(TokenKind::identifier) && (begins_statement(parser.word()) || begins_item(parser.word())));
  if (follows) parser.silent = false;
  return follows;
}

void close_list(Parser& parser, TokenKind close) {
  if (!parser.silent && !parser.accept(close)) parser.expected(std::string("`,` or ") + describe(close));
}

// As far in as the line that opens the block.
std::string indentation(const Parser& parser, Span open) {
  const size_t line = parser.text.rfind('\n', open.begin);
  const size_t begin = line == std::string_view::npos ? 0 : line + 1;
  const size_t word = parser.text.find_first_not_of(" \t", begin);
  return std::string(parser.text.substr(begin, word - begin));
}

void close_block(Parser& parser, Span open) {
  if (parser.accept(TokenKind::right_brace)) return;
  const bool known = parser.lost_structure;
  parser.lost_structure = true;
  if (parser.silent || known) return;
  if (parser.at == 0) return;
  const Token& last = parser.tokens[parser.at - 1];
  Diagnostic diagnostic(DiagnosticKind::BlockNotClosed, parser.span(last));
  diagnostic.note(DiagnosticKind::BlockOpensHere, open).fix({parser.file, last.end, last.end}, "\n" + indentation(parser, open) + "}");
  parser.complain(std::move(diagnostic));
  parser.silent = false;
}

}  // namespace rg::dsl
