// expression := term { (+ | -) term }      term := factor { (* | / | %) factor }      factor := - factor | place | number | (list) | [list]
#include <charconv>

#include "dsl/parser_state.h"

namespace rg::dsl {
namespace {

using ast::Expr;
using ast::ExprKind;

Expr leaf(Parser& parser, ExprKind kind) {
  Expr expr;
  expr.kind = kind;
  expr.span = parser.here();
  expr.text = parser.word();
  return expr;
}

bool to_integer(std::string_view text, int64_t& value) {
  int base = 10;
  if (text.substr(0, 2) == "0x") text.remove_prefix(2), base = 16;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

Expr parse_integer(Parser& parser) {
  Expr expr = leaf(parser, ExprKind::integer);
  if (!to_integer(expr.text, expr.integer)) {
    parser.complain({DiagnosticKind::NumberTooLarge, expr.span, {std::string(expr.text.substr(0, 40))}});
    expr.kind = ExprKind::error;
  }
  expr.real = static_cast<double>(expr.integer);
  parser.take();
  return expr;
}

Expr parse_real(Parser& parser) {
  Expr expr = leaf(parser, ExprKind::real);
  const auto result = std::from_chars(expr.text.data(), expr.text.data() + expr.text.size(), expr.real);
  if (result.ec != std::errc()) {
    parser.complain({DiagnosticKind::NumberTooLarge, expr.span, {std::string(expr.text.substr(0, 40))}});
    expr.kind = ExprKind::error;
  }
  parser.take();
  return expr;
}

Expr parse_dimensions(Parser& parser) {
  Expr expr = leaf(parser, ExprKind::dimensions);
  std::string_view rest = expr.text;
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find('x'));
    Expr axis;
    axis.kind = ExprKind::integer;
    axis.span = expr.span;
    if (!to_integer(part, axis.integer)) parser.complain({DiagnosticKind::NumberTooLarge, expr.span, {std::string(part.substr(0, 40))}});
    expr.operands.push_back(std::move(axis));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
  }
  parser.take();
  return expr;
}

// Inside brackets: as deep as the deepest of them.
Expr parse_part(Parser& parser, const char* what = "an expression") {
  const uint32_t others = parser.operators;
  Expr part = parse_expression(parser, what);
  parser.operators = std::max(others, parser.operators);
  return part;
}

Expr parse_list(Parser& parser, TokenKind close) {
  const Span open = parser.here();
  parser.take();
  Expr list;
  list.kind = ExprKind::list;
  do {
    list.operands.push_back(parse_part(parser));
  } while (!parser.silent && parser.accept(TokenKind::comma));
  close_list(parser, close);
  list.span = parser.since(open.begin);
  if (close == TokenKind::right_paren && list.operands.size() == 1) {
    Expr inner = std::move(list.operands[0]);
    inner.span = list.span;
    return inner;
  }
  return list;
}

Expr unary(Parser& parser, ExprKind kind, Expr operand, uint32_t begin) {
  Expr expr;
  expr.kind = kind;
  expr.operands.push_back(std::move(operand));
  expr.span = parser.since(begin);
  return expr;
}

Expr parse_suffix(Parser& parser, Expr base) {
  const uint32_t begin = base.span.begin;
  if (parser.accept(TokenKind::dot)) {
    const ast::Name member = parser.expect_name("the name of a part");
    Expr expr = unary(parser, ExprKind::member, std::move(base), begin);
    expr.text = member.text;
    if (member.empty()) expr.kind = ExprKind::error;
    return expr;
  }
  if (parser.accept(TokenKind::left_bracket)) {
    Expr index = parse_part(parser, "an index");
    parser.expect(TokenKind::right_bracket);
    Expr expr = unary(parser, ExprKind::index, std::move(base), begin);
    expr.operands.push_back(std::move(index));
    return expr;
  }
  std::vector<Expr> arguments = parse_arguments(parser);
  Expr expr = unary(parser, ExprKind::call, std::move(base), begin);
  for (Expr& argument : arguments) expr.operands.push_back(std::move(argument));
  return expr;
}

// Of a place only members are called: what follows `clear NAME` in parentheses is the value.
Expr parse_suffixes(Parser& parser, Expr expr, bool calls_names) {
  uint32_t length = 0;
  const auto follows = [&] {
    if (parser.is(TokenKind::left_paren)) return calls_names || expr.kind == ExprKind::member;
    return parser.is(TokenKind::dot) || parser.is(TokenKind::left_bracket);
  };
  while (!parser.silent && follows()) {
    if (++length > kMaxNesting) {
      parser.complain({DiagnosticKind::NestingTooDeep, parser.here(), {std::to_string(kMaxNesting)}});
      break;
    }
    expr = parse_suffix(parser, std::move(expr));
  }
  return expr;
}

Expr parse_named(Parser& parser, const char* what, bool calls_names) {
  Expr expr = leaf(parser, ExprKind::name);
  if (!parser.is(TokenKind::identifier) || parser.next_begins()) {
    parser.expected(what);
    expr.kind = ExprKind::error;
    return expr;
  }
  parser.take();
  return parse_suffixes(parser, std::move(expr), calls_names);
}

Expr parse_primary(Parser& parser, const char* what) {
  switch (parser.peek().kind) {
    case TokenKind::integer:
      return parse_integer(parser);
    case TokenKind::real:
      return parse_real(parser);
    case TokenKind::dimensions:
      return parse_dimensions(parser);
    case TokenKind::left_paren:
      return parse_suffixes(parser, parse_list(parser, TokenKind::right_paren), false);
    case TokenKind::left_bracket:
      return parse_list(parser, TokenKind::right_bracket);
    default:
      return parse_named(parser, what, true);
  }
}

Expr parse_factor(Parser& parser, const char* what) {
  const Nested nested(parser);
  if (!nested.fits) return {};
  parser.operators = 0;
  const uint32_t begin = parser.peek().begin;
  if (!parser.accept(TokenKind::minus)) return parse_primary(parser, what);
  return unary(parser, ExprKind::negate, parse_factor(parser, what), begin);
}

Expr binary(Parser& parser, ExprKind kind, Expr left, Expr right) {
  Expr expr = unary(parser, kind, std::move(left), 0);
  expr.span = {parser.file, expr.operands[0].span.begin, std::max(expr.operands[0].span.end, right.span.end)};
  expr.operands.push_back(std::move(right));
  return expr;
}

// One operator above operands that are `left` and parser.operators deep.
bool too_long(Parser& parser, uint32_t left) {
  parser.operators = std::max(left, parser.operators) + 1;
  if (parser.operators <= kMaxOperators) return false;
  parser.complain({DiagnosticKind::TooManyOperators, parser.here(), {std::to_string(kMaxOperators)}});
  return true;
}

Expr parse_term(Parser& parser, const char* what) {
  Expr left = parse_factor(parser, what);
  const auto joins = [&] { return parser.is(TokenKind::star) || parser.is(TokenKind::slash) || parser.is(TokenKind::percent); };
  while (!parser.silent && joins()) {
    const ExprKind kind = parser.is(TokenKind::star) ? ExprKind::mul : parser.is(TokenKind::slash) ? ExprKind::div : ExprKind::mod;
    const uint32_t deep = parser.operators;
    parser.take();
    left = binary(parser, kind, std::move(left), parse_factor(parser, "an operand"));
    if (too_long(parser, deep)) break;
  }
  return left;
}

}  // namespace

