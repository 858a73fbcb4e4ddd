// Graphs: items are walked twice, first for resources, then for passes, so that a pass may come before what it uses is declared.
#include <algorithm>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

constexpr int64_t kMaxUnrolled = 65536;  // loop bodies and technique instances of one graph
constexpr uint32_t kMaxUseDepth = 16;

enum class Phase : uint8_t { resources, passes };
struct Walker {
  Checker& checker;
  GraphScope& scope;
  Phase phase;
};

void walk(Walker at, const std::vector<ast::Item>& items);

void visit(Walker at, const ast::ResourceDeclaration& node) {
  if (at.phase == Phase::resources) declare_resource(at.checker, at.scope, node);
}

void visit(Walker at, const ast::PassDeclaration& node) {
  if (at.phase == Phase::passes) declare_pass(at.checker, at.scope, node);
}

bool count_unrolled(Walker at, int64_t count, Span span) {
  at.scope.unrolled += static_cast<uint64_t>(std::max<int64_t>(count, 0));
  if (at.scope.unrolled <= static_cast<uint64_t>(kMaxUnrolled)) return true;
  at.checker.report(DiagnosticKind::LoopTooLong, span, {std::to_string(kMaxUnrolled)});
  at.scope.incomplete = true;
  return false;
}

void visit(Walker at, const ast::For& node) {
  if (node.variable.empty()) return void(at.scope.incomplete = true);
  const auto first = evaluate_integer(at.checker, &at.scope, at.scope.module, node.first, INT32_MIN, INT32_MAX);
  const auto last = evaluate_integer(at.checker, &at.scope, at.scope.module, node.last, INT32_MIN, INT32_MAX);
  if (!first || !last) return void(at.scope.incomplete = true);
  if (*last < *first) {
    at.checker.report(DiagnosticKind::LoopBackwards, node.span, {std::to_string(*first), std::to_string(*last)});
    return;
  }
  if (!count_unrolled(at, *last - *first, node.span)) return;
  at.scope.bindings.push_back({node.variable.text, Binding::Kind::integer, 0, {}, false, {}, node.variable.span});
  const size_t slot = at.scope.bindings.size() - 1;
  for (int64_t i = *first; i < *last; ++i) {
    at.scope.bindings[slot].value = i;
    walk(at, node.body);
  }
  at.scope.bindings.pop_back();
}

