#include "compiler/check_queues.h"

#include <algorithm>
#include <set>

#include "compiler/assign_queues.h"
#include "compiler/pass_cost.h"

namespace rg::compiler {

using dsl::DiagnosticKind;

void check_first_queue(const dsl::Program& program, dsl::GraphId graph, const std::vector<Configuration>& configurations, const PlanOptions& options,
                       dsl::Diagnostics& diagnostics) {
  if (options.queues.empty() || options.queues.front() == dsl::QueueKind::graphics) return;
  for (const Configuration& configuration : configurations) {
    const Frame frame = expand(program, graph, configuration, {});
    for (uint32_t i = 0; i < frame.passes.size(); ++i) {
      if (runs_at_home(frame, i, options)) continue;
      const dsl::Pass& pass = frame.pass(i);
      constexpr const char* kPasses[] = {"raster", "compute", "transfer", "host"};
      const char* queue = options.queues.front() == dsl::QueueKind::compute ? "compute" : "transfer";
      diagnostics.report(DiagnosticKind::FirstQueueCannotRun, pass.span, {kPasses[static_cast<size_t>(pass.kind)], pass.name, queue});
      return;  // the others would say the same
    }
  }
}

void check_queues(const dsl::Program& program, dsl::GraphId graph, const std::vector<Configuration>& configurations, dsl::Diagnostics& diagnostics) {
  const auto ordered = [](const dsl::Pass& pass) { return pass.queue != dsl::QueueKind::graphics && !pass.queue_may; };
  const auto& passes = program.graphs[graph].passes;
  if (std::none_of(passes.begin(), passes.end(), ordered)) return;
  std::set<uint32_t> reported;
  for (const Configuration& configuration : configurations) {
    const Frame frame = expand(program, graph, configuration, {});
    for (uint32_t i = 0; i < frame.passes.size(); ++i) {
      const dsl::Pass& pass = frame.pass(i);
      if (!ordered(pass)) continue;
      const std::string why = why_not_on_queue(frame, i);
      if (why.empty() || !reported.insert(frame.passes[i]).second) continue;
      diagnostics.report(DiagnosticKind::QueueCannotRun, pass.span, {pass.name, pass.queue == dsl::QueueKind::compute ? "compute" : "transfer", why});
    }
  }
}

std::map<std::string, double> measured_times(const dsl::Program& program, dsl::GraphId graph, const std::string& path, const std::string& text,
                                             dsl::Diagnostics& diagnostics) {
  const Profile profile = parse_profile(text);
  const dsl::Graph& row = program.graphs[graph];
  const bool first = graph.value == 0;
  if (!profile.wrong.empty()) {
    if (first) diagnostics.report(DiagnosticKind::ProfileIgnored, {}, {path, profile.wrong});
    return {};
  }
  if (profile.graph != row.name) {
    const bool foreign =
        std::none_of(program.graphs.begin(), program.graphs.end(), [&](const dsl::Graph& each) { return each.name == profile.graph; });
    if (first && foreign)
      diagnostics.report(DiagnosticKind::ProfileIgnored, {}, {path, "it is of graph `" + profile.graph + "`, which there is not"});
    return {};
  }
  std::vector<std::string> unknown;
  for (const auto& [name, us] : profile.passes_us)
    if (std::none_of(row.passes.begin(), row.passes.end(), [&, &name = name](const dsl::Pass& pass) { return pass.name == name; }))
      unknown.push_back(name);
  if (!unknown.empty() && unknown.size() == profile.passes_us.size()) {
    diagnostics.report(DiagnosticKind::ProfileIgnored, {}, {path, "graph `" + row.name + "` has none of its passes"});
    return {};
  }
  if (!unknown.empty())
    diagnostics.report(DiagnosticKind::ProfileOfOthers, {},
                       {path, unknown.size() == 1 ? "a pass" : std::to_string(unknown.size()) + " passes", row.name, unknown.front()});
  return profile.passes_us;
}

}  // namespace rg::compiler
