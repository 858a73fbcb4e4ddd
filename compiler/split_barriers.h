// Barriers in two halves: an event is set where all their sources are recorded, and waited for in front of their users.
//
//   producer │ A │ B │ users           a barrier in front of the users waits for A and B, too, where they use the producer's stages
//            set       wait
//
// A barrier is split where
//   - something is recorded between its sources and its users that its first scope would wait for;
//   - no whole barrier of its group makes the same stages wait for the same work all the same;
//   - it hands on no memory (runtime/alias.h adds to those), changes no owner, and names no host; its queue can set events, as transfer queues
//   cannot.
//
// `CellBarrier::set` says how early: no derivation of a fact of obligations.h, of those the plan rests on, has anything in front of the barrier
// that is recorded later. So all facts still hold. What could be left out of the plan before was needed for a fact, and with halves apart less
// follows than before: nothing becomes redundant. Both halves stand in one batch.
#pragma once

#include "compiler/frame.h"
#include "compiler/make_schedule.h"
#include "compiler/synchronise.h"

namespace rg::compiler {

// Moves barriers from `sync.groups` to `sync.splits`. O(barriers * barriers of their group + barriers * segments between the halves).
void split_barriers(const Frame& frame, const Schedule& schedule, const PlanOptions& options, SyncPlan& sync);

}  // namespace rg::compiler