Expr parse_place(Parser& parser, const char* what) { return parse_named(parser, what, false); }

std::vector<Expr> parse_arguments(Parser& parser) {
  std::vector<Expr> arguments;
  if (!parser.expect(TokenKind::left_paren)) return arguments;
  if (parser.accept(TokenKind::right_paren)) return arguments;
  do {
    arguments.push_back(parse_part(parser));
  } while (!parser.silent && parser.accept(TokenKind::comma));
  close_list(parser, TokenKind::right_paren);
  return arguments;
}

std::vector<Expr> parse_indices(Parser& parser) {
  std::vector<Expr> indices;
  while (!parser.silent && indices.size() < kMaxNesting && parser.accept(TokenKind::left_bracket)) {
    indices.push_back(parse_expression(parser, "an index"));
    parser.expect(TokenKind::right_bracket);
  }
  return indices;
}

Expr parse_expression(Parser& parser, const char* what) {
  const Nested nested(parser);
  if (!nested.fits) return {};
  Expr left = parse_term(parser, what);
  while (!parser.silent && (parser.is(TokenKind::plus) || parser.is(TokenKind::minus))) {
    const ExprKind kind = parser.is(TokenKind::plus) ? ExprKind::add : ExprKind::sub;
    const uint32_t deep = parser.operators;
    parser.take();
    left = binary(parser, kind, std::move(left), parse_term(parser, "an operand"));
    if (too_long(parser, deep)) break;
  }
  return left;
}

}  // namespace rg::dsl
