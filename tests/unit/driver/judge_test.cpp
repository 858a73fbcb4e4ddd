#include "compiler/judge.h"

#include <gtest/gtest.h>

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

// Passes a, b, c with one barrier group between b and c.
FramePlan three_passes() {
  FramePlan frame;
  PlanData& plan = frame.plan;
  for (const char* name : {"a", "b", "c"}) {
    Pass pass;
    pass.name = name;
    plan.passes.push_back(pass);
  }
  plan.groups.push_back({});
  plan.image_barriers.resize(3);
  plan.memory_barriers.resize(1);
  plan.steps = {{StepKind::pass, 0}, {StepKind::pass, 1}, {StepKind::barriers, 0}, {StepKind::pass, 2}};
  plan.batches.resize(1);
  frame.heap_bytes = 3 << 20;
  return frame;
}

dsl::Program asserting(const dsl::Assertion& assertion) {
  dsl::Program program;
  dsl::Graph graph;
  graph.name = "frame";
  for (const char* name : {"a", "b", "c", "dropped"}) {
    dsl::Pass pass;
    pass.name = name;
    graph.passes.add(pass);
  }
  graph.assertions.push_back(assertion);
  program.graphs.add(graph);
  return program;
}

dsl::Assertion fact(const std::string& name, const std::string& comparison, double value, std::vector<std::string> arguments = {}) {
  dsl::Assertion assertion;
  assertion.fact = name;
  assertion.comparison = comparison;
  assertion.value = value;
  assertion.arguments = std::move(arguments);
  assertion.text = "as written";
  return assertion;
}

std::vector<dsl::Diagnostic> judged(const dsl::Assertion& assertion) {
  dsl::Diagnostics diagnostics;
  judge(asserting(assertion), dsl::GraphId{0}, {three_passes()}, {}, diagnostics);
  return diagnostics.rows();
}

TEST(Judge, FactsThatHoldAreSilent) {
  EXPECT_TRUE(judged(fact("memory", "<=", 3 << 20)).empty());
  EXPECT_TRUE(judged(fact("barriers", "==", 4)).empty());
  EXPECT_TRUE(judged(fact("submits", "<", 2)).empty());
  EXPECT_TRUE(judged(fact("passes", ">=", 3)).empty());
  EXPECT_TRUE(judged(fact("variants", "==", 1)).empty());
  EXPECT_TRUE(judged(fact("order", "", 0, {"a", "c"})).empty());
  EXPECT_TRUE(judged(fact("overlaps", "", 0, {"a", "b"})).empty());
}

TEST(Judge, AFailureSaysWhatWasFound) {
  const auto rows = judged(fact("memory", "<", 1 << 20));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].kind, DiagnosticKind::AssertionFails);
  EXPECT_EQ(rows[0].arguments, (std::vector<std::string>{"as written", "3.0 MiB (3145728 bytes)"}));
}

TEST(Judge, AWarningIsNoError) {
  dsl::Assertion soft = fact("barriers", "<=", 1);
  soft.is_error = false;
  const auto rows = judged(soft);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].kind, DiagnosticKind::AssertionWarns);
  EXPECT_EQ(rows[0].arguments[1], "4");
}

TEST(Judge, OrderAndOverlapLookAtBarriers) {
  EXPECT_EQ(judged(fact("order", "", 0, {"c", "a"}))[0].arguments[1], "the other way round");
  EXPECT_EQ(judged(fact("overlaps", "", 0, {"b", "c"}))[0].arguments[1], "separated by a barrier");
}

TEST(Judge, APassThatWasCulledContradictsNothing) { EXPECT_TRUE(judged(fact("order", "", 0, {"dropped", "a"})).empty()); }

TEST(Judge, UnknownNamesAndFactsAreReported) {
  const auto names = judged(fact("order", "", 0, {"a", "nobody"}));
  ASSERT_EQ(names.size(), 1u);
  EXPECT_EQ(names[0].kind, DiagnosticKind::AssertionUnknownName);
  EXPECT_EQ(names[0].arguments, (std::vector<std::string>{"nobody", "frame"}));
  const auto facts = judged(fact("beauty", ">", 0));
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].kind, DiagnosticKind::AssertionUnknownFact);
}

}  // namespace
}  // namespace rg::compiler
