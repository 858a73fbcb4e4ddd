#include "compiler/expressions.h"

namespace rg::compiler {
namespace {

ExprOp convert(dsl::ExprOp op) {
  switch (op) {
    case dsl::ExprOp::constant:
      return ExprOp::constant;
    case dsl::ExprOp::extent:
      return ExprOp::extent;
    case dsl::ExprOp::add:
      return ExprOp::add;
    case dsl::ExprOp::sub:
      return ExprOp::sub;
    case dsl::ExprOp::mul:
      return ExprOp::mul;
    case dsl::ExprOp::floor_div:
      return ExprOp::floor_div;
    case dsl::ExprOp::ceil_div:
      return ExprOp::ceil_div;
    case dsl::ExprOp::min:
      return ExprOp::min;
    case dsl::ExprOp::max:
      return ExprOp::max;
    case dsl::ExprOp::mip:
      return ExprOp::mip;
  }
  return ExprOp::constant;
}

int64_t apply(dsl::ExprOp op, int64_t a, int64_t b) {
  const Expr rows[] = {{ExprOp::constant, kNone, kNone, a}, {ExprOp::constant, kNone, kNone, b}, {convert(op), 0, 1, 0}};
  return evaluate(rows, 2, {});
}

}  // namespace

std::vector<Expr> convert_expressions(const dsl::Program& program) {
  std::vector<Expr> rows;
  rows.reserve(program.exprs.size());
  for (const dsl::Expr& e : program.exprs) rows.push_back({convert(e.op), index_of(e.a), index_of(e.b), e.value});
  return rows;
}

std::optional<int64_t> constant_value(const dsl::Program& program, dsl::ExprId id) {
  if (!id.valid()) return std::nullopt;
  const dsl::Expr& e = program.exprs[id];
  if (e.op == dsl::ExprOp::constant) return e.value;
  if (e.op == dsl::ExprOp::extent) return std::nullopt;
  const auto a = constant_value(program, e.a), b = constant_value(program, e.b);
  if (!a || !b) return std::nullopt;
  return apply(e.op, *a, *b);
}

std::vector<int64_t> initial_values(const dsl::Program& program) {
  std::vector<int64_t> values;
  for (const dsl::Extent& extent : program.extents) values.insert(values.end(), extent.initial, extent.initial + 3);
  return values;
}

Index Expressions::add(const Expr& expr) {
  const auto [found, is_new] = added_.try_emplace({expr.op, expr.a, expr.b, expr.value}, static_cast<Index>(rows_.size()));
  if (is_new) rows_.push_back(expr);
  return found->second;
}

}  // namespace rg::compiler
