// The planner under the checker: random programs, random sizes, damaged plans.
#include <gtest/gtest.h>

#include <random>

#include "compiler/plan_frame.h"
#include "compiler/verify/mutate.h"
#include "compiler/verify/verify.h"
#include "tests/unit/verify/random_program.h"

namespace rg::verify {
namespace {

constexpr dsl::GraphId kGraph{size_t{0}};

struct Planned {
  dsl::Program program;
  compiler::FramePlan frame;
};
Planned plan_random(uint64_t seed, const RandomShape& shape) {
  Planned planned{make_random_program(seed, shape), {}};
  planned.frame = compiler::plan_frame(planned.program, kGraph, {}, {});
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

TEST(RandomGraphs, PlansAreProved) {
  for (uint64_t seed = 0; seed < 1000; ++seed) ASSERT_EQ(findings_of(plan_random(seed, shape_of_seed(seed))), "") << "seed " << seed;
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

// Removing any one stage bit, access bit or barrier of a plan without redundant atoms breaks it; so does any other damage.
TEST(RandomGraphs, EveryDamageIsNoticed) {
  size_t mutants = 0;
  for (uint64_t seed = 2000; seed < 2100; ++seed) {
    const Planned planned = plan_random(seed, shape_of_seed(seed));
    const PlanData& plan = planned.frame.plan;
    const MutationReport report = mutate(planned.program, kGraph, {}, plan.view(), plan.program_pass, plan.program_resource);
    for (const std::string& survivor : report.survivors) ADD_FAILURE() << "seed " << seed << ", not noticed: " << survivor;
    mutants += report.mutants;
  }
  EXPECT_GT(mutants, 8000u);
}

}  // namespace
}  // namespace rg::verify
