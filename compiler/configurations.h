// Feature configurations of a graph: the plans that have to exist.
#pragma once

#include <string>
#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/diagnostics.h"
#include "dsl/features.h"

namespace rg::compiler {

using dsl::kFreeFeature;  // in a configuration: no plan depends on it, shaders are selected by it when a frame is recorded

// Every combination of values of the features that the passes and resources of `graph` depend on and that keeps the features' rules, in counting
// order, the first feature slowest. Features that only shaders and conditions see are kFreeFeature; others keep their initial value, or what the
// rules ask for. `fixed` holds "NAME=VALUE" of features decided at build time. Reports unknown names, more than `limit` plans with the features that
// multiply them, and none at all.
//
//   feature fog: bool   feature quality: { low, high }      fixed {"fog=on"}  ->  {1, 0} {1, 1}
std::vector<Configuration> expand_configurations(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed, size_t limit,
                                                 dsl::Diagnostics& diagnostics);

// "fog=on quality=low"; empty where the program has no features.
std::string configuration_name(const dsl::Program& program, const Configuration& configuration);

}  // namespace rg::compiler
