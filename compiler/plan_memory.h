// Where transients lie, estimated at the initial extents.
//
// Which of them may share bytes follows from the plan's points and clocks, see runtime/alias.h. On one queue that is the same as lives that do not
// meet; then the packer works on intervals. On several queues it works on the pairs that must not share, and the bound is the greatest weight of
// transients of which none comes after another.
#pragma once

#include "compiler/frame.h"
#include "compiler/plan_data.h"
#include "compiler/plan_frame.h"

namespace rg::compiler {

struct MemoryPlan {
  uint64_t heap_bytes = 0, unaliased_bytes = 0, lower_bound_bytes = 0;
  uint64_t lazy_bytes = 0, heap_beside_lazy_bytes = 0;  // images that may live on the chip; the heap of the others
};

// Fills Resource::estimated_offset of transients and Plan::estimated_heap_bytes. Pre-condition: find_alias_clocks(). `heap_beside_lazy_bytes` is only
// found where it is asked for, because it takes as long again.
MemoryPlan place_transients(PlanData& plan, Effort effort, bool beside_lazy);

}  // namespace rg::compiler
