#include "compiler/variant_space.h"

#include <algorithm>

#include "compiler/build_graph.h"
#include "compiler/cull.h"

namespace rg::compiler {
namespace {

constexpr uint64_t kMaxCombinations = 4096;  // of one pass

bool has_shaders(const dsl::Graph& graph) {
  return std::any_of(graph.passes.begin(), graph.passes.end(), [](const dsl::Pass& pass) { return !pass.shaders.empty(); });
}

uint32_t value_of(const dsl::ShaderFeature& feature, const Configuration& configuration) {
  return feature.feature.valid() ? configuration[feature.feature.value] : feature.value;
}

// Product of the values of the selecting features; reports and gives 0 beyond the limit.
uint64_t count_selectors(const dsl::Program& program, const dsl::Pass& pass, const std::vector<size_t>& selecting, dsl::Diagnostics& diagnostics) {
  uint64_t product = 1;
  for (const size_t i : selecting) product = std::min(product * program.features[pass.features[i].feature].values.size(), kMaxCombinations + 1);
  if (product <= kMaxCombinations) return product;
  diagnostics.report(dsl::DiagnosticKind::TooManyVariants, pass.span, {pass.name, std::to_string(kMaxCombinations)});
  return 0;
}

// False where rules forbid the values, or no frame runs the pass with them.
bool selectable(const dsl::Program& program, const dsl::Pass& pass, const Configuration& configuration, const VariantRow& row) {
  Configuration values = configuration;
  for (size_t i = 0; i < pass.features.size(); ++i)
    if (pass.features[i].feature.valid()) values[pass.features[i].feature.value] = row.values[i];
  if (!dsl::allowed(program.features, values)) return false;
  return std::all_of(pass.conditions.begin(), pass.conditions.end(), [&](const dsl::ConditionId id) {
    const dsl::Condition& condition = program.conditions[id];
    if (!condition.feature.valid() || values[condition.feature.value] == kFreeFeature) return true;
    return std::find(condition.values.begin(), condition.values.end(), values[condition.feature.value]) != condition.values.end();
  });
}

void add_rows(const dsl::Program& program, const dsl::Pass& pass, const Configuration& configuration, uint32_t index, bool live,
              std::vector<VariantRow>& rows, dsl::Diagnostics& diagnostics) {
  const std::vector<size_t> selecting = selecting_features(pass, configuration);
  const uint64_t count = count_selectors(program, pass, selecting, diagnostics);
  for (uint32_t selector = 0; selector < count; ++selector) {
    VariantRow row{index, selector, live, {}};
    for (const dsl::ShaderFeature& feature : pass.features) row.values.push_back(value_of(feature, configuration));
    uint32_t rest = selector;
    for (size_t i = selecting.size(); i-- > 0;) {
      const auto values = static_cast<uint32_t>(program.features[pass.features[selecting[i]].feature].values.size());
      row.values[selecting[i]] = rest % values;
      rest /= values;
    }
    row.live = live && selectable(program, pass, configuration, row);
    rows.push_back(std::move(row));
  }
}

}  // namespace

std::vector<bool> features_of_plans(const dsl::Program& program, const dsl::Graph& graph) {
  std::vector<bool> used(program.features.size(), false);
  const auto mark = [&](const dsl::Guard& guard) {
    for (const dsl::Guard::Term& term : guard.terms) used[term.feature.value] = true;
  };
  for (const dsl::Resource& resource : graph.resources) mark(resource.guard);
  for (const dsl::Pass& pass : graph.passes) mark(pass.guard);
  return used;
}

std::vector<size_t> selecting_features(const dsl::Pass& pass, const Configuration& configuration) {
  std::vector<size_t> selecting;
  for (size_t i = 0; i < pass.features.size(); ++i)
    if (pass.features[i].feature.valid() && configuration[pass.features[i].feature.value] == kFreeFeature) selecting.push_back(i);
  return selecting;
}

VariantSpace find_variant_space(const dsl::Program& program, dsl::GraphId graph_id, const std::vector<Configuration>& configurations,
                                dsl::Diagnostics& diagnostics) {
  const dsl::Graph& graph = program.graphs[graph_id];
  VariantSpace space;
  space.configurations = static_cast<uint32_t>(configurations.size());
  space.passes.resize(graph.passes.size());
  for (const dsl::Pass& pass : graph.passes) {
    space.selecting.emplace_back();
    for (const Configuration& configuration : configurations) space.selecting.back().push_back(selecting_features(pass, configuration));
  }
  if (!has_shaders(graph)) return space;
  for (uint32_t c = 0; c < configurations.size(); ++c) {
    const Frame frame = expand(program, graph_id, configurations[c], {});
    const Liveness liveness = cull(frame, build_graph(frame, std::vector<bool>(frame.passes.size(), true)));
    for (size_t i = 0; i < frame.passes.size(); ++i) {
      const uint32_t pass = frame.passes[i];
      add_rows(program, graph.passes.rows[pass], configurations[c], c, liveness.live[i], space.passes[pass], diagnostics);
    }
  }
  return space;
}

}  // namespace rg::compiler
