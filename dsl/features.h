// Which combinations of feature values may occur: those that break no `requires` or `excludes`.
#pragma once

#include <functional>
#include <vector>

#include "dsl/program.h"

namespace rg::dsl {

constexpr uint32_t kFreeFeature = UINT32_MAX;  // not decided yet
using FeatureValues = std::vector<uint32_t>;   // one value a FeatureId, or kFreeFeature

// True where no rule is broken, whatever the free features become.
bool allowed(const Table<FeatureId, Feature>& features, const FeatureValues& values);
bool asks(const State& state, Capability capability);         // whether the state says what only devices with the capability can
bool holds(const Guard& guard, const FeatureValues& values);  // of decided features

// Calls `visit` once for every assignment of the `open` features that some choice of all others completes without breaking a rule, in counting
// order, the first feature slowest; what is passed is the first such completion, initial values preferred. Features that no rule connects to an open
// or decided one keep their initial value. `decided` holds kFreeFeature for every feature that is not fixed. Stops and returns false when `visit`
// does, or after `budget` steps of the search.
//
//   feature a: bool   feature b: bool requires a      open {a, b}:  {0, 0} {1, 0} {1, 1}
bool each_configuration(const Table<FeatureId, Feature>& features, const FeatureValues& decided, const std::vector<bool>& open, uint64_t budget,
                        const std::function<bool(const FeatureValues&)>& visit);

}  // namespace rg::dsl
