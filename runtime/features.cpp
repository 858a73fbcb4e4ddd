#include "runtime/features.h"

#include <cstring>

namespace rg {

namespace {

template <class Struct>
struct Feature {
  const char* name;
  VkBool32 Struct::*member;
  bool required;
};

#define RG_FEATURE(Struct, member, required) \
  { #member, &Struct::member, required }
constexpr Feature<VkPhysicalDeviceFeatures> kCore[] = {
    RG_FEATURE(VkPhysicalDeviceFeatures, fragmentStoresAndAtomics, true),
    RG_FEATURE(VkPhysicalDeviceFeatures, independentBlend, true),
    RG_FEATURE(VkPhysicalDeviceFeatures, shaderStorageImageExtendedFormats, true),
    RG_FEATURE(VkPhysicalDeviceFeatures, vertexPipelineStoresAndAtomics, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, shaderStorageImageWriteWithoutFormat, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, samplerAnisotropy, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, pipelineStatisticsQuery, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, multiDrawIndirect, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, drawIndirectFirstInstance, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, imageCubeArray, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, tessellationShader, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, geometryShader, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, depthBounds, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, depthClamp, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, depthBiasClamp, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, fillModeNonSolid, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, fullDrawIndexUint32, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, sampleRateShading, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, textureCompressionBC, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, shaderUniformBufferArrayDynamicIndexing, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, shaderSampledImageArrayDynamicIndexing, false),
    RG_FEATURE(VkPhysicalDeviceFeatures, shaderStorageBufferArrayDynamicIndexing, false),
};
constexpr Feature<VkPhysicalDeviceVulkan11Features> kV11[] = {
    RG_FEATURE(VkPhysicalDeviceVulkan11Features, multiview, false),
    RG_FEATURE(VkPhysicalDeviceVulkan11Features, shaderDrawParameters, false),
};
constexpr Feature<VkPhysicalDeviceVulkan12Features> kV12[] = {
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, timelineSemaphore, true),
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, separateDepthStencilLayouts, true),
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, scalarBlockLayout, false),
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, uniformBufferStandardLayout, false),
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, drawIndirectCount, false),
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, shaderOutputLayer, false),
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, bufferDeviceAddress, false),
    RG_FEATURE(VkPhysicalDeviceVulkan12Features, hostQueryReset, false),
};
constexpr Feature<VkPhysicalDeviceVulkan13Features> kV13[] = {
    RG_FEATURE(VkPhysicalDeviceVulkan13Features, synchronization2, true),
    RG_FEATURE(VkPhysicalDeviceVulkan13Features, dynamicRendering, true),
    RG_FEATURE(VkPhysicalDeviceVulkan13Features, maintenance4, false),
    RG_FEATURE(VkPhysicalDeviceVulkan13Features, shaderDemoteToHelperInvocation, false),
    RG_FEATURE(VkPhysicalDeviceVulkan13Features, subgroupSizeControl, false),
};
#undef RG_FEATURE

template <class Struct, size_t Count>
void collect_missing(const Feature<Struct> (&table)[Count], const Struct& available, std::vector<std::string>& missing) {
  for (const Feature<Struct>& feature : table)
    if (feature.required && available.*feature.member == VK_FALSE) missing.push_back(feature.name);
}

template <class Struct, size_t Count>
void copy_available(const Feature<Struct> (&table)[Count], const Struct& available, Struct& wanted) {
  for (const Feature<Struct>& feature : table) wanted.*feature.member = available.*feature.member;
}

}  // namespace

FeatureChain::FeatureChain() : core{}, v11{}, v12{}, v13{} {
  v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  v12.pNext = &v13;
  v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
  v11.pNext = &v12;
  core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  core.pNext = &v11;
}

std::vector<std::string> missing_features(const FeatureChain& available) {
  std::vector<std::string> missing;
  collect_missing(kCore, available.core.features, missing);
  collect_missing(kV11, available.v11, missing);
  collect_missing(kV12, available.v12, missing);
  collect_missing(kV13, available.v13, missing);
  return missing;
}

void enable_available(FeatureChain& wanted, const FeatureChain& available) {
  copy_available(kCore, available.core.features, wanted.core.features);
  copy_available(kV11, available.v11, wanted.v11);
  copy_available(kV12, available.v12, wanted.v12);
  copy_available(kV13, available.v13, wanted.v13);
}

bool has_device_extension(const DeviceFunctions& vk, VkPhysicalDevice physical, const char* name) {
  uint32_t count = 0;
  vk.EnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vk.EnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  for (const VkExtensionProperties& extension : extensions)
    if (std::strcmp(extension.extensionName, name) == 0) return true;
  return false;
}

}  // namespace rg
