#include <algorithm>

#include "compiler/emit_plan.h"
#include "compiler/slots.h"

namespace rg::compiler {
namespace {

Bytes plan_bytes(const dsl::Range& range) { return {index_of(range.offset), index_of(range.size)}; }

Layout layout_in_pass(const Frame& frame, uint32_t pass, const dsl::Access& access) {
  const std::vector<uint32_t> cells = cells_of(frame, access);
  for (const Use& use : frame.uses_of(pass))
    if (!cells.empty() && use.cell == cells.front()) return use.effect.layout;
  return Layout::undefined;
}

Access access_row(const PlanParts& parts, const PlanIndices& indices, uint32_t pass, const dsl::Access& access) {
  const Frame& frame = parts.frame;
  const dsl::Resource& resource = frame.graph->resources[access.resource];
  const Range exact = resolved_range(resource, access);
  const bool image = resource.kind == dsl::ResourceKind::image;
  const Effect effect = effect_of(frame.pass(pass), access, image ? exact.aspects & (~exact.aspects + 1) : 0);
  Access row;
  row.ref = plan_ref(indices, access.resource, access.age);
  if (image) row.range = plan_range(resource, exact), row.layout = layout_in_pass(frame, pass, access);
  if (!image) row.range = {}, row.bytes = plan_bytes(access.range);
  row.stages = effect.stages(), row.accesses = effect.reads | effect.writes;
  row.writes = effect.writes != 0;
  if (access.role == dsl::Role::color && !access.clear && !may_discard(parts.options, resource)) row.accesses |= rg::access::color_attachment_read;
  return row;
}

uint64_t guard_bits(const dsl::Pass& pass) {
  uint64_t bits = 0;
  for (const dsl::ConditionId condition : pass.conditions) bits |= uint64_t{1} << condition.value;
  return bits;
}

Index engine_set_of(const dsl::Program& program, const std::string& bind) {
  if (bind.empty()) return kNone;
  const auto found =
      std::find_if(program.engine_sets.begin(), program.engine_sets.end(), [&](const dsl::EngineSet& set) { return set.name == bind; });
  return found == program.engine_sets.end() ? kNone : static_cast<Index>(found - program.engine_sets.begin());
}

// A rendering of several passes loads what some of them need and stores what some of them wrote, whatever the pass at hand does itself.
void add_loads_and_stores(const Schedule& schedule, size_t position, PlanData& plan, const Pass& row) {
  const auto shares = [&](size_t other) {
    return other < schedule.order.size() && schedule.one_rendering(schedule.order[position], schedule.order[other]);
  };
  if (row.rendering == kNone || (!shares(position + 1) && (position == 0 || !shares(position - 1)))) return;
  const Rendering& rendering = plan.renderings[row.rendering];
  const auto add = [&](const Attachment& attachment, Accesses reads, Accesses writes) {
    for (Index a = row.first_access; a < row.first_access + row.access_count; ++a) {
      Access& access = plan.accesses[a];
      if (access.ref != attachment.ref || (access.accesses & (reads | writes)) == 0) continue;
      if (attachment.load == LoadOp::load) access.accesses |= reads;
      if (attachment.store != StoreOp::none) access.accesses |= writes;
    }
  };
  for (Index i = 0; i < rendering.color_count; ++i)
    add(plan.attachments[rendering.first_color + i], access::color_attachment_read, access::color_attachment_write);
  for (const Index i : {rendering.depth, rendering.stencil})
    if (i != kNone) add(plan.attachments[i], access::depth_stencil_attachment_read, access::depth_stencil_attachment_write);
}

void emit_pass(const PlanParts& parts, const PlanIndices& indices, size_t position, Index host_slot, Expressions& exprs, PlanData& plan) {
  const uint32_t pass = parts.schedule.order[position];
  const dsl::Pass& from = parts.frame.pass(pass);
  Pass row;
  row.name = intern(from.name), row.module = intern(from.module);
  row.kind = static_cast<PassKind>(from.kind);
  row.guard = guard_bits(from);
  row.queue = parts.schedule.queue_of_pass(pass);
  row.first_access = static_cast<Index>(plan.accesses.size()), row.access_count = static_cast<Index>(from.accesses.size());
  for (const dsl::Access& access : from.accesses) plan.accesses.push_back(access_row(parts, indices, pass, access));
  row.engine_set = engine_set_of(*parts.frame.program, from.bind);
  row.host_slot = host_slot;
  row.first_mip_limit = static_cast<Index>(plan.mip_limits.size()), row.mip_limit_count = static_cast<Index>(from.mip_limits.size());
  for (const dsl::MipLimit& limit : from.mip_limits) plan.mip_limits.push_back({indices.resource[limit.image.value], limit.mip});
  emit_rendering(parts, indices, position, exprs, plan, row);
  add_loads_and_stores(parts.schedule, position, plan, row);
  emit_work(parts, indices, pass, exprs, plan, row);
  plan.passes.push_back(row);
}

}  // namespace

void emit_passes(const PlanParts& parts, const PlanIndices& indices, Expressions& exprs, PlanData& plan) {
  const std::vector<Index> slots = host_slots(*parts.frame.graph);
  for (size_t at = 0; at < parts.schedule.order.size(); ++at)
    emit_pass(parts, indices, at, slots[parts.frame.passes[parts.schedule.order[at]]], exprs, plan);
}

}  // namespace rg::compiler
