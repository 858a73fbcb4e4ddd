// Who comes after whom on the GPU without a barrier's help: points and clocks of the hand-offs of memory, see rg::Release and Plan::alias_clocks.
//
//   queue 0   group 0   A   group 1   B   end 2                     release of what A used last: point 1 of queue 0
//   queue 1                                  wait   group 0   C     clock of what C acquires: 2 on queue 0, so A and B have completed
//
// A wait counts for an acquire whose hand-off goes on after it: the stages of the acquire's first users, or earlier ones, meet those of the wait or
// later ones. A signal counts for releases in its stages or earlier ones; a chain over a third queue needs the stages of its wait and its signal to
// meet in the same way. Nothing is added to the plan but what it implies already.
//
// Signals name what their waiters need, and say nothing of what ran before in other stages: memory that it used last is then not known to be free. So
// memory_signals() says what they would have to name besides, and a plan made with that is taken where it saves memory. A signal comes after its
// batch in the cost model anyway, and no wait is added.
#pragma once

#include "compiler/plan_data.h"
#include "compiler/synchronise.h"

namespace rg::compiler {

// Fills Release::point, Acquire::queue, point and first_clock, and alias_clocks. Pre-condition: steps, batches, waits, signals, groups, passes and
// accesses are complete; releases name resource, queue and scopes, acquires resource, group and scopes.
// O(steps + accesses + (signals + waits + acquires) * queues * different stage masks + releases * log).
// `over_at`: what signals are known to come after without naming it.
void find_alias_clocks(PlanData& plan, const OverAt& over_at = {});

// By batch: on which signals clocks count if all of them name what their queues have released, and the stages that these have to name for it, as few
// as can be on two queues (points that stab intervals from a release to the signal that a clock rests on). Empty if no clock counts further for it.
// Cost as above.
std::vector<MemorySignal> memory_signals(const PlanData& plan);

}  // namespace rg::compiler
