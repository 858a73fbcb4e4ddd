#include "compiler/verify/boundary.h"

#include <algorithm>

namespace rg::verify {
namespace {

void add_scope(PendingOn& on, StageSet stages, AccessSet accesses) {
  on.stages |= stages;
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (stages & stage_bit(s)) on.accesses[s] |= accesses & supported(s);
}

void add_row(const Model& model, Pending& pending, const BoundaryNode& row, uint32_t aspect) {
  pending.stated = true;
  pending.discard = pending.discard || row.discard;
  pending.layout = layout_of_aspect(row.layout, aspect);
  const uint32_t queue = row.queue == kNone ? 0 : row.queue;
  if (row.queue != kNone && pending.owner == kNone && !pending.disagrees) pending.owner = row.queue;
  if (pending.owner != kNone && model.family[pending.owner] != model.family[queue]) pending.owner = kNone, pending.disagrees = true;
  add_scope(pending.on.at(queue), row.stages, row.accesses);
}

Layout layout_of_state(dsl::Role role, uint32_t aspect) {
  switch (role) {
    case dsl::Role::sampled:
    case dsl::Role::input:
      return aspect == aspect_color ? Layout::shader_read_only : layout_of_aspect(Layout::depth_stencil_read_only, aspect);
    case dsl::Role::color:
    case dsl::Role::resolve_src:
    case dsl::Role::resolve_dst:
      return aspect == aspect_color ? Layout::color_attachment : layout_of_aspect(Layout::depth_stencil_attachment, aspect);
    case dsl::Role::depth:
    case dsl::Role::stencil:
      return layout_of_aspect(Layout::depth_stencil_attachment, aspect);
    case dsl::Role::depth_readonly:
      return layout_of_aspect(Layout::depth_stencil_read_only, aspect);
    case dsl::Role::copy_src:
    case dsl::Role::blit_src:
      return Layout::transfer_src;
    case dsl::Role::copy_dst:
    case dsl::Role::blit_dst:
    case dsl::Role::clear_dst:
    case dsl::Role::fill_dst:
    case dsl::Role::update_dst:
      return Layout::transfer_dst;
    case dsl::Role::present:
      return Layout::present_src;
    case dsl::Role::undefined:
      return Layout::undefined;
    default:
      return Layout::general;
  }
}

// Whoever waits for a pending stage waits for what comes before it in the pipeline, too.
bool is_covered(const ReadRecord& read, const Pending& pending) {
  bool covered = false;
  pending.on.each([&](uint32_t queue, const PendingOn& on) {
    const StageSet own = read.queue == queue ? stage_bit(read.stage) : 0;
    covered = covered || ((read.reach().stages(queue) | own) & with_earlier(on.stages)) != 0;
  });
  return covered;
}

StageSet stages_without(StageSet reach, StageSet stages) {
  StageSet result = 0;
  for (uint32_t s = 0; s < kStageCount; ++s)
    if ((stages & stage_bit(s)) && !(reach & with_earlier(stage_bit(s)))) result |= stage_bit(s);
  return result;
}

bool leads_to_write(const Reach& reach, const Pending& pending) {
  bool leads = false;
  pending.on.each([&](uint32_t queue, const PendingOn& on) {
    for (uint32_t s = 0; s < kStageCount; ++s)
      if ((on.accesses[s] & kAllWrites) && (reach.stages(queue) & with_earlier(stage_bit(s)))) leads = true;
  });
  return leads;
}

std::string why_not_covered(const WriteRecord& write, const Pending& pending) {
  // A signal may have made it available; who waits for the named write does so, too.
  if (write.stage < kStageCount && (pending.on.get(write.queue).accesses[write.stage] & access_bit(write.access))) return "";
  if (!write.available) return "its write in " + stage_name(write.stage) + " is not available and not named";
  if (pending.has_writes()) return leads_to_write(write.reach, pending) ? "" : "no named write comes after its last write";
  std::string why;
  pending.on.each([&](uint32_t queue, const PendingOn& on) {
    const StageSet unordered = stages_without(write.reach.stages(queue), on.stages);
    if (unordered != 0) why = "stage " + stages_text(unordered) + " is not ordered after its last write";
    for (uint32_t s = 0; s < kStageCount && why.empty() && !pending.discard; ++s)
      if (on.accesses[s] & kAllReads & ~write.visible_to(queue, s)) why = "its last write is not visible to " + stage_name(s);
  });
  return why;
}

bool same_layout(const CellState& state, const Pending& pending) { return pending.layout == Layout::undefined || state.layout == pending.layout; }

// The frame after: copies of a history resource are one frame older.
uint32_t next_cell(const Model& model, uint32_t resource, uint32_t copy, uint32_t cell) {
  const uint32_t copies = model.resources[resource].copies;
  return model.cell(resource, (copy + copies - 1) % copies, cell);
}

void report_boundary(const Model& model, uint32_t resource, uint32_t cell, const std::string& text, Report& report) {
  report.add({Hazard::boundary_mismatch, model.resource(resource).name, "", "", model.place(resource, cell) + ": " + text});
}

void check_import(const Model& model, uint32_t r, const std::vector<Pending>& entry, Report& report) {
  const ResourceNode& node = model.resources[r];
  History history(model);
  for (uint32_t c = 0; c < node.partition.cell_count(); ++c) {
    const Pending& given = entry[model.cell(r, 0, c)];
    if (!given.stated) continue;
    // The engine hands over on the queue that the plan names.
    const uint32_t queue = given.owner == kNone ? 0 : given.owner;
    const Pending declared = pending_of(model.resource(r).before, node.partition.shape.image, aspect_of_cell(node.partition, c), queue);
    const std::string why = why_not_covered(state_from(declared, false, history), given);
    if (!why.empty()) report_boundary(model, r, c, "the entry state does not cover the declared `ready as` state: " + why, report);
    if (node.partition.shape.image && given.layout != declared.layout && given.layout != Layout::undefined)
      report_boundary(model, r, c, "entry layout " + layout_name(given.layout) + " is not the declared " + layout_name(declared.layout), report);
  }
}

}  // namespace

bool Pending::has_writes() const {
  bool found = false;
  on.each([&](uint32_t, const PendingOn& queue) {
    for (const AccessSet accesses : queue.accesses) found = found || (accesses & kAllWrites);
  });
  return found;
}
bool Pending::is_free() const {
  bool free = true;
  on.each([&](uint32_t, const PendingOn& queue) { free = free && queue.stages == 0; });
  return free;
}

std::vector<Pending> pending_of(const Model& model, const std::vector<BoundaryNode>& rows) {
  std::vector<Pending> result(model.cell_count);
  for (const BoundaryNode& row : rows) {
    const ResourceNode& node = model.resources[row.resource];
    const uint32_t copy = (node.copies - row.age % node.copies) % node.copies;
    for (const uint32_t c : row.cells) add_row(model, result[model.cell(row.resource, copy, c)], row, aspect_of_cell(node.partition, c));
  }
  return result;
}

Pending pending_of(const dsl::BoundaryState& state, bool image, uint32_t aspect, uint32_t queue) {
  dsl::Access access;
  access.role = state.role;
  access.stages = state.stages;
  access.mode = state.wrote ? dsl::Mode::write : dsl::Mode::read;
  dsl::Pass pass;
  pass.kind = dsl::PassKind::raster;
  Pending pending;
  pending.stated = true;
  if (image) pending.layout = layout_of_state(state.role, aspect);
  std::vector<Touch> touches = is_attachment(state.role) ? touches_of_attachment(access, state.wrote ? LoadOp::none : LoadOp::load, StoreOp::none)
                                                         : touches_of(pass, access, 0);
  for (const Touch& touch : touches)
    if (touch.needed) add_scope(pending.on.at(queue), touch.stages, touch.accesses);
  return pending;
}

CellState state_from(const Pending& pending, bool signalled, History& history) {
  const auto seen = static_cast<uint32_t>(history.executed.size());
  CellState state;
  state.layout = pending.layout;
  state.owner = pending.discard ? kNone : pending.owner;
  if (pending.is_free()) return state;
  WriteRecord settled;  // the write that the pending reads saw
  settled.pass = kNone, settled.seen = seen;
  settled.available = settled.read_since = true;
  const auto make_write = [&](uint32_t queue, uint32_t stage, uint32_t access) {
    WriteRecord write(queue);
    write.stage = stage, write.access = access, write.pass = kNone, write.seen = seen;
    if (signalled) write.reach.signals = {{queue, 0, {}}};
    state.writes.push_back(std::move(write));
  };
  pending.on.each([&](uint32_t queue, const PendingOn& on) {
    if (signalled && on.stages) settled.reach.signals.push_back({queue, 0, {}});
    for (uint32_t s = 0; s < kStageCount; ++s) {
      if (!(on.stages & stage_bit(s))) continue;
      state.reads.push_back(make_read(history, site_of(queue, s), kNone, 0, 0));
      if (signalled) state.reads.back().fate->reach.signals = {{queue, 0, {}}};
      for (uint32_t a = 0; a < kAccessCount; ++a)
        if (on.accesses[s] & kAllWrites & access_bit(a)) make_write(queue, s, a);
      settled.reach.queues.at(queue).settled = settled.reach.queues.at(queue).stages |= stage_bit(s);
      settled.visible.at(queue).to[s] = on.accesses[s] & kAllReads;
    }
  });
  if (state.writes.empty()) state.writes.push_back(std::move(settled));
  return state;
}

std::string why_not_covered(const CellState& state, const Pending& pending) {
  if (!same_layout(state, pending)) return "layout is " + layout_name(state.layout) + ", not " + layout_name(pending.layout);
  for (const ReadRecord& read : state.reads)
    if (!is_covered(read, pending)) return "a read in " + stage_name(read.stage) + " is not named";
  for (const WriteRecord& write : state.writes) {
    const std::string why = why_not_covered(write, pending);
    if (!why.empty()) return why;
  }
  return "";
}

std::string why_not_visible(const CellState& state, const Pending& pending) {
  std::string why;
  for (const WriteRecord& write : state.writes)
    pending.on.each([&](uint32_t queue, const PendingOn& on) {
      for (uint32_t s = 0; s < kStageCount && why.empty(); ++s)
        if (on.accesses[s] & kAllReads & ~write.visible_to(queue, s)) why = "its last write is not visible to " + stage_name(s);
    });
  return why;
}

void check_boundaries(const Model& model, Report& report) {
  const std::vector<Pending> entry = pending_of(model, model.entry), exit = pending_of(model, model.exit);
  History history(model);
  for (uint32_t r = 0; r < model.resources.size(); ++r) {
    const ResourceNode& node = model.resources[r];
    const dsl::Lifetime lifetime = model.resource(r).lifetime;
    if (node.plan == kNone || lifetime == dsl::Lifetime::readback) continue;
    if (lifetime == dsl::Lifetime::imported) {
      check_import(model, r, entry, report);
      continue;
    }
    for (uint32_t copy = 0; copy < node.copies; ++copy)
      for (uint32_t c = 0; c < node.partition.cell_count(); ++c) {
        const Pending& left = exit[model.cell(r, copy, c)];
        // The copy that is `age` frames old now keeps its memory and is one frame older at the next entry.
        const Pending& found = entry[next_cell(model, r, copy, c)];
        if (left.stated != found.stated)
          report_boundary(model, r, c, left.stated ? "the entry state is missing" : "the exit state is missing", report);
        if (!left.stated || !found.stated) continue;
        const std::string why = why_not_covered(state_from(left, false, history), found);
        if (!why.empty()) report_boundary(model, r, c, "the next entry does not cover the exit state: " + why, report);
        if (model.is_exclusive(r) && !left.discard && (left.disagrees || found.disagrees))
          report_boundary(model, r, c, "its rows name queues of different families, but one owns it", report);
        const bool kept = model.is_exclusive(r) && !left.discard && left.owner != kNone && found.owner != kNone;
        if (kept && model.family[left.owner] != model.family[found.owner])
          report_boundary(model, r, c,
                          "the next frame expects it on " + model.queue_name(found.owner) + ", but " + model.queue_name(left.owner) + " owns it",
                          report);
      }
  }
}

}  // namespace rg::verify
