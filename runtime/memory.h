// Placement of a graph's resources by their real memory requirements.
//
//   transients            one heap a memory type, packed by runtime/packing.h; bytes are shared only between allowed alias pairs
//   persistent, history   one allocation a memory type, side by side
//   readback              the same in memory that the host reads
#pragma once

#include "runtime/graph_state.h"

namespace rg {

Result<UniqueMemory> allocate_memory(Device::State& device, VkDeviceSize bytes, uint32_t type, std::string_view name);

// Places and binds every image and buffer of `sized`, maps read-back memory, fills report and placements.
Status place_resources(const Context& context, Sized& sized);

}  // namespace rg
