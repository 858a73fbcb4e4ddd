// New facts on a record, gathered while all barriers of a group see the state before the group, then merged. Private to sync_state.h.
#pragma once

#include <vector>

#include "compiler/verify/sync_state.h"

namespace rg::verify {

struct NewReach {
  uint32_t stage = 0;
  Proof proof;
};
struct NewVisible {
  uint32_t stage = 0, access = 0;
  Proof proof;
};
struct Updates {  // on `queue`
  uint32_t queue = 0;
  StageSet reach = 0;
  Visible visible;
  bool available = false;
  std::vector<NewReach> new_reach;
  std::vector<NewVisible> new_visible;
};

struct Held {
  uint32_t group = 0;  // of kind set
  Updates updates;     // with whole proofs: the root may be another when they count
};

// The atom of the one bit of `raw` that stands for the stage or access; empty if none or several do.
Proof stage_atom(uint32_t scope, AtomField field, Stages raw, uint32_t stage);
Proof access_atom(uint32_t scope, AtomField field, Accesses raw, uint32_t access);

// The source stages of `scope` that meet `stage`, as alternatives on top of `premise`.
void add_meeting_sources(const Scope& scope, uint32_t scope_id, uint32_t stage, const Proof& premise, Alternatives& result);
// Those that meet what already comes after the record; proofs without the root.
void add_chained_sources(const Scope& scope, uint32_t scope_id, const Reach& reach, Alternatives& result);
// The second scope of `scope` after `source`.
void add_reach(const Scope& scope, uint32_t scope_id, const Proof& source, StageSet settled, std::vector<NewReach>& result);
void add_visible(const Scope& scope, uint32_t scope_id, const Proof& source, std::vector<NewVisible>& result);

bool makes_available(const Scope& scope, const WriteRecord& write);
Proof availability_proof(const Scope& scope, uint32_t scope_id, const WriteRecord& write);
// The memory dependency of a scope that covers the cell. `source`: how the write comes before it.
void see(const History& history, uint32_t scope_id, const WriteRecord& write, const Alternatives& source, Updates& updates);

void commit(const History& history, const Updates& updates, Reach& reach);
void commit(const History& history, const Updates& updates, WriteRecord& write);

// Proofs on the queue no longer share a root: there is a second beginning.
void forget_root(Reach& reach, uint32_t queue);
void forget_root(WriteRecord& write, uint32_t queue);
// What all proofs on the queue have in common stays in all that follow.
void grow_root(Reach& reach, uint32_t queue);
void grow_root(WriteRecord& write, uint32_t queue);

// Its proofs on the queue all begin there.
void set_root(Reach& reach, uint32_t queue, Proof root);

// Neither another signal nor another wait of this kind says more, until the proofs of the record change where it looks.
inline bool is_quiet(const Reach& reach, const GroupNode& group) { return group.alike < 64 && (reach.quiet >> group.alike & 1); }

// Set and awaited events, see events.cpp.
void hold(const History& history, uint32_t group, ReadFate& fate);
void hold(const History& history, uint32_t group, const std::vector<uint32_t>& local, WriteRecord& write);
void hold(uint32_t group, Updates updates, Reach& reach);
void await(const History& history, const GroupNode& group, ReadFate& fate);
void await(const History& history, const GroupNode& group, WriteRecord& write);

// What barriers of a group do to a record, beside what it is before them. `own`: stages of reads that are no longer than that record.
void chain(const History& history, const ExecutionClass& execution, const Reach& reach, StageSet own, Updates& updates);
// `rooted`: the one barrier that makes the write available is its root already.
Updates effects(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, bool rooted, const WriteRecord& write);

// A group without effects on the record can be skipped without a look at its barriers.
bool concerns(const GroupNode& group, const Reach& reach, StageSet own);
inline StageSet own_stage(const GroupNode& group, const ReadFate& read) { return read.queue == group.queue ? stage_bit(read.stage) : 0; }

// A signal or wait, see semaphores.cpp.
void apply_semaphores(const History& history, const Executed& executed, ReadFate& fate);
void apply_semaphores(const History& history, const Executed& executed, WriteRecord& write);

}  // namespace rg::verify
