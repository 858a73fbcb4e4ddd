// Private to the optimiser: the location problem after closing masks and merging features that always come together.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/spectrum/cost_model.h"

namespace rg::compiler {

struct Facilities {
  uint32_t bits = 0;            // sets are numbers below 2^bits
  std::vector<double> cost;     // by set, monotone: more features never cost less
  std::vector<Mask> masks;      // distinct
  std::vector<double> weights;  // of masks, positive, sum 1
  uint32_t open = 1;            // how many sets besides the full one
  Mask full() const { return static_cast<Mask>((uint64_t{1} << bits) - 1); }
};
struct FacilityChoice {
  std::vector<Mask> sets;  // without the full one
  double expected = 0, bound = 0;
  bool exact = false;
};

FacilityChoice choose_facilities(const Facilities& problem);

// Expected cost with these sets and the full one.
double expected_cost(const Facilities& problem, const std::vector<Mask>& sets);

}  // namespace rg::compiler
