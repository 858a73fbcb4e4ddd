#include "examples/demo/spectrum.h"

#include <fstream>

namespace rg::demo {
namespace {

using Features = frame::spectrum::light_features;

Status time_kernel(Renderer& renderer, const Scene& scene, const NamedCamera& camera, const FrameSettings& settings, size_t kernel, int rounds,
                   double weight, SpectrumProfile& profile) {
  for (int round = 0; round <= rounds; ++round) {  // the first is for the driver, which compiles when something is used first
    if (Status drawn = renderer.render(make_frame(scene, camera, settings)); !drawn) return drawn;
    if (Status idle = renderer.graph().wait_idle(); !idle) return idle;
    const auto masks = renderer.graph().tile_features();
    if (!masks) return masks.error();
    if (round > 0) profile.add_time(kernel, weight, renderer.graph().instance(), "deferred_light", *masks);
  }
  return Done{};
}

}  // namespace

std::optional<uint32_t> feature_bit(std::string_view name) {
  for (size_t i = 0; i < std::size(Features::features); ++i)
    if (Features::features[i] == name) return uint32_t{1} << i;
  return std::nullopt;
}

Status record_tiles(Renderer& renderer, std::string_view camera, double weight, SpectrumProfile& profile) {
  const auto masks = renderer.graph().tile_features();
  if (!masks) return masks.error();
  profile.add_scene(camera, weight, *masks);
  return Done{};
}

Status time_kernels(Renderer& renderer, const Scene& scene, const NamedCamera& camera, FrameSettings settings, int rounds, double weight,
                    SpectrumProfile& profile) {
  for (size_t kernel = 0; kernel < std::size(Features::kernels); ++kernel) {
    settings.forced_features = Features::kernels[kernel];
    if (Status timed = time_kernel(renderer, scene, camera, settings, kernel, rounds, weight, profile); !timed) return timed;
  }
  return Done{};
}

Status write_spectrum(const std::filesystem::path& path, const SpectrumProfile& profile) {
  const std::filesystem::path temporary = path.string() + ".tmp";
  std::ofstream file(temporary);
  file << profile.json();
  file.close();
  std::error_code failure;
  if (file) std::filesystem::rename(temporary, path, failure);
  if (!file || failure) return Error{ErrorCode::io, "`" + path.string() + "` cannot be written; choose another path with --record-spectrum"};
  return Done{};
}

}  // namespace rg::demo
