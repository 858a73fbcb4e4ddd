// Images that nothing but renderings sees, each from its beginning to its end: they may live on the chip, where the device has memory for that
// (VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT). A depth buffer that is cleared, tested and dropped is one; the samples of an image that is resolved are
// another.
#pragma once

#include "compiler/plan_data.h"

namespace rg::compiler {

// Sets Resource::lazy. Pre-condition: renderings are emitted. O(resources + attachments).
void mark_lazy(PlanData& plan);

}  // namespace rg::compiler
