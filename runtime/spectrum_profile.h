// What the groups of a spectrum ask for and what its kernels take, as a file for `rgc spectrum --profile` and `spectrum { profile "..." }`: schema
// rgc-spectrum-1 (docs/variants.md). A tool: it allocates.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/graph.h"

namespace rg {

// A spectrum as generated code knows it: the text lives as long as the program.
struct SpectrumKernels {
  std::string_view name = {};
  std::span<const std::string_view> features = {};  // by bit of a mask
  std::span<const uint32_t> sets = {};              // of features, by kernel, in the order in which they are tried
};
// Of `frame::spectrum::NAME`.
template <class Generated>
constexpr SpectrumKernels kernels_of() {
  return {Generated::name, Generated::features, Generated::kernels};
}
// Which of the kernels a group with this mask gets: the first that has all its features, else the last.
size_t kernel_for(const SpectrumKernels& kernels, uint32_t mask);

// Collects scenes and times; one thread at a time.
class SpectrumProfile {
 public:
  // An empty profile; what `kernels` points to outlives it.
  explicit SpectrumProfile(const SpectrumKernels& kernels);

  // The masks of all groups of a picture. Scenes are merged by weight, each first divided by its groups.
  void add_scene(std::string_view name, double weight, std::span<const uint32_t> masks);
  // `kernel` ran `groups` groups in `ms`; times of one kernel are added up by weight before they are divided.
  void add_time(size_t kernel, double weight, double ms, uint64_t groups);
  // ... in the last finished frame of `graph`, where it is a kernel of `pass` and the groups had `masks`. Of use where times of passes are their own:
  // with GraphOptions::submit_per_pass, or where the driver's timestamps separate them. A kernel is best timed on every group that it can serve, in a
  // frame in which all groups are forced to its features: its mean time is then what it costs whoever is given to it.
  void add_time(size_t kernel, double weight, GraphInstance& graph, std::string_view pass, std::span<const uint32_t> masks);

  // Milliseconds a thousand groups, by kernel; a kernel that ran nothing has none.
  std::vector<std::pair<uint32_t, double>> costs() const;
  // All that was added, for a file.
  std::string json() const;

 private:
  struct Scene {
    std::string name;
    double weight = 1;
    std::map<uint32_t, uint64_t> groups;  // by mask
  };
  struct Time {
    double ms = 0, groups = 0;
  };
  SpectrumKernels kernels_;
  std::vector<Scene> scenes_;
  std::vector<Time> times_;  // by kernel
};

}  // namespace rg
