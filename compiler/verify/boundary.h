// States between frames: what is pending on a cell, and when one such state covers another.
#pragma once

#include "compiler/verify/sync_state.h"

namespace rg::verify {

struct PendingOn {  // a queue
  StageSet stages = 0;
  AccessSet accesses[kStageCount] = {};  // supported ones, by stage
};
// The rows of a boundary that speak of one cell.
struct Pending {
  bool stated = false, discard = false;
  ByQueue<PendingOn> on;
  Layout layout = Layout::undefined;
  uint32_t owner = kNone;  // queue; kNone: not said
  bool disagrees = false;  // rows name queues of different families: they say nothing of the owner
  bool has_writes() const;
  bool is_free() const;  // nothing is pending
};

// By cell of the model; history copies as at frame 0.
std::vector<Pending> pending_of(const Model& model, const std::vector<BoundaryNode>& rows);
// What an imported resource's declared state leaves pending on `queue`.
Pending pending_of(const dsl::BoundaryState& state, bool image, uint32_t aspect, uint32_t queue);

// A cell as it is when a frame starts in this state. `signalled`: what is pending came before the last signals of the frame before.
CellState state_from(const Pending& pending, bool signalled, History& history);
// Empty if every barrier sequence that is right after `pending` is right after `state`; else the reason it is not.
std::string why_not_covered(const CellState& state, const Pending& pending);
// Writes the state may not leave behind: what `pending` reads must see them. Empty if all are visible.
std::string why_not_visible(const CellState& state, const Pending& pending);

// Entry against declared imports, exit of one frame against entry of the next.
void check_boundaries(const Model& model, Report& report);

}  // namespace rg::verify
