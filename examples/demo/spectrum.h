// Which sets of lamp features the tiles of a scene ask for, as `rgc spectrum --profile` reads it: schema rgc-spectrum-1.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/result.h"

namespace rg::demo {

struct SpectrumScene {
  std::string name;
  double weight = 1;
  std::map<uint32_t, uint64_t> tiles;  // by mask of LAMP_* bits
};

// The bit of a feature of spectrum light_features by its name.
std::optional<uint32_t> feature_bit(std::string_view name);

void count_tiles(SpectrumScene& scene, std::span<const uint32_t> tile_features);

// Written to a temporary name first, then renamed.
Status write_spectrum(const std::filesystem::path& path, const std::vector<SpectrumScene>& scenes);

}  // namespace rg::demo
