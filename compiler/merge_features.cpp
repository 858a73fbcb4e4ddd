#include "compiler/merge_features.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "compiler/build_graph.h"
#include "compiler/configurations.h"
#include "compiler/cull.h"
#include "compiler/variant_space.h"

namespace rg::compiler {
namespace {

constexpr size_t kMostCombinations = 1024;  // that are planned to find out
constexpr size_t kMostConditions = 64;      // bits of a frame's conditions
constexpr size_t kMostValues = 64;          // bits of FeatureCondition::values

using Passes = std::set<uint32_t>;

Passes live_passes(const dsl::Program& program, dsl::GraphId graph, const Configuration& configuration) {
  const Frame frame = expand(program, graph, configuration, {});
  const Liveness liveness = cull(frame, build_graph(frame, std::vector<bool>(frame.passes.size(), true)));
  Passes live;
  for (size_t i = 0; i < frame.passes.size(); ++i)
    if (liveness.live[i]) live.insert(frame.passes[i]);
  return live;
}

// What the plans have of one combination of all other features, by value of the feature in question.
struct Group {
  std::map<uint32_t, Passes> live;
  Passes all() const {
    Passes passes;
    for (const auto& [value, each] : live) passes.insert(each.begin(), each.end());
    return passes;
  }
};
using Groups = std::map<Configuration, Group>;  // the key has kFreeFeature for the feature

class Merger {
 public:
  Merger(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed) : program_(program), graph_(graph), fixed_(fixed) {}

  std::optional<dsl::Program> merge(dsl::FeatureId feature) const {
    if (program_.features[feature].capability != dsl::Capability::none || program_.features[feature].values.size() > kMostValues) return std::nullopt;
    const std::optional<Groups> groups = find_groups(feature);
    if (!groups || !covered(*groups)) return std::nullopt;
    const auto when = values_of_passes(*groups, program_.features[feature].values.size());
    if (!when) return std::nullopt;
    dsl::Program merged = rewrite(feature, *when);
    if (merged.conditions.size() > kMostConditions || !same_passes(merged, *groups)) return std::nullopt;
    return merged;
  }

 private:
  std::optional<Groups> find_groups(dsl::FeatureId feature) const {
    dsl::Diagnostics ignored;
    Groups groups;
    for (const Configuration& configuration : expand_configurations(program_, graph_, fixed_, kMostCombinations, ignored)) {
      Configuration key = configuration;
      key[feature.value] = kFreeFeature;
      groups[key].live[configuration[feature.value]] = live_passes(program_, graph_, configuration);
    }
    if (groups.empty()) return std::nullopt;
    return groups;
  }

  // One value has everything.
  static bool covered(const Groups& groups) {
    return std::all_of(groups.begin(), groups.end(), [](const auto& row) {
      const Passes all = row.second.all();
      return std::any_of(row.second.live.begin(), row.second.live.end(), [&](const auto& each) { return each.second == all; });
    });
  }

  // By pass the values with which it runs; nullopt where that depends on other features. Values nobody can choose count as running.
  static std::optional<std::map<uint32_t, std::vector<bool>>> values_of_passes(const Groups& groups, size_t count) {
    std::map<uint32_t, std::map<uint32_t, bool>> known;
    for (const auto& [key, group] : groups)
      for (const uint32_t pass : group.all())
        for (const auto& [value, live] : group.live) {
          const auto [at, is_new] = known[pass].emplace(value, live.contains(pass));
          if (!is_new && at->second != live.contains(pass)) return std::nullopt;
        }
    std::map<uint32_t, std::vector<bool>> when;
    for (const auto& [pass, values] : known) {
      std::vector<bool> row(count, true);
      for (const auto& [value, runs] : values) row[value] = runs;
      when.emplace(pass, std::move(row));
    }
    return when;
  }

  // What `feature` having one of `values` asks of other features that still make plans.
  std::vector<dsl::Guard::Term> needs(dsl::FeatureId feature, const std::vector<bool>& values, const std::vector<bool>& of_plans) const {
    std::vector<dsl::Guard::Term> terms;
    if (std::count(values.begin(), values.end(), true) != 1) return terms;
    for (const dsl::Feature::Rule& rule : program_.features[feature].rules)
      if (values[rule.value] && of_plans[rule.needs.feature.value]) terms.push_back(rule.needs);
    return terms;
  }

