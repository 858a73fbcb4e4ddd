#include "compiler/verify/verify.h"

#include <fmt/format.h>

#include "compiler/commands/command.h"
#include "compiler/configurations.h"
#include "compiler/verify/mutate.h"

namespace rg::commands {
namespace {

std::string subject(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan) {
  const std::string variant = compiler::configuration_name(result.program, plan.configuration);
  return result.program.graphs[graph.graph].name + (variant.empty() ? "" : " " + variant);
}

// True if the checker proves the plan; findings are printed.
bool prove(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan) {
  const std::string name = subject(result, graph, plan);
  show_progress("proving " + name);
  const auto findings =
      verify::verify(result.program, graph.graph, plan.configuration, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource);
  show_progress({});
  for (const verify::Finding& finding : findings) print(fmt::format("{}: {}: {}\n", name, verify::name(finding.hazard), finding.text));
  if (findings.empty()) print(fmt::format("{}: proved\n", name));
  return findings.empty();
}

// True if the checker objects to every damaged plan that differs; what it missed is printed.
bool test_checker(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan) {
  const std::string name = subject(result, graph, plan);
  verify::MutateOptions options;
  options.progress = [&](size_t done) { show_progress(fmt::format("damaging {}: {}", name, done)); };
  const verify::MutationReport report = verify::mutate(result.program, graph.graph, plan.configuration, plan.plan.view(), plan.plan.program_pass,
                                                       plan.plan.program_resource, options);
  show_progress({});
  print(fmt::format("{}: {} damaged plans, {} rejected\n", name, report.mutants, report.killed));
  for (const auto& [reason, count] : report.equivalent) print(fmt::format("{}: {} change nothing: {}\n", name, count, reason));
  for (const std::string& survivor : report.survivors) print(fmt::format("{}: not noticed: {}\n", name, survivor));
  return report.survivors.empty();
}

}  // namespace

int verify_file(const VerifyCommand& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  bool proved = true;
  for (const compiler::CompiledGraph& graph : result->graphs)
    for (const compiler::FramePlan& plan : graph.plans) proved &= prove(*result, graph, plan) && (!options.mutate || test_checker(*result, graph, plan));
  return proved ? exit_done : exit_our_fault;  // the planner made what the checker does not accept
}

}  // namespace rg::commands
