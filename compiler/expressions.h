// Program expressions in the plan's form; ids are kept, so that a program's ExprId is an index into Plan::exprs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::compiler {

std::vector<Expr> convert_expressions(const dsl::Program& program);
inline Index index_of(dsl::ExprId id) { return id.valid() ? id.value : kNone; }

// The value of an expression that depends on no extent.
std::optional<int64_t> constant_value(const dsl::Program& program, dsl::ExprId id);

// `initial` of every extent, 3 values each.
std::vector<int64_t> initial_values(const dsl::Program& program);

// Appends to a plan's expressions, reusing equal nodes among those it added.
class Expressions {
 public:
  explicit Expressions(std::vector<Expr> rows) : rows_(std::move(rows)) {}
  Index constant(int64_t value) { return add({ExprOp::constant, kNone, kNone, value}); }
  Index binary(ExprOp op, Index a, Index b) { return add({op, a, b, 0}); }
  Index mip(Index size, uint32_t level) { return level == 0 || size == kNone ? size : binary(ExprOp::mip, size, constant(level)); }
  std::vector<Expr> take() { return std::move(rows_); }

 private:
  Index add(const Expr& expr);
  std::vector<Expr> rows_;
  std::map<std::tuple<ExprOp, Index, Index, int64_t>, Index> added_;
};

}  // namespace rg::compiler
