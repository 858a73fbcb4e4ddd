// A Vulkan device to run graphs on: its own, an engine's, or one that only records text.
#pragma once

#include <vulkan/vulkan_core.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/result.h"

namespace rg {

struct DeviceFunctions;  // runtime/functions.h: every Vulkan function the runtime calls, loaded per device

struct DeviceOptions {
  int device = -1;              // index as `list_devices` numbers them; -1: best
  bool validate = false;        // Khronos validation with synchronization and submit-time checks; an error if the layer is missing
  std::function<void(bool is_error, std::string_view message)> on_message;  // validation messages
  std::vector<const char*> instance_extensions, device_extensions;
};
// An engine's device. Must be Vulkan 1.3 with synchronization2, dynamicRendering and timelineSemaphore enabled. Nothing is owned.
struct ExternalDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queue_family = 0;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
};

// What a null device counts and how it misbehaves.
struct NullCounters {
  uint64_t fallible_calls = 0;  // calls that return a VkResult, failed ones included
  uint64_t live_handles = 0;    // created and not yet destroyed, without the device itself
};
struct NullOptions {
  uint64_t fail_at = 0;                                     // this fallible call and no other fails; counted from 1, 0: none
  VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  NullCounters* counters = nullptr;                         // outlives the device
};

class Device {
 public:
  static Result<Device> create(const DeviceOptions& options);
  static Result<Device> adopt(const ExternalDevice& external);
  // Records every call as one line of text into `log`; nothing runs. Handles are numbered in order of creation.
  // `log` may be null. Semaphores are signalled at submit, mapped memory is real and zero.
  static Device null(std::string* log, const NullOptions& options = {});
  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;
  ~Device();

  const DeviceFunctions& vk() const;
  VkDevice handle() const;
  VkPhysicalDevice physical() const;
  VkQueue queue() const;
  uint32_t queue_family() const;
  std::string_view name() const;          // "llvmpipe (LLVM 15.0.6, 256 bits)"
  const VkPhysicalDeviceLimits& limits() const;
  bool validating() const;                // the layer is really loaded
  uint64_t validation_messages() const;   // errors and warnings of synchronization and core checks so far
  uint32_t memory_type(uint32_t type_bits, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred = 0) const;  // UINT32_MAX: none

  struct State;
  State& state() { return *state_; }

 private:
  explicit Device(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct DeviceDescription { std::string name; uint32_t api_version = 0; bool usable = false; std::string reason; };
std::vector<DeviceDescription> list_devices();

}  // namespace rg
