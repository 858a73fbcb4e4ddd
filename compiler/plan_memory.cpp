#include "compiler/plan_memory.h"

#include "runtime/alias.h"
#include "runtime/packing.h"

namespace rg::compiler {
namespace {

struct Items {
  std::vector<Index> resources;
  std::vector<packing::Item> rows;
};

Items list_items(const PlanData& plan, const Plan& view) {
  const std::vector<alias::GroupInterval> intervals = alias::group_intervals(view);
  const alias::Sharing sharing(view);
  Items items;
  for (Index r = 0; r < plan.resources.size(); ++r) {
    const Resource& resource = plan.resources[r];
    if (resource.lifetime != Lifetime::transient || !intervals[r].used()) continue;
    const bool alone = resource.no_alias || !sharing.acquire(r);
    const uint32_t begin = alone ? 0 : intervals[r].begin, end = alone ? static_cast<uint32_t>(plan.groups.size()) : intervals[r].end + 1;
    items.resources.push_back(r);
    items.rows.push_back({resource.estimated_bytes, resource.estimated_alignment, begin, end});
  }
  return items;
}

std::vector<packing::Conflict> list_conflicts(const Items& items, const Plan& view) {
  const alias::Sharing sharing(view);
  std::vector<packing::Conflict> conflicts;
  for (uint32_t a = 0; a < items.rows.size(); ++a)
    for (uint32_t b = a + 1; b < items.rows.size(); ++b)
      if (!sharing.may_share(items.resources[a], items.resources[b])) conflicts.emplace_back(a, b);
  return conflicts;
}

}  // namespace

MemoryPlan place_transients(PlanData& plan) {
  const Plan view = plan.view();
  const Items items = list_items(plan, view);
  MemoryPlan memory;
  for (const packing::Item& item : items.rows) memory.unaliased_bytes += item.bytes;
  const packing::Placement placement = plan.queues.size() == 1 ? packing::pack(items.rows) : packing::pack(items.rows, list_conflicts(items, view));
  for (size_t i = 0; i < items.rows.size(); ++i) plan.resources[items.resources[i]].estimated_offset = placement.offsets[i];
  memory.heap_bytes = placement.heap_bytes, memory.lower_bound_bytes = placement.lower_bound_bytes;
  plan.estimated_heap_bytes = memory.heap_bytes;
  return memory;
}

}  // namespace rg::compiler
