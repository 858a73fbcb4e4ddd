#include "compiler/configurations.h"

#include <algorithm>

#include "compiler/variant_space.h"

namespace rg::compiler {
namespace {

constexpr uint32_t kOpen = UINT32_MAX - 1;  // to be expanded

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

// For each feature its one value, kOpen or kFreeFeature.
Configuration decided(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed, dsl::Diagnostics& diagnostics) {
  Configuration values(program.features.size(), kOpen);
  const std::vector<bool> plans = features_of_plans(program, program.graphs[graph]), shaders = features_of_shaders(program, program.graphs[graph]);
  for (size_t f = 0; f < values.size(); ++f)
    if (!plans[f]) values[f] = shaders[f] ? kFreeFeature : program.features.rows[f].initial;
  for (const std::string& text : fixed)
    if (!fix(program, text, values)) diagnostics.report(dsl::DiagnosticKind::UnknownFeatureValue, {}, {text});
  return values;
}

// How many configurations the kOpen ones make; saturates.
size_t count(const dsl::Program& program, const Configuration& values) {
  constexpr size_t kMost = size_t{1} << 40;
  size_t product = 1;
  for (size_t f = 0; f < values.size(); ++f)
    if (values[f] == kOpen) product = std::min(kMost, product * program.features.rows[f].values.size());
  return product;
}

void report_too_many(const dsl::Program& program, const dsl::Graph& graph, const Configuration& values, size_t total, size_t limit,
                     dsl::Diagnostics& diagnostics) {
  dsl::Diagnostic& error =
      diagnostics.report(dsl::DiagnosticKind::TooManyPlans, graph.span, {graph.name, std::to_string(total), std::to_string(limit)});
  for (size_t f = 0; f < values.size(); ++f) {
    const dsl::Feature& feature = program.features.rows[f];
    if (values[f] == kOpen) error.note(dsl::DiagnosticKind::FeatureMultiplies, feature.span, {feature.name, std::to_string(feature.values.size())});
  }
}

}  // namespace

std::vector<Configuration> expand_configurations(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed, size_t limit,
                                                 dsl::Diagnostics& diagnostics) {
  const Configuration values = decided(program, graph, fixed, diagnostics);
  const size_t total = count(program, values);
  if (total > limit) {
    report_too_many(program, program.graphs[graph], values, total, limit, diagnostics);
    return {};
  }
  std::vector<Configuration> all;
  for (size_t index = 0; index < total; ++index) {
    Configuration configuration = values;
    size_t rest = index;
    for (size_t f = values.size(); f-- > 0;) {
      if (values[f] != kOpen) continue;
      configuration[f] = static_cast<uint32_t>(rest % program.features.rows[f].values.size());
      rest /= program.features.rows[f].values.size();
    }
    all.push_back(std::move(configuration));
  }
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
