// Which passes each feature configuration of a graph has, and which of them anything observable depends on: what shaders have to be built for.
#pragma once

#include <vector>

#include "compiler/configurations.h"
#include "compiler/shaders/shaders.h"

namespace rg::compiler {

// The features that decide which passes and resources `graph` has: each combination of their values is a configuration with a plan of its own.
std::vector<bool> features_of_plans(const dsl::Program& program, const dsl::Graph& graph);
// The features of `pass` that no plan depends on and that are not fixed: indices into Pass::features. Which shaders run is selected among the
// combinations of their values, in counting order, the first slowest.
std::vector<size_t> selecting_features(const dsl::Pass& pass, const Configuration& configuration);

// Culling looks at accesses alone, so the shaders need not be known yet. Reports passes with too many combinations.
// O(configurations * planning's first phases + rows).
VariantSpace find_variant_space(const dsl::Program& program, dsl::GraphId graph, const std::vector<Configuration>& configurations,
                                dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
