#include "dsl/program.h"

#include <algorithm>

#include "dsl/check_macro.h"

namespace rg::dsl {
namespace {

int64_t floor_div(int64_t a, int64_t b) { return a / b - ((a % b != 0) && ((a < 0) != (b < 0)) ? 1 : 0); }

int64_t saturate(bool overflows, int64_t value, bool negative) {
  if (!overflows) return value;
  return negative ? INT64_MIN : INT64_MAX;
}

int64_t add(int64_t a, int64_t b) {
  int64_t out = 0;
  const bool overflows = __builtin_add_overflow(a, b, &out);
  return saturate(overflows, out, a < 0);
}

int64_t subtract(int64_t a, int64_t b) {
  int64_t out = 0;
  const bool overflows = __builtin_sub_overflow(a, b, &out);
  return saturate(overflows, out, a < 0);
}

int64_t multiply(int64_t a, int64_t b) {
  int64_t out = 0;
  const bool overflows = __builtin_mul_overflow(a, b, &out);
  return saturate(overflows, out, (a < 0) != (b < 0));
}

int64_t apply(const Expr& expr, int64_t a, int64_t b) {
  switch (expr.op) {
    case ExprOp::add:
      return add(a, b);
    case ExprOp::sub:
      return subtract(a, b);
    case ExprOp::mul:
      return multiply(a, b);
    case ExprOp::floor_div:
      return b == 0 ? 0 : floor_div(a, b);
    case ExprOp::ceil_div:
      return b == 0 ? 0 : floor_div(a, b) + (a % b != 0 ? 1 : 0);
    case ExprOp::min:
      return std::min(a, b);
    case ExprOp::max:
      return std::max(a, b);
    case ExprOp::mip:
      return std::max<int64_t>(b >= 63 ? 0 : a >> b, 1);
    case ExprOp::constant:
    case ExprOp::extent:
      break;
  }
  RG_CHECK(false, "an expression without operands is a constant or an extent");
  return 0;
}

// The nodes below `id`, ascending: operands come before their users.
std::vector<uint32_t> nodes_below(const Program& program, ExprId id) {
  std::vector<uint32_t> nodes{id.value};
  std::vector<uint32_t> open{id.value};
  while (!open.empty()) {
    const Expr& expr = program.exprs.rows[open.back()];
    open.pop_back();
    for (const ExprId operand : {expr.a, expr.b}) {
      if (!operand.valid()) continue;
      const auto at = std::lower_bound(nodes.begin(), nodes.end(), operand.value);
      if (at != nodes.end() && *at == operand.value) continue;
      nodes.insert(at, operand.value);
      open.push_back(operand.value);
    }
  }
  return nodes;
}

std::vector<int64_t> flatten(const Program& program, int64_t (Extent::*values)[3]) {
  std::vector<int64_t> flat;
  for (const Extent& extent : program.extents)
    for (int axis = 0; axis < 3; ++axis) flat.push_back((extent.*values)[axis]);
  return flat;
}

}  // namespace

Graph::Graph() = default;
Graph::Graph(const Graph&) = default;
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(const Graph&) = default;
Graph& Graph::operator=(Graph&&) noexcept = default;
Graph::~Graph() = default;
bool Graph::operator==(const Graph&) const = default;

Program::Program() = default;
Program::Program(const Program&) = default;
Program::Program(Program&&) noexcept = default;
Program& Program::operator=(const Program&) = default;
Program& Program::operator=(Program&&) noexcept = default;
Program::~Program() = default;
bool Program::operator==(const Program&) const = default;

int64_t evaluate(const Program& program, ExprId id, const std::vector<int64_t>& extent_values) {
  RG_CHECK(id.value < program.exprs.size(), "evaluate() needs a valid expression");
  if (program.exprs[id].op == ExprOp::constant) return program.exprs[id].value;
  const std::vector<uint32_t> nodes = nodes_below(program, id);
  std::vector<int64_t> values(nodes.size());
  const auto value_of = [&](ExprId operand) {
    if (!operand.valid()) return int64_t{0};
    return values[static_cast<size_t>(std::lower_bound(nodes.begin(), nodes.end(), operand.value) - nodes.begin())];
  };
  for (size_t i = 0; i < nodes.size(); ++i) {
    const Expr& expr = program.exprs.rows[nodes[i]];
    if (expr.op == ExprOp::constant)
      values[i] = expr.value;
    else if (expr.op == ExprOp::extent)
      values[i] = extent_values.at(static_cast<size_t>(expr.value));
    else
      values[i] = apply(expr, value_of(expr.a), value_of(expr.b));
  }
  return values.back();
}

std::vector<int64_t> initial_extents(const Program& program) { return flatten(program, &Extent::initial); }
std::vector<int64_t> maximum_extents(const Program& program) { return flatten(program, &Extent::maximum); }

}  // namespace rg::dsl
