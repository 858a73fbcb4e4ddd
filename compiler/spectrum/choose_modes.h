// Which few kernels serve all feature masks of a spectrum at the least expected cost.
//
// Choose a set K of at most `modes` feature sets, the full set among them, minimising
//
//   sum over masks m of weight(m) * min { cost(k) : k in K, m is part of k }
//
// A capped facility location problem. Sets are closed under `needs`, and cost is made monotone: the kernel of a set may be that of a cheaper
// superset. Search: Lagrangian relaxation of "every mask is served once" (Cornuejols, Fisher, Nemhauser 1977) whose pricing over all 2^n sets is a
// superset sum; its bound is reported. Primal solutions come from the relaxation and from interchange (Teitz, Bart 1968). What remains after
// reduced-cost fixing is enumerated where that is affordable, and the result is exact then.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/spectrum/cost_model.h"

namespace rg::compiler {

struct MaskWeight {
  Mask mask = 0;
  double weight = 0;
  friend bool operator==(const MaskWeight&, const MaskWeight&) = default;
};
struct SpectrumProblem {
  uint32_t features = 0;              // at most 32
  std::vector<Mask> needs;            // by feature: what it requires, transitively or not
  std::vector<MaskWeight> histogram;  // masks may repeat; weights are not negative
  CostModel costs;
  uint32_t modes = 8;  // at least 1
};
struct ModeChoice {
  std::vector<Mask> modes;        // ascending by cost, the full set last; closed under `needs`; no more than are of use
  std::vector<double> costs;      // of each
  std::vector<uint32_t> mode_of;  // by row of the histogram: the cheapest mode that serves it
  double expected = 0;            // cost a unit of weight
  double bound = 0;               // no choice is cheaper than this
  bool exact = false;             // expected is the optimum
  double one_kernel = 0;          // expected cost with the full set alone
  double kernel_per_mask = 0;     // ... and with a kernel for every mask
  double gap() const { return expected > 0 ? (expected - bound) / expected : 0; }
};

// O(2^min(features seen apart, 20) * buckets + rows * candidates); effort counts evaluations, so equal problems give equal choices.
ModeChoice choose_modes(const SpectrumProblem& problem);

// The least set that holds `mask` and everything it needs.
Mask close(const SpectrumProblem& problem, Mask mask);
// The share of the histogram's weight that each of `modes` serves; empty where nothing weighs anything.
std::vector<double> group_shares(const SpectrumProblem& problem, const std::vector<Mask>& modes);
// The first of `modes` that serves the mask.
uint32_t mode_for(const std::vector<Mask>& modes, Mask mask);

}  // namespace rg::compiler