std::optional<uint32_t> value_index(Walker at, const ast::When& node, const Feature& feature) {
  const bool is_bool = feature.values.size() == 2 && feature.values[0] == "off" && feature.values[1] == "on";
  if (node.value.empty() && is_bool) return 1;
  if (node.value.empty()) {
    at.checker.report(DiagnosticKind::FeatureNeedsValue, node.feature.span, {feature.name});
    return std::nullopt;
  }
  const auto found = std::find(feature.values.begin(), feature.values.end(), node.value.text);
  if (found != feature.values.end()) return static_cast<uint32_t>(found - feature.values.begin());
  const std::vector<std::string_view> candidates(feature.values.begin(), feature.values.end());
  Diagnostic diagnostic(DiagnosticKind::UnknownName, node.value.span, {"value of feature `" + feature.name + "`", std::string(node.value.text)});
  const std::string guess = closest(node.value.text, candidates);
  if (!guess.empty()) diagnostic.fix(node.value.span, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  return std::nullopt;
}

Guard::Term term_of(FeatureId id, const Feature& feature, uint32_t value, bool negated) {
  if (feature.values.size() == 2 && negated) return {id, 1 - value, false};  // the other value
  return {id, value, negated};
}

void walk_guarded(Walker at, Guard::Term term, const std::vector<ast::Item>& items) {
  at.scope.guard.terms.push_back(term);
  walk(at, items);
  at.scope.guard.terms.pop_back();
}

void visit(Walker at, const ast::When& node) {
  const auto symbol = find_symbol(at.checker, at.scope.module, node.feature, SymbolKind::feature);
  if (!symbol) return void(at.scope.incomplete = true);
  const FeatureId id = feature_of(at.checker, *symbol);
  const Feature feature = at.checker.program.features[id];
  const auto value = value_index(at, node, feature);
  if (!value) return void(at.scope.incomplete = true);
  walk_guarded(at, term_of(id, feature, *value, node.negated), node.body);
  walk_guarded(at, term_of(id, feature, *value, !node.negated), node.otherwise);
}

void visit(Walker at, const ast::IfHost& node) {
  const auto symbol = find_symbol(at.checker, at.scope.module, node.condition, SymbolKind::condition);
  if (!symbol) return void(at.scope.incomplete = true);
  at.scope.conditions.push_back(condition_of(at.checker, *symbol));
  walk(at, node.body);
  at.scope.conditions.pop_back();
}

bool bind_place(Walker at, const ast::Parameter& parameter, const ast::Expr& argument, Binding& binding) {
  binding.kind = Binding::Kind::place;
  binding.writable = parameter.writable;
  binding.place = find_place(at.checker, at.scope, argument);
  if (!binding.place.ok()) return false;
  const Resource& resource = at.scope.graph.resources[binding.place.resource];
  const bool is_image = resource.kind == ResourceKind::image;
  if (is_image == (parameter.kind == ast::Parameter::Kind::image)) return true;
  at.checker.report(DiagnosticKind::ArgumentKind, argument.span,
                    {resource.name, is_image ? "an image" : "a buffer", std::string(parameter.name.text), is_image ? "a buffer" : "an image"});
  return false;
}

bool bind_params(Walker at, const ast::Expr& argument, Binding& binding) {
  binding.kind = Binding::Kind::params;
  const auto found = at.scope.params.find(spelled(argument));
  if (found != at.scope.params.end()) return binding.params = found->second, true;
  at.checker.report(DiagnosticKind::UnknownName, argument.span, {"parameter block", spelled(argument)});
  return false;
}

bool bind_argument(Walker at, const ast::Parameter& parameter, const ast::Expr& argument, Binding& binding) {
  binding.name = parameter.name.text;
  binding.span = parameter.span;
  using Kind = ast::Parameter::Kind;
  if (parameter.kind == Kind::image || parameter.kind == Kind::buffer) return bind_place(at, parameter, argument, binding);
  if (parameter.kind == Kind::params) return bind_params(at, argument, binding);
  if (parameter.kind != Kind::constant) {
    at.checker.report(DiagnosticKind::ParameterOfGraph, parameter.span, {std::string(parameter.name.text)});
    return false;
  }
  const auto value = evaluate_integer(at.checker, &at.scope, at.scope.module, argument, INT32_MIN, INT32_MAX);
  binding.value = value.value_or(0);
  return value.has_value();
}

std::optional<std::vector<Binding>> bind_arguments(Walker at, const ast::Use& node, const ast::GraphDeclaration& technique) {
  if (node.arguments.size() != technique.parameters.size()) {
    at.checker.report(DiagnosticKind::WrongArgumentCount, node.span, {spelled(node.technique), std::to_string(node.arguments.size())})
        .note(DiagnosticKind::DeclaredHere, technique.name.span, {std::string(technique.name.text)});
    return std::nullopt;
  }
  std::vector<Binding> bindings;
  for (size_t i = 0; i < node.arguments.size(); ++i) {
    Binding binding;
    if (!bind_argument(at, technique.parameters[i], node.arguments[i], binding)) return std::nullopt;
    bindings.push_back(std::move(binding));
  }
  return bindings;
}

// A technique sees its parameters and its own module, not the names around the `use`.
void walk_instance(Walker at, const Symbol& symbol, const ast::GraphDeclaration& technique, std::vector<Binding> bindings,
                   const std::string& instance) {
  const uint32_t module = at.scope.module;
  const std::string prefix = at.scope.prefix;
  std::swap(at.scope.bindings, bindings);
  at.scope.module = symbol.module;
  at.scope.prefix += instance + ".";
  ++at.scope.use_depth;
  walk(at, technique.body);
  --at.scope.use_depth;
  at.scope.prefix = prefix;
  at.scope.module = module;
  std::swap(at.scope.bindings, bindings);
}

void visit(Walker at, const ast::Use& node) {
  const auto id = find_symbol(at.checker, at.scope.module, node.technique, SymbolKind::technique);
  if (!id) return void(at.scope.incomplete = true);
  const Symbol symbol = at.checker.symbols[*id];
  const auto& technique = std::get<ast::GraphDeclaration>(*symbol.declaration);
  if (at.scope.use_depth >= kMaxUseDepth) {
    at.checker.report(DiagnosticKind::TechniqueTooDeep, node.span, {std::string(symbol.name.text), std::to_string(kMaxUseDepth)});
    return void(at.scope.incomplete = true);
  }
  if (!count_unrolled(at, 1, node.span)) return;
  auto bindings = bind_arguments(at, node, technique);
  if (!bindings || technique.has_error) return void(at.scope.incomplete = true);
  const std::string instance(node.instance.empty() ? symbol.name.text : node.instance.text);
  walk_instance(at, symbol, technique, std::move(*bindings), instance);
}

std::string argument_name(Walker at, const ast::Expr& expr) {
  if (expr.kind != ast::ExprKind::index) return spelled(expr);
  const auto index = evaluate_integer(at.checker, &at.scope, at.scope.module, expr.operands[1], 0, UINT32_MAX);
  return spelled(expr.operands[0]) + "[" + std::to_string(index.value_or(0)) + "]";
}

double unit_of(std::string_view unit) {
  constexpr double kKibi = 1024.0, kKilo = 1000.0;
  if (unit == "KiB") return kKibi;
  if (unit == "MiB") return kKibi * kKibi;
  if (unit == "GiB") return kKibi * kKibi * kKibi;
  if (unit == "KB") return kKilo;
  if (unit == "MB") return kKilo * kKilo;
  return unit == "GB" ? kKilo * kKilo * kKilo : 1.0;
}

void read_argument(Walker at, const ast::Expr& expr, Assertion& out) {
  const bool is_size = expr.kind == ast::ExprKind::dimensions || expr.kind == ast::ExprKind::list || expr.kind == ast::ExprKind::integer;
  if (!is_size) return out.arguments.push_back(argument_name(at, expr));
  const Value size = evaluate_expr(at.checker, &at.scope, at.scope.module, expr);
  for (uint8_t axis = 0; size.kind == Value::Kind::integer && axis < size.axes; ++axis) out.extent[axis] = size.at[axis].value;
}

void visit(Walker at, const ast::Assertion& node) {
  if (at.phase != Phase::passes || node.fact.empty()) return;
  Assertion assertion;
  assertion.is_error = node.is_error;
  assertion.fact = std::string(node.fact.text);
  assertion.comparison = std::string(node.comparison.text);
  assertion.text = std::string(node.text);
  assertion.span = node.span;
  for (const ast::Expr& argument : node.arguments) read_argument(at, argument, assertion);
  if (node.value) {
    const auto value = evaluate_number(at.checker, &at.scope, at.scope.module, *node.value);
    if (!value) return;
    assertion.value = *value * unit_of(node.unit.text);
  }
  at.scope.graph.assertions.push_back(std::move(assertion));
}

void walk(Walker at, const std::vector<ast::Item>& items) {
  for (const ast::Item& item : items) std::visit([&](const auto& node) { visit(at, node); }, item.node);
}

void finish_graph(Checker& checker, GraphScope& scope) {
  for (const Graph& other : checker.program.graphs)
    if (other.name == scope.graph.name) return;
  if (!scope.incomplete) {
    check_definitions(checker, scope.graph);
    check_unused(checker, scope);
    check_block_layouts(checker, scope.graph);
  }
  checker.program.graphs.add(std::move(scope.graph));
}

}  // namespace

void check_graph(Checker& checker, uint32_t symbol) {
  const auto& node = std::get<ast::GraphDeclaration>(*checker.symbols[symbol].declaration);
  GraphScope scope;
  scope.module = checker.symbols[symbol].module;
  scope.graph.name = std::string(node.name.text);
  scope.graph.span = node.name.span;
  scope.incomplete = node.has_error || checker.lost_names;
  declare_parameters(checker, scope, node);
  walk({checker, scope, Phase::resources}, node.body);
  scope.unrolled = 0;
  walk({checker, scope, Phase::passes}, node.body);
  finish_graph(checker, scope);
}

}  // namespace rg::dsl
