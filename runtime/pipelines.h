// Set and pipeline layouts of every pass, and the pipelines of those that name shaders.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Fills Objects::passes in the order of Plan::passes. The layouts of engine sets come from the context.
Status create_pass_objects(const Context& context, Objects& objects);

}  // namespace rg
