#include "dsl/format.h"

#include <algorithm>

#include "dsl/check_macro.h"
#include "dsl/lexer.h"
#include "dsl/parser.h"

namespace rg::dsl {
namespace {

constexpr size_t kIndent = 2;
constexpr size_t kVerbWidth = 6;     // `read   x`, `atomic x`: statements of a pass line up
constexpr size_t kMaxColumn = 120;   // trailing comments are not pushed beyond
constexpr size_t kContinuation = 4;  // inside parentheses

enum class Context : uint8_t { file, graph, pass, fields, glsl };
enum class LineKind : uint8_t { blank, other, field, resource, setting };

struct Line {
  std::vector<Token> tokens;
  std::string_view comment;
  std::string_view raw;  // GLSL, kept as it is
  Context context = Context::file;
  size_t depth = 0;
  bool continued = false;
  bool is_raw = false;
  // filled while laying out
  std::string code;
  size_t align_at = std::string::npos;  // where this line's column begins in `code`
};

struct Formatter {
  std::string_view text;
  Tokens tokens;
  std::vector<Comment> comments;
  std::vector<Line> lines;
};

std::string_view trim_right(std::string_view text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

std::string_view word(const Formatter& at, const Token& token) { return text_of(token, at.text); }

// ---- lines ------------------------------------------------------------------------------------------------------

Context context_after(std::string_view first, Context outer) {
  if (first == "pass") return Context::pass;
  if (outer == Context::pass) return Context::fields;
  if (outer == Context::file && (first == "graph" || first == "technique")) return Context::graph;
  if (outer == Context::file && first == "set") return Context::glsl;
  return outer == Context::graph ? Context::graph : Context::fields;
}

struct Nesting {
  std::vector<Context> stack{Context::file};
  size_t parens = 0;
  std::string_view heading;  // first word of the last line that began something
};

bool opens(TokenKind kind) { return kind == TokenKind::left_paren || kind == TokenKind::left_bracket; }
bool closes(TokenKind kind) { return kind == TokenKind::right_paren || kind == TokenKind::right_bracket; }

void follow(const Formatter& at, const Line& line, Nesting& nesting) {
  const bool begins = !line.tokens.empty() && !line.continued && line.tokens[0].kind == TokenKind::identifier;
  if (begins) nesting.heading = word(at, line.tokens[0]);
  for (const Token& token : line.tokens) {
    if (opens(token.kind)) ++nesting.parens;
    if (closes(token.kind) && nesting.parens > 0) --nesting.parens;
    if (token.kind == TokenKind::left_brace) nesting.stack.push_back(context_after(nesting.heading, nesting.stack.back()));
    if (token.kind == TokenKind::right_brace && nesting.stack.size() > 1) nesting.stack.pop_back();
  }
}

void place(const Nesting& nesting, Line& line) {
  line.context = nesting.stack.back();
  line.depth = nesting.stack.size() - 1;
  line.continued = nesting.parens > 0 && !(line.tokens.size() == 1 && closes(line.tokens[0].kind));
  const bool closing = !line.tokens.empty() && line.tokens[0].kind == TokenKind::right_brace;
  if (closing && line.depth > 0) --line.depth;
}

void split_lines(Formatter& at) {
  size_t token = 0, comment = 0;
  Nesting nesting;
  for (size_t begin = 0; begin <= at.text.size();) {
    const size_t end = std::min(at.text.find('\n', begin), at.text.size());
    Line line;
    line.raw = at.text.substr(begin, end - begin);
    while (token + 1 < at.tokens.size() && at.tokens[token].begin < end) line.tokens.push_back(at.tokens[token++]);
    while (comment < at.comments.size() && at.comments[comment].begin < end) {
      line.comment = trim_right(at.text.substr(at.comments[comment].begin, at.comments[comment].end - at.comments[comment].begin));
      ++comment;
    }
    place(nesting, line);
    follow(at, line, nesting);
    const bool closes_set = line.context == Context::glsl && nesting.stack.back() != Context::glsl;
    line.is_raw = line.context == Context::glsl && !closes_set;
    at.lines.push_back(std::move(line));
    begin = end + 1;
  }
}

bool is_blank(const Line& line) { return !line.is_raw && line.tokens.empty() && line.comment.empty(); }
bool ends_open(const Line& line) { return !line.tokens.empty() && line.tokens.back().kind == TokenKind::left_brace; }
bool starts_closed(const Line& line) { return !line.tokens.empty() && line.tokens[0].kind == TokenKind::right_brace; }

// One blank line at most, none at either end of a block or of the file.
void drop_blank_lines(Formatter& at) {
  std::vector<Line> kept;
  for (Line& line : at.lines) {
    if (is_blank(line) && (kept.empty() || is_blank(kept.back()) || ends_open(kept.back()))) continue;
    if (starts_closed(line) && !kept.empty() && is_blank(kept.back())) kept.pop_back();
    kept.push_back(std::move(line));
  }
  while (!kept.empty() && is_blank(kept.back())) kept.pop_back();
  at.lines = std::move(kept);
}

// ---- the gap between two tokens ---------------------------------------------------------------------------------

bool is_operator(TokenKind kind) {
  switch (kind) {
    case TokenKind::plus:
    case TokenKind::star:
    case TokenKind::slash:
    case TokenKind::equal:
    case TokenKind::arrow:
    case TokenKind::less:
    case TokenKind::greater:
    case TokenKind::less_equal:
    case TokenKind::greater_equal:
    case TokenKind::equal_equal:
    case TokenKind::not_equal:
      return true;
    default:
      return false;
  }
}

bool spaced_colon(const Formatter& at, const Line& line, size_t index) {
  const std::string_view first = word(at, line.tokens[0]);
  const bool declares = first == "image" || first == "buffer" || first == "pass";
  return declares && line.context == Context::graph &&
         std::none_of(line.tokens.begin(), line.tokens.begin() + static_cast<long>(index),
                      [](const Token& token) { return token.kind == TokenKind::colon || token.kind == TokenKind::left_brace; });
}

// Settings and statements that share a line may stand two blanks apart.
bool separates(const Line& line, size_t index) {
  if (line.context == Context::fields) return true;
  return std::any_of(line.tokens.begin(), line.tokens.begin() + static_cast<long>(index),
                     [](const Token& token) { return token.kind == TokenKind::left_brace; });
}

size_t gap(const Formatter& at, const Line& line, size_t index) {
  const Token &left = line.tokens[index - 1], &right = line.tokens[index];
  const size_t source = right.begin - left.end;
  const TokenKind a = left.kind, b = right.kind;
  if (a == TokenKind::dot || b == TokenKind::dot || a == TokenKind::dot_dot || b == TokenKind::dot_dot) return 0;
  if (opens(a) || closes(b) || b == TokenKind::comma || b == TokenKind::semicolon) return 0;
  if (a == TokenKind::comma) return 1;
  if (b == TokenKind::colon) return spaced_colon(at, line, index) ? 1 : 0;
  if (a == TokenKind::left_brace || b == TokenKind::left_brace || b == TokenKind::right_brace) return 1;
  if (line.context == Context::fields && (word(at, right) == "ready" || word(at, right) == "written")) return 2;
  if (is_operator(a) || is_operator(b) || a == TokenKind::colon) return 1;
  if (opens(b)) return std::min<size_t>(source, 1);
  if (a == TokenKind::minus || b == TokenKind::minus) return std::min<size_t>(source, 1);  // unary or binary: as written
  return std::min<size_t>(source, separates(line, index) ? 2 : 1);
}

// ---- one line ---------------------------------------------------------------------------------------------------

LineKind kind_of(const Formatter& at, const Line& line) {
  if (line.tokens.empty()) return line.comment.empty() ? LineKind::blank : LineKind::other;
  if (line.continued || line.is_raw) return LineKind::other;
  const std::string_view first = word(at, line.tokens[0]);
  if (line.context == Context::fields && line.tokens.size() > 1 && line.tokens[1].kind == TokenKind::colon) return LineKind::field;
  if (line.context == Context::graph && (first == "image" || first == "buffer")) return LineKind::resource;
  const bool one_line = line.tokens.back().kind == TokenKind::right_brace;
  if (line.context == Context::file && one_line && (first == "state" || first == "sampler")) return LineKind::setting;
  return LineKind::other;
}

// The token before which a line of this kind lines up with its neighbours.
size_t aligned_token(const Line& line, LineKind kind) {
  const TokenKind wanted = kind == LineKind::resource ? TokenKind::colon : kind == LineKind::setting ? TokenKind::left_brace : TokenKind::end_of_file;
  if (kind == LineKind::field) return line.tokens.size() > 2 ? 2 : 0;
  for (size_t i = 0; i < line.tokens.size(); ++i)
    if (line.tokens[i].kind == wanted) return i;
  return 0;
}

size_t padded_first_word(const Line& line, LineKind kind, bool mixed_run) {
  if (line.continued || line.tokens.size() < 2) return 0;
  const Token& first = line.tokens[0];
  if (first.kind != TokenKind::identifier || line.tokens[1].kind == TokenKind::colon) return 0;
  if (line.context == Context::pass) return kVerbWidth;
  return kind == LineKind::resource && mixed_run ? kVerbWidth : 0;
}

void lay_out(const Formatter& at, Line& line, LineKind kind, bool mixed_run) {
  const size_t align = aligned_token(line, kind);
  line.code.assign(line.depth * kIndent + (line.continued ? kContinuation : 0), ' ');
  if (line.tokens.empty()) line.code.clear();
  const size_t width = padded_first_word(line, kind, mixed_run);
  const size_t first = line.tokens.empty() ? 0 : line.tokens[0].end - line.tokens[0].begin;
  for (size_t i = 0; i < line.tokens.size(); ++i) {
    if (i == 1 && width > 0)
      line.code.append(std::max(width, first) + 1 - first, ' ');
    else if (i > 0)
      line.code.append(gap(at, line, i), ' ');
    if (i == align && align > 0) line.align_at = line.code.size();
    line.code += word(at, line.tokens[i]);
  }
}

// ---- runs of lines ----------------------------------------------------------------------------------------------

size_t run_end(const Formatter& at, size_t begin, LineKind kind) {
  size_t end = begin + 1;
  while (end < at.lines.size() && kind_of(at, at.lines[end]) == kind && at.lines[end].depth == at.lines[begin].depth) ++end;
  return end;
}

bool is_mixed(const Formatter& at, size_t begin, size_t end) {
  const auto is_buffer = [&](const Line& line) { return word(at, line.tokens[0]) == "buffer"; };
  const auto first = at.lines.begin() + static_cast<long>(begin), last = at.lines.begin() + static_cast<long>(end);
  return std::any_of(first, last, is_buffer) && !std::all_of(first, last, is_buffer);
}

void align_run(Formatter& at, size_t begin, size_t end) {
  size_t column = 0;
  for (size_t i = begin; i < end; ++i)
    if (at.lines[i].align_at != std::string::npos) column = std::max(column, at.lines[i].align_at);
  for (size_t i = begin; i < end; ++i) {
    Line& line = at.lines[i];
    if (line.align_at != std::string::npos) line.code.insert(line.align_at, column - line.align_at, ' ');
  }
}

void lay_out_lines(Formatter& at) {
  for (size_t begin = 0; begin < at.lines.size();) {
    const LineKind kind = kind_of(at, at.lines[begin]);
    const bool in_run = kind != LineKind::other && kind != LineKind::blank;
    const size_t end = in_run ? run_end(at, begin, kind) : begin + 1;
    const bool mixed = kind == LineKind::resource && is_mixed(at, begin, end);
    for (size_t i = begin; i < end; ++i) lay_out(at, at.lines[i], kind, mixed);
    align_run(at, begin, end);
    begin = end;
  }
}

bool has_trailing_comment(const Line& line) { return !line.is_raw && !line.tokens.empty() && !line.comment.empty(); }

// Trailing comments line up between blank lines.
void add_comments(Formatter& at) {
  for (size_t begin = 0; begin < at.lines.size();) {
    size_t end = begin, column = 0;
    for (; end < at.lines.size() && !is_blank(at.lines[end]); ++end)
      if (has_trailing_comment(at.lines[end]) && at.lines[end].code.size() <= kMaxColumn) column = std::max(column, at.lines[end].code.size());
    for (; begin < end; ++begin) {
      Line& line = at.lines[begin];
      if (!has_trailing_comment(line)) continue;
      line.code.append(std::max(column, line.code.size()) - line.code.size() + kIndent, ' ');
      line.code += line.comment;
    }
    ++begin;
  }
}

std::string text_of_line(const Line& line) {
  if (line.is_raw) return std::string(trim_right(line.raw));
  if (!line.tokens.empty()) return line.code;
  if (line.comment.empty()) return {};
  return std::string(line.depth * kIndent + (line.continued ? kContinuation : 0), ' ') + std::string(line.comment);
}

std::string join(const Formatter& at) {
  std::string out;
  for (const Line& line : at.lines) out += text_of_line(line) + "\n";
  return out;
}

bool same_tokens(FileId file, std::string_view a, std::string_view b) {
  Diagnostics ignored;
  const Tokens left = lex(file, a, ignored), right = lex(file, b, ignored);
  return left.size() == right.size() &&
         std::equal(left.begin(), left.end(), right.begin(), [&](const Token& one, const Token& two) { return text_of(one, a) == text_of(two, b); });
}

}  // namespace

std::optional<std::string> format(FileId file, std::string_view text, Diagnostics& diagnostics) {
  Diagnostics found;
  Formatter at{text, lex(file, text, found), find_comments(text), {}};
  parse(file, text, at.tokens, found);
  for (const Diagnostic& diagnostic : found.rows()) diagnostics.report(diagnostic);
  if (found.has_errors()) return std::nullopt;
  split_lines(at);
  drop_blank_lines(at);
  lay_out_lines(at);
  add_comments(at);
  std::string out = join(at);
  RG_CHECK(same_tokens(file, text, out), "formatting changed more than blanks");
  return out;
}

}  // namespace rg::dsl
