#include "compiler/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/command.h"
#include "compiler/configurations.h"
#include "compiler/machine/machine.h"
#include "compiler/verify/folding.h"
#include "compiler/verify/fusion.h"
#include "compiler/verify/mutate.h"

namespace rg::commands {
namespace {

std::string subject(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan) {
  const std::string variant = compiler::configuration_name(result.program, plan.configuration);
  return result.program.graphs[graph.graph].name + (variant.empty() ? "" : " " + variant);
}

std::vector<verify::Kernel> kernels_of(const compiler::CompileResult& result, const compiler::CompiledGraph& graph) {
  std::vector<verify::Kernel> kernels;
  for (const compiler::FusedKernel& kernel : result.fused)
    if (kernel.graph == graph.graph) kernels.push_back({kernel.pass, kernel.members});
  return kernels;
}

// True if the checker proves the plan; findings are printed.
bool prove(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan) {
  const std::string name = subject(result, graph, plan);
  show_progress("proving " + name);
  auto findings =
      verify::verify(result.program, graph.graph, plan.configuration, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource);
  for (verify::Finding& finding : verify::verify_fusion(result.written, result.unfolded, graph.graph, plan.configuration, kernels_of(result, graph)))
    findings.push_back(std::move(finding));
  for (verify::Finding& finding : verify::verify_folding(result.unfolded, result.program, graph.graph, plan.configuration))
    findings.push_back(std::move(finding));
  show_progress({});
  for (const verify::Finding& finding : findings) print(fmt::format("{}: {}: {}\n", name, verify::name(finding.hazard), finding.text));
  if (findings.empty()) print(fmt::format("{}: proved\n", name));
  return findings.empty();
}

// The abstract machine as second opinion: conditions all off and, where there are any, all on, memory placed as estimated.
bool misbehaves(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& frame, const Plan& plan) {
  machine::MachineOptions options;
  options.max_divergences = 1;
  for (const Resource& resource : plan.resources) {
    const bool shares = resource.lifetime == Lifetime::transient && !resource.no_alias;
    options.placement.push_back(shares ? machine::Placement{resource.estimated_offset, resource.estimated_bytes} : machine::Placement{});
  }
  const bool guarded = std::any_of(plan.passes.begin(), plan.passes.end(), [](const Pass& pass) { return pass.guard != 0; });
  for (const uint64_t conditions : {uint64_t{0}, ~uint64_t{0}}) {
    if (conditions != 0 && !guarded) break;
    options.conditions = {conditions};
    if (!machine::run_adversarially(result.program, graph.graph, frame.configuration, plan, frame.plan.program_pass, frame.plan.program_resource,
                                    options)
             .empty())
      return true;
  }
  return false;
}

std::string confirmed_of(const verify::MutationReport& report, const std::string& reason, size_t count) {
  const auto asked = report.confirmed.find(reason);
  if (asked == report.confirmed.end() || asked->second == count) return {};
  return fmt::format(" of the {} it was shown (--long shows it all)", asked->second);
}

// True if the checker objects to every damaged plan that differs; what it missed is printed.
bool test_checker(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan, bool ask_all) {
  const std::string name = subject(result, graph, plan);
  verify::MutateOptions options;
  options.progress = [&](size_t done) { show_progress(fmt::format("damaging {}: {}", name, done)); };
  options.misbehaves = [&](const Plan& mutant) { return misbehaves(result, graph, plan, mutant); };
  options.ask_every = 20;
  if (!ask_all) options.ask_at_most = 20;
  const verify::MutationReport report =
      verify::mutate(result.program, graph.graph, plan.configuration, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource, options);
  show_progress({});
  print(fmt::format("{}: {} damaged plans, {} rejected\n", name, report.mutants, report.killed));
  for (const auto& [kind, of] : report.kinds)
    print(fmt::format("{}:   {:<11} {:>5} made, {:>5} rejected; the abstract machine rejects {} of {} it was shown\n", name, kind, of.made, of.killed,
                      of.agreed, of.asked));
  for (const auto& [reason, count] : report.equivalent)
    print(fmt::format("{}: {} change nothing, as the abstract machine confirms{}: {}\n", name, count, confirmed_of(report, reason, count), reason));
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
    for (const compiler::FramePlan& plan : graph.plans)
      proved &= prove(*result, graph, plan) && (!options.mutate || test_checker(*result, graph, plan, options.ask_all));
  return proved ? exit_done : exit_our_fault;  // the planner made what the checker does not accept
}

}  // namespace rg::commands
