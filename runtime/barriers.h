// Barrier groups as Vulkan structs, translated once for every combination of physical copies.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Fills groups, poisons and the list of barriers on imports. Needs placed resources.
void create_barriers(const Context& context, Sized& sized);

// Puts this frame's imported handles into the translated barriers.
void update_imported_barriers(const Context& context, Sized& sized, const std::vector<Import>& imports);

// ---- poison ---------------------------------------------------------------------------------------------------------
// Debug mode: what a group acquires is filled with a pattern right before, so that reads of undefined contents show. The group's discarding
// barriers then start from the fill instead of from `undefined`.
void add_poison(const Context& context, Sized& sized);
void record_poison(const Context& context, const Sized& sized, const PoisonTable& poison, VkCommandBuffer commands);

}  // namespace rg
