// Command buffers, queries and fences of the frames in flight, and how a frame is cut into command buffers and submits.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

Status create_frames(GraphInstance::State& state);

// Makes the command buffers of a slot whose last frame is done ready to be recorded again.
Status reset_slot(const GraphInstance::State& state, const FrameSlot& slot);

}  // namespace rg
