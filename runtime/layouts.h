// Image layouts as the frame's barriers leave them. Debug tools and classic render passes ask; the executor does not.
#pragma once

#include "runtime/plan.h"

namespace rg {

// Of one subresource of `ref` while `pass` runs: the entry state, then every barrier before the pass. O(barriers).
Layout layout_at(const Plan& plan, Index pass, Ref ref, uint32_t aspect, uint32_t mip, uint32_t layer);

// What a layout of depth and stencil together means for one of them; other layouts stay.
Layout depth_part(Layout layout);
Layout stencil_part(Layout layout);

}  // namespace rg
