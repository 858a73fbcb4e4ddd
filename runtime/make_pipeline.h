// One pipeline from its rows of the plan.
#pragma once

#include <vector>

#include "runtime/graph_state.h"

namespace rg {

// Shader modules live only until the pipelines are made.
using Shaders = std::vector<UniqueShader>;  // by Plan::shaders
// Those of row `pipeline` of Plan::pipelines that are not there yet.
Status create_shaders(const Context& context, Index pipeline, Shaders& shaders);

// Row `pipeline` of Plan::pipelines for `pass`, whose layout and formats are in `out`. Several threads may be here at a time.
Result<UniquePipeline> make_pipeline(const Context& context, const Pass& pass, Index pipeline, const Shaders& shaders, const PassObjects& out);

}  // namespace rg
