// Images, buffers, the ring and their memory at given extents.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Evaluates sizes of every resource; no Vulkan objects yet. Fails where the device's limits are exceeded.
Status size_resources(const Context& context, Sized& sized);

// Fills `active` for the extents that are set now.
void active_extents_of_images(const Context& context, Sized& sized);

// An instance whose history and persistent contents go on in another one.
struct Carried {
  const Plan& plan;
  const Sized& sized;
  const Context& context;
  // Between frames both plans have the resource with one owner, and what has to change between them is a layout of whole boundary rows of the new
  // one.
  bool may_carry(const Context& now, Index resource, Index before) const;
};
// The layout of a subresource between two frames of a plan.
Layout layout_between_frames(const Plan& plan, Ref ref, uint32_t aspects, uint32_t mip, uint32_t layer);

// Creates images and buffers, or takes them over from `from` (may be null), places and binds them, fills the memory report.
Status create_resources(const Context& context, const Carried* from, Sized& sized);

// A buffer of its own in mapped host memory, for all queues.
struct HostBuffer {
  UniqueMemory memory;
  UniqueBuffer buffer;
  std::byte* mapped = nullptr;
};
Result<HostBuffer> create_host_buffer(const Context& context, VkDeviceSize bytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags preferred,
                                      std::string_view name);

uint32_t find_memory_type(const Device::State& device, uint32_t type_bits, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred);

// Names an object for tools, where they listen.
template <class Handle>
void name_object(const Device::State& device, VkObjectType type, Handle handle, std::string_view name);
void name_object(const Device::State& device, VkObjectType type, uint64_t handle, std::string_view name);
template <class Handle>
void name_object(const Device::State& device, VkObjectType type, Handle handle, std::string_view name) {
  name_object(device, type, reinterpret_cast<uint64_t>(handle), name);
}

}  // namespace rg
