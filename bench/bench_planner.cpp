#include "bench/graphs.h"
#include "bench/rows.h"
#include "compiler/plan_frame.h"

namespace rg::bench {
namespace {

constexpr double kMB = 1e6;

// Bytes of the copies of history resources, which heap figures of the reference include.
double persistent_bytes(const PlanData& plan) {
  double bytes = 0;
  for (const Resource& resource : plan.resources)
    if (resource.lifetime == Lifetime::history || resource.lifetime == Lifetime::persistent)
      bytes += static_cast<double>(resource.estimated_bytes) * resource.copies;
  return bytes;
}

double barrier_calls(const PlanData& plan) {
  double calls = 0;
  for (const BarrierGroup& group : plan.groups) calls += group.memory_count + group.image_count + group.buffer_count > 0;
  return calls;
}

// Median time of each phase over several runs, in order of the phases.
std::vector<std::pair<std::string, double>> phase_medians(const std::vector<compiler::FramePlan>& runs) {
  std::vector<std::pair<std::string, double>> medians;
  for (size_t phase = 0; phase < runs.front().phase_ms.size(); ++phase) {
    std::vector<double> times;
    for (const compiler::FramePlan& run : runs) times.push_back(run.phase_ms[phase].second);
    std::sort(times.begin(), times.end());
    medians.emplace_back(runs.front().phase_ms[phase].first, times[times.size() / 2]);
  }
  return medians;
}

Rows rows_of(const BenchGraph& graph, const std::string& graphs) {
  const Reference& reference = *graph.reference;
  const std::string prefix = std::string("planner/") + reference.graph + "/";
  const int runs = graph.text.size() > 1'000'000 ? 1 : 5;
  std::vector<compiler::FramePlan> plans;
  const double total = median_ms(runs, [&] { plans.push_back(compiler::plan_frame(graph.program, dsl::GraphId{0}, {}, {})); });
  const compiler::FramePlan& plan = plans.back();
  const double persistent = persistent_bytes(plan.plan);
  Rows rows = {{prefix + "plan", total, "ms", reference.plan_ms, "theirs is paid every frame, ours at build time"}};
  for (const auto& [phase, ms] : phase_medians(plans)) rows.push_back({prefix + "plan/" + phase, ms, "ms", {}, ""});
  rows.push_back({prefix + "passes", static_cast<double>(plan.plan.passes.size()), "count", {}, ""});
  if (const auto culled = load_graph(graphs, reference, "_culled")) {
    const compiler::FramePlan needed = compiler::plan_frame(culled->program, dsl::GraphId{0}, {}, {});
    rows.push_back({prefix + "culled", static_cast<double>(needed.plan.culled.size()), "count", {}, ""});
  }
  rows.push_back({prefix + "heap", (static_cast<double>(plan.heap_bytes) + persistent) / kMB, "MB", reference.heap_mb, "their best setting"});
  rows.push_back({prefix + "bound", (static_cast<double>(plan.lower_bound_bytes) + persistent) / kMB, "MB", reference.bound_mb,
                  "theirs counts passes, ours groups"});
  rows.push_back({prefix + "barrier_calls", barrier_calls(plan.plan), "count", reference.barrier_calls, ""});
  rows.push_back({prefix + "barriers",
                  static_cast<double>(plan.plan.memory_barriers.size() + plan.plan.image_barriers.size() + plan.plan.buffer_barriers.size()), "count",
                  reference.barriers, ""});
  return rows;
}

}  // namespace

Rows bench_planner(const std::string& graphs) {
  Rows rows;
  for (const Reference& reference : kReferences)
    if (const auto graph = load_graph(graphs, reference))
      for (Row& row : rows_of(*graph, graphs)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace rg::bench
