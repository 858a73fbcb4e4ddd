#include "compiler/configurations.h"

#include <algorithm>

#include "compiler/merge_features.h"
#include "compiler/variant_space.h"
#include "dsl/closest.h"

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

std::string listed(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "`" : ", `") + std::string(word) + "`";
  return text;
}

void guess(dsl::Diagnostic& error, const std::string& word, const std::vector<std::string_view>& candidates) {
  if (const std::string meant = dsl::closest(word, candidates).shown(); !meant.empty()) error.note(dsl::DiagnosticKind::DidYouMean, {}, {meant});
}

// Applies one "NAME=VALUE", or reports which part of it is wrong.
void fix(const dsl::Program& program, const std::string& text, Configuration& fixed, dsl::Diagnostics& diagnostics) {
  using dsl::DiagnosticKind;
  const size_t equals = text.find('=');
  if (equals == std::string::npos) return void(diagnostics.report(DiagnosticKind::UnknownFeatureValue, {}, {text}));
  const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
  std::vector<std::string_view> features;
  for (size_t f = 0; f < program.features.size(); ++f) {
    const dsl::Feature& feature = program.features.rows[f];
    features.push_back(feature.name);
    if (feature.name != name) continue;
    const std::vector<std::string_view> values(feature.values.begin(), feature.values.end());
    const auto found = static_cast<uint32_t>(std::find(values.begin(), values.end(), value) - values.begin());
    if (found == values.size())
      return guess(diagnostics.report(DiagnosticKind::UnknownSettingValue, {}, {value, name, listed(values)}), value, values);
    if (fixed[f] != kFreeFeature && fixed[f] != found) diagnostics.report(DiagnosticKind::RepeatedSetting, {}, {name});
    fixed[f] = found;
    return;
  }
  guess(diagnostics.report(DiagnosticKind::UnknownName, {}, {"feature", name}), name, features);
}

// For each feature the value it is fixed to, or kFreeFeature.
Configuration decided(const dsl::Program& program, const std::vector<std::string>& fixed, dsl::Diagnostics& diagnostics) {
  Configuration values(program.features.size(), kFreeFeature);
  for (const std::string& text : fixed) fix(program, text, values, diagnostics);
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
  dsl::Diagnostics told;
  const Configuration values = decided(program, fixed, graph.value == 0 ? diagnostics : told);  // once, however many graphs there are
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
