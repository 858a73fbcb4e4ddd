// Brings fresh resources into the plan's entry state.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// On a queue of the first of QueueMap::families: clears, entry layouts, and releases of what other families own at the frame's ends.
bool record_prologue(const Context& context, const Sized& sized, VkCommandBuffer commands, uint64_t next_frame);

// On a queue of another family: acquires what it owns. False: there was nothing to record.
bool record_first_owner(const Context& context, const Sized& sized, VkCommandBuffer commands, uint64_t next_frame, uint32_t family);

}  // namespace rg
