#include <algorithm>

#include "compiler/emit_plan.h"
#include "compiler/format_table.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

using dsl::Role;

constexpr uint32_t kResolveSampleZero = 1, kResolveAverage = 2;  // VkResolveModeFlagBits

struct Found {
  bool defined_before = false, needed_after = false;
  Layout layout = Layout::undefined;
};
// Over all cells of the attachment.
Found find_uses(const PlanParts& parts, uint32_t pass, const dsl::Access& access) {
  Found found;
  const std::vector<uint32_t> cells = cells_of(parts.frame, access);
  for (uint32_t u = parts.frame.first_use[pass]; u < parts.frame.first_use[pass + 1]; ++u) {
    const Use& use = parts.frame.uses[u];
    if (!std::binary_search(cells.begin(), cells.end(), use.cell)) continue;
    found.defined_before = found.defined_before || parts.contents[u].defined_before;
    found.needed_after = found.needed_after || parts.contents[u].needed_after;
    found.layout = use.effect.layout;
  }
  return found;
}

LoadOp load_op(const dsl::Pass& pass, const dsl::Access& access, const Found& found, bool may_discard) {
  if (access.clear) return LoadOp::clear;
  if (is_slice(access) && access.covers && may_discard) return LoadOp::dont_care;
  return (needs_contents(pass, access) || !may_discard) && found.defined_before ? LoadOp::load : LoadOp::dont_care;
}
// NONE leaves memory alone, so an attachment that is only read really only is.
StoreOp store_op(bool writes, const Found& found, bool may_discard) {
  if (!writes) return StoreOp::none;
  return found.needed_after || !may_discard ? StoreOp::store : StoreOp::dont_care;
}

// The passes of a rendering, as they are recorded.
using Members = std::vector<uint32_t>;
Members members_of(const Schedule& schedule, size_t position) {
  Members members;
  for (size_t at = position; at < schedule.order.size() && schedule.leader_of[schedule.order[at]] == schedule.order[position]; ++at)
    members.push_back(schedule.order[at]);
  return members;
}

// The place of an attachment among the accesses of its pass, the same in all passes of the rendering.
enum class Slot : uint8_t { color, depth, stencil };
Slot slot_of(Role role) { return role == Role::color ? Slot::color : role == Role::stencil ? Slot::stencil : Slot::depth; }
std::vector<const dsl::Access*> attachments_of(const dsl::Pass& pass) {
  std::vector<const dsl::Access*> found;
  for (const dsl::Access& access : pass.accesses)
    if (access.role == Role::color) found.push_back(&access);
  for (const dsl::Access& access : pass.accesses)
    if (is_attachment(access.role) && access.role != Role::color) found.push_back(&access);
  return found;
}

const dsl::Access& attachment_of(const dsl::Pass& pass, size_t number) {
  for (const bool color : {true, false})
    for (const dsl::Access& access : pass.accesses)
      if (is_attachment(access.role) && (access.role == Role::color) == color && number-- == 0) return access;
  RG_CHECK(false, "passes of one rendering have the same attachments");
  return pass.accesses.front();
}

// Of a volume whose depth is known, where none are named.
uint32_t slices_of(const PlanParts& parts, const dsl::Resource& volume, const dsl::Access& access) {
  if (is_slice(access)) return access.range.slices;
  const int64_t depth = dsl::evaluate(*parts.frame.program, volume.depth, dsl::initial_extents(*parts.frame.program));
  return static_cast<uint32_t>(std::max<int64_t>(depth >> access.range.mip, 1));
}

