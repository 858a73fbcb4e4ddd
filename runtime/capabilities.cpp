#include "runtime/capabilities.h"

#include <array>
#include <cstdio>

#include "runtime/features.h"

namespace rg {
namespace {

struct Extension {
  Capability capability;
  const char* name;
};
constexpr Extension kExtensions[] = {{Capability::conservative_rasterization, VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME},
                                     {Capability::barycentrics, VK_KHR_FRAGMENT_SHADER_BARYCENTRIC_EXTENSION_NAME},
                                     {Capability::sample_locations, VK_EXT_SAMPLE_LOCATIONS_EXTENSION_NAME}};

}  // namespace

std::string_view name(Capability capability) {
  static constexpr std::array<std::string_view, 12> kNames = {
      "none",         "subgroup_arithmetic",        "subgroup_ballot", "subgroup_shuffle", "subgroup_quad", "subgroup_size_32", "subgroup_size_64",
      "depth_bounds", "conservative_rasterization", "barycentrics",    "sample_locations", "multiview"};
  return kNames[static_cast<size_t>(capability)];
}

std::vector<const char*> capability_extensions(const Device::State& state) {
  std::vector<const char*> names;
  for (const Extension& extension : kExtensions)
    if (has_device_extension(state.vk, state.physical, extension.name) && (state.without & bit(extension.capability)) == 0)
      names.push_back(extension.name);
  return names;
}

uint32_t subgroup_capabilities(const Device::State& state) {
  VkPhysicalDeviceSubgroupProperties subgroups{};
  subgroups.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &subgroups;
  state.vk.GetPhysicalDeviceProperties2(state.physical, &properties);
  uint32_t bits = 0;
  const auto add = [&](bool has, Capability capability) { bits |= has ? bit(capability) : 0; };
  const bool compute = (subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  add(compute && (subgroups.supportedOperations & VK_SUBGROUP_FEATURE_ARITHMETIC_BIT) != 0, Capability::subgroup_arithmetic);
  add(compute && (subgroups.supportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT) != 0, Capability::subgroup_ballot);
  add(compute && (subgroups.supportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT) != 0, Capability::subgroup_shuffle);
  add(compute && (subgroups.supportedOperations & VK_SUBGROUP_FEATURE_QUAD_BIT) != 0, Capability::subgroup_quad);
  add(compute && subgroups.subgroupSize == 32, Capability::subgroup_size_32);
  add(compute && subgroups.subgroupSize == 64, Capability::subgroup_size_64);
  return bits & ~state.without;
}

bool places_samples(const Device::State& state) {
  VkPhysicalDeviceSampleLocationsPropertiesEXT locations{};
  locations.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SAMPLE_LOCATIONS_PROPERTIES_EXT;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &locations;
  state.vk.GetPhysicalDeviceProperties2(state.physical, &properties);
  const VkSampleCountFlags attachments =
      properties.properties.limits.framebufferColorSampleCounts & ~static_cast<VkSampleCountFlags>(VK_SAMPLE_COUNT_1_BIT);
  return (attachments & ~locations.sampleLocationSampleCounts) == 0;
}

bool draws_every_view(const Device::State& state) {
  constexpr unsigned kSound = 25;  // of Mesa, the oldest that was seen to; the driver's own version is 1 in all of them
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  state.vk.GetPhysicalDeviceProperties2(state.physical, &properties);
  unsigned mesa = 0;
  return driver.driverID != VK_DRIVER_ID_MESA_LLVMPIPE || (std::sscanf(driver.driverInfo, "Mesa %u", &mesa) == 1 && mesa >= kSound);
}

uint32_t enabled_capabilities(const EnabledFeatures& features) {
  uint32_t bits = 0;
  if (features.depth_bounds) bits |= bit(Capability::depth_bounds);
  if (features.conservative_rasterization) bits |= bit(Capability::conservative_rasterization);
  if (features.barycentrics) bits |= bit(Capability::barycentrics);
  if (features.sample_locations) bits |= bit(Capability::sample_locations);
  if (features.multiview) bits |= bit(Capability::multiview);
  return bits;
}

}  // namespace rg
