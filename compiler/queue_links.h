// What stands between the uses of a cell before and after a point in its life: a barrier, or, between queues, a wait with what goes with it.
#pragma once

#include <vector>

#include "compiler/reduce_waits.h"
#include "compiler/synchronise.h"

namespace rg::compiler {

// One side of a barrier: what happened, or what comes.
struct Side {
  Effect effect;
  bool writes = false;
  bool defined = true;  // holds contents
  bool needs = false;   // as the later side: depends on contents
  std::vector<Event> events;
  bool skippable = false;  // every use may be skipped, so that what came before meets what comes after
  Effect seen = {};        // as the later side: reads the contents are already visible to
};

// Queues of the side's events, ascending; none for a side that only a boundary state describes.
std::vector<uint32_t> queues_of(const Side& side);
// What the side does on one queue.
Side on_queue(const Frame& frame, uint32_t cell, const Side& side, uint32_t queue);

// The barrier between two sides of which each is on one and the same queue. Names neither group nor use.
CellBarrier connect(const Frame& frame, const PlanOptions& options, uint32_t cell, const Side& from, const Side& to);

// Two sides on different queues, or one of them on several.
struct Crossing {
  uint32_t cell = 0;
  const Side& from;
  const Side& to;
  uint32_t acquire = UINT32_MAX;  // the segment where a transient takes its memory over; else the first user's
};
// Adds barriers to `sync` and what must wait to `needs`. Pre-condition, kept by assign_queues(): a layout that changes has one queue before or after.
void cross(const Frame& frame, const Schedule& schedule, const PlanOptions& options, const Crossing& crossing, SyncPlan& sync,
           std::vector<Need>& needs);

// Puts a barrier into a slot, unless it does nothing.
void add_barrier(SyncPlan& sync, uint32_t slot, CellBarrier barrier);

}  // namespace rg::compiler
