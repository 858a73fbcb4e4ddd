// Replays the plan's commands on all cells: is every access ordered after, and does it see, what came before it?
//
// A pass that may be skipped leaves both possibilities behind, so one replay covers every outcome of the conditions.
// The first frame starts from the plan's entry states, as after any other plan, and must end within its exit states. Further frames go on from where
// the frame before really ended, until a frame ends as the one before it did: from there on all are alike.
#pragma once

#include <vector>

#include "compiler/verify/sync_state.h"

namespace rg::verify {

struct SyncResult {
  std::vector<bool> required;       // by Atom: some necessary fact has no proof without it; empty unless asked for
  std::vector<Release> released;    // by release of the plan: bits in use; empty unless asked for
  std::vector<uint32_t> first_use;  // by program resource: position in Model::steps; kNone: unused
};

SyncResult replay_sync(const Model& model, bool proofs, Report& report);

}  // namespace rg::verify
