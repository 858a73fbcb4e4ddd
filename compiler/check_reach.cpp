#include "compiler/check_reach.h"

#include <algorithm>
#include <map>
#include <set>

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

struct Dead {
  const dsl::Pass* pass = nullptr;
  std::string reason;
};

std::map<std::string, std::string> culled_everywhere(const std::vector<FramePlan>& plans) {
  std::map<std::string, std::string> reasons;
  for (const FramePlan& plan : plans)
    for (const Culled& culled : plan.plan.culled) reasons.emplace(culled.pass, culled.reason);
  for (const FramePlan& plan : plans)
    for (const auto& pass : plan.plan.passes) reasons.erase(std::string(pass.name));
  return reasons;
}

// In program order, one a place: the rounds of a loop and the clear before a pass say the same.
std::vector<Dead> dead_passes(const dsl::Graph& graph, const std::vector<FramePlan>& plans) {
  const auto reasons = culled_everywhere(plans);
  std::vector<Dead> dead;
  for (const dsl::Pass& pass : graph.passes) {
    const auto found = reasons.find(pass.name);
    const bool is_clear = pass.kind == dsl::PassKind::transfer && pass.name.ends_with(".clear");
    const bool told = std::any_of(dead.begin(), dead.end(), [&](const Dead& other) { return other.pass->span == pass.span; });
    if (found != reasons.end() && !told && !is_clear) dead.push_back({&pass, found->second});
  }
  return dead;
}

}  // namespace

void check_reach(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, dsl::Diagnostics& diagnostics) {
  constexpr size_t kMostNotes = 4;
  const std::vector<Dead> dead = dead_passes(program.graphs[graph], plans);
  if (dead.empty()) return;
  dsl::Diagnostic& warning = diagnostics.report(DiagnosticKind::ReachesNothing, dead[0].pass->span, {dead[0].pass->name, dead[0].reason});
  for (size_t i = 1; i < std::min(dead.size(), 1 + kMostNotes); ++i)
    warning.note(DiagnosticKind::AlsoLeftOut, dead[i].pass->span, {dead[i].pass->name, dead[i].reason});
  if (dead.size() > 1 + kMostNotes) warning.note(DiagnosticKind::NotShown, {}, {std::to_string(dead.size() - 1 - kMostNotes) + " more of its passes are"});
}

}  // namespace rg::compiler
