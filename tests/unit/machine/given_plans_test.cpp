// The planner's plans of programs that are written down: legal as they are, broken without what they need.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "compiler/machine/machine.h"
#include "compiler/plan_frame.h"
#include "compiler/verify/verify.h"
#include "dsl/front_end.h"

namespace rg::test {
namespace {

struct Given {
  dsl::Program program;
  compiler::FramePlan frame;

  explicit Given(const std::string& source) {
    dsl::Diagnostics diagnostics;
    dsl::FrontEndResult front = dsl::load_program(
        "given.rg", [&](const std::string&, std::string&) { return std::optional(source); }, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << print(diagnostics, front.files, false);
    program = std::move(front.program);
    frame = compiler::plan_frame(program, dsl::GraphId{0}, {}, {});
  }
  std::string found() const {
    std::string all;
    for (const machine::Divergence& each : machine::run_adversarially(program, dsl::GraphId{0}, {}, frame.plan.view(), frame.plan.program_pass,
                                                                      frame.plan.program_resource, machine::MachineOptions{}))
      all += text(each) + "\n";
    return all;
  }
};

// `how` says what a slice is drawn with.
Given slices(const std::string& how) {
  return Given(
      "graph frame(surface bb: rgba8 64x64) {\n image f : rgba16f [16, 16, 2]\n"
      " for z in 0..2 { pass fs[z] : raster { color f.slice(z) " +
      how +
      " } }\n"
      " pass show : raster { read f as sampled in fragment  color bb clear 0 }\n}\n");
}

TEST(GivenPlans, SlicesDrawnAnewKeepTheOthers) {
  for (const char* how : {"covers", "clear 0"}) {
    Given given = slices(how);
    EXPECT_EQ(given.found(), "") << how;
    const auto between = [](const ImageBarrier& barrier) { return barrier.old_layout == barrier.new_layout; };
    auto& barriers = given.frame.plan.image_barriers;
    const auto barrier = std::find_if(barriers.begin(), barriers.end(), between);
    ASSERT_NE(barrier, barriers.end()) << how;
    const ImageBarrier kept = *barrier;
    barrier->src_accesses = access::none;
    EXPECT_NE(given.found(), "") << how;
    *barrier = kept;
    barrier->old_layout = Layout::undefined;
    EXPECT_NE(given.found(), "") << how << ": the slice drawn first is lost";
  }
}

TEST(GivenPlans, DepthAndStencilComeInLayoutsOfTheirOwn) {
  Given given(
      "interface S { zb: image d32f_s8 64x64 ready as depth }\n"
      "graph frame(surface bb: rgba8 64x64, s: S) {\n"
      " pass c : raster { stencil s.zb }\n"
      " pass g : raster { color bb clear 0  read s.zb as sampled in fragment }\n}\n");
  EXPECT_EQ(given.found(), "");
  bool moved = false;
  for (ImageBarrier& barrier : given.frame.plan.image_barriers)
    if (barrier.range.aspects == aspect_depth && barrier.new_layout == Layout::depth_read_only) barrier.new_layout = Layout::general, moved = true;
  EXPECT_TRUE(moved);
  EXPECT_NE(given.found(), "");
}

// The checker counts every resolve of a rendering, and stencil has none.
TEST(GivenPlans, TheCheckerKnowsWhatARenderingResolves) {
  Given given(
      "graph frame(surface bb: rgba8 64x64) {\n image d : d32f_s8 64x64 samples 4\n image r : d32f_s8 64x64\n image other : d32f_s8 64x64 output\n"
      " pass wipe : raster { depth other clear 0  stencil other clear 0 }\n"
      " pass y : raster { depth d clear 1  stencil d clear 0  draw host  resolve d.depth -> r.depth }\n"
      " pass show : raster { read r.depth as sampled in fragment  color bb clear 0 }\n}\n");
  PlanData& plan = given.frame.plan;
  const auto findings = [&] {
    std::string all;
    for (const verify::Finding& finding : verify::verify(given.program, dsl::GraphId{0}, {}, plan.view(), plan.program_pass, plan.program_resource))
      all += finding.text + "\n";
    return all;
  };
  EXPECT_EQ(findings(), "");
  const auto drawn = std::find_if(plan.renderings.begin(), plan.renderings.end(), [](const Rendering& each) { return each.samples == 4; });
  ASSERT_NE(drawn, plan.renderings.end());
  const Attachment depth = plan.attachments[drawn->depth];
  plan.attachments[drawn->stencil].resolve = depth.resolve;
  EXPECT_NE(findings().find("`y`: the rendering resolves otherwise than declared"), std::string::npos) << findings();
  plan.attachments[drawn->stencil].resolve = {};
  const auto other = std::find_if(plan.resources.begin(), plan.resources.end(), [](const Resource& each) { return each.name == "other"; });
  plan.attachments[drawn->depth].resolve = {static_cast<Index>(other - plan.resources.begin()), 0};
  EXPECT_NE(findings().find("`y`: the rendering resolves otherwise than declared"), std::string::npos) << findings();
}

}  // namespace
}  // namespace rg::test
