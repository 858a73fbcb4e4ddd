// What a Device owns. Shared with the runtime's own files, not with users.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/device.h"
#include "runtime/functions.h"
#include "runtime/handles.h"
#include "runtime/pipeline_cache.h"

namespace rg {

struct NullDevice;  // null_device.cpp
struct NullDeviceDeleter {
  void operator()(NullDevice* device) const;
};

// A pool with the command buffers that were allocated from it, `used` of them by its owner.
struct CommandPool {
  uint32_t family = 0;
  UniqueCommandPool pool;
  std::vector<VkCommandBuffer> commands;
  size_t used = 0;
};

// One VkQueue. Several instances, and with a lent one the engine too, submit to it: only under the mutex.
struct DeviceQueue {
  VkQueue handle = VK_NULL_HANDLE;
  uint32_t family = 0;
  VkQueueFlags flags = 0;  // graphics and compute imply transfer
  uint32_t timestamp_bits = 0;
  bool whole_copies_only = false;  // copies of parts of an image are restricted
  std::mutex* mutex = nullptr;
};

struct Device::State {
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  DeviceFunctions vk;
  void* library = nullptr;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  std::vector<DeviceQueue> queues;  // [0] does graphics and compute
  std::vector<uint32_t> families;   // of `queues`, without repetition
  std::vector<std::unique_ptr<std::mutex>> mutexes;
  bool owned = false;  // instance, messenger and device are destroyed with the state
  std::string name;
  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceMemoryProperties memory{};
  bool validating = false;
  bool classic_render_passes = false;  // the validation layer is blind to attachments of dynamic rendering
  bool load_op_none = false;
  bool sampler_anisotropy = false;
  bool multi_draw_indirect = false, draw_indirect_count = false;
  bool host_query_reset = false;
  bool pipeline_statistics = false;
  uint32_t capabilities = 0, without = 0;  // bits of Capability: present, and not to be looked for
  CacheIdentity identity;
  VkPipelineCache pipeline_cache = VK_NULL_HANDLE;  // the engine's, or that of `cache_file`
  PipelineCacheFile cache_file;
  // Semaphores that a submit has waited for stay until 64 others have come: drivers (Mesa) touch them after they have signalled that the submit is
  // done.
  std::array<std::shared_ptr<void>, 64> resting;
  size_t next_resting = 0;
  std::mutex resting_mutex;
  void rest(std::shared_ptr<void> object);
  // While validating, pools outlive instances: the validation layer keeps about 3 KiB of every command buffer that was ever allocated, freed or not.
  std::vector<CommandPool> spare_pools;
  std::mutex spare_mutex;
  CommandPool take_pool(uint32_t family);  // without a handle: there is none to spare
  void give_pool(CommandPool pool);        // nothing of it is in flight
  std::atomic<bool> lost = false;          // said once; everything after fails without a call
  std::function<void(bool is_error, std::string_view message)> on_message;
  std::atomic<uint64_t> messages = 0;
  std::unique_ptr<NullDevice, NullDeviceDeleter> null;
};

// Limits, memory types, properties of `queues` and name of `physical`; needs the instance functions.
void describe_physical_device(Device::State& state);

void add_queue(Device::State& state, const ExternalQueue& queue);

// A lost device is reported as what it is, and not called again.
template <class T>
Result<T> guarded(Device::State& device, Result<T> result) {
  if (!result && result.error().code == ErrorCode::device_lost) device.lost = true;
  return result;
}

// vkDeviceWaitIdle, which nothing may be submitted beside.
VkResult wait_for_queues(Device::State& state);

}  // namespace rg
