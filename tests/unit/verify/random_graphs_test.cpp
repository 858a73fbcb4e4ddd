// The planner under the checker: random programs, random sizes.
#include <gtest/gtest.h>

#include <random>

#include "compiler/plan_frame.h"
#include "compiler/verify/verify.h"
#include "tests/unit/verify/random_program.h"

namespace rg::verify {
namespace {

std::vector<Finding> plan_and_verify(const dsl::Program& program, const VerifyOptions& options = {}) {
  const compiler::FramePlan frame = compiler::plan_frame(program, dsl::GraphId{size_t{0}}, {}, {});
  return verify(program, dsl::GraphId{size_t{0}}, {}, frame.plan.view(), frame.plan.program_pass, frame.plan.program_resource, options);
}

std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) text += std::string(name(finding.hazard)) + ": " + finding.text + "\n";
  return text;
}

TEST(RandomGraphs, PlansAreProved) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const RandomShape shape{.passes = 4 + static_cast<uint32_t>(seed % 40),
                            .images = 2 + static_cast<uint32_t>(seed % 9),
                            .buffers = 1 + static_cast<uint32_t>(seed % 5)};
    ASSERT_EQ(text_of(plan_and_verify(make_random_program(seed, shape))), "") << "seed " << seed;
  }
}

}  // namespace
}  // namespace rg::verify
