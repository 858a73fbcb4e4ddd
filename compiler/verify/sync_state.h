// What one cell's accesses still wait for, and what barriers have done about it.
//
//   write ──> available ──> visible to (stage, access)            RAW and WAW need visible
//   read  ──────────────> reach: stages ordered after it          WAR needs the writer's stage in reach
//
// A barrier (S -> D) extends reach where S, with logically earlier stages, meets it; to D with logically later stages. It makes a
// write available if S and its accesses name it, and visible to exactly D x its destination accesses.
//
// Proofs. Beside every fact stands the set of atoms (barriers, stage bits, access bits) that all its derivations use. A fact that
// has a derivation without an atom survives its removal: sets of alternative derivations intersect, sets of joint premises unite.
// An atom that no proof of any necessary fact contains is redundant.
//
// Source of the rules: Vulkan 1.3, "Execution and Memory Dependencies", "Synchronization Scopes", "Availability, visibility".
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compiler/verify/model.h"

namespace rg::verify {

using Atom = uint32_t;
using Proof = std::vector<Atom>;  // sorted

enum class AtomField : uint8_t { whole, src_stage, src_access, dst_stage, dst_access };
constexpr Atom atom_of(uint32_t scope, AtomField field, uint32_t bit = 0) { return (scope * 5 + static_cast<uint32_t>(field)) * 64 + bit; }
constexpr uint32_t scope_of(Atom atom) { return atom / (5 * 64); }

// Stages ordered after something.
struct Reach {
  StageSet stages = 0;
  StageSet settled = 0;                            // needs no atom beyond the root's
  Proof root;                                      // what every proof also uses: the one barrier with which everything began
  std::vector<std::pair<uint32_t, Proof>> proofs;  // of stages that are not settled
};

// Reads in one stage between the same two groups share their fate.
struct ReadFate {
  uint32_t stage = 0;
  uint32_t born = 0, seen = 0;  // groups executed before the reads, and taken into account
  Reach reach;
};
struct ReadRecord {
  uint32_t stage = 0, pass = 0;  // pass kNone: before the frame
  uint64_t order = 0;            // accesses that share a number do not wait for each other
  std::shared_ptr<ReadFate> fate;
  const Reach& reach() const { return fate->reach; }
};

struct VisibleTo {
  uint32_t stage = 0, access = 0;
  Proof proof;
};
struct WriteRecord {
  uint32_t stage = kStageCount, access = kAccessCount;  // kStageCount: a layout transition, or settled before the frame
  uint32_t pass = 0;
  uint32_t scope = kNone;  // of a layout transition
  uint64_t order = 0;      // commuting writers, and passes of one rendering, share a number and do not wait for each other
  uint32_t seen = 0;
  bool available = false;
  bool read_since = false;  // by a pass that always runs: who waits for it comes after this write, and sees it
  Reach reach;              // from where it became available
  AccessSet visible[kStageCount] = {};
  std::vector<VisibleTo> proofs;  // of visible pairs that still depend on single atoms
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
  uint32_t layout_scope = kNone;  // the barrier that set it
  Without without;                // only where proofs are kept, until the next write
};

// The barriers executed so far. `proofs` off keeps only the facts.
struct History {
  const Model& model;
  bool proofs = false;
  std::vector<uint32_t> groups;  // in execution order, indices of Model::groups
  std::shared_ptr<ReadFate> newest[kStageCount];
};
ReadRecord make_read(History& history, uint32_t stage, uint32_t pass, uint64_t order);
// As it is now, whatever comes.
CellState frozen(const CellState& state);

// Takes all groups in `history` into account that came since the state was last looked at, without effects that are local to ranges.
void advance(const History& history, CellState& state);

// Applies one group to the writes of a cell on which it has local effects through `local` scopes (no transitions among them), before it is
// part of the history. Everything before must have been taken into account.
void apply_to_writes(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, CellState& state);

// How `scope` sees a record as its source. `proof` receives what the fact needs of earlier barriers and of the source masks.
bool in_source(const Scope& scope, uint32_t scope_id, const ReadRecord& read, Proof& proof);
bool in_source(const Scope& scope, uint32_t scope_id, const WriteRecord& write, Proof& proof);

// The state a layout transition leaves.
WriteRecord transition_record(const History& history, const Scope& scope, uint32_t scope_id);

// Of facts that hold.
Proof proof_of_reach(const ReadRecord& read, uint32_t stage);
Proof proof_of_reach(const WriteRecord& write, uint32_t stage);
Proof proof_of_visible(const WriteRecord& write, uint32_t stage, uint32_t access);

}  // namespace rg::verify
