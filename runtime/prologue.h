// Brings freshly created resources into the plan's entry state, so that no frame is special.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Records, for the frame that comes next: initial clears of every copy, then the transition of every entry boundary.
void record_prologue(const Context& context, const Sized& sized, VkCommandBuffer commands, uint64_t next_frame);

}  // namespace rg
