// Barriers: every ordering and layout the schedule needs, exact per cell, and the state of each cell at the frame boundary.
//
//   hazard              first scope                    second scope
//   read after write    the writes                     all reads of the version, wherever they come
//   write after write   the writes                     the write
//   write after read    execution of the reads         execution of the write
//   new layout          as above                       also accesses: the transition itself writes
//
// A barrier stands in the group before the segment of its first user. Old contents that nobody needs are discarded (old layout undefined). All
// discards of one transient stand in the group where it is acquired, so that memory changes hands at one place.
//
// Across frames: frames follow each other on one queue, so the last epoch of a cell precedes its first epoch of the next frame. Transients and dead
// copies enter undefined, after the last users of the frame before. Imported resources enter in their declared `before` state and leave in `after`.
// Read-back buffers leave visible to the host, and enter free, because the host has waited.
//
// Boundary states: `stages` are those of the last users; `accesses` hold writes that are not yet available, or, where the last epoch reads,
// the reads the contents are already visible to.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "compiler/epochs.h"
#include "compiler/frame.h"
#include "compiler/make_schedule.h"

namespace rg::compiler {

// Between queues there are no barriers: the batch of the later users waits for the end of the batch of the earlier ones. An image that one queue uses
// at a time changes hands by a release at the end of the one batch and an acquire in the other; images read on several queues at once, and history
// used on several, are shared instead. A layout changes on the queue of the later users, or, where those are on several, at the end of the earlier
// users' batch. A barrier that goes on after a wait names the stages that wait as its first scope.
struct SetPlace {  // where an event is set: in front of the barriers of a slot, or right behind them
  uint32_t slot = 0;
  bool behind = false;
  friend bool operator==(const SetPlace&, const SetPlace&) = default;
};
inline constexpr std::string_view kStateAfter = "state after the frame";  // reason: what `after` says of a resource that the engine brings
struct CellBarrier {
  uint32_t cell = 0;  // with its age
  Range range;        // as merged; equals the cell's at first
  uint64_t begin = 0, end = 0;
  Stages src_stages = 0, dst_stages = 0;
  Accesses src_accesses = 0, dst_accesses = 0;
  Layout old_layout = Layout::undefined, new_layout = Layout::undefined;
  BarrierTag tag = BarrierTag::hazard;
  bool is_acquire = false;                        // first use of a transient
  bool wraps = false;                             // its first scope lies in the frame before
  uint32_t src_queue = kNone, dst_queue = kNone;  // change of owner
  bool dropped = false;                           // nothing needs it
  bool changes_queue = false;                     // half a change of owner
  SetPlace set;                                   // the first place at which everything is recorded that has to be in its first scope
  std::string_view whole;                         // why it is not split where the target asks for it, a literal
  std::string_view reason;                        // "read after write", a literal
};

struct CellBoundary {
  uint32_t cell = 0;
  Boundary row;  // without reference and range
};

// A batch waits for another one of this frame, or (`batch` kNone) for the end of the frame before on `queue`.
struct BatchWait {
  uint32_t queue = 0, batch = kNone;
  Stages stages = 0;
  uint32_t cell = 0;  // one of those that need it
};
struct BatchSync {
  std::vector<BatchWait> waits;
  Stages signal = 0;        // 0: nobody waits for it
  bool for_memory = false;  // it has to come after all that its queue has released, see MemorySignal
};
// What the signal of a batch does so that memory can change hands.
struct MemorySignal {
  bool counts = false;  // some clock counts as far as it comes after releases
  Stages stages = 0;    // that it names for that besides
};
// Releases by program resource and queue: the batch whose signal is known to come after them.
using OverAt = std::map<std::pair<uint32_t, uint32_t>, uint32_t>;

// Barriers that are set at one place and awaited behind the barriers of a slot, see split_barriers.h.
struct SplitGroup {
  SetPlace set;
  uint32_t wait_slot = 0;
  std::vector<CellBarrier> barriers;
};

struct SyncPlan {
  std::vector<std::vector<CellBarrier>> groups;  // by slot, see Schedule
  std::vector<SplitGroup> splits;                // by slot of their wait
  std::vector<BatchSync> batches;
  std::vector<bool> concurrent, scattered;  // by program resource; scattered: first used on several queues, so that its memory is not shared
  std::vector<CellBoundary> entry, exit;    // one row a queue that has last users
  std::vector<Acquire> acquires;            // resources by program index; image barriers filled when the plan is emitted
  std::vector<Release> releases;
  OverAt over_at;         // of those that some `for_memory` is about
  uint32_t unproved = 0;  // facts of obligations.h that do not hold: the planner is wrong
};

// `for_memory`: by batch, see memory_signals() of alias_clocks.h.
SyncPlan synchronise(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, const PlanOptions& options,
                     const std::vector<MemorySignal>& for_memory = {});

// Joins barriers of one group that differ only in neighbouring mips, layers or bytes. Part of synchronise.
void merge_ranges(const Frame& frame, std::vector<CellBarrier>& group);

// Removes every barrier, wait, signal, stage and access without which all facts of obligations.h still hold. Part of synchronise.
// O((facts + atoms * facts that rest on one) * points between source and target).
void drop_redundant(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, SyncPlan& sync);

}  // namespace rg::compiler
