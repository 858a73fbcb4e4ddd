#include "compiler/verify/boundary.h"

#include <algorithm>

namespace rg::verify {
namespace {

void add_row(Pending& pending, const BoundaryNode& row, uint32_t aspect) {
  pending.stated = true;
  pending.discard = pending.discard || row.discard;
  pending.stages |= row.stages;
  pending.layout = layout_of_aspect(row.layout, aspect);
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (row.stages & stage_bit(s)) pending.accesses[s] |= row.accesses & supported(s);
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
  return ((read.reach().stages | stage_bit(read.stage)) & with_earlier(pending.stages)) != 0;
}

StageSet stages_without(const Reach& reach, StageSet stages) {
  StageSet result = 0;
  for (uint32_t s = 0; s < kStageCount; ++s)
    if ((stages & stage_bit(s)) && !(reach.stages & with_earlier(stage_bit(s)))) result |= stage_bit(s);
  return result;
}

std::string why_not_covered(const WriteRecord& write, const Pending& pending) {
  if (!write.available) {
    const bool named = pending.accesses[write.stage] & access_bit(write.access);
    return named ? "" : "its write in " + stage_name(write.stage) + " is not available and not named";
  }
  if (pending.has_writes()) {
    for (uint32_t s = 0; s < kStageCount; ++s)
      if ((pending.accesses[s] & kAllWrites) && (write.reach.stages & with_earlier(stage_bit(s)))) return "";
    return "no named write comes after its last write";
  }
  const StageSet unordered = stages_without(write.reach, pending.stages);
  if (unordered != 0) return "stage " + stages_text(unordered) + " is not ordered after its last write";
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (!pending.discard && (pending.accesses[s] & kAllReads & ~write.visible[s])) return "its last write is not visible to " + stage_name(s);
  return "";
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
  History history{model, false, {}, {}};
  for (uint32_t c = 0; c < node.partition.cell_count(); ++c) {
    const Pending& given = entry[model.cell(r, 0, c)];
    const Pending declared = pending_of(model.resource(r).before, node.partition.shape.image, aspect_of_cell(node.partition, c));
    if (!given.stated) continue;
    const std::string why = why_not_covered(state_from(declared, history), given);
    if (!why.empty()) report_boundary(model, r, c, "the entry state does not cover the declared `ready as` state: " + why, report);
    if (node.partition.shape.image && given.layout != declared.layout && given.layout != Layout::undefined)
      report_boundary(model, r, c, "entry layout " + layout_name(given.layout) + " is not the declared " + layout_name(declared.layout), report);
  }
}

}  // namespace

bool Pending::has_writes() const {
  return std::any_of(std::begin(accesses), std::end(accesses), [](AccessSet set) { return (set & kAllWrites) != 0; });
}

std::vector<Pending> pending_of(const Model& model, const std::vector<BoundaryNode>& rows) {
  std::vector<Pending> result(model.cell_count);
  for (const BoundaryNode& row : rows) {
    const ResourceNode& node = model.resources[row.resource];
    const uint32_t copy = (node.copies - row.age % node.copies) % node.copies;
    for (const uint32_t c : row.cells) add_row(result[model.cell(row.resource, copy, c)], row, aspect_of_cell(node.partition, c));
  }
  return result;
}

Pending pending_of(const dsl::BoundaryState& state, bool image, uint32_t aspect) {
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
  for (const Touch& touch : touches) {
    if (!touch.needed) continue;
    pending.stages |= touch.stages;
    for (uint32_t s = 0; s < kStageCount; ++s)
      if (touch.stages & stage_bit(s)) pending.accesses[s] |= touch.accesses & supported(s);
  }
  return pending;
}

CellState state_from(const Pending& pending, History& history) {
  const auto seen = static_cast<uint32_t>(history.groups.size());
  CellState state;
  state.layout = pending.layout;
  if (pending.stages == 0) return state;
  for (uint32_t s = 0; s < kStageCount; ++s) {
    if (!(pending.stages & stage_bit(s))) continue;
    state.reads.push_back(make_read(history, s, kNone, 0));
    for (uint32_t a = 0; a < kAccessCount; ++a) {
      if (!(pending.accesses[s] & kAllWrites & access_bit(a))) continue;
      WriteRecord write;
      write.stage = s, write.access = a, write.pass = kNone, write.seen = seen;
      state.writes.push_back(std::move(write));
    }
  }
  if (!state.writes.empty()) return state;
  WriteRecord write;
  write.pass = kNone, write.seen = seen;
  write.available = write.read_since = true;
  write.reach.stages = write.reach.settled = pending.stages;
  for (uint32_t s = 0; s < kStageCount; ++s) write.visible[s] = pending.accesses[s] & kAllReads;
  state.writes.push_back(std::move(write));
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
  for (const WriteRecord& write : state.writes)
    for (uint32_t s = 0; s < kStageCount; ++s)
      if (pending.accesses[s] & kAllReads & ~write.visible[s]) return "its last write is not visible to " + stage_name(s);
  return "";
}

void check_boundaries(const Model& model, Report& report) {
  const std::vector<Pending> entry = pending_of(model, model.entry), exit = pending_of(model, model.exit);
  History history{model, false, {}, {}};
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
        const std::string why = why_not_covered(state_from(left, history), found);
        if (!why.empty()) report_boundary(model, r, c, "the next entry does not cover the exit state: " + why, report);
      }
  }
}

}  // namespace rg::verify
