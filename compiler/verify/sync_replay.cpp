#include "compiler/verify/sync_replay.h"

#include <algorithm>
#include <map>

#include "compiler/verify/boundary.h"
#include "compiler/verify/frame_end.h"
#include "compiler/verify/replay.h"

namespace rg::verify {
namespace {

// ---- words ------------------------------------------------------------------------------------------------------

bool is_signalled(const Reach& reach, uint32_t queue) {
  return std::any_of(reach.signals.begin(), reach.signals.end(), [&](const SignalReach& signal) { return signal.queue == queue; });
}

// The first edge that lacks between two queues.
std::string missing_wait(const Replay& replay, const Reach& reach, uint32_t from, uint32_t to, uint32_t stage) {
  const std::string first = replay.model.queue_name(from), second = replay.model.queue_name(to);
  if (!is_signalled(reach, from)) return first + " signals nothing after it";
  if (reach.stages(to) == 0) return second + " waits for no signal of " + first + " that comes after it";
  return "no wait of " + second + " leads from it to " + stage_name(stage);
}

std::string what_is_missing(const Replay& replay, const WriteRecord& write, uint32_t queue, uint32_t stage, uint32_t access) {
  const bool reached = write.reach.stages(queue) & stage_bit(stage);
  if (write.queue != queue && !reached) return missing_wait(replay, write.reach, write.queue, queue, stage);
  if (!write.available) return "no barrier makes the write available";
  if (!reached) return "no barrier orders " + stage_name(stage) + " after it";
  return "no barrier makes it visible to " + stage_name(stage) + " " + access_name(access);
}

struct Point {
  uint32_t pass, resource, cell, queue;
};  // where an access happens

std::string whose(const Replay& replay, const Point& at, uint32_t stage, uint32_t access) {
  const std::string on = replay.model.queue_count > 1 ? ", " + replay.model.queue_name(at.queue) : "";
  return "`" + replay.model.pass_name(at.pass) + "` (" + stage_name(stage) + " " + access_name(access) + on + ")";
}

void report_write(Replay& replay, const Point& at, const WriteRecord& write, uint32_t stage, uint32_t access) {
  const bool writes = kAllWrites & access_bit(access);
  const std::string second = replay.model.pass_name(at.pass);
  replay.report.add({writes ? Hazard::write_after_write : Hazard::read_after_write, replay.model.resource(at.resource).name,
                     pass_or_empty(replay, write.pass), second,
                     whose(replay, at, stage, access) + (writes ? " writes " : " reads ") + replay.model.place(at.resource, at.cell) + " after " +
                         who(replay, write) + ": " + what_is_missing(replay, write, at.queue, stage, access)});
}

void report_read(Replay& replay, const Point& at, const ReadRecord& read, uint32_t stage, uint32_t access) {
  const std::string second = replay.model.pass_name(at.pass);
  const std::string missing = read.queue == at.queue ? "no barrier orders " + stage_name(stage) + " after the read"
                                                     : missing_wait(replay, read.reach(), read.queue, at.queue, stage);
  replay.report.add({Hazard::write_after_read, replay.model.resource(at.resource).name, pass_or_empty(replay, read.pass), second,
                     whose(replay, at, stage, access) + " overwrites " + replay.model.place(at.resource, at.cell) + " read by " + who(replay, read) +
                         ": " + missing});
}

// ---- one access -------------------------------------------------------------------------------------------------

// Attachment work inside one rendering happens in rasterization order. Numbers of renderings, of commuting runs and of frames do not meet.
constexpr uint64_t kRenderingOrder = uint64_t{1} << 32;
uint64_t order_of(const Replay& replay, const PassNode& node, const Use& use, size_t cell) {
  const uint64_t frame = uint64_t{replay.frame} << 33;
  if (use.attachment) return frame | kRenderingOrder | node.rendering;
  return use.orders[cell] == 0 ? 0 : frame | use.orders[cell];
}

// Readers in between saw the write, and whoever writes waits for them: that orders it, too. Those that commute with it are not waited for.
bool readers_order(const WriteRecord& write, uint64_t order) { return write.read_since && (write.read_by == 0 || write.read_by != order); }

void check_after_writes(Replay& replay, const Point& at, const CellState& state, uint64_t order, uint32_t stage, uint32_t access, bool needed) {
  const bool writes = kAllWrites & access_bit(access);
  for (const WriteRecord& write : state.writes) {
    if (order != 0 && write.order == order) continue;
    if (writes && readers_order(write, order)) continue;
    if (write.visible_to(at.queue, stage) & access_bit(access))
      replay.require(proof_of_visible(write, site_of(at.queue, stage), access));
    else if (needed)
      report_write(replay, at, write, stage, access);
  }
}

void check_after_reads(Replay& replay, const Point& at, const CellState& state, uint64_t order, uint32_t stage, uint32_t access) {
  for (const ReadRecord& read : state.reads) {
    if (order != 0 && read.order == order) continue;
    if (read.reach().stages(at.queue) & stage_bit(stage))
      replay.require(proof_of_reach(read.reach(), site_of(at.queue, stage)));
    else
      report_read(replay, at, read, stage, access);
  }
}

void check_touch(Replay& replay, const Point& at, const CellState& state, uint64_t order, const Touch& touch) {
  for (uint32_t s = 0; s < kStageCount; ++s) {
    if (!(touch.stages & stage_bit(s))) continue;
    for (uint32_t a = 0; a < kAccessCount; ++a) {
      if (!(touch.accesses & supported(s) & access_bit(a))) continue;
      check_after_writes(replay, at, state, order, s, a, touch.needed);
      if (touch.needed && (kAllWrites & access_bit(a))) check_after_reads(replay, at, state, order, s, a);
    }
  }
}

void check_layout(Replay& replay, const Point& at, const CellState& state, Layout planned) {
  const Partition& partition = replay.model.resources[at.resource].partition;
  if (!partition.shape.image || planned == Layout::undefined) return;
  const Layout wanted = layout_of_aspect(planned, aspect_of_cell(partition, at.cell));
  if (state.layout_scope != kNone) replay.require({atom_of(state.layout_scope, AtomField::whole)});
  if (state.layout == wanted) return;
  const std::string pass = replay.model.pass_name(at.pass);
  replay.report.add({Hazard::wrong_layout, replay.model.resource(at.resource).name, "", pass,
                     "`" + pass + "` uses " + replay.model.place(at.resource, at.cell) + " in layout " + layout_name(wanted) + ", but it is in " +
                         layout_name(state.layout)});
}

// ---- without a transition ---------------------------------------------------------------------------------------

bool holds_without(const Proof& proof, uint32_t scope) { return !std::binary_search(proof.begin(), proof.end(), atom_of(scope, AtomField::whole)); }

bool is_ordered_without(const Without& without, uint32_t queue, uint32_t stage, uint32_t access) {
  const bool writes = kAllWrites & access_bit(access);
  const Site site = site_of(queue, stage);
  for (const WriteRecord& write : without.writes) {
    if (writes && write.read_since) continue;
    if (!(write.visible_to(queue, stage) & access_bit(access)) || !holds_without(proof_of_visible(write, site, access), without.scope)) return false;
  }
  for (const ReadRecord& read : without.reads) {
    if (!writes) continue;
    if (!(read.reach().stages(queue) & stage_bit(stage)) || !holds_without(proof_of_reach(read.reach(), site), without.scope)) return false;
  }
  return true;
}

// The use would be right if the transition before it, which discards and changes no layout, were missing.
bool is_right_without(const CellState& state, const Use& use, uint32_t queue) {
  if (state.without.scope == kNone || use.uses_contents) return false;
  for (const Touch& touch : use.touches)
    for (uint32_t s = 0; s < kStageCount && touch.needed; ++s)
      for (uint32_t a = 0; a < kAccessCount && (touch.stages & stage_bit(s)); ++a)
        if ((touch.accesses & supported(s) & access_bit(a)) && !is_ordered_without(state.without, queue, s, a)) return false;
  return true;
}

// All touches of one pass on one cell: what is checked against the state before, and recorded together.
struct CellUse {
  bool touched = false, may_skip = false;
  bool settles = true;  // no other pass of the same rendering follows, which would wait for what came before and not for this pass
  uint64_t order = 0;
  StageSet read_stages = 0;
  AccessSet writes[kStageCount] = {};
  bool any_write = false;
};

void gather(CellUse& cell_use, const Use& use) {
  for (const Touch& touch : use.touches) {
    if (!touch.needed) continue;
    for (uint32_t s = 0; s < kStageCount; ++s) {
      if (!(touch.stages & stage_bit(s))) continue;
      const AccessSet accesses = touch.accesses & supported(s);
      if (accesses & kAllReads) cell_use.read_stages |= stage_bit(s);
      cell_use.writes[s] |= accesses & kAllWrites;
      cell_use.any_write = cell_use.any_write || (accesses & kAllWrites);
    }
  }
}

void record_reads(Replay& replay, uint32_t pass, const CellUse& use, CellState& state) {
  const uint32_t queue = replay.model.passes[pass].queue;
  // Of this pass itself, too: what it wrote in an earlier frame.
  for (WriteRecord& write : state.writes)
    if (use.read_stages && !use.may_skip && !write.read_since && !(use.order != 0 && write.order == use.order))
      write.read_since = true, write.read_by = use.order;
  for (uint32_t s = 0; s < kStageCount; ++s) {
    // A later access that waits for this pass's write in a stage waits for its read there as well.
    if (!(use.read_stages & stage_bit(s)) || use.writes[s]) continue;
    std::erase_if(state.reads,
                  [&](const ReadRecord& read) { return read.queue == queue && read.stage == s && (use.settles || read.order == use.order); });
    state.reads.push_back(make_read(replay.history, site_of(queue, s), pass, replay.frame, use.order));
  }
}

void record_writes(Replay& replay, uint32_t pass, const CellUse& use, CellState& state) {
  const uint32_t queue = replay.model.passes[pass].queue;
  const bool commuting = use.order != 0 && !(use.order & kRenderingOrder);
  if (!use.may_skip && !commuting) {
    if (use.settles) {
      std::erase_if(state.reads, [&](const ReadRecord& read) { return read.pass != pass || read.frame != replay.frame; });
      state.writes.clear();
    }
    state.without = {};
  }
  for (uint32_t s = 0; s < kStageCount; ++s)
    for (uint32_t a = 0; a < kAccessCount; ++a) {
      if (!(use.writes[s] & access_bit(a))) continue;
      // An older write by the same queue, stage and access is settled whenever this one is.
      std::erase_if(state.writes, [&](const WriteRecord& w) {
        return w.queue == queue && w.stage == s && w.access == a && (use.order == 0 || w.order == use.order);
      });
      WriteRecord write(queue);
      write.stage = s, write.access = a, write.pass = pass, write.order = use.order, write.seen = replay.now();
      state.writes.push_back(std::move(write));
    }
}

void check_use(Replay& replay, const PassNode& node, const Use& use, std::map<uint32_t, CellUse>& cell_uses) {
  for (size_t i = 0; i < use.cells.size(); ++i) {
    const uint32_t physical = replay.physical(use.resource, use.age, use.cells[i]);
    CellState& state = replay.cells[physical];
    advance(replay.history, state);
    const Point at{node.plan_pass, use.resource, use.cells[i], node.queue};
    const uint64_t order = order_of(replay, node, use, i);
    check_owner(replay, node.plan_pass, use.resource, use.cells[i], state, node.queue);
    check_layout(replay, at, state, use.layouts[i]);
    replay.dispensable = is_right_without(state, use, node.queue) ? state.without.scope : kNone;
    for (const Touch& touch : use.touches) check_touch(replay, at, state, order, touch);
    replay.dispensable = kNone;
    CellUse& cell_use = cell_uses[physical];
    // Two accesses of one pass to one cell: they share an order only if both have it.
    cell_use.order = cell_use.touched && cell_use.order != order ? 0 : order;
    cell_use.touched = true;
    cell_use.settles = cell_use.settles && (!use.attachment || node.last_in_rendering);
    cell_use.may_skip = replay.model.may_skip(node.plan_pass, use.resource, use.cells[i]);
    gather(cell_use, use);
  }
}

void run_pass(Replay& replay, uint32_t index) {
  const PassNode& node = replay.model.passes[index];
  std::map<uint32_t, CellUse> cell_uses;
  for (const Use& use : node.uses) check_use(replay, node, use, cell_uses);
  for (const auto& [physical, use] : cell_uses) {
    CellState& state = replay.cells[physical];
    record_reads(replay, index, use, state);
    if (use.any_write) record_writes(replay, index, use, state);
  }
}

// ---- barriers ---------------------------------------------------------------------------------------------------

void report_transition(Replay& replay, const Scope& scope, uint32_t cell, Hazard hazard, const std::string& before, const std::string& pass,
                       const std::string& missing) {
  std::string what = scope.kind == ScopeKind::image ? "image barrier " + std::to_string(scope.index) + " moves "
                                                    : "buffer barrier " + std::to_string(scope.index) + " moves ";
  what += replay.model.place(scope.resource, cell);
  if (scope.old_layout != scope.new_layout) what += " from " + layout_name(scope.old_layout) + " to " + layout_name(scope.new_layout);
  if (scope.transfer == Ownership::release) what += " to " + replay.model.queue_name(scope.other);
  if (scope.transfer == Ownership::acquire) what += " from " + replay.model.queue_name(scope.other);
  replay.report.add({hazard, replay.model.resource(scope.resource).name, pass, "", what + " after " + before + ": " + missing});
}

void check_transition(Replay& replay, const Scope& scope, uint32_t id, uint32_t cell, const CellState& state) {
  Proof proof;
  for (const ReadRecord& read : state.reads) {
    if (in_source(scope, id, read, proof))
      replay.require(proof);
    else
      report_transition(replay, scope, cell, Hazard::write_after_read, "a read by " + who(replay, read), pass_or_empty(replay, read.pass),
                        "its source stages do not wait for it");
  }
  for (const WriteRecord& write : state.writes) {
    if (write.read_since) continue;  // its readers saw it, and the transition waits for them
    if (in_source(scope, id, write, proof))
      replay.require(proof);
    else
      report_transition(replay, scope, cell, Hazard::write_after_write, "a write by " + who(replay, write), pass_or_empty(replay, write.pass),
                        "its source scope does not make the write available");
  }
}

void check_old_layout(Replay& replay, const Scope& scope, uint32_t cell, const CellState& state) {
  if (scope.old_layout == Layout::undefined) return;
  const uint32_t aspect = aspect_of_cell(replay.model.resources[scope.resource].partition, cell);
  if (state.layout_scope != kNone) replay.require({atom_of(state.layout_scope, AtomField::whole)});
  if (layout_of_aspect(scope.old_layout, aspect) == state.layout) return;
  replay.report.add({Hazard::wrong_layout, replay.model.resource(scope.resource).name, "", "",
                     "image barrier " + std::to_string(scope.index) + " expects " + replay.model.place(scope.resource, cell) + " in " +
                         layout_name(scope.old_layout) + ", but it is in " + layout_name(state.layout)});
}

void apply_to_cell(Replay& replay, const GroupNode& group, uint32_t cell, const std::vector<uint32_t>& local, CellState& state) {
  const auto transition = std::find_if(local.begin(), local.end(), [&](uint32_t id) { return replay.model.scopes[id].changes(); });
  for (const uint32_t id : local) {
    const Scope& scope = replay.model.scopes[id];
    if (scope.kind == ScopeKind::image && scope.transfer != Ownership::acquire) check_old_layout(replay, scope, cell, state);
  }
  if (transition == local.end()) {
    apply_to_writes(replay.history, group, local, state);
    return;
  }
  const Scope& scope = replay.model.scopes[*transition];
  if (local.size() > 1)
    replay.report.add({Hazard::invalid_barrier, replay.model.resource(scope.resource).name, "", "",
                       "two barriers of one group cover " + replay.model.place(scope.resource, cell) + ", and one changes its layout or owner"});
  check_transition(replay, scope, *transition, cell, state);
  if (scope.transfer == Ownership::none)
    check_owner_of_transition(replay, scope, *transition, cell, state);
  else
    check_transfer(replay, scope, *transition, cell, state);
  const Layout layout = layout_of_aspect(scope.new_layout, aspect_of_cell(replay.model.resources[scope.resource].partition, cell));
  state.without = {};
  if (replay.history.proofs && state.layout == layout && scope.transfer == Ownership::none) state.without = {*transition, state.reads, state.writes};
  if (state.layout != layout) state.layout_scope = *transition;
  state.reads.clear();
  state.writes = {transition_record(replay.history, group, *transition)};
  state.writes.front().seen = replay.now() + 1;
  state.layout = layout;
}

// The runtime adds a memory barrier from the last users of the memory to the first users of its new owner; to these it is a write before them.
void hand_over(Replay& replay, const Acquire& acquire, uint32_t queue) {
  WriteRecord write(queue);
  write.pass = kNone;
  write.available = true;
  write.seen = replay.now();
  write.reach.queues.at(queue).stages = write.reach.queues.at(queue).settled = with_later(expand_stages(acquire.stages));
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (expand_stages(acquire.stages) & stage_bit(s)) write.visible.at(queue).to[s] = expand_accesses(acquire.accesses) & supported(s);
  const uint32_t r = replay.model.input->program_resource[acquire.resource];
  for (uint32_t c = 0; c < replay.model.resources[r].partition.cell_count(); ++c) {
    if (!replay.used[replay.model.cell(r, 0, c)]) continue;
    CellState& state = replay.cells[replay.physical(r, 0, c)];
    advance(replay.history, state);
    state.writes.push_back(write);
  }
}

void run_group(Replay& replay, uint32_t index) {
  const GroupNode& group = replay.model.groups[index];
  pass_point(replay, replay.releases, group);
  struct Local {
    uint32_t cell = 0;
    std::vector<uint32_t> scopes;
  };
  std::map<uint32_t, Local> covered;
  for (const uint32_t id : group.scopes) {
    const Scope& scope = replay.model.scopes[id];
    if (!scope.has_range()) continue;
    for (const uint32_t c : scope.cells) {
      Local& local = covered[replay.physical(scope.resource, scope.age, c)];
      local.cell = c;
      local.scopes.push_back(id);
    }
  }
  for (const auto& [physical, local] : covered) {
    advance(replay.history, replay.cells[physical]);
    apply_to_cell(replay, group, local.cell, local.scopes, replay.cells[physical]);
  }
  replay.history.executed.push_back({index, replay.frame});
  ++replay.history.executed_on[group.queue];
  for (const uint32_t acquire : group.handed_over) hand_over(replay, replay.model.input->plan.acquires[acquire], group.queue);
}

// ---- frames -----------------------------------------------------------------------------------------------------

// Only what was there before the frame was signalled by the frame before; what the engine brings was not.
void enter_resource(Replay& replay, uint32_t r, const std::vector<Pending>& entry) {
  const dsl::Lifetime lifetime = replay.model.resource(r).lifetime;
  const ResourceNode& node = replay.model.resources[r];
  for (uint32_t i = node.first_cell; i < node.first_cell + node.copies * node.partition.cell_count(); ++i) {
    // The host has waited for everything before it uses a read-back buffer again.
    replay.cells[i] = lifetime == dsl::Lifetime::readback ? CellState{} : state_from(entry[i], lifetime != dsl::Lifetime::imported, replay.history);
    for (WriteRecord& write : replay.cells[i].writes) write.pass = kNone;
  }
}

// Contents of transients end with the frame, and with them their owner.
void forget_owner(Replay& replay, uint32_t r) {
  const ResourceNode& node = replay.model.resources[r];
  for (uint32_t i = node.first_cell; i < node.first_cell + node.partition.cell_count(); ++i) replay.cells[i].owner = kNone;
}

void enter(Replay& replay, const std::vector<Pending>& entry) {
  const auto start_over = [&] { replay.history.newest.assign(replay.history.newest.size(), nullptr); };
  start_over();
  for (const bool imported : {true, false}) {
    for (uint32_t r = 0; r < replay.model.resources.size(); ++r) {
      const dsl::Lifetime lifetime = replay.model.resource(r).lifetime;
      if ((lifetime == dsl::Lifetime::imported) != imported) continue;
      const bool fresh = imported || lifetime == dsl::Lifetime::readback;
      if (replay.frame == 0 || fresh) enter_resource(replay, r, entry);
      if (lifetime == dsl::Lifetime::transient) forget_owner(replay, r);
    }
    start_over();
  }
}

void find_uses(Replay& replay) {
  SyncResult& result = replay.result;
  result.first_use.assign(replay.model.resources.size(), kNone);
  replay.used.assign(replay.model.cell_count, false);
  for (uint32_t s = 0; s < replay.model.steps.size(); ++s) {
    if (!replay.model.steps[s].is_pass) continue;
    for (const Use& use : replay.model.passes[replay.model.steps[s].index].uses) {
      for (const uint32_t cell : use.cells) replay.used[replay.model.cell(use.resource, 0, cell)] = true;
      if (result.first_use[use.resource] == kNone) result.first_use[use.resource] = s;
    }
  }
}

void run_frame(Replay& replay) {
  for (uint32_t s = 0; s < replay.model.steps.size() && !replay.report.full(); ++s) {
    const StepNode& step = replay.model.steps[s];
    if (!step.is_pass) {
      run_group(replay, step.index);
      continue;
    }
    run_pass(replay, step.index);
  }
}

}  // namespace

SyncResult replay_sync(const Model& model, bool proofs, Report& report) {
  Replay replay(model, report, proofs);
  replay.cells.resize(model.cell_count);
  if (proofs) replay.result.required.assign(static_cast<size_t>(atom_of(static_cast<uint32_t>(model.scopes.size()), AtomField::whole)), false);
  find_uses(replay);
  const std::vector<Pending> entry = pending_of(model, model.entry), exit = pending_of(model, model.exit);
  FrameEnd before, now;
  const uint32_t least = model.history + 2, most = least + 8;
  for (; replay.frame < most && !report.full(); ++replay.frame) {
    enter(replay, entry);
    begin_frame(replay, replay.releases);
    run_frame(replay);
    end_frame(replay, replay.releases);
    leave(replay, exit);
    before = std::move(now), now = end_of_frame(replay);
    if (replay.frame + 1 < least || before != now) continue;
    if (proofs && replay.releases.active) replay.result.released = std::move(replay.releases.used);
    return std::move(replay.result);
  }
  if (!report.full()) report.add({Hazard::boundary_mismatch, "", "", "", "frame after frame leaves another state behind: the proof does not close"});
  return std::move(replay.result);
}

}  // namespace rg::verify
