// One frame: inputs, recording, submission. Allocates nothing.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

Status execute_frame(GraphInstance::State& state, const FrameInputs& inputs);

}  // namespace rg
