// What the layer knows about instances and devices, and the functions below it.
#pragma once

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan_core.h>

#include <array>
#include <memory>
#include <shared_mutex>

#include "tests/layer/scheduler.h"

namespace rgc_layer {

// The loader's dispatch table: the first word of every dispatchable object, the same for a device and all that is made from it.
inline void* dispatch_key(const void* handle) { return *static_cast<void* const*>(handle); }

struct InstanceLayer {
  VkInstance handle = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr next = nullptr;
  // Asked for while the instance is created: afterwards the loader answers with the top of the chain, which is this layer again.
  PFN_vkDestroyInstance DestroyInstance = nullptr;
  PFN_vkGetPhysicalDeviceQueueFamilyProperties GetPhysicalDeviceQueueFamilyProperties = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceSupportKHR GetPhysicalDeviceSurfaceSupportKHR = nullptr;
};

struct DeviceLayer;

// What the program gets as a VkQueue.
struct LayerQueue {
  void* dispatch = nullptr;  // must come first
  DeviceLayer* device = nullptr;
  uint32_t family = 0;
};

// clang-format off
#define RGC_LAYER_DEVICE_FUNCTIONS(X)                                                                                                             \
  X(DestroyDevice) X(GetDeviceQueue) X(QueueSubmit2) X(QueueWaitIdle) X(DeviceWaitIdle) X(QueuePresentKHR) X(QueueBindSparse) X(CreateSemaphore)  \
  X(DestroySemaphore) X(SignalSemaphore) X(WaitSemaphores) X(GetSemaphoreCounterValue) X(WaitForFences) X(GetFenceStatus) X(CreateCommandPool)    \
  X(AllocateCommandBuffers) X(FreeCommandBuffers) X(DestroyCommandPool) X(CreateBuffer) X(CreateImage) X(CreateSwapchainKHR) X(CmdPipelineBarrier) \
  X(CmdPipelineBarrier2) X(CmdSetEvent2) X(CmdWaitEvents) X(CmdWaitEvents2) X(SetDebugUtilsObjectNameEXT) X(QueueBeginDebugUtilsLabelEXT)          \
  X(QueueEndDebugUtilsLabelEXT) X(QueueInsertDebugUtilsLabelEXT)
// clang-format on

struct DeviceLayer {
  VkDevice handle = VK_NULL_HANDLE;
  PFN_vkGetDeviceProcAddr next = nullptr;
#define RGC_LAYER_MEMBER(name) PFN_vk##name name = nullptr;
  RGC_LAYER_DEVICE_FUNCTIONS(RGC_LAYER_MEMBER)
#undef RGC_LAYER_MEMBER
  VkQueue real = VK_NULL_HANDLE;
  uint32_t real_family = 0;
  std::array<LayerQueue, kQueues> queues;
  std::unique_ptr<Scheduler> scheduler;
  std::shared_mutex families_mutex;  // guards the two tables below
  std::unordered_map<VkCommandPool, uint32_t> pool_families;
  std::unordered_map<VkCommandBuffer, std::pair<VkCommandPool, uint32_t>> command_families;
};

InstanceLayer& layer_of(VkInstance instance);
InstanceLayer& layer_of(VkPhysicalDevice physical);
DeviceLayer& layer_of(VkDevice device);
DeviceLayer& layer_of(VkCommandBuffer commands);
inline LayerQueue& layer_of(VkQueue queue) { return *reinterpret_cast<LayerQueue*>(queue); }

void add_instance(std::unique_ptr<InstanceLayer> instance);
void remove_instance(VkInstance instance);
void add_device(std::unique_ptr<DeviceLayer> device);
std::unique_ptr<DeviceLayer> remove_device(VkDevice device);

// The first family below that does graphics and compute: everything runs on its first queue.
uint32_t universal_family(const InstanceLayer& instance, VkPhysicalDevice physical);

// Functions of this layer by name; null: not one of them.
PFN_vkVoidFunction find_queue_function(const char* name);   // queues.cpp: submits, waits, semaphores, presentation
PFN_vkVoidFunction find_family_function(const char* name);  // families.cpp: families in pools, resources and barriers

}  // namespace rgc_layer
