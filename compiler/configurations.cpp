#include "compiler/configurations.h"

#include <algorithm>

#include "compiler/merge_features.h"
#include "compiler/variant_space.h"

namespace rg::compiler {
namespace {

// Features that some shader of the graph sees.
std::vector<bool> features_of_shaders(const dsl::Program& program, const dsl::Graph& graph) {
  std::vector<bool> used(program.features.size(), false);
  for (const dsl::Pass& pass : graph.passes)
    for (const dsl::ShaderFeature& feature : pass.features)
      if (feature.feature.valid()) used[feature.feature.value] = true;
  return used;
}

// Applies one "NAME=VALUE"; false if there is no such feature or value.
bool fix(const dsl::Program& program, const std::string& text, Configuration& fixed) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) return false;
  for (size_t f = 0; f < program.features.size(); ++f) {
    const dsl::Feature& feature = program.features.rows[f];
    if (feature.name != text.substr(0, equals)) continue;
    const auto value = std::find(feature.values.begin(), feature.values.end(), text.substr(equals + 1));
    if (value == feature.values.end()) return false;
    fixed[f] = static_cast<uint32_t>(value - feature.values.begin());
    return true;
  }
  return false;
}

// For each feature the value it is fixed to, or kFreeFeature.
Configuration decided(const dsl::Program& program, const std::vector<std::string>& fixed, dsl::Diagnostics& diagnostics) {
  Configuration values(program.features.size(), kFreeFeature);
  for (const std::string& text : fixed)
    if (!fix(program, text, values)) diagnostics.report(dsl::DiagnosticKind::UnknownFeatureValue, {}, {text});
  return values;
}

void report_too_many(const dsl::Program& program, const dsl::Graph& graph, const std::vector<bool>& open, size_t total, bool counted, size_t limit,
                     dsl::Diagnostics& diagnostics) {
  const std::string count = counted ? std::to_string(total) : "more than " + std::to_string(total);
  dsl::Diagnostic& error = diagnostics.report(dsl::DiagnosticKind::TooManyPlans, graph.span, {graph.name, count, std::to_string(limit)});
  for (size_t f = 0; f < open.size(); ++f) {
    const dsl::Feature& feature = program.features.rows[f];
    if (open[f]) error.note(dsl::DiagnosticKind::FeatureMultiplies, feature.span, {feature.name, std::to_string(feature.values.size())});
  }
}

}  // namespace

std::vector<Configuration> expand_configurations(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed, size_t limit,
                                                 dsl::Diagnostics& diagnostics) {
  constexpr uint64_t kBudget = 1 << 18;  // steps of the search
  const Configuration values = decided(program, fixed, diagnostics);
  std::vector<bool> open = features_of_plans(program, program.graphs[graph]);
  std::vector<bool> selecting = features_of_shaders(program, program.graphs[graph]);
  const std::vector<bool> conditions = features_of_conditions(program, program.graphs[graph]);
  for (size_t f = 0; f < open.size(); ++f) selecting[f] = (selecting[f] || conditions[f]) && !open[f] && values[f] == kFreeFeature;
  for (size_t f = 0; f < open.size(); ++f) open[f] = open[f] && values[f] == kFreeFeature;
  std::vector<Configuration> all;
  size_t total = 0;
  const bool counted = dsl::each_configuration(program.features, values, open, kBudget, [&](const Configuration& configuration) {
    if (++total > limit) return true;
    all.push_back(configuration);
    for (size_t f = 0; f < selecting.size(); ++f)
      if (selecting[f]) all.back()[f] = kFreeFeature;
    return true;
  });
  const dsl::Graph& row = program.graphs[graph];
  if (total > limit || !counted) {
    report_too_many(program, row, open, total, counted, limit, diagnostics);
    return {};
  }
  if (all.empty()) diagnostics.report(dsl::DiagnosticKind::NoConfiguration, row.span, {row.name});
  return all;
}

std::string configuration_name(const dsl::Program& program, const Configuration& configuration) {
  std::string name;
  for (size_t f = 0; f < configuration.size(); ++f) {
    const dsl::Feature& feature = program.features.rows[f];
    if (configuration[f] == kFreeFeature) continue;
    name += (name.empty() ? "" : " ") + feature.name + "=" + feature.values[configuration[f]];
  }
  return name;
}

}  // namespace rg::compiler
