// Placement of a graph's resources by their real memory requirements.
//
//   transients            one heap a memory type, packed by runtime/packing.h; bytes are shared only between allowed alias pairs
//   lazy attachments      one allocation in lazily allocated memory, side by side, where the device has such memory; else transients like others
//   persistent, history   one allocation a resource, side by side
//   readback              one allocation a memory type in memory that the host reads
//
// An image has memory of its own where the driver requires it, or prefers it and it shares none (VkMemoryDedicatedRequirements).
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// `dedicated`: the image that it is for, and no other; null: whatever is bound to it.
Result<UniqueMemory> allocate_memory(Device::State& device, VkDeviceSize bytes, uint32_t type, std::string_view name,
                                     VkImage dedicated = VK_NULL_HANDLE);

// Places and binds every image and buffer of `sized`, maps read-back memory, fills report and placements.
Status place_resources(const Context& context, Sized& sized);

}  // namespace rg
