// A Vulkan device to run graphs on: its own, an engine's, or one that only records text.
#pragma once

#include <vulkan/vulkan_core.h>

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/plan.h"
#include "runtime/result.h"

namespace rg {

struct DeviceFunctions;  // runtime/functions.h: every Vulkan function the runtime calls, loaded per device

// How a device of the runtime's own is made.
struct DeviceOptions {
  int device = -1;        // index as `list_devices` numbers them; -1: best
  bool validate = false;  // Khronos validation with synchronization and submit-time checks; an error if the layer is missing
  std::function<void(bool is_error, std::string_view message)> on_message;  // validation messages
  std::vector<const char*> instance_extensions, device_extensions;
  std::vector<const char*> layers;  // below validation, in this order
  std::vector<Capability> without;  // left alone although the device has them: what runs elsewhere can be tried here
  // A file that keeps the driver's compiled pipelines between runs; empty: none. Read when the device is made: one that is missing, damaged, longer
  // than 256 MiB, or of another device or driver counts as empty. Written by save_pipeline_cache, and by ~Device where pipelines have come; never
  // read again.
  std::string pipeline_cache;
};
// A queue that an engine lends. Vulkan wants calls on one queue to exclude each other: where the engine submits to it as well, both lock `mutex`
// (which outlives the Device); null: only this Device submits to it.
struct ExternalQueue {
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;
  std::mutex* mutex = nullptr;
};
// Optional device features and extensions that an engine has enabled. What is false is never used; each has a fallback but one.
struct EnabledFeatures {
  bool sampler_anisotropy = false;   // else samplers are isotropic
  bool multi_draw_indirect = false;  // else one call a draw
  bool draw_indirect_count = false;  // else plans whose numbers of draws come from buffers are refused
  bool host_query_reset = false;     // else only passes of graphics and compute queues are timed
  bool pipeline_statistics = false;  // else there are none
  bool load_op_none = false;         // VK_EXT_load_store_op_none; else attachments that are not touched are loaded
  // Answers to `feature NAME : device CAPABILITY`.
  bool depth_bounds = false, conservative_rasterization = false, barycentrics = false, sample_locations = false, multiview = false;
};
// An engine's device. Must be Vulkan 1.3 with synchronization2, dynamicRendering and timelineSemaphore enabled. Nothing is owned: everything here
// outlives the Device.
struct ExternalDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;  // does graphics and compute
  uint32_t queue_family = 0;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  std::mutex* queue_mutex = nullptr;                // see ExternalQueue
  std::span<const ExternalQueue> more_queues = {};  // taken by plans that have queues of their kind
  EnabledFeatures features = {};
  const VkAllocationCallbacks* allocator =
      nullptr;  // called from several threads at a time, unless every instance has one of GraphOptions::threads and pipeline_threads
  VkPipelineCache pipeline_cache =
      VK_NULL_HANDLE;  // used by all pipelines of the runtime; likewise, so not made VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT
};

// What a null device counts and how it misbehaves.
struct NullCounters {
  uint64_t fallible_calls = 0;  // calls that return a VkResult, failed ones included
  uint64_t live_handles = 0;    // created and not yet destroyed, without the device itself
  uint64_t wrong_destroys = 0;  // of handles that are not alive
  uint64_t unmet_waits = 0;     // waits, on the host or in a submit, for values that nobody had submitted a signal for
};
// What a null device has, and which of its calls fail.
struct NullOptions {
  uint64_t fail_at = 0;  // this fallible call and no other fails; counted from 1, 0: none
  VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  NullCounters* counters = nullptr;                            // outlives the device
  bool fails_from_then_on = false;                             // `fail_at` and all later ones fail: a lost device stays lost
  uint32_t compute_queues = 0, transfer_queues = 0;            // each kind in a family of its own, beside one universal queue
  std::vector<Capability> capabilities = {};                   // that it has
  bool lazy_memory = false;                                    // a memory type that is backed as needed, for images that live in renderings only
  bool prefers_dedicated = false, requires_dedicated = false;  // memory of its own for every image
};

// One Vulkan device and its queues. Outlives every instance, swapchain and object made with it. Movable: what was made with it stays valid. Any
// thread may use it; submits to one queue exclude each other.
class Device {
 public:
  // A device of the runtime's own with up to two queues of every family. `unsupported` where there is no loader, no driver or no device that
  // suffices, with what is missing.
  static Result<Device> create(const DeviceOptions& options);
  // The engine's device. `unsupported` where a function that the runtime needs is missing; `invalid_argument` where a handle is.
  static Result<Device> adopt(const ExternalDevice& external);
  // Records every call as one line of text into `log`; nothing runs. Handles are numbered in order of creation.
  // `log` may be null. Semaphores are signalled at submit, mapped memory is real and zero.
  static Device null(std::string* log, const NullOptions& options = {});
  Device(Device&&) noexcept;  // leaves an object that can only be destroyed or assigned to
  Device& operator=(Device&&) noexcept;
  ~Device();

  const DeviceFunctions& vk() const;  // valid while the device lives, also when it moves
  VkInstance instance() const;        // the runtime's, or the engine's
  // Any function of the instance by name, for extensions that the runtime does not use (surfaces, say); null: there is none.
  PFN_vkVoidFunction instance_function(const char* name) const;
  VkDevice handle() const;            // likewise
  VkPhysicalDevice physical() const;  // the device that it runs on
  VkQueue queue() const;              // does graphics and compute
  uint32_t queue_family() const;      // of queue()
  size_t queue_count() const;         // over all families
  // The families of all queues, without repetition. Imports that a plan uses on several queues (Resource::concurrent) are created for all of them.
  std::span<const uint32_t> queue_families() const;
  // Waits on the host until nothing runs; for shutting down. Excludes submits of other threads.
  Status wait_idle();
  // Writes what the driver has compiled so far to `DeviceOptions::pipeline_cache`, under another name in the same folder that is then renamed. Any
  // thread, also while pipelines are made. Of several processes that write one file the last one wins. `io`, with the file as it was, where it cannot
  // be written; `out_of_memory` or `driver` where the driver gives nothing; `invalid_argument` where no file was named. Cost: O(bytes), at most 256
  // MiB; blocks. ~Device does the same, and has nobody to tell.
  Status save_pipeline_cache();
  uint64_t pipeline_cache_loaded() const;        // bytes that the file held when the device was made; 0: it counted as empty
  std::string_view name() const;                 // "llvmpipe (LLVM 15.0.6, 256 bits)"
  const VkPhysicalDeviceLimits& limits() const;  // of the physical device
  bool has(Capability capability) const;         // as enabled, less `DeviceOptions::without`
  bool validating() const;                       // the layer is really loaded
  uint64_t validation_messages() const;          // errors and warnings of synchronization and core checks so far
  uint32_t memory_type(uint32_t type_bits, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred = 0) const;  // UINT32_MAX: none

  struct State;                       // device_state.h, for the runtime's own files
  State& state() { return *state_; }  // likewise

 private:
  explicit Device(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// A device that the loader knows; `reason`: why it is not usable.
struct DeviceDescription {
  std::string name;
  uint32_t api_version = 0;
  bool usable = false;
  std::string reason;
};
// All of them, numbered as DeviceOptions::device. Makes an instance and destroys it; empty where there is no loader.
std::vector<DeviceDescription> list_devices();

}  // namespace rg
