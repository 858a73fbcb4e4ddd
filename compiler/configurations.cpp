#include "compiler/configurations.h"

#include <algorithm>

namespace rg::compiler {
namespace {

constexpr uint32_t kFree = UINT32_MAX;

std::vector<bool> used_features(const dsl::Program& program, const dsl::Graph& graph) {
  std::vector<bool> used(program.features.size(), false);
  const auto mark = [&](const dsl::Guard& guard) {
    for (const dsl::Guard::Term& term : guard.terms) used[term.feature.value] = true;
  };
  for (const dsl::Resource& resource : graph.resources) mark(resource.guard);
  for (const dsl::Pass& pass : graph.passes) mark(pass.guard);
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

// For each feature either its one value, or kFree.
Configuration decided(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed, dsl::Diagnostics& diagnostics) {
  Configuration values(program.features.size(), kFree);
  const std::vector<bool> used = used_features(program, program.graphs[graph]);
  for (size_t f = 0; f < values.size(); ++f)
    if (!used[f]) values[f] = program.features.rows[f].initial;
  for (const std::string& text : fixed)
    if (!fix(program, text, values)) diagnostics.report(dsl::DiagnosticKind::UnknownFeatureValue, {}, {text});
  return values;
}

// How many configurations leave the kFree ones open; saturates above `limit`.
size_t count(const dsl::Program& program, const Configuration& values, size_t limit) {
  size_t product = 1;
  for (size_t f = 0; f < values.size(); ++f) {
    if (values[f] == kFree) product *= program.features.rows[f].values.size();
    if (product > limit) return product;
  }
  return product;
}

}  // namespace

std::vector<Configuration> expand_configurations(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed, size_t limit,
                                                 dsl::Diagnostics& diagnostics) {
  const Configuration values = decided(program, graph, fixed, diagnostics);
  const size_t total = count(program, values, limit);
  if (total > limit) {
    const dsl::Graph& row = program.graphs[graph];
    diagnostics.report(dsl::DiagnosticKind::TooManyPlans, row.span, {row.name, std::to_string(total), std::to_string(limit)});
    return {};
  }
  std::vector<Configuration> all;
  for (size_t index = 0; index < total; ++index) {
    Configuration configuration = values;
    size_t rest = index;
    for (size_t f = values.size(); f-- > 0;) {
      if (values[f] != kFree) continue;
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
    name += (name.empty() ? "" : " ") + feature.name + "=" + feature.values[configuration[f]];
  }
  return name;
}

}  // namespace rg::compiler
