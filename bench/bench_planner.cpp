#include <cstdlib>

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

// Time, heap and calls with another effort of the search; `max` is what a release build pays once, so it is measured on request only.
void add_effort(Rows& rows, const BenchGraph& graph, const char* name, compiler::Effort effort, int runs) {
  const std::string prefix = std::string("planner/") + graph.reference->graph + "/" + name + "/";
  const compiler::PlanOptions options = {.effort = effort};
  std::vector<compiler::FramePlan> plans;
  const double total = median_ms(runs, [&] { plans.push_back(compiler::plan_frame(graph.program, dsl::GraphId{0}, {}, options)); });
  const compiler::FramePlan& plan = plans.back();
  rows.push_back({prefix + "plan", total, "ms", {}, ""});
  rows.push_back({prefix + "heap", (static_cast<double>(plan.heap_bytes) + persistent_bytes(plan.plan)) / kMB, "MB", graph.reference->heap_mb, ""});
  rows.push_back({prefix + "barrier_calls", barrier_calls(plan.plan), "count", graph.reference->barrier_calls, ""});
}

// Orders for one queue that no other beats in calls and memory, and what a second queue is worth.
void add_choices(Rows& rows, const BenchGraph& graph, const compiler::FramePlan& one) {
  const std::string prefix = std::string("planner/") + graph.reference->graph + "/";
  for (const auto& point : one.order.frontier)
    rows.push_back(
        {prefix + "frontier/" + std::to_string(point.groups), (static_cast<double>(point.bytes) + persistent_bytes(one.plan)) / kMB, "MB", {}, ""});
  const compiler::OrderFacts order = compiler::plan_frame(graph.program, dsl::GraphId{0}, {}, {.reasons = true}).order;
  rows.push_back({prefix + "ordered_pairs", static_cast<double>(order.ordered_pairs), "count", static_cast<double>(order.needed_pairs),
                  "pairs the program needs"});
  const compiler::PlanOptions options = {.queues = {dsl::QueueKind::graphics, dsl::QueueKind::compute}};
  const compiler::FramePlan two = compiler::plan_frame(graph.program, dsl::GraphId{0}, {}, options);
  const compiler::Overlap& o = two.overlap;
  rows.push_back({prefix + "two_queues/modelled", o.end / 1e3, "us", o.bound / 1e3, "no plan can be faster"});
  rows.push_back({prefix + "two_queues/one_queue", o.serial / 1e3, "us", {}, ""});
  rows.push_back({prefix + "two_queues/gained", o.serial > o.bound ? 100 * (o.serial - o.end) / (o.serial - o.bound) : 100, "%", {}, ""});
  rows.push_back({prefix + "two_queues/batches", static_cast<double>(two.plan.batches.size()), "count", {}, ""});
  rows.push_back({prefix + "two_queues/waits", static_cast<double>(two.plan.waits.size()), "count", {}, ""});
  rows.push_back({prefix + "two_queues/heap", (static_cast<double>(two.heap_bytes) + persistent_bytes(two.plan)) / kMB, "MB", {}, ""});
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
  add_choices(rows, graph, plan);
  add_effort(rows, graph, "fast", compiler::Effort::fast, runs);
  if (std::getenv("RGC_LONG")) add_effort(rows, graph, "max", compiler::Effort::max, 1);
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
