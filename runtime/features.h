// The device features the runtime asks for, as tables.
#pragma once

#include <string>
#include <vector>

#include "runtime/functions.h"

namespace rg {

// A pNext chain of feature structs; not movable because it points into itself.
struct FeatureChain {
  FeatureChain();
  FeatureChain(const FeatureChain&) = delete;
  FeatureChain& operator=(const FeatureChain&) = delete;
  VkPhysicalDeviceFeatures2 core;
  VkPhysicalDeviceVulkan11Features v11;
  VkPhysicalDeviceVulkan12Features v12;
  VkPhysicalDeviceVulkan13Features v13;
};

// Names of required features that `available` lacks, in table order.
std::vector<std::string> missing_features(const FeatureChain& available);

// Sets in `wanted` every known feature that `available` has, and no other.
void enable_available(FeatureChain& wanted, const FeatureChain& available);

bool has_device_extension(const DeviceFunctions& vk, VkPhysicalDevice physical, const char* name);

}  // namespace rg
