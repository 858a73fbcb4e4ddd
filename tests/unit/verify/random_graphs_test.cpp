// The planner under the checker: random programs, random sizes, damaged plans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>

#include "compiler/fold_transfers.h"
#include "compiler/machine/machine.h"
#include "compiler/plan_frame.h"
#include "compiler/verify/folding.h"
#include "compiler/verify/mutate.h"
#include "compiler/verify/verify.h"
#include "dsl/print.h"
#include "tests/unit/verify/random_program.h"

namespace rg::verify {
namespace {

constexpr dsl::GraphId kGraph{size_t{0}};

using Kind = dsl::QueueKind;
const std::vector<std::vector<Kind>> kQueues = {{Kind::graphics},
                                                {Kind::graphics, Kind::compute},
                                                {Kind::graphics, Kind::compute, Kind::transfer},
                                                {Kind::graphics, Kind::compute, Kind::compute, Kind::transfer}};

bool is_long() { return std::getenv("RGC_LONG") != nullptr; }

struct Planned {
  dsl::Program program;
  compiler::FramePlan frame;
};
Planned plan_random(uint64_t seed, const RandomShape& shape, const std::vector<Kind>& queues = kQueues[0]) {
  Planned planned{make_random_program(seed, shape), {}};
  planned.program.split_barriers = seed / 4 % 2 == 1;
  compiler::PlanOptions options;
  options.queues = queues;
  planned.frame = compiler::plan_frame(planned.program, kGraph, {}, options);
  return planned;
}
RandomShape shape_of_seed(uint64_t seed) {
  const auto n = static_cast<uint32_t>(seed);
  return {.passes = 4 + n % 40, .images = 2 + n % 9, .buffers = 1 + n % 5};
}

std::string findings_of(const Planned& planned, const VerifyOptions& options = {}) {
  const PlanData& plan = planned.frame.plan;
  std::string text;
  for (const Finding& finding : verify(planned.program, kGraph, {}, plan.view(), plan.program_pass, plan.program_resource, options))
    text += std::string(name(finding.hazard)) + ": " + finding.text + "\n";
  return text;
}

std::string findings_between(const dsl::Program& apart, const dsl::Program& folded) {
  std::string text;
  for (const Finding& finding : verify_folding(apart, folded, kGraph, {})) text += std::string(name(finding.hazard)) + ": " + finding.text + "\n";
  return text;
}
dsl::Program with_other_clear(dsl::Program program, const compiler::Fold& fold) {
  for (dsl::Pass& pass : program.graphs.rows[0].passes)
    for (dsl::Access& access : pass.accesses)
      if (pass.name == fold.parts[0].into && access.clear && program.graphs.rows[0].resources[access.resource].name == fold.parts[0].image)
        access.clear->f[0] += 1;
  return program;
}

bool uses_several_queues(const PlanData& plan) {
  return std::any_of(plan.batches.begin(), plan.batches.end(), [&](const Batch& batch) { return batch.queue != plan.batches.front().queue; });
}

// The abstract machine's opinion, with memory placed as estimated.
bool misbehaves(const Planned& planned, const Plan& plan) {
  machine::MachineOptions options;
  options.max_divergences = 1;
  for (const Resource& resource : plan.resources) {
    const bool shares = resource.lifetime == Lifetime::transient && !resource.no_alias;
    options.placement.push_back(shares ? machine::Placement{resource.estimated_offset, resource.estimated_bytes} : machine::Placement{});
  }
  for (const uint64_t conditions : {uint64_t{0}, ~uint64_t{0}}) {
    options.conditions = {conditions};
    const PlanData& own = planned.frame.plan;
    if (!machine::run_adversarially(planned.program, kGraph, {}, plan, own.program_pass, own.program_resource, options).empty()) return true;
  }
  return false;
}

TEST(RandomGraphs, PlansAreProved) {
  for (uint64_t seed = 0; seed < 1000; ++seed) ASSERT_EQ(findings_of(plan_random(seed, shape_of_seed(seed))), "") << "seed " << seed;
}

// Programs that draw into the same attachments again and again: what becomes one rendering is right, and there is some of it.
TEST(RandomGraphs, RenderingsOfSeveralPassesAreProved) {
  size_t merged = 0;
  std::vector<uint64_t> seeds(400);
  std::iota(seeds.begin(), seeds.end(), 0u);
  seeds.push_back(166149);  // went wrong once
  for (const uint64_t seed : seeds) {
    RandomShape shape = shape_of_seed(seed);
    shape.continues = true;
    const Planned planned = plan_random(seed, shape, kQueues[seed % 2]);
    VerifyOptions options;
    options.irredundancy = seed % 2 == 0;
    ASSERT_EQ(findings_of(planned, options), "") << "seed " << seed;
    if (seed % 8 == 0) {
      ASSERT_FALSE(misbehaves(planned, planned.frame.plan.view())) << "seed " << seed;
    }
    for (const compiler::Decision& decision : planned.frame.decisions) merged += decision.what == "merged";
  }
  EXPECT_GT(merged, 100u);
}

// Renderings that clear and resolve in place of passes: the program means the same, its plan is right, and a clear of something else would be
// noticed.
TEST(RandomGraphs, FoldedProgramsAreProved) {
  size_t clears = 0, resolves = 0, refused = 0;
  for (uint64_t seed = 0; seed < (is_long() ? 2000u : 160u); ++seed) {
    RandomShape shape = shape_of_seed(seed);
    shape.folds = true, shape.continues = seed % 2 == 0;
    const dsl::Program apart = make_random_program(seed, shape);
    const compiler::FoldResult folded = compiler::fold_transfers(apart, {});
    ASSERT_EQ(findings_between(apart, folded.program), "") << "seed " << seed;
    for (const compiler::Fold& fold : folded.folds) (fold.parts[0].target.empty() ? clears : resolves) += 1;
    refused += folded.refusals.size();
    compiler::PlanOptions options;
    options.queues = kQueues[seed % 3];
    const Planned planned{folded.program, compiler::plan_frame(folded.program, kGraph, {}, options)};
    VerifyOptions verify;
    verify.irredundancy = seed % 4 == 0;
    ASSERT_EQ(findings_of(planned, verify), "") << "seed " << seed;
    if (seed % 8 == 0) {
      ASSERT_FALSE(misbehaves(planned, planned.frame.plan.view())) << "seed " << seed;
    }
    for (const compiler::Fold& fold : folded.folds)
      if (fold.parts[0].target.empty()) {
        ASSERT_NE(findings_between(apart, with_other_clear(folded.program, fold)), "") << "seed " << seed << ", " << fold.pass;
      }
  }
  EXPECT_GT(clears, 50u);
  EXPECT_GT(resolves, 50u);
  EXPECT_GT(refused, 50u);
}

// Every switch, on every program, leaves the plan right.
TEST(RandomGraphs, PlansWithSwitchesAreProved) {
  for (uint64_t seed = 0; seed < 160; ++seed) {
    RandomShape shape = shape_of_seed(seed);
    shape.continues = true;
    Planned planned{make_random_program(seed, shape), {}};
    compiler::PlanOptions options;
    options.aliasing = (seed & 1) == 0, options.reorder = (seed & 2) == 0, options.merge = (seed & 4) == 0, options.discard = (seed & 8) == 0;
    options.queues = kQueues[seed % 3];
    const auto& graph = planned.program.graphs[kGraph];
    if (seed % 5 == 0) {
      const std::string& pass = graph.passes.rows[seed % graph.passes.size()].name;
      options.no_reorder = {pass}, options.no_merge = {graph.passes.rows.back().name, pass}, options.no_async = {pass};
      options.no_aliasing = options.no_discard = {graph.resources.rows[seed % graph.resources.size()].name};
    }
    planned.frame = compiler::plan_frame(planned.program, kGraph, {}, options);
    VerifyOptions verify;
    verify.irredundancy = false;
    ASSERT_EQ(findings_of(planned, verify), "") << "seed " << seed;
  }
}

TEST(RandomGraphs, PlansOnSeveralQueuesAreProved) {
  size_t several = 0;
  for (uint64_t seed = 0; seed < (is_long() ? 2500u : 300u); ++seed) {
    const Planned planned = plan_random(seed, shape_of_seed(seed), kQueues[1 + seed % 3]);
    several += uses_several_queues(planned.frame.plan);
    ASSERT_EQ(findings_of(planned), "") << "seed " << seed;
    ASSERT_EQ(planned.frame.unproved, 0u) << "seed " << seed;
  }
  EXPECT_GT(several, 90u);
}

// Programs that were planned, proved or run wrongly once.
TEST(RandomGraphs, ProgramsThatWentWrongStayRight) {
  for (const uint64_t seed : {28,   55,   61,   147,  194,  311,  373,  548,  1212, 1220, 1474, 1555,  1664,
                              1899, 2018, 2103, 2154, 2277, 2662, 3365, 5893, 6892, 8464, 9392, 14958, 15537})
    for (const std::vector<Kind>& queues : kQueues) {
      const Planned planned = plan_random(seed, shape_of_seed(seed), queues);
      EXPECT_EQ(findings_of(planned), "") << "seed " << seed << ", " << queues.size() << " queues";
      EXPECT_FALSE(misbehaves(planned, planned.frame.plan.view())) << "seed " << seed << ", " << queues.size() << " queues";
    }
}

// What the checker proves, the abstract machine runs as program order does, on one family and on several.
TEST(RandomGraphs, MachineAgreesOnSeveralQueues) {
  for (uint64_t seed = 0; seed < (is_long() ? 400u : 40u); ++seed) {
    const Planned planned = plan_random(seed, shape_of_seed(seed % 24), kQueues[1 + seed % 3]);
    EXPECT_FALSE(misbehaves(planned, planned.frame.plan.view())) << "seed " << seed;
  }
}

TEST(RandomGraphs, LargePlanIsProved) {
  const Planned planned = plan_random(7, {.passes = 2000, .images = 600, .buffers = 300});
  EXPECT_GT(planned.frame.plan.passes.size(), 500u);
  EXPECT_EQ(findings_of(planned), "");
}

TEST(RandomGraphs, PlansAreProvedAtAThousandSizes) {
  std::mt19937 random(5);
  for (uint64_t seed = 1000; seed < 1020; ++seed) {
    VerifyOptions options;
    for (int i = 0; i < 50; ++i) options.extents.push_back({1 + static_cast<int64_t>(random() % 1920), 1 + static_cast<int64_t>(random() % 1080), 1});
    ASSERT_EQ(findings_of(plan_random(seed, shape_of_seed(seed)), options), "") << "seed " << seed;
  }
}

// Removing any one stage bit, access bit, barrier, wait or signal of a plan without redundant atoms breaks it; so does any other damage, but for
// classes in which the abstract machine sees no difference either. Many graphs show more than all damage of a few: of each every sixth, with RGC_LONG
// all.
TEST(RandomGraphs, EveryDamageIsNoticed) {
  size_t mutants = 0, killed = 0, plans = 0, equivalent = 0;
  const size_t every = is_long() ? 1 : 6;
  const char* from = std::getenv("RGC_FIRST_SEED");  // for graphs that no run before has seen, or to see one again
  const uint64_t first = from ? std::strtoull(from, nullptr, 10) : 2000;
  for (uint64_t seed = first; seed < first + (is_long() ? 10000u : 300u); ++seed) {
    const Planned planned = plan_random(seed, shape_of_seed(seed), kQueues[seed % 3]);
    ASSERT_EQ(findings_of(planned), "") << "seed " << seed << ": of a plan that is wrong, all damage would count as noticed";
    const PlanData& plan = planned.frame.plan;
    MutateOptions options;
    options.misbehaves = [&](const Plan& mutant) { return misbehaves(planned, mutant); };
    options.every = every, options.first = seed;
    const MutationReport report = mutate(planned.program, kGraph, {}, plan.view(), plan.program_pass, plan.program_resource, options);
    for (const std::string& survivor : report.survivors)
      ADD_FAILURE() << "seed " << seed << ", not noticed: " << survivor << "\n" << dsl::print_program(planned.program);
    mutants += report.mutants, killed += report.killed, ++plans;
    for (const auto& [name, count] : report.equivalent) equivalent += count;
    if (HasFailure()) return;
  }
  EXPECT_EQ(killed + equivalent, mutants);
  EXPECT_GT(plans, 200u);
  EXPECT_GT(mutants, plans * 60 / every);
  RecordProperty("mutants", static_cast<int>(mutants));
  RecordProperty("killed", static_cast<int>(killed));
}

}  // namespace
}  // namespace rg::verify
