#include "compiler/plan_memory.h"

#include "runtime/packing.h"

namespace rg::compiler {
namespace {

bool disjoint(const Lifetime& a, const Lifetime& b) { return a.end <= b.begin || b.end <= a.begin; }

std::vector<AliasPair> list_pairs(const Lifetimes& lifetimes, const std::vector<uint32_t>& used) {
  std::vector<AliasPair> pairs;
  for (const uint32_t after : used)
    for (const uint32_t before : used)
      if (before != after && disjoint(lifetimes[before], lifetimes[after]))
        pairs.push_back({before, after, lifetimes[after].begin < lifetimes[before].end});
  return pairs;
}

}  // namespace

MemoryPlan plan_memory(const Frame& frame, const Lifetimes& lifetimes, const PlanOptions& options) {
  MemoryPlan memory;
  memory.offsets.resize(lifetimes.size());
  std::vector<uint32_t> used;
  std::vector<packing::Item> items;
  for (uint32_t r = 0; r < lifetimes.size(); ++r) {
    if (!lifetimes[r].used()) continue;
    const bool image = frame.graph->resources.rows[r].kind == dsl::ResourceKind::image;
    used.push_back(r);
    items.push_back({frame.bytes[r], image ? options.image_alignment : options.buffer_alignment, lifetimes[r].begin, lifetimes[r].end});
    memory.unaliased_bytes += frame.bytes[r];
  }
  const packing::Placement placement = packing::pack(items);
  for (size_t i = 0; i < used.size(); ++i) memory.offsets[used[i]] = placement.offsets[i];
  memory.heap_bytes = placement.heap_bytes, memory.lower_bound_bytes = placement.lower_bound_bytes;

  memory.alias_by_lifetime = used.size() > kMostListed;
  if (!memory.alias_by_lifetime) memory.alias_pairs = list_pairs(lifetimes, used);
  return memory;
}

}  // namespace rg::compiler
