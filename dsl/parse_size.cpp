// Sizes, and the many ways in which several axes are written elsewhere.
#include <cctype>

#include "dsl/parser_state.h"

namespace rg::dsl {
namespace {

// How numbers in a row are held together; a bit each.
enum Joint : unsigned { joined = 1, bare = 2, commas = 4, words = 8, parentheses = 16 };
struct Axes {
  std::vector<std::string_view> numbers;
  unsigned joints = 0;
  size_t tokens = 0;
};

bool is_hexadecimal(std::string_view word) { return word.starts_with("0x"); }

void add_numbers(Axes& axes, const Parser& parser, size_t ahead) {
  const std::string_view word = parser.word(ahead);
  if (parser.is(TokenKind::integer, ahead)) return axes.numbers.push_back(word);  // `0x40` is one
  for (size_t at = 0; at <= word.size();) {
    const size_t end = std::min(word.find('x', at), word.size());
    axes.numbers.push_back(word.substr(at, end - at));
    at = end + 1;
  }
}

bool is_number(const Parser& parser, size_t ahead) {
  return !parser.peek(ahead).starts_line && (parser.is(TokenKind::integer, ahead) || parser.is(TokenKind::dimensions, ahead));
}

// `x64`, which is a word where it does not touch the number before it.
bool is_axis_word(std::string_view word) {
  return word.size() > 1 && (word[0] == 'x' || word[0] == 'X') &&
         std::all_of(word.begin() + 1, word.end(), [](unsigned char c) { return std::isdigit(c); });
}

// One more number; false where none follows. In groups a word may be a constant's name.
bool add_axis(const Parser& parser, AxesForm form, Axes& axes) {
  size_t ahead = axes.tokens;
  if (parser.peek(ahead).starts_line) return false;
  if (parser.is(TokenKind::identifier, ahead) && form == AxesForm::group) return false;
  if (parser.is(TokenKind::identifier, ahead) && is_axis_word(parser.word(ahead))) {
    axes.numbers.push_back(parser.word(ahead).substr(1));
    axes.joints |= words, axes.tokens = ahead + 1;
    return true;
  }
  const bool by = parser.is_word("x", ahead) || parser.is_word("X", ahead) || parser.is_word("by", ahead);
  const unsigned joint = by ? words : parser.is(TokenKind::comma, ahead) ? commas : bare;
  if (joint != bare) ++ahead;
  if (!is_number(parser, ahead)) return false;
  add_numbers(axes, parser, ahead);
  axes.joints |= joint | (parser.is(TokenKind::dimensions, ahead) ? joined : 0u), axes.tokens = ahead + 1;
  return true;
}

// What stands here, if it is numbers and nothing else.
Axes axes_here(const Parser& parser, AxesForm form) {
  Axes axes;
  const bool opens = parser.is(TokenKind::left_paren) || parser.is(TokenKind::left_bracket);
  axes.tokens = opens ? 1 : 0;
  if (!is_number(parser, axes.tokens)) return {};
  add_numbers(axes, parser, axes.tokens);
  axes.joints = (opens ? parentheses : 0u) | (parser.is(TokenKind::dimensions, axes.tokens) ? joined : 0u);
  ++axes.tokens;
  while (add_axis(parser, form, axes)) continue;
  if (!opens) return axes;
  if (!parser.is(TokenKind::right_paren, axes.tokens) && !parser.is(TokenKind::right_bracket, axes.tokens)) return {};
  ++axes.tokens;
  return axes;
}

std::string join(const std::vector<std::string_view>& numbers, const char* between) {
  std::string text;
  for (const std::string_view number : numbers) text += (text.empty() ? "" : between) + std::string(number);
  return text;
}

std::string written(const Axes& axes, AxesForm form) {
  if (form == AxesForm::size) return join(axes.numbers, "x");
  return form == AxesForm::group ? join(axes.numbers, " ") : "(" + join(axes.numbers, ", ") + ")";
}

// `0x64` is a number, and where a size stands two axes are meant.
bool complain_about_zero_axis(Parser& parser) {
  const std::string_view word = parser.is(TokenKind::integer) ? parser.word() : std::string_view();
  const bool axes = is_hexadecimal(word) && std::all_of(word.begin() + 2, word.end(), [](unsigned char c) { return std::isdigit(c); });
  if (axes) parser.complain({DiagnosticKind::OutOfRange, parser.here(), {"the axis 0 of `" + std::string(word.substr(0, 40)) + "`", "1", "65536"}});
  return axes;
}

}  // namespace

bool complain_about_axes(Parser& parser, AxesForm form) {
  const Axes axes = axes_here(parser, form);
  if (axes.numbers.size() < 2 || axes.numbers.size() > 3) return false;
  constexpr unsigned kRight[] = {joined, bare, commas | parentheses};
  const bool list = form == AxesForm::size && (axes.joints & parentheses) != 0;  // of expressions
  if (list || axes.joints == kRight[static_cast<size_t>(form)]) return false;
  const Span span{parser.file, parser.here().begin, parser.peek(axes.tokens - 1).end};
  Diagnostic diagnostic(DiagnosticKind::AxesApart, span, {written(axes, form)});
  diagnostic.fix(span, written(axes, form));
  parser.complain(std::move(diagnostic));
  return true;
}

ast::Expr parse_size(Parser& parser) {
  if (complain_about_zero_axis(parser)) return {};
  if (complain_about_axes(parser, AxesForm::size)) return {};
  return parse_expression(parser, "a size");
}

namespace {

std::vector<ast::Expr> parse_axes(Parser& parser) {
  if (complain_about_axes(parser, AxesForm::arguments)) return {};
  return parse_arguments(parser);
}

}  // namespace

ast::ExtentDeclaration parse_extent(Parser& parser) {
  ast::ExtentDeclaration extent;
  parser.take();
  extent.name = parser.expect_name("the name of the extent");
  parser.expect(TokenKind::equal);
  const uint32_t begin = parser.peek().begin;
  if (!parser.silent && !parser.expect_one_of("`runtime`", {"runtime"}).empty()) extent.initial = parse_axes(parser);
  for (bool more = true; more && !parser.silent;) {
    more = false;
    if (extent.minimum.empty() && parser.is_word("min")) parser.take(), extent.minimum = parse_axes(parser), more = true;
    if (extent.maximum.empty() && parser.is_word("max")) parser.take(), extent.maximum = parse_axes(parser), more = true;
  }
  extent.span = parser.since(begin);
  return extent;
}

}  // namespace rg::dsl
