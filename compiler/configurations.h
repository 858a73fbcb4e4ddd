// Feature configurations of a graph: the plans that have to exist.
#pragma once

#include <string>
#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/diagnostics.h"

namespace rg::compiler {

constexpr uint32_t kFreeFeature = UINT32_MAX;  // no plan depends on it: shaders are selected by it when a frame is recorded

// Every combination of values of the features that the passes and resources of `graph` depend on, in counting order, the first feature slowest.
// Features that only shaders see are kFreeFeature, those that nothing sees keep their initial value. `fixed` holds "NAME=VALUE" of features decided
// at build time. Reports unknown names and more than `limit` plans.
//
//   feature fog: bool   feature quality: { low, high }      fixed {"fog=on"}  ->  {1, 0} {1, 1}
std::vector<Configuration> expand_configurations(const dsl::Program& program, dsl::GraphId graph, const std::vector<std::string>& fixed, size_t limit,
                                                 dsl::Diagnostics& diagnostics);

// "fog=on quality=low"; empty where the program has no features.
std::string configuration_name(const dsl::Program& program, const Configuration& configuration);

}  // namespace rg::compiler
