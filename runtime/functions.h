// The Vulkan functions of one device. There is no global table: two devices may come from two loaders, and one may be null.
#pragma once

#include <vulkan/vulkan_core.h>

namespace rg {

struct DeviceFunctions {
  const VkAllocationCallbacks* allocator = nullptr;  // the engine's, for every object made and destroyed through this table
#define RG_MEMBER(name) PFN_vk##name name = nullptr;
#define RG_GLOBAL RG_MEMBER
#define RG_INSTANCE RG_MEMBER
#define RG_INSTANCE_OPTIONAL RG_MEMBER
#define RG_DEVICE RG_MEMBER
#define RG_DEVICE_OPTIONAL RG_MEMBER
#include "runtime/functions.def"
#undef RG_MEMBER
};

// Each fills its part and returns the first required function that is missing, or null. Device functions need the instance part.
const char* load_global_functions(DeviceFunctions& vk, PFN_vkGetInstanceProcAddr get);
const char* load_instance_functions(DeviceFunctions& vk, PFN_vkGetInstanceProcAddr get, VkInstance instance);
const char* load_device_functions(DeviceFunctions& vk, VkDevice device);

}  // namespace rg
