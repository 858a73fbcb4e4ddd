#include "compiler/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace rg::compiler {
namespace {

using dsl::Assertion;
using dsl::DiagnosticKind;

// What was found: a number to compare, or the verdict of a fact that just holds or not.
struct Finding {
  double value = 0;
  std::string text;
};

size_t barrier_count(const PlanData& plan) { return plan.memory_barriers.size() + plan.image_barriers.size() + plan.buffer_barriers.size(); }

template <class Measure>
double worst(const std::vector<FramePlan>& plans, Measure measure) {
  double value = 0;
  for (const FramePlan& plan : plans) value = std::max(value, static_cast<double>(measure(plan)));
  return value;
}

// The program as if its first extent were chosen as the assertion says.
dsl::Program at_extent(dsl::Program program, const Assertion& assertion) {
  if (program.extents.empty()) return program;
  dsl::Extent& extent = program.extents[dsl::ExtentId{0}];
  for (size_t axis = 0; axis < 3; ++axis)
    if (assertion.extent[axis]) extent.initial[axis] = *assertion.extent[axis];
  return program;
}

double memory_bytes(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, const PlanOptions& options,
                    const Assertion& assertion) {
  if (!assertion.extent[0]) return worst(plans, [](const FramePlan& plan) { return plan.heap_bytes; });
  const dsl::Program resized = at_extent(program, assertion);
  return worst(plans, [&](const FramePlan& plan) { return plan_frame(resized, graph, plan.configuration, options).heap_bytes; });
}

std::string bytes_text(double bytes) { return fmt::format("{:.1f} MiB ({:.0f} bytes)", bytes / (1024.0 * 1024.0), bytes); }

// Position of a pass among the plan's steps, counting barrier groups: {step, groups before it}.
struct Place {
  size_t step = 0, groups_before = 0;
};
std::optional<Place> find_pass(const PlanData& plan, const std::string& name) {
  Place place;
  for (; place.step < plan.steps.size(); ++place.step) {
    const Step& step = plan.steps[place.step];
    if (step.kind == StepKind::barriers)
      ++place.groups_before;
    else if (plan.passes[step.index].name == name)
      return place;
  }
  return std::nullopt;
}

template <class Holds>
Finding pairwise(const std::vector<FramePlan>& plans, const Assertion& assertion, const char* otherwise, Holds holds) {
  for (const FramePlan& plan : plans) {
    const auto a = find_pass(plan.plan, assertion.arguments[0]), b = find_pass(plan.plan, assertion.arguments[1]);
    if (a && b && !holds(*a, *b)) return {0, otherwise};
  }
  return {1, "so"};
}

const char* const kFacts = "memory, barriers, submits, passes, variants, order, overlaps";

std::optional<Finding> find(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, const PlanOptions& options,
                            const Assertion& assertion) {
  const auto number = [](double value) { return Finding{value, fmt::format("{:.0f}", value)}; };
  if (assertion.fact == "memory") {
    const double bytes = memory_bytes(program, graph, plans, options, assertion);
    return Finding{bytes, bytes_text(bytes)};
  }
  if (assertion.fact == "barriers") return number(worst(plans, [](const FramePlan& plan) { return barrier_count(plan.plan); }));
  if (assertion.fact == "submits") return number(worst(plans, [](const FramePlan& plan) { return plan.plan.batches.size(); }));
  if (assertion.fact == "passes") return number(worst(plans, [](const FramePlan& plan) { return plan.plan.passes.size(); }));
  if (assertion.fact == "variants") return number(static_cast<double>(plans.size()));
  if (assertion.arguments.size() != 2) return std::nullopt;
  if (assertion.fact == "order")
    return pairwise(plans, assertion, "the other way round", [](const Place& a, const Place& b) { return a.step < b.step; });
  if (assertion.fact == "overlaps")
    return pairwise(plans, assertion, "separated by a barrier", [](const Place& a, const Place& b) { return a.groups_before == b.groups_before; });
  return std::nullopt;
}

bool compare(double value, const std::string& comparison, double limit) {
  if (comparison == "<=") return value <= limit;
  if (comparison == "<") return value < limit;
  if (comparison == ">=") return value >= limit;
  if (comparison == ">") return value > limit;
  if (comparison == "==") return value == limit;
  return value != 0;  // a fact without a comparison
}

// True if every argument names a pass or resource of the graph; reports the first that does not.
bool names_exist(const dsl::Graph& graph, const Assertion& assertion, dsl::Diagnostics& diagnostics) {
  for (const std::string& name : assertion.arguments) {
    const auto named = [&](const auto& row) { return row.name == name; };
    if (std::any_of(graph.passes.begin(), graph.passes.end(), named) || std::any_of(graph.resources.begin(), graph.resources.end(), named)) continue;
    diagnostics.report(DiagnosticKind::AssertionUnknownName, assertion.span, {name, graph.name});
    return false;
  }
  return true;
}

}  // namespace

void judge(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, const PlanOptions& options,
           dsl::Diagnostics& diagnostics) {
  for (const Assertion& assertion : program.graphs[graph].assertions) {
    if (!names_exist(program.graphs[graph], assertion, diagnostics)) continue;
    const std::optional<Finding> found = find(program, graph, plans, options, assertion);
    if (!found)
      diagnostics.report(DiagnosticKind::AssertionUnknownFact, assertion.span, {assertion.fact, kFacts});
    else if (!compare(found->value, assertion.comparison, assertion.value))
      diagnostics.report(assertion.is_error ? DiagnosticKind::AssertionFails : DiagnosticKind::AssertionWarns, assertion.span,
                         {assertion.text, found->text});
  }
}

}  // namespace rg::compiler
