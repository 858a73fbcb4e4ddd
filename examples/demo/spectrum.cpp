#include "examples/demo/spectrum.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "frame.h"

namespace rg::demo {
namespace {

using Features = frame::spectrum::light_features;

nlohmann::ordered_json names_of(uint32_t mask) {
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (size_t i = 0; i < std::size(Features::features); ++i)
    if ((mask >> i & 1) != 0) names.push_back(Features::features[i]);
  return names;
}

nlohmann::ordered_json to_json(const SpectrumScene& scene) {
  nlohmann::ordered_json out{{"name", scene.name}, {"weight", scene.weight}, {"masks", nlohmann::ordered_json::array()}};
  for (const auto& [mask, tiles] : scene.tiles) out["masks"].push_back({{"features", names_of(mask)}, {"tiles", tiles}});
  return out;
}

Error io_error(const std::filesystem::path& path) {
  return {ErrorCode::io, "`" + path.string() + "` cannot be written; choose another path with --record-spectrum"};
}

}  // namespace

std::optional<uint32_t> feature_bit(std::string_view name) {
  for (size_t i = 0; i < std::size(Features::features); ++i)
    if (Features::features[i] == name) return uint32_t{1} << i;
  return std::nullopt;
}

void count_tiles(SpectrumScene& scene, std::span<const uint32_t> tile_features) {
  for (const uint32_t mask : tile_features) ++scene.tiles[mask];
}

Status write_spectrum(const std::filesystem::path& path, const std::vector<SpectrumScene>& scenes) {
  nlohmann::ordered_json out{
      {"schema", "rgc-spectrum-1"}, {"spectrum", "light_features"}, {"features", names_of(~0u)}, {"scenes", nlohmann::ordered_json::array()}};
  for (const SpectrumScene& scene : scenes) out["scenes"].push_back(to_json(scene));
  const std::filesystem::path temporary = path.string() + ".tmp";
  std::ofstream file(temporary);
  file << out.dump(1) << "\n";
  file.close();
  std::error_code failure;
  if (file) std::filesystem::rename(temporary, path, failure);
  if (!file || failure) return io_error(path);
  return Done{};
}

}  // namespace rg::demo
