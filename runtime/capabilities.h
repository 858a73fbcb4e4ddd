// What features that ask the device (`feature NAME : device CAPABILITY`) find there.
#pragma once

#include <string_view>

#include "runtime/device_state.h"

namespace rg {

constexpr uint32_t bit(Capability capability) { return uint32_t{1} << static_cast<uint32_t>(capability); }
std::string_view name(Capability capability);

// Extensions of the device behind capabilities that it offers; null-terminated names.
std::vector<const char*> capability_extensions(const Device::State& state);

// Of the physical device, as bits: subgroups. The others have to be enabled, see EnabledFeatures.
uint32_t subgroup_capabilities(const Device::State& state);

// False where the driver says that it has multiview and draws the first view alone: lavapipe of Mesa 22.3.
bool draws_every_view(const Device::State& state);

// Whether attachments of every number of samples take locations of one's own, where the extension is there.
bool places_samples(const Device::State& state);

uint32_t enabled_capabilities(const EnabledFeatures& features);

}  // namespace rg
