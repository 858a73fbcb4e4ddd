#include "compiler/judge.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/judge_facts.h"
#include "dsl/closest.h"

namespace rg::compiler {
namespace {

using dsl::Assertion;
using dsl::DiagnosticKind;

std::string amount(double value, bool bytes) {
  if (!bytes) return fmt::format("{:.0f}", value);
  constexpr double kKibi = 1024.0;
  if (value < kKibi * kKibi) return fmt::format("{:.1f} KiB ({:.0f} bytes)", value / kKibi, value);
  return fmt::format("{:.1f} MiB ({:.0f} bytes)", value / (kKibi * kKibi), value);
}

std::string distance(const Finding& finding, const Assertion& assertion) {
  const double by = finding.value - assertion.value;
  const std::string budget = finding.bytes ? amount(assertion.value, true) : fmt::format("{:g}", assertion.value);
  if (by == 0) return fmt::format(", just the budget of {}", budget);
  const std::string size = finding.bytes ? amount(by < 0 ? -by : by, true) : fmt::format("{:g}", by < 0 ? -by : by);
  return fmt::format(", {} {} the budget of {}", size, by > 0 ? "over" : "under", budget);
}

std::string found_text(const Finding& finding, const Assertion& assertion) {
  std::string text = finding.verdict.empty() ? amount(finding.value, finding.bytes) : finding.verdict;
  if (!assertion.comparison.empty()) text += distance(finding, assertion);
  if (!finding.variant.empty()) text += fmt::format(", with `{}`", finding.variant);
  return text;
}

bool compare(double value, const std::string& comparison, double limit) {
  if (comparison == "<=") return value <= limit;
  if (comparison == "<") return value < limit;
  if (comparison == ">=") return value >= limit;
  if (comparison == ">") return value > limit;
  if (comparison == "==") return value == limit;
  return value != 0;  // a fact without a comparison
}

template <class Rows>
bool has(const Rows& rows, const std::string& name) {
  return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name || row.name.starts_with(name + "["); });
}

// True if every argument names a pass or resource of the graph; reports the first that does not.
bool names_exist(const dsl::Graph& graph, const Assertion& assertion, dsl::Diagnostics& diagnostics) {
  for (const std::string& name : assertion.arguments) {
    if (has(graph.passes, name) || has(graph.resources, name)) continue;
    dsl::Diagnostic& error = diagnostics.report(DiagnosticKind::AssertionUnknownName, assertion.span, {name, graph.name});
    std::vector<std::string_view> known;
    for (const dsl::Pass& pass : graph.passes) known.push_back(pass.name);
    for (const dsl::Resource& resource : graph.resources) known.push_back(resource.name);
    const std::string guess = dsl::closest(name, known).shown();
    if (!guess.empty()) error.note(DiagnosticKind::DidYouMean, assertion.span, {guess});
    return false;
  }
  return true;
}

std::string fact_list() {
  std::string text;
  for (const Fact& fact : known_facts()) text += (text.empty() ? "" : ", ") + std::string(fact.name) + fact.arguments;
  return text;
}

const Fact* find_fact(const Assertion& assertion, dsl::Diagnostics& diagnostics) {
  const auto& facts = known_facts();
  const auto fact = std::find_if(facts.begin(), facts.end(), [&](const Fact& each) { return assertion.fact == each.name; });
  if (fact == facts.end()) {
    dsl::Diagnostic& error = diagnostics.report(DiagnosticKind::AssertionUnknownFact, assertion.span, {assertion.fact, fact_list()});
    std::vector<std::string_view> names;
    for (const Fact& known : facts) names.push_back(known.name);
    const std::string guess = dsl::closest(assertion.fact, names).shown();
    if (!guess.empty()) error.note(DiagnosticKind::DidYouMean, assertion.span, {guess});
    return nullptr;
  }
  const bool counts = assertion.arguments.size() >= fact->least && assertion.arguments.size() <= fact->most;
  if (counts && fact->compares != assertion.comparison.empty()) return &*fact;
  const std::string shape = std::string(fact->name) + fact->arguments + (fact->compares ? " <= N" : "");
  diagnostics.report(DiagnosticKind::AssertionShape, assertion.span, {assertion.fact, shape});
  return nullptr;
}

void report(const Assertion& assertion, const Finding& finding, dsl::Diagnostics& diagnostics) {
  dsl::Diagnostic& failed = diagnostics.report(assertion.is_error ? DiagnosticKind::AssertionFails : DiagnosticKind::AssertionWarns, assertion.span,
                                               {assertion.text, found_text(finding, assertion)});
  for (const Contributor& each : finding.contributors) {
    const dsl::Span span = each.span.file.valid() ? each.span : assertion.span;
    failed.note(DiagnosticKind::AssertionContributor, span, {each.name, each.share});
  }
}

}  // namespace

void judge(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, const PlanOptions& options,
           dsl::Diagnostics& diagnostics) {
  const auto& assertions = program.graphs[graph].assertions;
  if (assertions.empty()) return;
  std::vector<PlanFigures> figures;
  for (const FramePlan& plan : plans) figures.push_back(find_figures(plan.plan));
  for (const Assertion& assertion : assertions) {
    const Fact* fact = find_fact(assertion, diagnostics);
    if (!fact || !names_exist(program.graphs[graph], assertion, diagnostics)) continue;
    const Finding finding = fact->find({program, graph, plans, figures, options, assertion});
    if (!compare(finding.value, assertion.comparison, assertion.value)) report(assertion, finding, diagnostics);
  }
}

}  // namespace rg::compiler
