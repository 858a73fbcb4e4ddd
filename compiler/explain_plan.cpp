#include "compiler/explain_plan.h"

#include <fmt/format.h>

#include "runtime/alias.h"

namespace rg::compiler {
namespace {

// For each pass, the dependency that keeps it from an earlier segment.
std::vector<const Dependency*> binding_dependencies(const Graph& graph, const Schedule& schedule) {
  std::vector<const Dependency*> binding(schedule.segment_of.size(), nullptr);
  for (const Dependency& d : graph.dependencies) {
    const bool adjacent = schedule.segment_of[d.before] + 1 == schedule.segment_of[d.after];
    if (adjacent && d.kind != DependencyKind::order && !binding[d.after]) binding[d.after] = &d;
  }
  return binding;
}

void explain_passes(const PlanParts& parts, const Graph& graph, Decisions& out) {
  const Frame& frame = parts.frame;
  const auto binding = binding_dependencies(graph, parts.schedule);
  out.push_back({"schedule", "chosen", parts.schedule.chosen_because});
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass) {
    const std::string& name = frame.pass(pass).name;
    out.push_back({name, parts.liveness.live[pass] ? "kept" : "culled", parts.liveness.reasons[pass]});
    if (!parts.liveness.live[pass]) continue;
    const std::string where = fmt::format("after group {}", parts.schedule.segment_of[pass]);
    if (const Dependency* d = binding[pass])
      out.push_back({name, "scheduled",
                     fmt::format("{}: {} on `{}` with `{}` just before", where, rg::compiler::name(d->kind), frame.resource_of(d->cell).name,
                                 frame.pass(d->before).name)});
    else
      out.push_back({name, "scheduled", where + ": nothing just before it binds it; chosen for memory"});
  }
}

void explain_memory(const PlanData& plan, Decisions& out) {
  const std::vector<alias::GroupInterval> intervals = alias::group_intervals(plan.view());
  for (Index r = 0; r < plan.resources.size(); ++r) {
    const Resource& resource = plan.resources[r];
    if (resource.lifetime != Lifetime::transient || !intervals[r].used()) continue;
    out.push_back({std::string(resource.name), "placed",
                   fmt::format("at {} with {} bytes, live between groups {} and {}", resource.estimated_offset, resource.estimated_bytes,
                               intervals[r].begin, intervals[r].end + 1)});
  }
}

void explain_barriers(const PlanParts& parts, Decisions& out) {
  for (size_t g = 0; g < parts.sync.groups.size(); ++g)
    for (const CellBarrier& b : parts.sync.groups[g])
      out.push_back({fmt::format("group {}", g), "barrier",
                     fmt::format("`{}`: {}{}", parts.frame.resource_of(b.cell).name, b.reason, b.wraps ? ", against the frame before" : "")});
}

}  // namespace

Decisions explain_plan(const PlanParts& parts, const Graph& graph, const PlanData& plan) {
  Decisions decisions;
  explain_passes(parts, graph, decisions);
  explain_memory(plan, decisions);
  explain_barriers(parts, decisions);
  return decisions;
}

}  // namespace rg::compiler
