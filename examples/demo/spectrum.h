// What the tiles of a scene ask of the lighting and what its kernels take, as `rgc spectrum --profile` reads it.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "examples/demo/renderer.h"
#include "runtime/spectrum_profile.h"

namespace rg::demo {

// The bit of a feature of spectrum light_features by its name.
std::optional<uint32_t> feature_bit(std::string_view name);

// The tiles of the last frame count for the camera's scene.
Status record_tiles(Renderer& renderer, std::string_view camera, double weight, SpectrumProfile& profile);

// Times every kernel from this camera on all tiles that it can serve, `rounds` times. `renderer` submits per pass.
Status time_kernels(Renderer& renderer, const Scene& scene, const NamedCamera& camera, FrameSettings settings, int rounds, double weight,
                    SpectrumProfile& profile);

// Written to a temporary name first, then renamed.
Status write_spectrum(const std::filesystem::path& path, const SpectrumProfile& profile);

}  // namespace rg::demo
