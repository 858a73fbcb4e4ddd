#include "compiler/plan_frame.h"

#include <algorithm>
#include <chrono>

#include "compiler/alias_clocks.h"
#include "compiler/assign_queues.h"
#include "compiler/build_graph.h"
#include "compiler/contents.h"
#include "compiler/cull.h"
#include "compiler/emit_plan.h"
#include "compiler/epochs.h"
#include "compiler/explain_plan.h"
#include "compiler/make_schedule.h"
#include "compiler/pass_cost.h"
#include "compiler/plan_memory.h"
#include "compiler/synchronise.h"

namespace rg::compiler {
namespace {

class Stopwatch {
 public:
  // Runs `phase` and notes how long it took.
  template <class Phase>
  auto time(const char* name, Phase phase) {
    const auto start = std::chrono::steady_clock::now();
    auto result = phase();
    phases.emplace_back(name, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    return result;
  }
  std::vector<std::pair<std::string, double>> phases;
};

struct Queues {
  Schedule schedule;
  Overlap overlap;
  Decisions decisions;
  std::vector<uint32_t> contested;
};

// One layout for all uses of the images, so that it never has to change between queues.
void use_general_layout(Frame& frame, const std::vector<uint32_t>& resources) {
  for (Use& use : frame.uses)
    if (std::find(resources.begin(), resources.end(), frame.cells[use.cell].resource) != resources.end()) use.effect.layout = Layout::general;
}

Overlap overlap_of(const QueuePlan& plan, const Schedule& one_queue, const std::vector<double>& costs, size_t queues) {
  Overlap overlap{
      plan.gain.serial, plan.gain.critical_path, plan.gain.bound, plan.gain.end, plan.simulations, plan.complete, 0, plan.decisions.size(), {}};
  overlap.work.assign(queues, 0);
  for (size_t node = 0; node < plan.queue_of.size(); ++node) overlap.work[plan.queue_of[node]] += costs[one_queue.order[node]];
  for (const uint32_t queue : plan.queue_of) overlap.moved += queue != 0;
  return overlap;
}

// Without queues that nothing runs on; the first stays.
void drop_idle(QueuePlan& plan, PlanOptions& options) {
  std::vector<bool> busy(options.queues.size());
  busy[0] = true;
  for (const uint32_t queue : plan.queue_of) busy[queue] = true;
  std::vector<uint32_t> renamed(options.queues.size());
  std::vector<dsl::QueueKind> kept;
  for (uint32_t queue = 0; queue < options.queues.size(); ++queue) {
    renamed[queue] = static_cast<uint32_t>(kept.size());
    if (busy[queue]) kept.push_back(options.queues[queue]);
  }
  for (uint32_t& queue : plan.queue_of) queue = renamed[queue];
  options.queues = std::move(kept);
}

// The plan for one queue, unless several are there and worth it.
Queues use_queues(const Frame& frame, const Graph& graph, const Schedule& one_queue, const PlanOptions& options) {
  const std::vector<double> costs = pass_costs(frame, options.measured_us);
  PlanOptions used = options;
  if (!used.async) used.queues.resize(1);
  QueuePlan plan = assign_queues(frame, graph, one_queue, costs, used);
  drop_idle(plan, used);
  Queues queues{one_queue, overlap_of(plan, one_queue, costs, used.queues.size()), {}, plan.contested};
  for (const QueueDecision& decision : plan.decisions) queues.decisions.push_back({frame.pass(decision.pass).name, "queue", decision.reason});
  if (queues.overlap.moved > 0 && plan.contested.empty()) queues.schedule = make_batches(frame, graph, one_queue, plan, costs, used);
  return queues;
}

}  // namespace

// The planner, top to bottom. Each line consumes only what is above it.
FramePlan plan_frame(const dsl::Program& program, dsl::GraphId graph_id, const Configuration& configuration, const PlanOptions& options) {
  Stopwatch watch;

  // What this configuration is made of, down to the subresource.
  Frame frame = watch.time("expand", [&] { return expand(program, graph_id, configuration, options); });

  // Who needs whom; what nobody needs goes, and with it its hazards.
  const std::vector<bool> all(frame.passes.size(), true);
  const Liveness liveness = watch.time("cull", [&] { return cull(frame, build_graph(frame, all)); });
  Graph graph = watch.time("build_graph", [&] { return build_graph(frame, liveness.live); });

  // Order, and where barriers stand. Beyond this point both are fixed.
  Schedule one_queue = watch.time("make_schedule", [&] { return make_schedule(frame, graph, liveness.live, options); });
  Queues queues = watch.time("assign_queues", [&] { return use_queues(frame, graph, one_queue, options); });
  if (!queues.contested.empty()) {
    use_general_layout(frame, queues.contested);
    graph = build_graph(frame, liveness.live);
    one_queue = make_schedule(frame, graph, liveness.live, options);
    queues = use_queues(frame, graph, one_queue, options);
  }
  const Schedule& schedule = queues.schedule;
  const std::vector<Line> lines = watch.time("find_epochs", [&] { return find_epochs(frame, schedule); });

  // Barriers do not depend on the placement: what it adds is patched in by runtime/alias.h.
  const SyncPlan sync = watch.time("synchronise", [&] { return synchronise(frame, schedule, lines, options); });

  FramePlan result;
  result.configuration = configuration;
  const ContentsOfUses contents = find_contents(frame, lines);
  const PlanParts parts{frame, liveness, schedule, contents, sync, options};
  result.plan = watch.time("emit_plan", [&] { return emit_plan(parts); });

  // Memory, estimated; the runtime places again with real sizes, within what the clocks allow.
  const MemoryPlan memory = watch.time("plan_memory", [&] {
    find_alias_clocks(result.plan);
    const MemoryPlan placed = place_transients(result.plan);
    list_alias_pairs(result.plan);
    return placed;
  });

  result.decisions = watch.time("explain", [&] { return explain_plan(parts, graph, result.plan); });
  result.overlap = queues.overlap;
  result.decisions.insert(result.decisions.end(), queues.decisions.begin(), queues.decisions.end());
  result.heap_bytes = memory.heap_bytes, result.unaliased_bytes = memory.unaliased_bytes, result.lower_bound_bytes = memory.lower_bound_bytes;
  result.phase_ms = std::move(watch.phases);
  return result;
}

}  // namespace rg::compiler
