// Set and pipeline layouts of every pass, and the pipelines of those that name shaders.
#pragma once

#include "runtime/pipeline_reuse.h"

namespace rg {

// Fills Objects::passes in the order of Plan::passes. The layouts of engine sets come from the context. Pipelines that `before` has are shared with
// it; null: all are made, by Context::pipeline_threads. Where several cannot be made, the error is that of the first in the order of passes, however
// many threads there are.
Status create_pass_objects(GraphInstance::State& state, const Predecessor* before);

}  // namespace rg
