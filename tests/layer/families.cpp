// Three families above, one below: indices in pools, resources and barriers are translated.
//
// A transfer of ownership is a release and an acquire that name the same layouts and happen once. Below there is nothing to transfer: the release
// becomes an ordinary barrier that changes no layout, the acquire one that does.
#include <cstring>
#include <mutex>

#include "tests/layer/layer.h"

namespace rgc_layer {

namespace {

bool ours(uint32_t family) { return family < kQueues; }

uint32_t family_of(DeviceLayer& device, VkCommandBuffer commands) {
  const std::shared_lock lock(device.families_mutex);
  const auto row = device.command_families.find(commands);
  return row == device.command_families.end() ? 0 : row->second.second;
}

template <class Barrier>
bool is_transfer(const Barrier& barrier) {
  return ours(barrier.srcQueueFamilyIndex) && ours(barrier.dstQueueFamilyIndex) && barrier.srcQueueFamilyIndex != barrier.dstQueueFamilyIndex;
}
template <class Barrier>
void translate_families(Barrier& barrier) {
  if (ours(barrier.srcQueueFamilyIndex)) barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  if (ours(barrier.dstQueueFamilyIndex)) barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
}
template <class Barrier>
void translate_image(Barrier& barrier, uint32_t family) {
  if (is_transfer(barrier) && family == barrier.srcQueueFamilyIndex) barrier.newLayout = barrier.oldLayout;
  translate_families(barrier);
}
// An image in no layout yet cannot stay in it: such a release says nothing.
template <class Barrier>
bool says_nothing(const Barrier& barrier, uint32_t family) {
  return is_transfer(barrier) && family == barrier.srcQueueFamilyIndex && barrier.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED;
}

template <class Barrier>
std::vector<Barrier> translate_images(const Barrier* barriers, uint32_t count, uint32_t family) {
  std::vector<Barrier> out;
  for (uint32_t i = 0; i < count; ++i) {
    if (says_nothing(barriers[i], family)) continue;
    translate_image(out.emplace_back(barriers[i]), family);
  }
  return out;
}
template <class Barrier>
std::vector<Barrier> translate_buffers(const Barrier* barriers, uint32_t count) {
  std::vector<Barrier> out(barriers, barriers + count);
  for (Barrier& barrier : out) translate_families(barrier);
  return out;
}

// A dependency with its barriers; points into itself.
struct Dependency {
  Dependency(const VkDependencyInfo& from, uint32_t family)
      : buffers(translate_buffers(from.pBufferMemoryBarriers, from.bufferMemoryBarrierCount)),
        images(translate_images(from.pImageMemoryBarriers, from.imageMemoryBarrierCount, family)),
        info(from) {
    info.pBufferMemoryBarriers = buffers.data();
    info.imageMemoryBarrierCount = static_cast<uint32_t>(images.size());
    info.pImageMemoryBarriers = images.data();
  }
  Dependency(const Dependency&) = delete;
  Dependency& operator=(const Dependency&) = delete;
  std::vector<VkBufferMemoryBarrier2> buffers;
  std::vector<VkImageMemoryBarrier2> images;
  VkDependencyInfo info;
};

void VKAPI_CALL CmdPipelineBarrier2(VkCommandBuffer commands, const VkDependencyInfo* info) {
  DeviceLayer& device = layer_of(commands);
  const Dependency dependency(*info, family_of(device, commands));
  device.CmdPipelineBarrier2(commands, &dependency.info);
}
void VKAPI_CALL CmdSetEvent2(VkCommandBuffer commands, VkEvent event, const VkDependencyInfo* info) {
  DeviceLayer& device = layer_of(commands);
  const Dependency dependency(*info, family_of(device, commands));
  device.CmdSetEvent2(commands, event, &dependency.info);
}
void VKAPI_CALL CmdWaitEvents2(VkCommandBuffer commands, uint32_t count, const VkEvent* events, const VkDependencyInfo* infos) {
  DeviceLayer& device = layer_of(commands);
  std::deque<Dependency> dependencies;
  std::vector<VkDependencyInfo> translated;
  for (uint32_t i = 0; i < count; ++i) translated.push_back(dependencies.emplace_back(infos[i], family_of(device, commands)).info);
  device.CmdWaitEvents2(commands, count, events, translated.data());
}
void VKAPI_CALL CmdPipelineBarrier(VkCommandBuffer commands, VkPipelineStageFlags src, VkPipelineStageFlags dst, VkDependencyFlags flags,
                                   uint32_t memory_count, const VkMemoryBarrier* memory, uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
                                   uint32_t image_count, const VkImageMemoryBarrier* images) {
  DeviceLayer& device = layer_of(commands);
  const auto translated_buffers = translate_buffers(buffers, buffer_count);
  const auto translated_images = translate_images(images, image_count, family_of(device, commands));
  device.CmdPipelineBarrier(commands, src, dst, flags, memory_count, memory, buffer_count, translated_buffers.data(),
                            static_cast<uint32_t>(translated_images.size()), translated_images.data());
}
void VKAPI_CALL CmdWaitEvents(VkCommandBuffer commands, uint32_t event_count, const VkEvent* events, VkPipelineStageFlags src,
                              VkPipelineStageFlags dst, uint32_t memory_count, const VkMemoryBarrier* memory, uint32_t buffer_count,
                              const VkBufferMemoryBarrier* buffers, uint32_t image_count, const VkImageMemoryBarrier* images) {
  DeviceLayer& device = layer_of(commands);
  const auto translated_buffers = translate_buffers(buffers, buffer_count);
  const auto translated_images = translate_images(images, image_count, family_of(device, commands));
  device.CmdWaitEvents(commands, event_count, events, src, dst, memory_count, memory, buffer_count, translated_buffers.data(),
                       static_cast<uint32_t>(translated_images.size()), translated_images.data());
}

// ---- pools and command buffers --------------------------------------------------------------------------------------

VkResult VKAPI_CALL CreateCommandPool(VkDevice handle, const VkCommandPoolCreateInfo* info, const VkAllocationCallbacks* allocator,
                                      VkCommandPool* pool) {
  DeviceLayer& device = layer_of(handle);
  VkCommandPoolCreateInfo translated = *info;
  translated.queueFamilyIndex = device.real_family;
  const VkResult result = device.CreateCommandPool(handle, &translated, allocator, pool);
  const std::lock_guard lock(device.families_mutex);
  if (result == VK_SUCCESS) device.pool_families[*pool] = info->queueFamilyIndex;
  return result;
}
void VKAPI_CALL DestroyCommandPool(VkDevice handle, VkCommandPool pool, const VkAllocationCallbacks* allocator) {
  DeviceLayer& device = layer_of(handle);
  {
    const std::lock_guard lock(device.families_mutex);
    device.pool_families.erase(pool);
    std::erase_if(device.command_families, [&](const auto& row) { return row.second.first == pool; });
  }
  device.DestroyCommandPool(handle, pool, allocator);
}
VkResult VKAPI_CALL AllocateCommandBuffers(VkDevice handle, const VkCommandBufferAllocateInfo* info, VkCommandBuffer* commands) {
  DeviceLayer& device = layer_of(handle);
  const VkResult result = device.AllocateCommandBuffers(handle, info, commands);
  const std::lock_guard lock(device.families_mutex);
  for (uint32_t i = 0; i < info->commandBufferCount && result == VK_SUCCESS; ++i)
    device.command_families[commands[i]] = {info->commandPool, device.pool_families[info->commandPool]};
  return result;
}
void VKAPI_CALL FreeCommandBuffers(VkDevice handle, VkCommandPool pool, uint32_t count, const VkCommandBuffer* commands) {
  DeviceLayer& device = layer_of(handle);
  {
    const std::lock_guard lock(device.families_mutex);
    for (uint32_t i = 0; i < count; ++i) device.command_families.erase(commands[i]);
  }
  device.FreeCommandBuffers(handle, pool, count, commands);
}

// ---- sharing --------------------------------------------------------------------------------------------------------

VkResult VKAPI_CALL CreateBuffer(VkDevice handle, const VkBufferCreateInfo* info, const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
  VkBufferCreateInfo translated = *info;
  translated.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  translated.queueFamilyIndexCount = 0;
  return layer_of(handle).CreateBuffer(handle, &translated, allocator, buffer);
}
VkResult VKAPI_CALL CreateImage(VkDevice handle, const VkImageCreateInfo* info, const VkAllocationCallbacks* allocator, VkImage* image) {
  VkImageCreateInfo translated = *info;
  translated.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  translated.queueFamilyIndexCount = 0;
  return layer_of(handle).CreateImage(handle, &translated, allocator, image);
}
VkResult VKAPI_CALL CreateSwapchainKHR(VkDevice handle, const VkSwapchainCreateInfoKHR* info, const VkAllocationCallbacks* allocator,
                                       VkSwapchainKHR* swapchain) {
  VkSwapchainCreateInfoKHR translated = *info;
  translated.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  translated.queueFamilyIndexCount = 0;
  return layer_of(handle).CreateSwapchainKHR(handle, &translated, allocator, swapchain);
}

}  // namespace

PFN_vkVoidFunction find_family_function(const char* name) {
  struct Row {
    const char* name;
    PFN_vkVoidFunction function;
  };
#define RGC_ROW(function) \
  { "vk" #function, reinterpret_cast<PFN_vkVoidFunction>(function) }
#define RGC_KHR_ROW(function) \
  { "vk" #function "KHR", reinterpret_cast<PFN_vkVoidFunction>(function) }
  static const Row rows[] = {
      RGC_ROW(CmdPipelineBarrier2), RGC_KHR_ROW(CmdPipelineBarrier2), RGC_ROW(CmdSetEvent2),       RGC_KHR_ROW(CmdSetEvent2),
      RGC_ROW(CmdWaitEvents2),      RGC_KHR_ROW(CmdWaitEvents2),      RGC_ROW(CmdPipelineBarrier), RGC_ROW(CmdWaitEvents),
      RGC_ROW(CreateCommandPool),   RGC_ROW(DestroyCommandPool),      RGC_ROW(FreeCommandBuffers), RGC_ROW(CreateBuffer),
      RGC_ROW(CreateImage),         RGC_ROW(AllocateCommandBuffers),  RGC_ROW(CreateSwapchainKHR),
  };
#undef RGC_ROW
#undef RGC_KHR_ROW
  for (const Row& row : rows)
    if (std::strcmp(row.name, name) == 0) return row.function;
  return nullptr;
}

}  // namespace rgc_layer
