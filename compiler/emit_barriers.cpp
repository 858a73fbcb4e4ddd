#include <algorithm>

#include "compiler/byte_cuts.h"
#include "compiler/emit_plan.h"

namespace rg::compiler {
namespace {

ImageBarrier image_row(const PlanParts& parts, const PlanIndices& indices, const CellBarrier& b) {
  const Cell& cell = parts.frame.cells[b.cell];
  ImageBarrier row;
  row.image = {indices.resource[cell.resource], cell.age};
  row.range = plan_range(parts.frame.graph->resources.rows[cell.resource], b.range);
  row.src_stages = b.src_stages, row.src_accesses = b.src_accesses;
  row.dst_stages = b.dst_stages, row.dst_accesses = b.dst_accesses;
  row.old_layout = b.old_layout, row.new_layout = b.new_layout;
  row.src_queue = b.src_queue, row.dst_queue = b.dst_queue;
  row.tag = b.tag;
  return row;
}

BufferBarrier buffer_row(const PlanParts& parts, const PlanIndices& indices, const CellBarrier& b, Expressions& exprs) {
  const Cell& cell = parts.frame.cells[b.cell];
  BufferBarrier row;
  row.buffer = {indices.resource[cell.resource], cell.age};
  row.bytes = bytes_between(parts.frame.grids[cell.resource], b.begin, b.end, exprs);
  row.src_stages = b.src_stages, row.src_accesses = b.src_accesses;
  row.dst_stages = b.dst_stages, row.dst_accesses = b.dst_accesses;
  row.tag = b.tag;
  return row;
}

void emit_group(const PlanParts& parts, const PlanIndices& indices, const std::vector<CellBarrier>& barriers, std::vector<Acquire>& acquires,
                Expressions& exprs, PlanData& plan) {
  BarrierGroup group;
  group.first_memory = static_cast<Index>(plan.memory_barriers.size());
  group.first_image = static_cast<Index>(plan.image_barriers.size());
  group.first_buffer = static_cast<Index>(plan.buffer_barriers.size());
  for (const CellBarrier& b : barriers) {
    const uint32_t resource = parts.frame.cells[b.cell].resource;
    if (parts.frame.graph->resources.rows[resource].kind == dsl::ResourceKind::buffer) {
      plan.buffer_barriers.push_back(buffer_row(parts, indices, b, exprs));
      continue;
    }
    if (b.is_acquire) {
      Acquire& acquire = *std::lower_bound(acquires.begin(), acquires.end(), resource, [](const Acquire& a, Index r) { return a.resource < r; });
      if (acquire.image_barriers++ == 0) acquire.image_barrier = static_cast<Index>(plan.image_barriers.size());
    }
    plan.image_barriers.push_back(image_row(parts, indices, b));
  }
  group.image_count = static_cast<Index>(plan.image_barriers.size()) - group.first_image;
  group.buffer_count = static_cast<Index>(plan.buffer_barriers.size()) - group.first_buffer;
  plan.groups.push_back(group);
}

void emit_boundary(const PlanParts& parts, const PlanIndices& indices, const std::vector<CellBoundary>& from, Expressions& exprs,
                   std::vector<Boundary>& to) {
  for (const auto& [cell_index, state] : from) {
    const Cell& cell = parts.frame.cells[cell_index];
    const dsl::Resource& resource = parts.frame.graph->resources.rows[cell.resource];
    Boundary row = state;
    row.ref = {indices.resource[cell.resource], cell.age};
    if (resource.kind == dsl::ResourceKind::image) row.range = plan_range(resource, cell.range);
    if (resource.kind == dsl::ResourceKind::buffer) row.bytes = bytes_between(parts.frame.grids[cell.resource], cell.begin, cell.end, exprs);
    to.push_back(row);
  }
}

}  // namespace

// Groups in front of segments are always there, for hand-offs of memory; those at the end of a batch where something stands in them, and at the end
// of a frame on one queue. Split groups have the numbers after them all, so that those of the others tell how far a frame has come.
std::vector<Index> groups_of_slots(const PlanParts& parts) {
  std::vector<Index> groups(parts.sync.groups.size(), kNone);
  std::vector<bool> opens(groups.size());
  for (uint32_t segment = 0; segment < parts.schedule.segments; ++segment) opens[parts.schedule.slot_before(segment)] = true;
  Index next = 0;
  for (uint32_t slot = 0; slot < groups.size(); ++slot)
    if (opens[slot] || !parts.sync.groups[slot].empty() || parts.schedule.queues.size() == 1) groups[slot] = next++;
  return groups;
}

Index first_split_group(const std::vector<Index>& groups_of_slots) {
  return static_cast<Index>(std::count_if(groups_of_slots.begin(), groups_of_slots.end(), [](Index group) { return group != kNone; }));
}

void emit_barriers(const PlanParts& parts, const PlanIndices& indices, Expressions& exprs, PlanData& plan) {
  std::vector<Acquire> acquires = parts.sync.acquires;  // by program resource, ascending
  const std::vector<Index> group_of_slot = groups_of_slots(parts);
  for (uint32_t slot = 0; slot < group_of_slot.size(); ++slot)
    if (group_of_slot[slot] != kNone) emit_group(parts, indices, parts.sync.groups[slot], acquires, exprs, plan);
  for (Index event = 0; event < parts.sync.splits.size(); ++event) {
    emit_group(parts, indices, parts.sync.splits[event].barriers, acquires, exprs, plan);
    plan.groups.back().event = event;
  }
  for (Acquire& acquire : acquires) acquire.resource = indices.resource[acquire.resource], acquire.group = group_of_slot[acquire.group];
  plan.acquires = std::move(acquires);
  plan.releases = parts.sync.releases;
  for (Release& release : plan.releases) release.resource = indices.resource[release.resource];
  emit_boundary(parts, indices, parts.sync.entry, exprs, plan.entry);
  emit_boundary(parts, indices, parts.sync.exit, exprs, plan.exit);
}

}  // namespace rg::compiler
