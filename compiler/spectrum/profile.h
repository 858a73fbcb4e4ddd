// A histogram of feature masks, as the runtime records it and as `spectrum { profile "..." }` and `rgc spectrum --profile` name it.
//
//   { "schema": "rgc-spectrum-1", "spectrum": "light_features", "features": ["shadows", "tubes"],
//     "scenes": [ { "name": "plaza", "weight": 1, "masks": [ { "features": ["shadows"], "tiles": 1716 }, ... ] }, ... ],
//     "costs":  [ { "features": [], "ms": 0.21 }, { "features": ["shadows"], "ms": 0.36 }, ... ] }
//
// Scenes are merged by their weights, each first divided by its own tiles. `costs` are optional: measured times of kernels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/spectrum/choose_modes.h"
#include "dsl/program.h"

namespace rg::compiler {

struct SpectrumProfile {
  std::vector<MaskWeight> histogram;           // merged, distinct, ascending by mask; weights sum to 1
  std::vector<std::pair<Mask, double>> costs;  // measured, ascending by set
  std::vector<std::string> scenes;
  double tiles = 0;  // counted, over all scenes
};

enum class ProfileFault : uint8_t { none, unreadable, foreign, empty };
struct ProfileResult {
  ProfileFault fault = ProfileFault::none;
  std::string why;  // "it is no JSON"
  SpectrumProfile profile;
};
// `text` is untrusted.
ProfileResult read_profile(const dsl::Spectrum& spectrum, const std::string& text);

// Where nothing was measured: every feature on in a quarter of the tiles, independently of the others; at most three at once beyond 12 features.
SpectrumProfile assumed_profile(const dsl::Spectrum& spectrum);

}  // namespace rg::compiler
