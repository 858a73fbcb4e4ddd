#include "compiler/judge.h"

#include <gtest/gtest.h>

#include "compiler/plan_figures.h"

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

void add_resource(PlanData& plan, const char* name, uint64_t bytes, uint64_t offset, std::initializer_list<Index> users) {
  Resource resource;
  resource.name = name;
  resource.estimated_bytes = bytes;
  resource.estimated_offset = offset;
  const auto index = static_cast<Index>(plan.resources.size());
  plan.resources.push_back(resource);
  for (const Index user : users) {
    // accesses of a pass are contiguous: insert behind those it has
    Pass& pass = plan.passes[user];
    if (pass.access_count == 0) pass.first_access = static_cast<Index>(plan.accesses.size());
    const auto at = plan.accesses.begin() + pass.first_access + pass.access_count;
    Access access;
    access.ref = {index, 0};
    const Index moved = pass.first_access + pass.access_count++;
    plan.accesses.insert(at, access);
    for (Pass& other : plan.passes)
      if (&other != &pass && other.access_count > 0 && other.first_access >= moved) ++other.first_access;
  }
}

// Passes a, b, c with four barriers between b and c; `big` shares bytes with `tail`, and nothing with `apart`.
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
  plan.groups[0].image_count = 3, plan.groups[0].memory_count = 1;
  plan.batches.resize(1);
  plan.batches[0].step_count = 4;
  add_resource(plan, "big", 1 << 20, 0, {0, 1});
  add_resource(plan, "tail", 1 << 19, 1 << 19, {2});
  add_resource(plan, "apart", 1 << 18, 2 << 20, {1, 2});
  frame.heap_bytes = 3 << 20;
  return frame;
}

dsl::Program asserting(const dsl::Assertion& assertion) {
  dsl::Program program;
  dsl::Graph graph;
  graph.name = "frame";
  for (const char* name : {"big", "tail", "apart"}) {
    dsl::Resource resource;
    resource.name = name;
    graph.resources.add(resource);
  }
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
  EXPECT_EQ(rows[0].arguments,
            (std::vector<std::string>{"as written", "3.0 MiB (3145728 bytes), 2.0 MiB (2097152 bytes) over the budget of 1.0 MiB (1048576 bytes)"}));
}

TEST(Judge, AWarningIsNoError) {
  dsl::Assertion soft = fact("barriers", "<=", 1);
  soft.is_error = false;
  const auto rows = judged(soft);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].kind, DiagnosticKind::AssertionWarns);
  EXPECT_EQ(rows[0].arguments[1], "4, 3 over the budget of 1");
}

TEST(Judge, OrderAndOverlapLookAtBarriers) {
  EXPECT_EQ(judged(fact("order", "", 0, {"c", "a"}))[0].arguments[1], "the other way round");
  EXPECT_EQ(judged(fact("overlaps", "", 0, {"b", "c"}))[0].arguments[1], "separated by a barrier");
}

TEST(Judge, APassThatWasCulledContradictsNothing) { EXPECT_TRUE(judged(fact("order", "", 0, {"dropped", "a"})).empty()); }

TEST(Judge, FactsOfNamedThings) {
  EXPECT_TRUE(judged(fact("memory", "==", 1 << 20, {"big"})).empty());
  EXPECT_TRUE(judged(fact("barriers", "==", 4, {"c"})).empty());
  EXPECT_TRUE(judged(fact("barriers", "==", 0, {"b"})).empty());
  EXPECT_TRUE(judged(fact("barrier_calls", "==", 1)).empty());
  EXPECT_TRUE(judged(fact("lifetime", "==", 2, {"big"})).empty());
  EXPECT_TRUE(judged(fact("lifetime", "==", 1, {"tail"})).empty());
  EXPECT_TRUE(judged(fact("aliases", "", 0, {"big", "tail"})).empty());
  EXPECT_TRUE(judged(fact("live", "", 0, {"a"})).empty());
  EXPECT_EQ(judged(fact("aliases", "", 0, {"big", "apart"}))[0].arguments[1], "no byte shared");
  EXPECT_EQ(judged(fact("lifetime", "<", 2, {"apart"}))[0].arguments[1], "2, just the budget of 2");
}

std::vector<std::string> contributors(const dsl::Diagnostic& diagnostic) {
  std::vector<std::string> all;
  for (const dsl::Diagnostic& note : diagnostic.notes) all.push_back(note.message());
  return all;
}

TEST(Judge, AFailureNamesWhatContributesMost) {
  // At the peak, passes a and b, `tail` is dead.
  EXPECT_EQ(judged(fact("memory", "<", 1))[0].notes[0].kind, DiagnosticKind::AssertionContributor);
  EXPECT_EQ(contributors(judged(fact("memory", "<", 1))[0]), (std::vector<std::string>{"`big`: 1.0 MiB", "`apart`: 256.0 KiB"}));
  EXPECT_EQ(contributors(judged(fact("barriers", "<", 1))[0]), std::vector<std::string>{"`c`: 4 before it"});
  EXPECT_EQ(contributors(judged(fact("lifetime", "<", 1, {"apart"}))[0]), (std::vector<std::string>{"`b`: first use", "`c`: last use"}));
  EXPECT_EQ(contributors(judged(fact("overlaps", "", 0, {"a", "c"}))[0]), std::vector<std::string>{"`c`: 4 barriers before it"});
}

TEST(Judge, PassesOfDifferentQueuesOverlapUnlessOneWaits) {
  FramePlan frame = three_passes();
  PlanData& plan = frame.plan;
  plan.queues = {{QueueKind::graphics}, {QueueKind::compute}};
  plan.batches = {{.queue = 0, .first_step = 0, .step_count = 1, .first_signal = 0, .signal_count = 1},
                  {.queue = 1, .first_step = 1, .step_count = 1},
                  {.queue = 1, .first_step = 2, .step_count = 2, .first_wait = 0, .wait_count = 1}};
  plan.signals = {{1, 0}};
  plan.waits = {{0, 1, 0}};
  const PlanFigures figures = find_figures(plan);
  EXPECT_TRUE(overlap(figures.passes[0], figures.passes[1]));
  EXPECT_FALSE(overlap(figures.passes[0], figures.passes[2]));
  EXPECT_FALSE(overlap(figures.passes[1], figures.passes[2]));  // a barrier on their queue
  dsl::Diagnostics diagnostics;
  judge(asserting(fact("async", "", 0, {"a"})), dsl::GraphId{0}, {frame}, {}, diagnostics);
  ASSERT_EQ(diagnostics.rows().size(), 1u);
  EXPECT_EQ(diagnostics.rows()[0].arguments[1], "on the graphics queue");
}

TEST(Judge, AFactIsWrittenInOneWay) {
  for (const dsl::Assertion& wrong :
       {fact("order", "", 0, {"a"}), fact("order", "<", 1, {"a", "b"}), fact("barriers", "", 0), fact("passes", "<", 9, {"a"})}) {
    const auto rows = judged(wrong);
    ASSERT_EQ(rows.size(), 1u) << wrong.fact;
    EXPECT_EQ(rows[0].kind, DiagnosticKind::AssertionShape);
  }
}

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