  static void drop_terms(dsl::FeatureId feature, dsl::Guard& guard) {
    std::erase_if(guard.terms, [&](const dsl::Guard::Term& term) { return term.feature == feature; });
  }

  dsl::Program rewrite(dsl::FeatureId feature, const std::map<uint32_t, std::vector<bool>>& when) const {
    dsl::Program program = program_;
    const std::vector<bool> of_plans = features_of_plans(program_, program_.graphs[graph_]);
    dsl::Graph& graph = program.graphs[graph_];
    for (dsl::Resource& resource : graph.resources) drop_terms(feature, resource.guard);
    for (uint32_t p = 0; p < graph.passes.size(); ++p) {
      dsl::Pass& pass = graph.passes.rows[p];
      const auto row = when.find(p);
      drop_terms(feature, pass.guard);
      if (row == when.end()) continue;  // nothing observable depends on it
      if (std::count(row->second.begin(), row->second.end(), false) == 0) continue;
      for (const dsl::Guard::Term& term : needs(feature, row->second, of_plans))
        if (std::find(pass.guard.terms.begin(), pass.guard.terms.end(), term) == pass.guard.terms.end()) pass.guard.terms.push_back(term);
      pass.conditions.push_back(condition_of(program, feature, row->second));
    }
    return program;
  }

  static dsl::ConditionId condition_of(dsl::Program& program, dsl::FeatureId feature, const std::vector<bool>& values) {
    const dsl::Feature& source = program.features[feature];
    dsl::Condition condition;
    condition.name = source.name + "=";
    condition.span = source.span;
    condition.feature = feature;
    for (uint32_t value = 0; value < values.size(); ++value) {
      if (!values[value]) continue;
      condition.name += (condition.values.empty() ? "" : "|") + source.values[value];
      condition.values.push_back(value);
    }
    for (size_t c = 0; c < program.conditions.size(); ++c)
      if (program.conditions.rows[c] == condition) return dsl::ConditionId{c};
    return program.conditions.add(std::move(condition));
  }

  // The merged plans have exactly the passes of the values together.
  bool same_passes(const dsl::Program& merged, const Groups& groups) const {
    return std::all_of(groups.begin(), groups.end(), [&](const auto& row) {
      Configuration configuration = row.first;
      for (size_t f = 0; f < configuration.size(); ++f)
        if (configuration[f] == kFreeFeature) configuration[f] = merged.features.rows[f].initial;
      return live_passes(merged, graph_, configuration) == row.second.all();
    });
  }

  const dsl::Program& program_;
  const dsl::GraphId graph_;
  const std::vector<std::string>& fixed_;
};

}  // namespace

std::vector<bool> features_of_conditions(const dsl::Program& program, const dsl::Graph& graph) {
  std::vector<bool> used(program.features.size(), false);
  for (const dsl::Pass& pass : graph.passes)
    for (const dsl::ConditionId condition : pass.conditions)
      if (program.conditions[condition].feature.valid()) used[program.conditions[condition].feature.value] = true;
  return used;
}

dsl::Program merge_features(dsl::Program program, dsl::GraphId graph, const std::vector<std::string>& fixed) {
  const std::vector<bool> of_plans = features_of_plans(program, program.graphs[graph]);
  for (uint32_t f = 0; f < of_plans.size(); ++f) {
    const std::string name = program.features.rows[f].name + "=";
    const bool is_fixed = std::any_of(fixed.begin(), fixed.end(), [&](const std::string& text) { return text.starts_with(name); });
    if (!of_plans[f] || is_fixed) continue;
    if (auto merged = Merger(program, graph, fixed).merge(dsl::FeatureId{size_t{f}})) program = std::move(*merged);
  }
  return program;
}

dsl::Program merge_features(dsl::Program program, const std::vector<std::string>& fixed) {
  for (size_t graph = 0; graph < program.graphs.size(); ++graph) program = merge_features(std::move(program), dsl::GraphId{graph}, fixed);
  return program;
}

}  // namespace rg::compiler
