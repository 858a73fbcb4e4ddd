// From everything that must wait for another queue to the waits that remain.
//
// A wait makes its whole queue, from that batch on, come after the whole of the batch it waits for and of those before it on the same queue. So of
// the waits of a batch only the latest on each queue counts, and none that an earlier wait, or one of the other queue itself, implies (transitive
// reduction over queue order). What an implied need asked for is added to the stages of the waits and signals that realise it.
#pragma once

#include <vector>

#include "compiler/make_schedule.h"
#include "compiler/synchronise.h"

namespace rg::compiler {

struct Need {
  uint32_t from_queue = 0, from_batch = kNone;  // kNone: what the queue did in the frame before
  Stages from_stages = 0;
  uint32_t to_batch = 0;
  Stages to_stages = 0;
  uint32_t cell = 0;      // why
  bool any_from = false;  // one of from_stages is enough: a barrier before the signal has gathered them
  bool chains = false;    // a barrier after the wait goes on from to_stages, so that a wait in earlier ones serves as well
};

// By batch of the schedule. O(needs log needs + batches * queues * waits a batch).
std::vector<BatchSync> reduce_waits(const Schedule& schedule, const std::vector<Need>& needs);

}  // namespace rg::compiler
