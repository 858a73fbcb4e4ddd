#include <algorithm>

#include "compiler/emit_plan.h"
#include "compiler/format_table.h"

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

LoadOp load_op(const dsl::Pass& pass, const dsl::Access& access, const Found& found) {
  if (access.clear) return LoadOp::clear;
  return needs_contents(pass, access) && found.defined_before ? LoadOp::load : LoadOp::dont_care;
}
// NONE leaves memory alone, so a read-only attachment really only reads.
StoreOp store_op(const Effect& effect, const Found& found) {
  if (effect.writes == 0) return StoreOp::none;
  return found.needed_after ? StoreOp::store : StoreOp::dont_care;
}

Attachment attachment_row(const PlanParts& parts, const PlanIndices& indices, uint32_t pass, const dsl::Access& access) {
  const dsl::Resource& resource = parts.frame.graph->resources[access.resource];
  const Found found = find_uses(parts, pass, access);
  const Range range = resolved_range(resource, access);
  const Effect effect = effect_of(parts.frame.pass(pass), access, range.aspects);
  Attachment row;
  row.ref = plan_ref(indices, access.resource, access.age);
  row.range = range;
  row.layout = found.layout;
  row.load = load_op(parts.frame.pass(pass), access, found);
  row.store = store_op(effect, found);
  if (access.clear) row.clear = plan_clear(*access.clear, range.aspects);
  return row;
}

// The resolve statement that names this attachment as its source.
void set_resolve(const PlanParts& parts, const PlanIndices& indices, uint32_t pass_index, const dsl::Access& source, Attachment& row) {
  const dsl::Pass& pass = parts.frame.pass(pass_index);
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
  rendering.layers = first ? range.layers : std::min(rendering.layers, range.layers);
}

}  // namespace

void emit_rendering(const PlanParts& parts, const PlanIndices& indices, uint32_t pass_index, Expressions& exprs, PlanData& plan, Pass& row) {
  const dsl::Pass& pass = parts.frame.pass(pass_index);
  if (pass.kind != dsl::PassKind::raster) return;
  Rendering rendering;
  rendering.first_color = static_cast<Index>(plan.attachments.size());
  bool first = true;
  const auto add = [&](const dsl::Access& access) {
    Attachment attachment = attachment_row(parts, indices, pass_index, access);
    set_resolve(parts, indices, pass_index, access, attachment);
    set_size(parts, access, exprs, first, rendering);
    first = false;
    plan.attachments.push_back(attachment);
    return static_cast<Index>(plan.attachments.size() - 1);
  };
  for (const dsl::Access& access : pass.accesses)
    if (access.role == Role::color) add(access), ++rendering.color_count;
  for (const dsl::Access& access : pass.accesses) {
    if (access.role == Role::depth || access.role == Role::depth_readonly) rendering.depth = add(access);
    if (access.role == Role::stencil) rendering.stencil = add(access);
  }
  row.rendering = static_cast<Index>(plan.renderings.size());
  plan.renderings.push_back(rendering);
}

}  // namespace rg::compiler
