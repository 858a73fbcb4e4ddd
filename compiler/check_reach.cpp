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
  std::set<std::pair<size_t, uint32_t>> places;
  for (const dsl::Pass& pass : graph.passes) {
    const auto found = reasons.find(pass.name);
    const bool is_clear = pass.kind == dsl::PassKind::transfer && pass.name.ends_with(".clear");
    if (found == reasons.end() || is_clear) continue;
    if (places.emplace(pass.span.file.value, pass.span.begin).second) dead.push_back({&pass, found->second});
  }
  return dead;
}

bool reads(const dsl::Access& access) { return access.mode != dsl::Mode::write && !access.clear; }

template <class Test>
bool writes_what(const dsl::Pass& pass, Test test) {
  return std::any_of(pass.accesses.begin(), pass.accesses.end(),
                     [&](const dsl::Access& access) { return access.mode != dsl::Mode::read && test(access); });
}

// Takes out those that the program knows of and reports them by themselves, so that they hide no others: what is allowed in its place, and what only
// such passes wanted.
void report_known(std::vector<Dead>& dead, dsl::Diagnostics& diagnostics) {
  std::vector<Dead> others;
  std::set<size_t> known_want, others_want;  // resources
  for (size_t i = dead.size(); i-- > 0;) {
    const dsl::Pass& pass = *dead[i].pass;
    dsl::Diagnostic row(DiagnosticKind::ReachesNothing, pass.span, {pass.name, dead[i].reason});
    diagnostics.judge(row);
    const auto wanted_by = [&](const std::set<size_t>& readers) {
      return writes_what(pass, [&](const dsl::Access& written) { return readers.contains(written.resource.value); });
    };
    const bool known = row.allowed() || (wanted_by(known_want) && !wanted_by(others_want));
    if (row.allowed()) diagnostics.report(row);
    if (!known) others.push_back(dead[i]);
    for (const dsl::Access& access : pass.accesses)
      if (reads(access)) (known ? known_want : others_want).insert(access.resource.value);
  }
  dead.assign(others.rbegin(), others.rend());
}

// Those of which no other dead pass behind them wanted anything come first: they are to blame for the others.
std::vector<Dead> by_blame(const std::vector<Dead>& dead) {
  std::map<size_t, size_t> last_reader;  // by resource: index in `dead`
  for (size_t i = 0; i < dead.size(); ++i)
    for (const dsl::Access& access : dead[i].pass->accesses)
      if (reads(access)) last_reader[access.resource.value] = i;
  std::vector<Dead> sorted, others;
  for (size_t i = 0; i < dead.size(); ++i) {
    const auto wanted = [&](const dsl::Access& written) {
      const auto reader = last_reader.find(written.resource.value);
      return reader != last_reader.end() && reader->second > i;
    };
    (writes_what(*dead[i].pass, wanted) ? others : sorted).push_back(dead[i]);
  }
  sorted.insert(sorted.end(), others.begin(), others.end());
  return sorted;
}

// The pass behind it that writes all of the same again; nothing where somebody looks at it before.
std::string overwritten(const dsl::Graph& graph, const dsl::Pass& pass) {
  const auto own = static_cast<size_t>(&pass - graph.passes.rows.data());
  for (size_t i = own + 1; i < graph.passes.size(); ++i) {
    const dsl::Pass& next = graph.passes.rows[i];
    for (const dsl::Access& access : next.accesses) {
      const auto same = [&](const dsl::Access& written) { return written.resource == access.resource; };
      if (!writes_what(pass, same)) continue;
      const bool again =
          !reads(access) && writes_what(pass, [&](const dsl::Access& written) { return same(written) && written.range == access.range; });
      const bool always = next.conditions.empty() && next.guard == pass.guard;
      return again && always ? "pass `" + next.name + "` overwrites `" + graph.resources[access.resource].name + "` before anything reads it" : "";
    }
  }
  return {};
}

}  // namespace

void check_reach(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, dsl::Diagnostics& diagnostics) {
  constexpr size_t kMostNotes = 4;
  std::vector<Dead> dead = dead_passes(program.graphs[graph], plans);
  report_known(dead, diagnostics);
  dead = by_blame(dead);
  if (dead.empty()) return;
  for (size_t i = 0; i < std::min(dead.size(), 1 + kMostNotes); ++i)
    if (const std::string why = overwritten(program.graphs[graph], *dead[i].pass); !why.empty()) dead[i].reason = why;
  dsl::Diagnostic& warning = diagnostics.report(DiagnosticKind::ReachesNothing, dead[0].pass->span, {dead[0].pass->name, dead[0].reason});
  for (size_t i = 1; i < std::min(dead.size(), 1 + kMostNotes); ++i)
    warning.note(DiagnosticKind::AlsoLeftOut, dead[i].pass->span, {dead[i].pass->name, dead[i].reason});
  if (dead.size() <= 1 + kMostNotes) return;
  const size_t more = dead.size() - 1 - kMostNotes;
  warning.note(DiagnosticKind::NotShown, {}, {std::to_string(more) + " more of its passes " + (more == 1 ? "is" : "are")});
}

}  // namespace rg::compiler
