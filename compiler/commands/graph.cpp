#include <map>

#include "compiler/commands/command.h"
#include "compiler/commands/facts.h"
#include "compiler/commands/plan_json.h"
#include "compiler/commands/plan_text.h"
#include "compiler/pages/pages.h"

namespace rg::commands {
namespace {

// By pass: the number of its rendering, where it shares that with others, or null.
nlohmann::ordered_json shared_renderings(const PlanData& plan) {
  std::map<Index, uint32_t> users;
  for (const Pass& pass : plan.passes) ++users[pass.rendering];
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Pass& pass : plan.passes) {
    const bool shared = pass.rendering != kNone && users[pass.rendering] > 1;
    rows.push_back(shared ? nlohmann::ordered_json(pass.rendering) : nlohmann::ordered_json());
  }
  return rows;
}

nlohmann::ordered_json page_data(const compiler::CompileResult& result) {
  nlohmann::ordered_json plans = nlohmann::ordered_json::array();
  for (const compiler::CompiledGraph& graph : result.graphs) {
    for (const compiler::FramePlan& plan : graph.plans) {
      nlohmann::ordered_json& row = plans.emplace_back(plan_json(result, graph, plan));
      const Facts facts = find_facts(result.program, graph, plan);
      row["figures"] = {{"barrier_calls", facts.barrier_calls},
                        {"barriers", facts.barriers},
                        {"heap_bytes", facts.heap_bytes},
                        {"unaliased_bytes", facts.unaliased_bytes},
                        {"lower_bound_bytes", facts.lower_bound_bytes}};
      row["shared_renderings"] = shared_renderings(plan.plan);
      auto& decisions = row["decisions"] = nlohmann::ordered_json::array();
      for (const compiler::Decision& decision : plan.decisions)
        decisions.push_back({{"subject", decision.subject}, {"what", decision.what}, {"reason", decision.reason}});
    }
  }
  return plans;
}

}  // namespace

int show_graph(const GraphOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  if (options.html) {
    print(pages::fill(pages::graph(), page_data(*result)));
    return exit_done;
  }
  for (const compiler::CompiledGraph& graph : result->graphs)
    print(options.dot ? graph_dot(result->program, graph) : graph_text(result->program, result->program.graphs[graph.graph]));
  return exit_done;
}

}  // namespace rg::commands
