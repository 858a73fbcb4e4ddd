#include "compiler/plan_frame.h"

#include <chrono>

#include "compiler/build_graph.h"
#include "compiler/contents.h"
#include "compiler/cull.h"
#include "compiler/emit_plan.h"
#include "compiler/epochs.h"
#include "compiler/explain_plan.h"
#include "compiler/find_lifetimes.h"
#include "compiler/make_schedule.h"
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

}  // namespace

// The planner, top to bottom. Each line consumes only what is above it.
FramePlan plan_frame(const dsl::Program& program, dsl::GraphId graph_id, const Configuration& configuration, const PlanOptions& options) {
  Stopwatch watch;

  // What this configuration is made of, down to the subresource.
  const Frame frame = watch.time("expand", [&] { return expand(program, graph_id, configuration, options); });

  // Who needs whom; what nobody needs goes, and with it its hazards.
  const std::vector<bool> all(frame.passes.size(), true);
  const Liveness liveness = watch.time("cull", [&] { return cull(frame, build_graph(frame, all)); });
  const Graph graph = watch.time("build_graph", [&] { return build_graph(frame, liveness.live); });

  // Order, and where barriers stand. Beyond this point both are fixed.
  const Schedule schedule = watch.time("make_schedule", [&] { return make_schedule(frame, graph, liveness.live, options); });
  const std::vector<Line> lines = watch.time("find_epochs", [&] { return find_epochs(frame, schedule); });

  // Memory, estimated; the runtime places again with real sizes, within the allowed pairs.
  const Lifetimes lifetimes = watch.time("find_lifetimes", [&] { return find_lifetimes(frame, schedule, lines, options); });
  const MemoryPlan memory = watch.time("plan_memory", [&] { return plan_memory(frame, lifetimes, options); });

  // Barriers do not depend on the placement: what it adds is patched in by runtime/alias.h.
  const SyncPlan sync = watch.time("synchronise", [&] { return synchronise(frame, schedule, lines, options); });

  FramePlan result;
  result.configuration = configuration;
  const ContentsOfUses contents = find_contents(frame, lines);
  const PlanParts parts{frame, liveness, schedule, contents, lifetimes, memory, sync};
  result.plan = watch.time("emit_plan", [&] { return emit_plan(parts); });
  result.decisions = watch.time("explain", [&] { return explain_plan(parts, graph); });
  result.heap_bytes = memory.heap_bytes, result.unaliased_bytes = memory.unaliased_bytes, result.lower_bound_bytes = memory.lower_bound_bytes;
  result.phase_ms = std::move(watch.phases);
  return result;
}

}  // namespace rg::compiler
