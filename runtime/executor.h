// One frame: inputs, recording, submission. Allocates nothing.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

Status execute_frame(GraphInstance::State& state, const FrameInputs& inputs);

Status record_own_frame(GraphInstance::State& state, const FrameInputs& inputs, std::span<const OwnCommands> parts, const FrameDone& done);

}  // namespace rg
