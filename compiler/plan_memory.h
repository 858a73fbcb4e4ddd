// Where transients lie, estimated at the initial extents, and which of them may share bytes at all.
#pragma once

#include <vector>

#include "compiler/find_lifetimes.h"
#include "compiler/frame.h"

namespace rg::compiler {

struct MemoryPlan {
  std::vector<uint64_t> offsets;       // by program resource; meaningful where the lifetime is used
  std::vector<AliasPair> alias_pairs;  // resources by program index, sorted
  bool alias_by_lifetime = false;      // too many to list
  uint64_t heap_bytes = 0, unaliased_bytes = 0, lower_bound_bytes = 0;
};

// Two transients may share bytes where their lifetimes are disjoint: the earlier hands over within the frame, the later to the next frame.
// Plans of up to kMostListed transients list every such pair; for larger ones the list would grow with the square and the rule stands for it.
inline constexpr size_t kMostListed = 512;
MemoryPlan plan_memory(const Frame& frame, const Lifetimes& lifetimes, const PlanOptions& options);

}  // namespace rg::compiler
