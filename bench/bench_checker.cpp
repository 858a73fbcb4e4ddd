#include "bench/graphs.h"
#include "bench/rows.h"
#include "compiler/plan_frame.h"
#include "compiler/verify/verify.h"

namespace rg::bench {

namespace {

void add_rows(const dsl::Program& program, const std::string& name, const std::vector<dsl::QueueKind>& queues, Rows& rows) {
  compiler::PlanOptions options;
  options.queues = queues;
  compiler::FramePlan plan;
  const double made = once_ms([&] { plan = compiler::plan_frame(program, dsl::GraphId{0}, {}, options); });
  for (const bool irredundancy : {false, true}) {
    verify::VerifyOptions verify_options;
    verify_options.irredundancy = irredundancy;
    size_t findings = 0;
    const double proved = once_ms([&] {
      findings =
          verify::verify(program, dsl::GraphId{0}, {}, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource, verify_options).size();
    });
    const std::string what = irredundancy ? "proof and irredundancy" : "proof";
    rows.push_back({"checker/" + name + "/" + what, proved, "ms", made, "the time to plan it"});
    rows.push_back({"checker/" + name + "/findings of " + what, static_cast<double>(findings), "count", {}, ""});
  }
}

}  // namespace

// The proof of a plan, beside the time it took to make it.
Rows bench_checker(const std::string& graphs) {
  Rows rows;
  for (const Reference& reference : kReferences) {
    const auto graph = load_graph(graphs, reference);
    if (!graph) continue;
    add_rows(graph->program, reference.graph, {dsl::QueueKind::graphics}, rows);
    add_rows(graph->program, std::string(reference.graph) + " on two queues", {dsl::QueueKind::graphics, dsl::QueueKind::compute}, rows);
  }
  return rows;
}

}  // namespace rg::bench
