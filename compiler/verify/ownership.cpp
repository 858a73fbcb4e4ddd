// Exclusive ranges belong to one queue family at a time. Source: Vulkan 1.3, "Queue Family Ownership Transfer", "Resource Sharing Mode".
#include <algorithm>

#include "compiler/verify/replay.h"

namespace rg::verify {
namespace {

std::string transfer_text(const Model& model, const Scope& scope) {
  const bool release = scope.transfer == Ownership::release;
  return std::string(release ? "the release" : "the acquire") + " of " +
         (scope.cells.empty() ? "" : model.place(scope.resource, scope.cells.front())) + (release ? " to " : " from ") +
         model.queue_name(scope.other);
}

void report_owner(Replay& replay, uint32_t resource, const std::string& pass, const std::string& text) {
  replay.report.add({Hazard::ownership, replay.model.resource(resource).name, "", pass, text});
}

// Empty if both are the halves of one transfer.
std::string why_no_match(const Scope& release, const Scope& acquire) {
  if (release.queue != acquire.other || release.other != acquire.queue) return "they name different queues";
  if (release.kind != acquire.kind || release.cells != acquire.cells) return "their ranges differ";
  if (release.old_layout != acquire.old_layout || release.new_layout != acquire.new_layout) return "their layouts differ";
  return "";
}

bool may_use(const Model& model, const CellState& state, uint32_t queue) {
  return state.owner == kNone || model.family[state.owner] == model.family[queue];
}

}  // namespace

void check_owner(Replay& replay, uint32_t pass, uint32_t resource, uint32_t cell, CellState& state, uint32_t queue) {
  const Model& model = replay.model;
  if (!model.is_exclusive(resource)) return;
  const std::string who = "`" + model.pass_name(pass) + "` on " + model.queue_name(queue) + " uses " + model.place(resource, cell);
  if (state.released_by != kNone)
    report_owner(replay, resource, model.pass_name(pass),
                 who + " between " + transfer_text(model, model.scopes[state.released_by]) + " and its acquire");
  else if (!may_use(model, state, queue))
    report_owner(replay, resource, model.pass_name(pass),
                 who + ", which " + model.queue_name(state.owner) + " owns: no release and acquire hand it over");
  for (const uint32_t scope : state.owner_scopes) replay.require({atom_of(scope, AtomField::whole)});
  if (!may_use(model, state, queue)) state.owner_scopes.clear();
  if (state.owner == kNone || !may_use(model, state, queue)) state.owner = queue;
  state.released_by = kNone;
}

void check_owner_of_transition(Replay& replay, const Scope& scope, uint32_t scope_id, uint32_t cell, CellState& state) {
  const Model& model = replay.model;
  if (!model.is_exclusive(scope.resource)) return;
  if (scope.old_layout == Layout::undefined) {
    const bool takes = state.released_by != kNone || !may_use(model, state, scope.queue);
    state.owner_scopes.clear();
    if (takes) state.owner_scopes = {scope_id};
    state.owner = scope.queue, state.released_by = kNone;
    return;
  }
  if (state.released_by == kNone && may_use(model, state, scope.queue)) {
    if (state.owner == kNone) state.owner = scope.queue;
    return;
  }
  report_owner(replay, scope.resource, "",
               "image barrier " + std::to_string(scope.index) + " on " + model.queue_name(scope.queue) + " keeps the contents of " +
                   model.place(scope.resource, cell) + ", which " +
                   (state.released_by == kNone ? model.queue_name(state.owner) + " owns" : "no queue owns between release and acquire"));
  state.owner = scope.queue, state.released_by = kNone;
}

void check_transfer(Replay& replay, const Scope& scope, uint32_t scope_id, uint32_t cell, CellState& state) {
  const Model& model = replay.model;
  const std::string what = transfer_text(model, scope);
  if (scope.transfer == Ownership::release) {
    if (state.released_by != kNone)
      report_owner(replay, scope.resource, "", what + " follows another release of " + model.place(scope.resource, cell));
    if (!may_use(model, state, scope.queue))
      report_owner(replay, scope.resource, "",
                   what + " comes from " + model.queue_name(scope.queue) + ", but " + model.queue_name(state.owner) + " owns it");
    state.released_by = scope_id;
    return;
  }
  if (state.released_by == kNone) {
    report_owner(replay, scope.resource, "", what + " has no release before it: the contents are lost");
  } else {
    const std::string why = why_no_match(model.scopes[state.released_by], scope);
    if (!why.empty()) report_owner(replay, scope.resource, "", what + " does not match the release: " + why);
    state.owner_scopes = {state.released_by, scope_id};
  }
  state.owner = scope.queue, state.released_by = kNone;
}

}  // namespace rg::verify
