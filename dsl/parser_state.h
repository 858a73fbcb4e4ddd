// Private to the parse_*.cpp files: the cursor, and how it complains.
//
// After a complaint the parser is `silent`: expectations that fail say nothing more, and nothing is consumed by them, until the
// enclosing block has found the next statement and `resume`s.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>

#include "dsl/ast.h"
#include "dsl/closest.h"
#include "dsl/diagnostics.h"
#include "dsl/token.h"

namespace rg::dsl {

constexpr uint32_t kMaxNesting = 100;     // of expressions and blocks; bounds the stack
constexpr uint32_t kMaxOperators = 1000;  // above one another in an expression; sums nest to the left in the tree, which recursive readers walk

struct Parser {
  FileId file;
  std::string_view text;
  const Tokens& tokens;
  Diagnostics& diagnostics;
  size_t at = 0;
  uint32_t nesting = 0;
  uint32_t operators = 0;  // above one another in the tree of the last expression
  bool silent = false;
  bool any_error = false;
  bool lost_names = false;      // a declaration was skipped
  bool lost_structure = false;  // braces do not match: what stands inside what is a guess
  std::vector<ast::Allow> allows = {};

  const Token& peek(size_t ahead = 0) const { return tokens[std::min(at + ahead, tokens.size() - 1)]; }
  std::string_view word(size_t ahead = 0) const { return text_of(peek(ahead), text); }
  bool is(TokenKind kind, size_t ahead = 0) const { return peek(ahead).kind == kind; }
  bool is_word(std::string_view spelling, size_t ahead = 0) const { return is(TokenKind::identifier, ahead) && word(ahead) == spelling; }
  bool next_begins() const;
  bool done() const { return is(TokenKind::end_of_file); }
  Span span(const Token& token) const { return {file, token.begin, token.end}; }
  Span here() const { return span(peek()); }
  Span since(uint32_t begin) const;  // up to the last token taken
  uint32_t previous_end() const { return at == 0 ? 0 : tokens[at - 1].end; }

  void take() {
    if (!done()) ++at;
  }
  bool accept(TokenKind kind);
  bool accept_word(std::string_view spelling);
  bool expect(TokenKind kind);
  ast::Name take_name();
  ast::Name expect_name(const char* what);
  ast::Name expect_one_of(const char* what, std::initializer_list<std::string_view> words);

  void complain(Diagnostic diagnostic);
  void expected(const std::string& what);    // at the end of the line before, if that is where it is missing
  void unexpected(const std::string& what);  // at what is there instead
};

struct Nested {  // counts one level of nesting; complains when it is too deep
  Parser& parser;
  bool fits;
  explicit Nested(Parser& parser);
  ~Nested() { --parser.nesting; }
};

// What is allowed while this lives, and not further in, is allowed from `begin` to where it ends.
class AllowScope {
 public:
  explicit AllowScope(Parser& parser) : AllowScope(parser, parser.peek().begin) {}
  AllowScope(Parser& parser, uint32_t begin) : parser_(parser), begin_(begin), first_(parser.allows.size()) {}
  ~AllowScope();

 private:
  Parser& parser_;
  uint32_t begin_;
  size_t first_;
};
void parse_allow(Parser& parser);

// Words that begin a declaration, an item of a graph, a statement of a pass.
bool begins_declaration(std::string_view word);
bool begins_item(std::string_view word);
bool begins_statement(std::string_view word);
Guess closest_declaration(std::string_view word);  // did you mean
Guess closest_item(std::string_view word);
Guess closest_statement(std::string_view word);

// Skips to the next token that can begin something at this level, or to the `}` that closes it.
enum class Level : uint8_t { file, graph, pass, fields };
void resynchronise(Parser& parser, Level level);

// Runs `one` until the `}` that belongs to the `{` at `open`; `level` says where to pick up after a mistake.
template <class One>
void parse_block(Parser& parser, Level level, One one);

void close_list(Parser& parser, TokenKind close);  // of elements with commas between them
bool starts_outer(const Parser& parser, Level level);
bool open_block(Parser& parser);
void close_block(Parser& parser, Span open);

ast::Expr parse_expression(Parser& parser, const char* what = "an expression");
ast::ExtentDeclaration parse_extent(Parser& parser);  // after `extent`
ast::Expr parse_size(Parser& parser);
// Two or three numbers stand here, but not as they have to where sizes, groups or extents stand: `64 x 64`, `8x8x1`, `runtime 1920 1080`.
enum class AxesForm : uint8_t { size, group, arguments };
bool complain_about_axes(Parser& parser, AxesForm form);
ast::Expr parse_place(Parser& parser, const char* what);  // a name with `.member`, `[index]` and `.member(call)` behind it
std::vector<ast::Expr> parse_arguments(Parser& parser);   // `(a, b, c)`
std::vector<ast::Expr> parse_indices(Parser& parser);     // `[i]`, `[i][j]`, or nothing
ast::TypeName parse_type(Parser& parser);
struct SettingShape {  // of one setting: its word, the second word where it has one, how many words and numbers follow
  std::string_view word, second;
  uint8_t names = 0, values = 0;
  bool repeats = false;  // the numbers may follow again behind a comma
};
// `{ setting setting ... }` of a sampler or a state.
std::vector<ast::Setting> parse_settings(Parser& parser, std::initializer_list<SettingShape> shapes, const char* what);
ast::Setting parse_setting(Parser& parser, const SettingShape& shape);
ast::Usage parse_usage(Parser& parser);
std::vector<ast::Name> parse_stages(Parser& parser);      // after `in`
ast::StructDeclaration parse_struct(Parser& parser);      // after `struct`
ast::ResourceDeclaration parse_resource(Parser& parser);  // after `image` or `buffer` of a graph
ast::ResourceDeclaration parse_member(Parser& parser);    // of an interface
ast::ResourceDeclaration parse_image_type(Parser& parser, ast::ResourceDeclaration image);
ast::PassDeclaration parse_pass(Parser& parser);  // after `pass`
ast::BundleDeclaration parse_bundle(Parser& parser);
void parse_pass_body(Parser& parser, ast::PassDeclaration& pass);
ast::FeatureTerm parse_feature_term(Parser& parser);  // `not fog`, `path == low`
ast::FeatureDeclaration parse_feature(Parser& parser);
ast::FeaturesStatement parse_features(Parser& parser);
ast::SpectrumStatement parse_spectrum_statement(Parser& parser);
ast::SpectrumDeclaration parse_spectrum(Parser& parser);
ast::FeatureTerm parse_feature_term(Parser& parser);
ast::Fuse parse_fuse(Parser& parser);  // after `fuse`
// Something on the same line that is not the next statement; `options` are what the statement could take, which begins at `begin`.
void complain_about_rest(Parser& parser, const std::vector<std::string_view>& options, uint32_t begin = UINT32_MAX);
ast::GraphDeclaration parse_graph(Parser& parser, bool is_technique);
void parse_items(Parser& parser, std::vector<ast::Item>& items);

template <class One>
void parse_block(Parser& parser, Level level, One one) {
  const Span open = parser.here();
  if (!open_block(parser)) return;
  const Nested nested(parser);
  while (nested.fits && !parser.is(TokenKind::right_brace) && !parser.done() && !starts_outer(parser, level)) {
    const size_t before = parser.at;
    one();
    if (parser.silent) resynchronise(parser, level);
    if (parser.at == before) parser.take();
  }
  close_block(parser, open);
}

}  // namespace rg::dsl
