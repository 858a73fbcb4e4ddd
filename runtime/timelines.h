// What is submitted and what is done, over all queues of an instance. Allocates nothing but in create.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

Status create_timelines(GraphInstance::State& state);

// Waits on the host. Zeros cost nothing.
Status wait_for(const GraphInstance::State& state, const Moment& moment);

// Waits on the host for what the next frame would wait for.
Status wait_for_entry(GraphInstance::State& state);

// False also where the driver cannot say.
bool reached(const GraphInstance::State& state, const Moment& moment);

// Drops what resizes have retired and the device has finished with.
void release_retired(GraphInstance::State& state);

}  // namespace rg
