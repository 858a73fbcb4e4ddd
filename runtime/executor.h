// Recording and submission of one frame. Allocates nothing.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Pools, command buffers, queries and semaphores of every frame in flight.
Status create_frames(GraphInstance::State& state);

Status execute_frame(GraphInstance::State& state, const FrameInputs& inputs);

Status wait_for(const GraphInstance::State& state, uint64_t value);

// Drops what resizes have retired and the device has finished with.
Status release_retired(GraphInstance::State& state);

// Records and submits the prologue of `sized`, ordered on the queue before the next frame.
Status submit_prologue(GraphInstance::State& state, const Sized& sized);

}  // namespace rg
