#include "dsl/check.h"

#include <algorithm>

#include "dsl/check_state.h"
#include "dsl/paths.h"
#include "dsl/reserved.h"

namespace rg::dsl {
namespace {

void add_constant(Checker& checker, uint32_t symbol) {
  const Value& value = constant_value(checker, symbol);
  if (!value.known_integer() || checker.symbols[symbol].is_private) return;  // private ones reach neither shaders nor C++
  const ast::Name name = checker.symbols[symbol].name;
  if (!claim_public_name(checker, name)) return;
  if (reserved_in_glsl(name.text))
    return void(checker.report(DiagnosticKind::ReservedName, name.span, {std::string(name.text), "call the constant otherwise"}));
  checker.program.constants.push_back({std::string(name.text), value.at[0].value});
}

void check_symbol(Checker& checker, uint32_t symbol) {
  switch (checker.symbols[symbol].kind) {
    case SymbolKind::constant:
      return add_constant(checker, symbol);
    case SymbolKind::extent:
      extent_of(checker, symbol);
      break;
    case SymbolKind::structure:
      struct_of(checker, symbol);
      break;
    case SymbolKind::sampler:
      sampler_of(checker, symbol);
      break;
    case SymbolKind::state:
      state_of(checker, symbol);
      break;
    case SymbolKind::feature:
      feature_of(checker, symbol);
      break;
    case SymbolKind::condition:
      condition_of(checker, symbol);
      break;
    case SymbolKind::set:
      check_engine_set(checker, symbol);
      break;
    case SymbolKind::spectrum:
      spectrum_of(checker, symbol);
      break;
    case SymbolKind::interface:
    case SymbolKind::graph:
    case SymbolKind::technique:
      break;
  }
}

// Named here, read by the compiler: what a profile promises is Vulkan's business. Any module may name one; all count.
void add_profiles(Checker& checker, const Module& module) {
  for (const ast::ProfileTarget& node : module.tree.profiles) {
    const auto path = join_inside(module.folder, node.path);
    if (!path) {
      checker.report(DiagnosticKind::ImportEscapes, node.span, {std::string(node.path)});
      continue;
    }
    Profile profile;
    profile.name = *path;
    profile.span = node.span;
    checker.program.profiles.push_back(std::move(profile));
  }
}

void check_target(Checker& checker, const ast::File& file) {
  if (!file.target || file.target->api.empty()) return;
  if (file.repeated_target.file.valid())
    checker.report(DiagnosticKind::RepeatedSetting, file.repeated_target, {"target vulkan"}).note(DiagnosticKind::FirstIsHere, file.target->span);
  const double version = file.target->version;
  checker.program.split_barriers = checker.program.split_barriers || !file.target->with.empty();
  if (version < 1.25 || version > 1.45) checker.report(DiagnosticKind::UnsupportedTarget, file.target->span, {std::to_string(version).substr(0, 3)});
}

}  // namespace

Program check(const std::vector<Module>& modules, Diagnostics& diagnostics) {
  Checker checker{modules, diagnostics, {}, {}, {}, {}, {}, {}, {}, {}, {}, false, 0, {}};
  checker.lost_names = std::any_of(modules.begin(), modules.end(), [](const Module& module) { return module.tree.lost_names; });
  checker.program.module = modules.back().name;
  collect_names(checker);
  for (const Module& module : modules) check_target(checker, module.tree), add_profiles(checker, module);
  for (uint32_t symbol = 0; symbol < checker.symbols.size(); ++symbol) check_symbol(checker, symbol);
  check_features(checker);
  for (uint32_t symbol = 0; symbol < checker.symbols.size(); ++symbol)
    if (checker.symbols[symbol].kind == SymbolKind::graph && !modules[checker.symbols[symbol].module].tree.lost_structure)
      check_graph(checker, symbol);
  return std::move(checker.program);
}

}  // namespace rg::dsl
