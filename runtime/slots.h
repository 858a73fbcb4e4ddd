// Command buffers, queries and fences of the frames in flight, and how a frame is cut into command buffers and submits.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// The threads that record, unless the engine's do.
Status create_workers(GraphInstance::State& state);
Status create_frames(GraphInstance::State& state);

// Of a slot whose last frame is done: its command buffers can be recorded again, its queries written.
Status reset_commands(const Context& context, const FrameSlot& slot);
// Events of the slot's last frame, which is over.
Status reset_events(const Context& context, const FrameSlot& slot);
void reset_slot_queries(const Context& context, const FrameSlot& slot);

}  // namespace rg
