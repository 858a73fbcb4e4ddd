// What one cell's accesses still wait for, and what barriers and semaphores have done about it.
//
//   write ──> available ──> visible to (queue, stage, access)     RAW and WAW need visible
//   read  ──────────────> reach: stages ordered after it          WAR needs the writer's stage in reach
//
// A barrier (S -> D) extends reach where S, with logically earlier stages, meets it; to D with logically later stages, on its own queue. It makes a
// write available if S and its accesses name it, and visible to exactly D x its destination accesses. A signal is a barrier whose second
// scope is the semaphore, a wait one whose first scope is; both name all accesses.
//
// A split barrier does all this with what is known when its event is set, and it counts from where the event is awaited.
//
// Proofs stand beside the facts, see proof.h.
//
// Source of the rules: Vulkan 1.3, "Execution and Memory Dependencies", "Synchronization Scopes", "Availability, visibility", "Semaphores".
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compiler/verify/by_queue.h"
#include "compiler/verify/model.h"
#include "compiler/verify/proof.h"

namespace rg::verify {

using Site = uint32_t;  // a stage of a queue
constexpr Site site_of(uint32_t queue, uint32_t stage) { return queue * kStageCount + stage; }

// Stages of one queue ordered after something.
struct QueueReach {
  StageSet stages = 0;
  StageSet settled = 0;  // needs no atom beyond the root's
  Proof root;            // what every proof on the queue also uses: the one barrier or wait with which everything began there, say
};
// A signal after something; so are all later ones of its queue.
struct SignalReach {
  uint32_t queue = 0;
  int64_t number = 0;  // counted through all frames, see number_of
  Proof proof;         // of all signals up to this one, with the share of its queue's root
};
struct Held;  // what a set event does when it is awaited, see sync_update.h
struct Reach {
  ByQueue<QueueReach> queues;
  std::vector<SignalReach> signals;               // by queue ascending numbers, each with a smaller proof than the one before
  std::vector<std::pair<Site, Proof>> proofs;     // of stages that are not settled, beside the root
  uint64_t quiet = 0;                             // by GroupNode::alike: signals and waits that say no more
  std::vector<std::shared_ptr<const Held>> held;  // by events that are set and not yet awaited
  explicit Reach(uint32_t queue = 0) : queues(queue) {}
  StageSet stages(uint32_t queue) const { return queues.get(queue).stages; }
  const Proof& root(uint32_t queue) const { return queues.get(queue).root; }
};

// Reads in one stage between the same two groups of their queue share their fate.
struct ReadFate {
  uint32_t queue = 0, stage = 0;
  uint32_t born = 0;  // groups executed on the queue before the reads
  uint32_t seen = 0;  // groups taken into account
  Reach reach;
};
struct ReadRecord {
  uint32_t queue = 0, stage = 0;
  uint32_t pass = 0, frame = 0;  // pass kNone: before the frame
  uint64_t order = 0;            // accesses that share a number do not wait for each other
  bool released = false;         // a release of the resource waits for it
  std::shared_ptr<ReadFate> fate;
  const Reach& reach() const { return fate->reach; }
};

struct VisibleTo {
  Site site = 0;
  uint32_t access = 0;
  Proof proof;
};
struct Visible {
  AccessSet to[kStageCount] = {};
};
struct WriteRecord {
  uint32_t queue = 0;
  uint32_t stage = kStageCount, access = kAccessCount;  // kStageCount: a layout transition, or settled before the frame
  uint32_t pass = 0;
  uint32_t scope = kNone;  // of a layout transition
  uint64_t order = 0;      // commuting writers, and passes of one rendering, share a number and do not wait for each other
  uint32_t seen = 0;
  bool available = false;
  bool read_since = false;  // by a pass that always runs: who waits for it comes after this write, and sees it
  uint64_t read_by = 0;     // the order of that pass: those that share it do not wait for it
  bool released = false;    // a release of the resource waits for it and makes it available
  Reach reach;              // from where it became available
  ByQueue<Visible> visible;
  std::vector<VisibleTo> proofs;  // of visible pairs that still depend on single atoms
  explicit WriteRecord(uint32_t on = 0) : queue(on), reach(on), visible(on) {}
  AccessSet visible_to(uint32_t at, uint32_t to_stage) const { return visible.get(at).to[to_stage]; }
};

// What the cell would be if the last transition, which left its layout as it was, did not exist.
struct Without {
  uint32_t scope = kNone;
  std::vector<ReadRecord> reads;
  std::vector<WriteRecord> writes;
};

struct CellState {
  std::vector<ReadRecord> reads;
  std::vector<WriteRecord> writes;
  Layout layout = Layout::undefined;
  uint32_t layout_scope = kNone;       // the barrier that set it
  uint32_t owner = kNone;              // queue; kNone: whoever comes first
  uint32_t released_by = kNone;        // a release whose acquire has not come
  std::vector<uint32_t> owner_scopes;  // release and acquire, or the discard, that made `owner` the owner
  Without without;                     // only where proofs are kept, until the next write
};

struct Executed {
  uint32_t group = 0, frame = 0;  // of Model::groups
};
// The barriers, signals and waits executed so far. `proofs` off keeps only the facts.
struct History {
  const Model& model;
  bool proofs = false;
  std::vector<Executed> executed;
  std::vector<uint32_t> executed_on;              // by queue: how many
  std::vector<std::shared_ptr<ReadFate>> newest;  // by site
  explicit History(const Model& m, bool with_proofs = false);
};
ReadRecord make_read(History& history, Site site, uint32_t pass, uint32_t frame, uint64_t order);

// Counted through all frames: the signals of a frame come after those of the frame before; number 0 is the last one before frame 0.
int64_t number_of(const Model& model, const Scope& signal, uint32_t frame);

// Takes all groups in `history` into account that came since the state was last looked at, without effects that are local to ranges.
void advance(const History& history, CellState& state);
void advance(const History& history, ReadFate& fate);
void advance(const History& history, WriteRecord& write);

// Applies one group to the writes of a cell on which it has local effects through `local` scopes (no transitions among them), before it is
// part of the history. Everything before must have been taken into account.
void apply_to_writes(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, CellState& state);

// How `scope` sees a record as its source. `proof` receives what the fact needs of earlier barriers and of the source masks.
bool in_source(const Scope& scope, uint32_t scope_id, const ReadRecord& read, Proof& proof);
bool in_source(const Scope& scope, uint32_t scope_id, const WriteRecord& write, Proof& proof);

// The state a layout transition leaves. That of a split group is ordered before nothing until it is awaited.
WriteRecord transition_record(const History& history, const GroupNode& group, uint32_t scope_id);

// Of facts that hold.
Proof proof_of_reach(const Reach& reach, Site site);
Proof proof_of_visible(const WriteRecord& write, Site site, uint32_t access);

}  // namespace rg::verify
