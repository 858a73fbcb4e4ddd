#include "bench/graphs.h"
#include "bench/rows.h"
#include "compiler/plan_frame.h"
#include "compiler/verify/verify.h"

namespace rg::bench {

// The proof of a plan, beside the time it took to make it.
Rows bench_checker(const std::string& graphs) {
  Rows rows;
  for (const Reference& reference : kReferences) {
    const auto graph = load_graph(graphs, reference);
    if (!graph || graph->text.size() > 1'000'000) continue;
    compiler::FramePlan plan;
    const double made = median_ms(1, [&] { plan = compiler::plan_frame(graph->program, dsl::GraphId{0}, {}, {}); });
    size_t findings = 0;
    const double proved = median_ms(1, [&] {
      findings = verify::verify(graph->program, dsl::GraphId{0}, {}, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource).size();
    });
    rows.push_back({std::string("checker/") + reference.graph + "/proof", proved, "ms", made, "the time to plan it"});
    rows.push_back({std::string("checker/") + reference.graph + "/findings", static_cast<double>(findings), "count", {}, ""});
  }
  return rows;
}

}  // namespace rg::bench