// The first pass says what is loaded, the last what is wanted.
Attachment attachment_row(const PlanParts& parts, const PlanIndices& indices, const Members& members, size_t number) {
  const dsl::Pass& pass = parts.frame.pass(members.front());
  const dsl::Access& access = attachment_of(pass, number);
  const dsl::Resource& resource = parts.frame.graph->resources[access.resource];
  const Found found = find_uses(parts, members.front(), access);
  const Range range = resolved_range(resource, access);
  bool writes = false;
  for (const uint32_t member : members) {
    const dsl::Pass& other = parts.frame.pass(member);
    writes = writes || effect_of(other, attachment_of(other, number), range.aspects).writes != 0;
  }
  Attachment row;
  row.ref = plan_ref(indices, access.resource, access.age);
  row.range = range;
  if (resource.dimension == dsl::Dimension::d3)
    row.slice = is_slice(access) ? access.range.slice : 0, row.slices = slices_of(parts, resource, access);
  if (access.view != dsl::Format::none) row.view_format = format_row(access.view).vulkan;
  row.layout = found.layout;
  const bool discards = may_discard(parts.options, resource);
  row.load = load_op(pass, access, found, discards);
  row.store = store_op(writes, find_uses(parts, members.back(), attachment_of(parts.frame.pass(members.back()), number)), discards);
  if (access.clear) row.clear = plan_clear(*access.clear, range.aspects);
  return row;
}

// The resolve statement that names this attachment as its source.
void set_resolve(const PlanParts& parts, const PlanIndices& indices, uint32_t pass_index, const dsl::Access& source, Attachment& row) {
  const dsl::Pass& pass = parts.frame.pass(pass_index);
  if (source.role == Role::stencil) return;  // which stays as it is where the depth beside it is resolved
  for (const dsl::Transfer& transfer : pass.transfers) {
    if (transfer.kind != dsl::TransferKind::resolve || pass.accesses[transfer.src].resource != source.resource) continue;
    const dsl::Access& target = pass.accesses[transfer.dst];
    const dsl::Resource& resource = parts.frame.graph->resources[target.resource];
    const FormatRow& format = format_row(resource.format);
    row.resolve = plan_ref(indices, target.resource, target.age);
    row.resolve_range = resolved_range(resource, target);
    row.resolve_range.mips = 1;
    row.resolve_layout = find_uses(parts, pass_index, target).layout;
    row.resolve_mode = format.integer || !(format.aspects & aspect_color) ? kResolveSampleZero : kResolveAverage;
  }
}

// Layers that all attachments have.
void set_size(const PlanParts& parts, const dsl::Access& access, Expressions& exprs, bool first, Rendering& rendering) {
  const dsl::Resource& resource = parts.frame.graph->resources[access.resource];
  const Range range = resolved_range(resource, access);
  if (first) {
    rendering.width = exprs.mip(index_of(resource.width), range.mip);
    rendering.height = exprs.mip(index_of(resource.height), range.mip);
    rendering.samples = resource.samples;
  }
  const uint32_t layers = resource.dimension == dsl::Dimension::d3 ? slices_of(parts, resource, access) : range.layers;
  rendering.layers = first ? layers : std::min(rendering.layers, layers);
}

}  // namespace

void emit_rendering(const PlanParts& parts, const PlanIndices& indices, size_t position, Expressions& exprs, PlanData& plan, Pass& row) {
  const uint32_t pass_index = parts.schedule.order[position];
  const dsl::Pass& pass = parts.frame.pass(pass_index);
  if (pass.kind != dsl::PassKind::raster) return;
  if (parts.schedule.leader_of[pass_index] != pass_index) {  // goes on in the one of the pass before
    row.rendering = static_cast<Index>(plan.renderings.size()) - 1;
    return;
  }
  const Members members = members_of(parts.schedule, position);
  const std::vector<const dsl::Access*> attachments = attachments_of(pass);
  Rendering rendering;
  rendering.first_color = static_cast<Index>(plan.attachments.size());
  for (size_t i = 0; i < attachments.size(); ++i) {
    const Index index = static_cast<Index>(plan.attachments.size());
    plan.attachments.push_back(attachment_row(parts, indices, members, i));
    set_resolve(parts, indices, members.back(), *attachments[i], plan.attachments.back());
    set_size(parts, *attachments[i], exprs, i == 0, rendering);
    const Slot slot = slot_of(attachments[i]->role);
    if (slot == Slot::color) ++rendering.color_count;
    if (slot == Slot::depth) rendering.depth = index;
    if (slot == Slot::stencil) rendering.stencil = index;
  }
  if (pass.multiview) rendering.view_mask = (1u << rendering.layers) - 1;
  row.rendering = static_cast<Index>(plan.renderings.size());
  plan.renderings.push_back(rendering);
}

}  // namespace rg::compiler
