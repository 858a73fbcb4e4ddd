// Set and pipeline layouts of every pass, and the pipelines of those that name shaders.
#pragma once

#include "runtime/pipeline_reuse.h"

namespace rg {

// Fills Objects::passes in the order of Plan::passes. The layouts of engine sets come from the context. Pipelines that `before` has are shared with it; null: all
// are made.
Status create_pass_objects(const Context& context, const Predecessor* before, Objects& objects);

}  // namespace rg
