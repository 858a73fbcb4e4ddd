// What a Device owns. Shared with the runtime's own files, not with users.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "runtime/device.h"
#include "runtime/functions.h"

namespace rg {

struct NullDevice;  // null_device.cpp
struct NullDeviceDeleter {
  void operator()(NullDevice* device) const;
};

struct Device::State {
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  DeviceFunctions vk;
  void* library = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queue_family = 0;
  bool owned = false;  // instance, messenger and device are destroyed with the state
  std::string name;
  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceMemoryProperties memory{};
  bool validating = false;
  bool classic_render_passes = false;  // the validation layer is blind to attachments of dynamic rendering
  bool load_op_none = false;
  bool sampler_anisotropy = false;
  bool multi_draw_indirect = false;
  uint32_t timestamp_bits = 0;
  std::function<void(bool is_error, std::string_view message)> on_message;
  std::atomic<uint64_t> messages = 0;
  std::mutex queue_mutex;  // instances of one device submit to one queue
  std::unique_ptr<NullDevice, NullDeviceDeleter> null;
};

// Limits, memory types, queue properties and name of `physical`; needs the instance functions.
void describe_physical_device(Device::State& state);

}  // namespace rg
