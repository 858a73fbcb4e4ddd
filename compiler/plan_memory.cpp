#include "compiler/plan_memory.h"

#include <algorithm>

#include "compiler/antichain.h"
#include "runtime/alias.h"
#include "runtime/packing.h"

namespace rg::compiler {
namespace {

struct Items {
  std::vector<Index> resources;
  std::vector<packing::Item> rows;
};

// `lazy`: with images that may live on the chip.
Items list_items(const PlanData& plan, const Plan& view, bool lazy) {
  const std::vector<alias::GroupInterval> intervals = alias::group_intervals(view);
  const alias::Sharing sharing(view);
  Items items;
  for (Index r = 0; r < plan.resources.size(); ++r) {
    const Resource& resource = plan.resources[r];
    if (resource.lifetime != Lifetime::transient || !intervals[r].used() || (resource.lazy && !lazy)) continue;
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

// Transients that share no bytes in one frame because neither comes after the other; exact where every life is ordered by clocks. Beyond
// kMostCompared the bound of the serial order stands, which is lower.
uint64_t bound_on_queues(const Items& items, const Plan& view) {
  constexpr size_t kMostCompared = 2000;
  if (items.rows.size() > kMostCompared) return 0;
  const alias::Sharing sharing(view);
  std::vector<uint64_t> weights;
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (const packing::Item& item : items.rows) weights.push_back(item.bytes);
  for (uint32_t a = 0; a < items.rows.size(); ++a)
    for (uint32_t b = 0; b < items.rows.size(); ++b)
      if (sharing.may_follow(items.resources[a], items.resources[b], false)) edges.emplace_back(a, b);
  return max_weight_antichain(weights, edges);
}

// More than make_schedule() has spent on the order it has chosen.
uint64_t packing_effort(Effort effort, size_t items) {
  if (effort == Effort::fast) return 100'000;
  if (effort == Effort::max) return items > 2000 ? 20'000 * items : 2'000'000'000;
  return 4000 * items;
}

packing::Placement place(const Items& items, const Plan& view, Effort effort) {
  const uint64_t work = packing_effort(effort, items.rows.size());
  if (view.queues.size() == 1) return packing::pack(items.rows, work);
  return packing::pack(items.rows, list_conflicts(items, view), work, bound_on_queues(items, view));
}

}  // namespace

MemoryPlan place_transients(PlanData& plan, Effort effort, bool beside_lazy) {
  const Plan view = plan.view();
  const Items items = list_items(plan, view, true);
  MemoryPlan memory;
  for (const packing::Item& item : items.rows) memory.unaliased_bytes += item.bytes;
  const packing::Placement placement = place(items, view, effort);
  for (size_t i = 0; i < items.rows.size(); ++i) plan.resources[items.resources[i]].estimated_offset = placement.offsets[i];
  memory.heap_bytes = placement.heap_bytes, memory.lower_bound_bytes = placement.lower_bound_bytes;
  plan.estimated_heap_bytes = memory.heap_bytes;
  for (const Index r : items.resources) memory.lazy_bytes += plan.resources[r].lazy ? plan.resources[r].estimated_bytes : 0;
  memory.heap_beside_lazy_bytes = memory.heap_bytes;
  if (beside_lazy && memory.lazy_bytes > 0) memory.heap_beside_lazy_bytes = place(list_items(plan, view, false), view, effort).heap_bytes;
  return memory;
}

}  // namespace rg::compiler
