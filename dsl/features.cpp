#include "dsl/features.h"

#include <algorithm>

namespace rg::dsl {
namespace {

// Unknown counts as held: a rule is broken only by what is decided.
bool may_hold(const Guard::Term& term, const FeatureValues& values) {
  const uint32_t value = values[term.feature.value];
  return value == kFreeFeature || (value == term.value) != term.negated;
}

struct Search {
  const Table<FeatureId, Feature>& features;
  const std::function<bool(const FeatureValues&)>& visit;
  std::vector<uint32_t> order;  // open features, then those that only have to fit
  size_t open_count = 0;
  uint64_t budget = 0;
  FeatureValues values;
  bool stopped = false;
};

// The values of the feature, the initial one first where the order is of no interest.
uint32_t candidate(const Feature& feature, uint32_t index, bool initial_first) {
  if (!initial_first) return index;
  return index == 0 ? feature.initial : index <= feature.initial ? index - 1 : index;
}

// True once a completion of the open features was found below `depth`.
bool search(Search& at, size_t depth) {
  if (at.stopped || at.budget == 0) return at.stopped = true;
  --at.budget;
  if (depth == at.order.size()) {
    at.stopped = !at.visit(at.values);
    return true;
  }
  const uint32_t id = at.order[depth];
  const Feature& feature = at.features.rows[id];
  bool found = false;
  for (uint32_t index = 0; index < feature.values.size() && !at.stopped; ++index) {
    at.values[id] = candidate(feature, index, depth >= at.open_count);
    if (!allowed(at.features, at.values)) continue;
    found = search(at, depth + 1) || found;
    if (found && depth >= at.open_count) break;  // one completion is enough
  }
  at.values[id] = kFreeFeature;
  return found;
}

// Marks everything that rules connect to what is marked.
void close_over_rules(const Table<FeatureId, Feature>& features, std::vector<bool>& marked) {
  for (bool grew = true; grew;) {
    grew = false;
    for (uint32_t id = 0; id < features.size(); ++id)
      for (const Feature::Rule& rule : features.rows[id].rules) {
        const uint32_t other = rule.needs.feature.value;
        if (marked[id] == marked[other]) continue;
        marked[id] = marked[other] = grew = true;
      }
  }
}

}  // namespace

bool allowed(const Table<FeatureId, Feature>& features, const FeatureValues& values) {
  for (uint32_t id = 0; id < features.size(); ++id)
    for (const Feature::Rule& rule : features.rows[id].rules)
      if (values[id] == rule.value && !may_hold(rule.needs, values)) return false;
  return true;
}

bool asks(const State& state, Capability capability) {
  switch (capability) {
    case Capability::depth_bounds:
      return state.depth_bounds;
    case Capability::conservative_rasterization:
      return state.conservative;
    case Capability::sample_locations:
      return !state.sample_locations.empty();
    default:
      return false;
  }
}

bool holds(const Guard& guard, const FeatureValues& values) {
  return std::all_of(guard.terms.begin(), guard.terms.end(),
                     [&](const Guard::Term& term) { return (values[term.feature.value] == term.value) != term.negated; });
}

bool each_configuration(const Table<FeatureId, Feature>& features, const FeatureValues& decided, const std::vector<bool>& open, uint64_t budget,
                        const std::function<bool(const FeatureValues&)>& visit) {
  Search at{features, visit, {}, 0, budget, decided, false};
  std::vector<bool> related = open;
  for (uint32_t id = 0; id < features.size(); ++id)
    if (decided[id] != kFreeFeature) related[id] = true;
  close_over_rules(features, related);
  for (uint32_t id = 0; id < features.size(); ++id)
    if (open[id] && decided[id] == kFreeFeature) at.order.push_back(id);
  at.open_count = at.order.size();
  for (uint32_t id = 0; id < features.size(); ++id) {
    if (decided[id] != kFreeFeature || open[id]) continue;
    if (related[id])
      at.order.push_back(id);
    else
      at.values[id] = features.rows[id].initial;
  }
  if (!allowed(features, at.values)) return true;
  search(at, 0);
  return !at.stopped;
}

}  // namespace rg::dsl
