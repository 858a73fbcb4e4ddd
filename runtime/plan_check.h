// A plan may come from a file or from a hot reload: nothing in it is trusted before this.
#pragma once

#include "runtime/plan.h"
#include "runtime/result.h"

namespace rg {

// Every index, range and enumerator in bounds, expressions free of cycles, imports and host slots consistent. Fails with
// `invalid_plan` and the first thing that is wrong. Does not check synchronisation: that is the checker's work. O(size of the plan).
Status check_plan(const Plan& plan);

}  // namespace rg
