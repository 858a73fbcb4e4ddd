// `extent NAME = runtime(...) min(...) max(...)`.
#include <algorithm>
#include <set>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

bool read_axes(Checker& checker, uint32_t module, const std::vector<ast::Expr>& axes, int64_t (&out)[3]) {
  constexpr int64_t kMaxExtent = 65536;
  for (size_t axis = 0; axis < axes.size(); ++axis) {
    const auto value = evaluate_integer(checker, nullptr, module, axes[axis], 1, kMaxExtent);
    if (!value) return false;
    out[axis] = *value;
  }
  return true;
}

bool axes_agree(Checker& checker, const ast::ExtentDeclaration& node, const Extent& extent) {
  const size_t axes = node.initial.size();
  if (axes > 3) {
    checker.report(DiagnosticKind::WrongOperand, node.initial[3].span, {"at most three axes"});
    return false;
  }
  for (const auto* bound : {&node.maximum, &node.minimum}) {
    if (bound->empty() || bound->size() == axes) continue;
    const char* what = bound == &node.maximum ? "maximum" : "minimum";
    checker.report(DiagnosticKind::ExtentAxes, node.span, {extent.name, std::to_string(axes), what, std::to_string(bound->size())});
    return false;
  }
  return true;
}

bool within_bounds(Checker& checker, const ast::ExtentDeclaration& node, const Extent& extent) {
  for (size_t axis = 0; axis < node.initial.size(); ++axis) {
    const bool over = extent.initial[axis] > extent.maximum[axis], under = extent.initial[axis] < extent.minimum[axis];
    if (!over && !under) continue;
    const int64_t bound = over ? extent.maximum[axis] : extent.minimum[axis];
    checker
        .report(over ? DiagnosticKind::ExtentOverMaximum : DiagnosticKind::ExtentUnderMinimum, node.initial[axis].span,
                {extent.name, std::to_string(extent.initial[axis]), std::to_string(bound)})
        .note(DiagnosticKind::BoundIsHere, over ? node.maximum[axis].span : node.minimum[axis].span, {over ? "maximum" : "minimum"});
    return false;
  }
  return true;
}

bool read_extent(Checker& checker, const Symbol& symbol, const ast::ExtentDeclaration& node, Extent& extent) {
  extent.name = std::string(symbol.name.text);
  extent.span = symbol.name.span;
  extent.axes = static_cast<uint32_t>(node.initial.size());
  if (node.initial.empty()) return false;
  if (!axes_agree(checker, node, extent) || !read_axes(checker, symbol.module, node.initial, extent.initial)) return false;
  std::copy(std::begin(extent.initial), std::end(extent.initial), std::begin(extent.maximum));
  if (!read_axes(checker, symbol.module, node.maximum, extent.maximum)) return false;
  if (!read_axes(checker, symbol.module, node.minimum, extent.minimum)) return false;
  return within_bounds(checker, node, extent);
}

// Each as evaluate() counts them: three an extent.
std::set<size_t> axes_below(const Program& program, const std::vector<ExprId>& exprs) {
  std::set<size_t> axes;
  std::set<uint32_t> seen;
  std::vector<ExprId> open = exprs;
  while (!open.empty()) {
    const ExprId id = open.back();
    open.pop_back();
    if (!id.valid() || !seen.insert(id.value).second) continue;
    const Expr& expr = program.exprs[id];
    if (expr.op == ExprOp::extent) axes.insert(static_cast<size_t>(expr.value));
    open.insert(open.end(), {expr.a, expr.b});
  }
  return axes;
}

}  // namespace

std::vector<std::vector<int64_t>> telling_extents(const Program& program, const std::vector<ExprId>& exprs) {
  constexpr size_t kMostAxes = 6, kMostAxesOfThree = 4;
  const std::set<size_t> axes = axes_below(program, exprs);
  const std::vector<int64_t> initial = initial_extents(program);
  if (axes.empty()) return {initial};
  if (axes.size() > kMostAxes) return {initial, maximum_extents(program), minimum_extents(program)};
  std::vector<std::vector<int64_t>> telling{initial};
  for (const size_t axis : axes) {
    const Extent& extent = program.extents.rows[axis / 3];
    const int64_t least = extent.minimum[axis % 3], most = extent.maximum[axis % 3];
    std::set<int64_t> values{least, most};
    if (axes.size() <= kMostAxesOfThree) values.insert(std::max(most - 1, least));
    std::vector<std::vector<int64_t>> next;
    for (const auto& before : telling)
      for (auto value = values.rbegin(); value != values.rend(); ++value) next.push_back(before), next.back()[axis] = *value;
    telling = std::move(next);
  }
  telling.insert(telling.begin(), initial);
  return telling;
}

std::string where_extents(const Program& program, const std::vector<ExprId>& exprs, const std::vector<int64_t>& values) {
  std::set<size_t> extents;
  for (const size_t axis : axes_below(program, exprs)) extents.insert(axis / 3);
  std::string text;
  for (const size_t id : extents) {
    text += (text.empty() ? " where `" : ", `") + program.extents.rows[id].name + "` is ";
    for (size_t axis = 0; axis < program.extents.rows[id].axes; ++axis) text += (axis ? "x" : "") + std::to_string(values[3 * id + axis]);
  }
  return text;
}

ExtentId extent_of(Checker& checker, uint32_t symbol) {
  if (begin_declaration(checker, symbol)) {
    const auto& node = std::get<ast::ExtentDeclaration>(*checker.symbols[symbol].declaration);
    Extent extent;
    if (read_extent(checker, checker.symbols[symbol], node, extent))
      checker.symbols[symbol].id = checker.program.extents.add(std::move(extent)).value;
    checker.symbols[symbol].progress = Symbol::Progress::done;
  }
  const uint32_t id = checker.symbols[symbol].id;
  return id == UINT32_MAX ? ExtentId{} : ExtentId{size_t{id}};
}

}  // namespace rg::dsl
