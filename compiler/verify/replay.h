// The replay's state, shared by what happens in a frame (sync_replay.cpp) and at its ends (replay_exit.cpp).
#pragma once

#include <string>
#include <vector>

#include "compiler/verify/boundary.h"
#include "compiler/verify/release_track.h"
#include "compiler/verify/sync_replay.h"

namespace rg::verify {

struct Replay {
  const Model& model;
  Report& report;
  History history;
  std::vector<CellState> cells;
  SyncResult result;
  std::vector<bool> used;  // by cell of copy 0
  ReleaseTrack releases;
  uint32_t frame = 0;
  uint32_t dispensable = kNone;  // a scope whose existence the access now checked does not need

  Replay(const Model& m, Report& r, bool proofs) : model(m), report(r), history(m, proofs), releases(make_release_track(m)) {}

  uint32_t physical(uint32_t resource, uint32_t age, uint32_t cell) const {
    const uint32_t copies = model.resources[resource].copies;
    return model.cell(resource, (frame + copies - age % copies) % copies, cell);
  }
  // Where boundaries keep what they say of a copy that is `age` frames old.
  uint32_t at_frame_zero(uint32_t resource, uint32_t age, uint32_t cell) const {
    const uint32_t copies = model.resources[resource].copies;
    return model.cell(resource, (copies - age % copies) % copies, cell);
  }
  uint32_t now() const { return static_cast<uint32_t>(history.executed.size()); }
  void require(const Proof& proof) {
    if (!history.proofs) return;
    for (const Atom atom : proof)
      if (dispensable == kNone || atom != atom_of(dispensable, AtomField::whole)) result.required[atom] = true;
  }
};

// Who may use a cell: the family of one queue at a time, where it is not shared.
void check_owner(Replay& replay, uint32_t pass, uint32_t resource, uint32_t cell, CellState& state, uint32_t queue);
// A transition without transfer that keeps contents needs the owner; one that discards makes its queue the owner.
void check_owner_of_transition(Replay& replay, const Scope& scope, uint32_t scope_id, uint32_t cell, CellState& state);
// Release and acquire must be halves of one transfer.
void check_transfer(Replay& replay, const Scope& scope, uint32_t scope_id, uint32_t cell, CellState& state);

// Words for findings.
std::string who(const Replay& replay, const WriteRecord& write);
std::string who(const Replay& replay, const ReadRecord& read);
std::string pass_or_empty(const Replay& replay, uint32_t pass);

// The frame's end: within the exit states, imports as declared, read-backs visible to the host.
void leave(Replay& replay, const std::vector<Pending>& exit);

}  // namespace rg::verify
