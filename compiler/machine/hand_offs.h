// A plan as it is recorded for a given placement: with the hand-offs of aliased memory patched in, as runtime/alias.h says.
#pragma once

#include <vector>

#include "compiler/machine/machine.h"

namespace rg::machine {

class PatchedPlan {
 public:
  PatchedPlan(const Plan& plan, const std::vector<Placement>& placement);
  PatchedPlan(const PatchedPlan&) = delete;
  const Plan& plan() const { return plan_; }

 private:
  Plan plan_;  // spans into the vectors below, or into the original
  std::vector<BarrierGroup> groups_;
  std::vector<MemoryBarrier> memory_barriers_;
  std::vector<ImageBarrier> image_barriers_;
};

}  // namespace rg::machine
