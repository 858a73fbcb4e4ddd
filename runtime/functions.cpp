#include "runtime/functions.h"

namespace rg {

const char* load_global_functions(DeviceFunctions& vk, PFN_vkGetInstanceProcAddr get) {
#define RG_GLOBAL(name)                                                      \
  vk.name = reinterpret_cast<PFN_vk##name>(get(VK_NULL_HANDLE, "vk" #name)); \
  if (vk.name == nullptr) return "vk" #name;
#include "runtime/functions.def"
  return nullptr;
}

const char* load_instance_functions(DeviceFunctions& vk, PFN_vkGetInstanceProcAddr get, VkInstance instance) {
#define RG_INSTANCE_OPTIONAL(name) vk.name = reinterpret_cast<PFN_vk##name>(get(instance, "vk" #name));
#define RG_INSTANCE(name)    \
  RG_INSTANCE_OPTIONAL(name) \
  if (vk.name == nullptr) return "vk" #name;
#include "runtime/functions.def"
  return nullptr;
}

const char* load_device_functions(DeviceFunctions& vk, VkDevice device) {
#define RG_DEVICE_OPTIONAL(name) vk.name = reinterpret_cast<PFN_vk##name>(vk.GetDeviceProcAddr(device, "vk" #name));
#define RG_DEVICE(name)    \
  RG_DEVICE_OPTIONAL(name) \
  if (vk.name == nullptr) return "vk" #name;
#include "runtime/functions.def"
  return nullptr;
}

}  // namespace rg
