// What `rgc spectrum` found, and the page it can write of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rg::commands {

struct KernelFacts {
  uint32_t set = 0;            // bits: SpectrumFacts::features
  double cost = 0, share = 0;  // share of all tiles
};
struct MaskFacts {
  uint32_t mask = 0;
  double share = 0;
  uint32_t kernel = 0;
  uint32_t superfluous = 0;  // features the kernel has and the mask lacks
  double cost = 0, own = 0;  // of its kernel; of one that has the mask's features only
};
struct SpectrumFacts {
  std::string name, pass;
  std::vector<std::string> features;
  bool measured = false;  // tiles were counted
  std::string costs;      // what they are taken from: "times", "statistics", or both
  std::vector<std::string> scenes;
  double tiles = 0;
  double expected = 0, bound = 0, one_kernel = 0, kernel_per_mask = 0;
  bool exact = false;
  uint32_t modes = 0;         // at most
  std::vector<double> curve;  // expected cost with 1, 2, ... kernels
  std::vector<KernelFacts> kernels;
  std::vector<MaskFacts> masks;  // by share, largest first

  std::string names(uint32_t set) const;  // "shadows tubes"; "nothing"
};

// One self-contained HTML page: no script, no file beside it.
std::string spectrum_page(const std::vector<SpectrumFacts>& spectra);

}  // namespace rg::commands
