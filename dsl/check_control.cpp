// Graphs: items are walked twice, first for resources, then for passes, so that a pass may come before what it uses is declared.
#include <algorithm>
#include <tuple>

#include "dsl/check_state.h"
#include "dsl/print.h"

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

void visit(Walker at, const ast::BundleDeclaration& node) {
  if (at.phase != Phase::resources || node.name.empty()) return;
  at.scope.bundles[at.scope.prefix + std::string(node.name.text)] = &node;
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

// What no feasible choice of features selects is checked, but a warning: nobody can ever see it run.
void walk_guarded(Walker at, Guard::Term term, const ast::When& node, const std::vector<ast::Item>& items) {
  const bool was_reachable = is_reachable(at.checker, at.scope.guard);
  at.scope.guard.terms.push_back(term);
  if (at.phase == Phase::passes && !items.empty() && was_reachable && !is_reachable(at.checker, at.scope.guard))
    at.checker.report(DiagnosticKind::NeverPlanned, node.term.span, {&items == &node.body ? "`when`" : "`else`"});
  walk(at, items);
  at.scope.guard.terms.pop_back();
}

void visit(Walker at, const ast::When& node) {
  const auto term = feature_term(at.checker, at.scope.module, node.term);
  if (!term) return void(at.scope.incomplete = true);
  walk_guarded(at, *term, node, node.body);
  walk_guarded(at, opposite(at.checker, *term), node, node.otherwise);
}

// `cache_miss[slot]`: the row of that index.
std::optional<ConditionId> condition_at(Walker at, const ast::IfHost& node, ConditionId first) {
  if (!first.valid()) return std::nullopt;
  const std::string name(node.condition.text);
  const uint32_t count = at.checker.program.conditions[first].count;
  const Span declared = at.checker.program.conditions[first].span;
  if (!node.index && count == 0) return first;
  if (!node.index || count == 0) {
    at.checker.report(count == 0 ? DiagnosticKind::NotIndexed : DiagnosticKind::NeedsIndex, node.condition.span, {name})
        .note(DiagnosticKind::DeclaredHere, declared, {name});
    return std::nullopt;
  }
  const auto index = evaluate_integer(at.checker, &at.scope, at.scope.module, *node.index, INT32_MIN, INT32_MAX);
  if (!index) return std::nullopt;
  if (*index >= 0 && *index < count) return ConditionId{first.value + static_cast<size_t>(*index)};
  at.checker.report(DiagnosticKind::IndexNotDeclared, node.index->span, {name, std::to_string(*index)})
      .note(DiagnosticKind::DeclaredHere, declared, {name});
  return std::nullopt;
}

void visit(Walker at, const ast::IfHost& node) {
  const auto symbol = find_symbol(at.checker, at.scope.module, node.condition, SymbolKind::condition);
  if (!symbol) return void(at.scope.incomplete = true);
  const auto condition = condition_at(at, node, condition_of(at.checker, *symbol));
  if (!condition) return void(at.scope.incomplete = true);
  at.scope.conditions.push_back(*condition);
  walk(at, node.body);
  at.scope.conditions.pop_back();
}

// `image source: rgba16f`, `buffer weights: f32`: the type of a port, if it says one.
bool port_fits(Walker at, const ast::Parameter& parameter, const ast::Expr& argument, const Resource& resource, uint32_t module) {
  if (parameter.type.kind == ast::ExprKind::error) return true;
  std::string has, wanted = spelled(parameter.type);
  if (resource.kind == ResourceKind::image) {
    has = name(resource.format);
    if (find_format(wanted) == Format::none) {
      at.checker.report(DiagnosticKind::UnknownFormat, parameter.type.span, {wanted});
      return false;
    }
  } else {
    ast::TypeName type;
    type.name = parameter.type;
    const auto element = element_type(at.checker, module, type);
    if (!element) return false;
    has = print_type(at.checker.program, resource.element);
    wanted = print_type(at.checker.program, *element);
  }
  if (has == wanted) return true;
  at.checker.report(DiagnosticKind::PortFormat, argument.span, {std::string(parameter.name.text), wanted, resource.name, has})
      .note(DiagnosticKind::DeclaredHere, parameter.span, {std::string(parameter.name.text)})
      .note(DiagnosticKind::DeclaredHere, resource.span, {resource.name});
  return false;
}

bool bind_place(Walker at, const ast::Parameter& parameter, const ast::Expr& argument, Binding& binding, uint32_t module) {
  binding.kind = Binding::Kind::place;
  binding.writable = parameter.direction != ast::Parameter::Direction::in;
  binding.is_out = parameter.direction == ast::Parameter::Direction::out;
  binding.place = find_place(at.checker, at.scope, argument);
  if (!binding.place.ok()) return false;
  const Resource& resource = at.scope.graph.resources[binding.place.resource];
  const bool is_image = resource.kind == ResourceKind::image;
  if (is_image == (parameter.kind == ast::Parameter::Kind::image)) return port_fits(at, parameter, argument, resource, module);
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

bool bind_argument(Walker at, const ast::Parameter& parameter, const ast::Expr& argument, Binding& binding, uint32_t module) {
  binding.name = parameter.name.text;
  binding.span = parameter.span;
  using Kind = ast::Parameter::Kind;
  if (parameter.kind == Kind::image || parameter.kind == Kind::buffer) return bind_place(at, parameter, argument, binding, module);
  if (parameter.kind == Kind::params) return bind_params(at, argument, binding);
  if (parameter.kind != Kind::constant) {
    at.checker.report(DiagnosticKind::ParameterOfGraph, parameter.span, {std::string(parameter.name.text)});
    return false;
  }
  const auto value = evaluate_integer(at.checker, &at.scope, at.scope.module, argument, INT32_MIN, INT32_MAX);
  binding.value = value.value_or(0);
  return value.has_value();
}

// `inout hdr` at the use says again what the parameter is declared to be.
bool direction_fits(Walker at, const ast::Use& node, size_t i, const ast::Parameter& parameter) {
  const ast::Name& said = node.directions[i];
  constexpr const char* kWords[] = {"in", "out", "inout"};
  const char* declared = kWords[static_cast<size_t>(parameter.direction)];
  if (said.empty() || said.text == declared) return true;
  at.checker.report(DiagnosticKind::OptionDoesNotFit, said.span, {std::string(said.text), std::string(parameter.name.text)})
      .note(DiagnosticKind::DeclaredHere, parameter.span, {std::string(parameter.name.text)})
      .fix(said.span, declared);
  return false;
}

std::optional<std::vector<Binding>> bind_arguments(Walker at, const ast::Use& node, const ast::GraphDeclaration& technique, uint32_t module) {
  if (node.arguments.size() != technique.parameters.size()) {
    at.checker
        .report(DiagnosticKind::WrongArgumentCount, node.span,
                {spelled(node.technique), std::to_string(node.arguments.size()), counted(technique.parameters.size(), "argument")})
        .note(DiagnosticKind::DeclaredHere, technique.name.span, {std::string(technique.name.text)});
    return std::nullopt;
  }
  std::vector<Binding> bindings;
  for (size_t i = 0; i < node.arguments.size(); ++i) {
    Binding binding;
    if (!direction_fits(at, node, i, technique.parameters[i])) return std::nullopt;
    if (!bind_argument(at, technique.parameters[i], node.arguments[i], binding, module)) return std::nullopt;
    bindings.push_back(std::move(binding));
  }
  return bindings;
}

// What is declared `out` leaves the technique defined, and so the port it is bound to, if that is one.
void check_ports(Walker at, const ast::GraphDeclaration& technique) {
  if (at.phase != Phase::passes) return;
  for (Binding& binding : at.scope.bindings) {
    if (!binding.is_out || binding.kind != Binding::Kind::place) continue;
    if (binding.written && binding.place.port) binding.place.port->written = true;
    if (binding.written || at.scope.incomplete) continue;
    at.checker.report(DiagnosticKind::PortNotWritten, binding.span, {std::string(binding.name), std::string(technique.name.text)});
  }
}

// A technique sees its parameters and its own module, not the names around the `use`.
void walk_instance(Walker at, const Symbol& symbol, const ast::GraphDeclaration& technique, std::vector<Binding> bindings,
                   const std::string& instance) {
  const uint32_t module = at.scope.module;
  const std::string prefix = at.scope.prefix;
  std::swap(at.scope.bindings, bindings);
  at.scope.module = symbol.module;
  at.scope.prefix = instance + ".";
  ++at.scope.use_depth;
  walk(at, technique.body);
  check_ports(at, technique);
  --at.scope.use_depth;
  at.scope.prefix = prefix;
  at.scope.module = module;
  std::swap(at.scope.bindings, bindings);
}

// Two instances of one name would declare everything twice.
bool claim_instance(Walker at, const ast::Use& node, const std::string& instance) {
  if (at.phase != Phase::resources) return true;
  const auto [first, fresh] = at.scope.uses.emplace(instance, node.span);
  if (fresh) return true;
  const bool named = !node.instance.empty();
  at.scope.incomplete = true;
  at.scope.repeated_uses.insert(&node);
  report_duplicate(at.checker, named ? node.instance : ast::Name{node.technique.text, node.technique.span}, first->second);
  return false;
}

void visit(Walker at, const ast::Use& node) {
  if (at.scope.repeated_uses.count(&node)) return;
  const auto id = find_symbol(at.checker, at.scope.module, node.technique, SymbolKind::technique);
  if (!id) return void(at.scope.incomplete = true);
  const Symbol symbol = at.checker.symbols[*id];
  const auto& technique = std::get<ast::GraphDeclaration>(*symbol.declaration);
  if (at.scope.use_depth >= kMaxUseDepth) {
    at.checker.report(DiagnosticKind::TechniqueTooDeep, node.span, {std::string(symbol.name.text), std::to_string(kMaxUseDepth)});
    return void(at.scope.incomplete = true);
  }
  if (!count_unrolled(at, 1, node.span)) return;
  auto bindings = bind_arguments(at, node, technique, symbol.module);
  if (!bindings || technique.has_error) return void(at.scope.incomplete = true);
  const auto instance = indexed_name(at.checker, at.scope, node.instance.empty() ? symbol.name : node.instance, node.index);
  if (!instance) return void(at.scope.incomplete = true);
  if (!claim_instance(at, node, *instance)) return;
  if (!node.index.empty()) at.scope.instances[at.scope.prefix + std::string(node.instance.text)] = true;
  if (at.phase == Phase::passes) at.scope.graph.instances.push_back({*instance, std::string(symbol.name.text), node.span, technique.name.span});
  const size_t told = at.checker.diagnostics.rows().size();
  walk_instance(at, symbol, technique, std::move(*bindings), *instance);
  // What is wrong inside a technique may be so only for what this `use` gives it.
  note_since(at.checker, told, node.span, std::string(symbol.name.text));
}

void visit(Walker at, const ast::Fuse& node) {
  if (at.phase == Phase::resources) return walk(at, node.body);
  const FusionId outer = at.scope.fusion;
  at.scope.fusion = declare_fusion(at.checker, at.scope, node);
  if (!at.scope.fusion.valid()) at.scope.incomplete = true;
  walk(at, node.body);
  if (at.scope.fusion.valid()) finish_fusion(at.checker, at.scope, at.scope.fusion);
  at.scope.fusion = outer;
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
  if (!is_size) return out.arguments.push_back(evaluated_name(at.checker, at.scope, expr).value_or(spelled(expr)));
  const Value size = evaluate_expr(at.checker, &at.scope, at.scope.module, expr);
  for (uint8_t axis = 0; size.kind == Value::Kind::integer && axis < size.axes; ++axis) out.extent[axis] = size.at[axis].value;
}

void visit(Walker at, const ast::Assertion& node) {
  if (at.phase != Phase::passes || node.fact.empty()) return;
  Assertion assertion;
  assertion.is_error = node.is_error;
  assertion.fact = std::string(node.fact.text) + (node.on.empty() ? "" : " on " + std::string(node.on.text));
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
    carry_forward(scope.graph, find_carried(checker, scope.graph));
    check_definitions(checker, scope.graph, scope.told);
    check_unused(checker, scope);
    check_block_layouts(checker, scope.graph);
  }
  checker.program.graphs.add(std::move(scope.graph));
}

// Of kind and place among the rows from `first` on: a loop's body is wrong once.
void drop_repeats(Checker& checker, size_t first) {
  if (first == checker.diagnostics.rows().size()) return;
  Diagnostics kept;
  std::set<std::tuple<DiagnosticKind, uint32_t, uint32_t, uint32_t>> seen;
  for (size_t i = 0; i < checker.diagnostics.rows().size(); ++i) {
    const Diagnostic& row = checker.diagnostics.rows()[i];
    if (i < first || seen.emplace(row.kind, row.span.file.value, row.span.begin, row.span.end).second) kept.report(row);
  }
  checker.diagnostics = std::move(kept);
}

}  // namespace

void note_since(Checker& checker, size_t first, Span span, const std::string& name) {
  if (first == checker.diagnostics.rows().size()) return;
  Diagnostics noted;
  for (size_t i = 0; i < checker.diagnostics.rows().size(); ++i) {
    Diagnostic row = checker.diagnostics.rows()[i];
    if (i >= first) row.note(DiagnosticKind::AccessUsedHere, span, {name});
    noted.report(std::move(row));
  }
  checker.diagnostics = std::move(noted);
}

void check_graph(Checker& checker, uint32_t symbol) {
  const auto& node = std::get<ast::GraphDeclaration>(*checker.symbols[symbol].declaration);
  GraphScope scope;
  scope.module = checker.symbols[symbol].module;
  scope.graph.name = std::string(node.name.text);
  scope.graph.span = node.name.span;
  scope.incomplete = node.has_error || checker.lost_names;
  const size_t told = checker.diagnostics.rows().size();
  declare_parameters(checker, scope, node);
  walk({checker, scope, Phase::resources}, node.body);
  scope.unrolled = 0;
  walk({checker, scope, Phase::passes}, node.body);
  finish_graph(checker, scope);
  drop_repeats(checker, told);
}

}  // namespace rg::dsl
