// Which queue runs which pass, and what that is worth.
//
// `queue KIND` is an order, `queue KIND may` a permission. A permitted pass moves only where the model of queue_timeline.h says that the frame ends
// earlier by more than a threshold. Some moves are never made, because the hand-over would cost more than it brings or need what the plan does not
// promise:
//
//   a pass that touches an imported image             its owner at the frame's ends is the engine
//   a pass that uses an imported buffer other than by reads that it is ready for
//   a pass of an atomic or disjoint group             the others of the group are not ordered against it
//   a reader of an image that changes layout both before and after being read on two queues
//   a reader of history that another queue reads in another layout
#pragma once

#include <string>
#include <vector>

#include "compiler/build_graph.h"
#include "compiler/frame.h"
#include "compiler/make_schedule.h"
#include "compiler/queue_timeline.h"

namespace rg::compiler {

struct QueueDecision {
  uint32_t pass = 0;  // of the frame
  bool moved = false;
  std::string reason;
};
struct QueuePlan {
  QueueOf queue_of;  // by node: position in Schedule::order
  QueueTimeline timeline;
  QueueGain gain;  // ns
  uint64_t simulations = 0;
  bool complete = true;
  std::vector<QueueDecision> decisions;              // of passes that name a queue
  std::vector<std::pair<uint32_t, uint32_t>> extra;  // passes: what reads imported data elsewhere runs between two of the engine's queue
  std::vector<uint32_t> contested;                   // images whose layout would change between several queues, which no move avoids: use `general`
};

// Why a pass cannot run on the queue it names, in any arrangement; empty: it can. What `queue KIND` without `may` asks for is then wrong.
std::string why_not_on_queue(const Frame& frame, uint32_t pass);

// False for a pass that has to run on the first of `options.queues` and cannot.
bool runs_at_home(const Frame& frame, uint32_t pass, const PlanOptions& options);

// `one_queue` is the schedule for a single queue, whose order is kept where that leaves no queue idle. `options.queues` are what there is; the first
// is the home of passes that name no queue.
QueuePlan assign_queues(const Frame& frame, const Graph& graph, const Schedule& one_queue, const std::vector<double>& costs,
                        const PlanOptions& options);

// Cuts each queue into segments and batches: a batch ends where another queue waits for it and starts where it waits, after transitive reduction;
// neighbours are joined again where the frame ends no later for it. O(dependencies + batches^2).
Schedule make_batches(const Frame& frame, const Graph& graph, const Schedule& one_queue, const QueuePlan& plan, const std::vector<double>& costs,
                      const PlanOptions& options);

}  // namespace rg::compiler
