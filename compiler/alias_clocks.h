// Who comes after whom on the GPU without a barrier's help: points and clocks of the hand-offs of memory, see rg::Release and Plan::alias_clocks.
//
//   queue 0   group 0   A   group 1   B   end 2                     release of what A used last: point 1 of queue 0
//   queue 1                                  wait   group 0   C     clock of what C acquires: 2 on queue 0, so A and B have completed
//
// A wait counts for an acquire whose first users lie in the wait's stages or later ones; a signal counts for releases in its stages or earlier ones;
// a chain over a third queue needs the stages of its wait and its signal to meet. Nothing is added to the plan but what it implies already.
//
// Signals name what their waiters need, and say nothing of what ran before in other stages: memory that it used last is then not known to be free. So
// silent_stages() says what they would have to name besides, and a plan made with that is taken where it saves memory. A signal comes after its batch in the cost
// model anyway, and no wait is added.
#pragma once

#include "compiler/plan_data.h"
#include "compiler/synchronise.h"

namespace rg::compiler {

// Fills Release::point, Acquire::queue, point and first_clock, and alias_clocks. Pre-condition: steps, batches, waits, signals, groups, passes and
// accesses are complete; releases name resource, queue and scopes, acquires resource, group and scopes.
// O(steps + accesses + releases + (waits + acquires) * queues * different stage masks).
// `over_at`: what else is known to come before signals.
void find_alias_clocks(PlanData& plan, const OverAt& over_at = {});

// By batch: stages of releases since the signal before that its signal does not come after, as far as clocks would count further with them. Empty if none
// would, and for more than a million signals times steps. O(signals * stages) times the above.
std::vector<Stages> silent_stages(const PlanData& plan);

}  // namespace rg::compiler
