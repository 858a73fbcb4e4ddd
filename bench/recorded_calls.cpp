#include "bench/recorded_calls.h"

#include <cstring>
#include <map>
#include <string>

#include "runtime/functions.h"

namespace rg::bench {
namespace {

Calls* kept = nullptr;
PFN_vkGetInstanceProcAddr real_instance_function = nullptr;
PFN_vkGetDeviceProcAddr real_device_function = nullptr;

// One vkCmd function: passes the call on and keeps it.
template <class Tag, class Function>
struct Keeping;
template <class Tag, class... Arguments>
struct Keeping<Tag, void (*)(VkCommandBuffer, Arguments...)> {
  static inline void (*real)(VkCommandBuffer, Arguments...) = nullptr;
  static void call(VkCommandBuffer commands, Arguments... arguments) {
    if (kept != nullptr) kept->push_back([=](VkCommandBuffer into) { real(into, arguments...); });
    real(commands, arguments...);
  }
  static PFN_vkVoidFunction wrap(PFN_vkVoidFunction function) {
    real = reinterpret_cast<void (*)(VkCommandBuffer, Arguments...)>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(call);
  }
};
template <class Tag, class Result, class... Arguments>
struct Keeping<Tag, Result (*)(Arguments...)> {
  static PFN_vkVoidFunction wrap(PFN_vkVoidFunction function) { return function; }
};

#define RG_DEVICE(name) \
  struct Tag##name {};
#define RG_DEVICE_OPTIONAL RG_DEVICE
#include "runtime/functions.def"

PFN_vkVoidFunction wrap(const char* name, PFN_vkVoidFunction function) {
  using Wrap = PFN_vkVoidFunction (*)(PFN_vkVoidFunction);
  static const std::map<std::string, Wrap> table = {
#define RG_DEVICE(name) {"vk" #name, Keeping<Tag##name, PFN_vk##name>::wrap},
#define RG_DEVICE_OPTIONAL RG_DEVICE  // labels among them
#include "runtime/functions.def"
  };
  const auto row = table.find(name);
  return function == nullptr || row == table.end() ? function : row->second(function);
}

PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) { return wrap(name, real_device_function(device, name)); }
PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(device_function);
  return real_instance_function(instance, name);
}

}  // namespace

Result<Device> keeping_device(Device& real) {
  real_instance_function = reinterpret_cast<PFN_vkGetInstanceProcAddr>(real.instance_function("vkGetInstanceProcAddr"));
  real_device_function = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real.instance_function("vkGetDeviceProcAddr"));
  if (real_instance_function == nullptr || real_device_function == nullptr) return Error{ErrorCode::unsupported, "the loader hides its functions"};
  ExternalDevice external;
  external.instance = real.instance(), external.physical_device = real.physical(), external.device = real.handle();
  external.queue = real.queue(), external.queue_family = real.queue_family();
  external.get_instance_proc_addr = instance_function;
  return Device::adopt(external);
}

void keep_calls(Calls* calls) { kept = calls; }

}  // namespace rg::bench
