// The machine's own reading of Vulkan: stages, accesses, their logical order, and what a declared access makes the hardware do.
// Source: Vulkan 1.3, chapter "Synchronization and Cache Control".
#pragma once

#include <vector>

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::machine {

// Masks that stand for several stages or accesses become the single bits they stand for.
Stages expand_stages(Stages stages);
Accesses expand_accesses(Accesses accesses);

// A first execution scope also holds logically earlier stages, a second one logically later stages. Arguments and results are expanded.
Stages with_earlier(Stages stages);
Stages with_later(Stages stages);

// One access by one stage. `partial`: a later touch of the same pass completes this write.
struct Touch {
  Stages stage = 0;
  Accesses access = 0;
  bool writes = false, partial = false;
};

// In the order the hardware performs them, reads first. Pre-condition: stages are declared or have defaults (fragment, compute).
std::vector<Touch> touches_of(const dsl::Pass& pass, const dsl::Access& access);
// Of the host or the engine around the frame. Empty for `undefined` and `present`.
std::vector<Touch> touches_of(const dsl::BoundaryState& state);

bool is_attachment(dsl::Role role);
// True if the result depends on earlier contents of the range.
bool needs_contents(const dsl::Pass& pass, const dsl::Access& access);
// Some neighbours may run in any order: atomics, and writers declared disjoint.
bool commutes(const dsl::Access& access);

// Combined depth-stencil layouts mean one layout for each aspect.
Layout layout_of_aspect(Layout layout, uint32_t aspect);
// The combined layout that means these two, or the first where none does.
Layout layout_of_both(Layout first, Layout second);
// May an access of this role find its image in this layout?
bool permits(Layout layout, dsl::Role role, bool writes);

}  // namespace rg::machine
