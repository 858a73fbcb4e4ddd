// Where the halves of barriers stand, and which barriers stay whole.
#include "compiler/split_barriers.h"

#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

constexpr char kFrame[] =
    "image albedo : rgba8 view\n image mask : rgba8 view\n image glow : rgba8 view\n buffer soft : u32[4096]\n image hdr : rgba16f view\n"
    "pass gbuffer : raster { color albedo clear 0  color mask clear 0  draw host }\n"
    "pass trace : compute { read mask as sampled  write soft as storage }\n"
    "pass halo : raster { read mask as sampled in fragment  color glow clear 0  draw host }\n"
    "pass lighting : compute { read albedo as sampled  read soft as storage  write hdr as storage }\n"
    "pass show : raster { read hdr as sampled in fragment  read glow as sampled in fragment  color backbuffer clear 0  draw host }\n";

FramePlan planned(const std::string& body, bool asked, PlanOptions options = {}) {
  dsl::Program program = program_of(body);
  program.split_barriers = asked;
  options.reasons = true;
  return plan_of(program, options);
}

// "gbuffer set:albedo trace halo await:albedo lighting": passes, and the halves of split groups with the resources they are about.
std::string halves(const PlanData& plan) {
  std::string text;
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::pass) {
      text += std::string(plan.passes[step.index].name) + " ";
      continue;
    }
    const BarrierGroup& group = plan.groups[step.index];
    if (group.event == kNone) continue;
    text += step.kind == StepKind::set ? "set:" : "await:";
    for (Index i = group.first_image; i < group.first_image + group.image_count; ++i)
      text += std::string(plan.resources[plan.image_barriers[i].image.resource].name) + " ";
    for (Index i = group.first_buffer; i < group.first_buffer + group.buffer_count; ++i)
      text += std::string(plan.resources[plan.buffer_barriers[i].buffer.resource].name) + " ";
  }
  return text;
}

std::string reason_of(const FramePlan& plan, const std::string& subject, const std::string& word) {
  std::string text;
  for (const Decision& decision : plan.decisions)
    if (decision.subject == subject && decision.what == "barrier" && decision.reason.find(word) != std::string::npos)
      text += decision.reason.substr(decision.reason.find(word)) + "\n";
  return text;
}

TEST(SplitBarriers, AreThoseWithWorkBetween) {
  EXPECT_EQ(halves(planned(kFrame, true).plan), "gbuffer set:albedo trace halo await:albedo lighting show ");
}

TEST(SplitBarriers, AreOnlyMadeWhereTheTargetAsks) {
  EXPECT_EQ(halves(planned(kFrame, false).plan), "gbuffer trace halo lighting show ");
  EXPECT_EQ(reason_of(planned(kFrame, false), "albedo", "split"), "");
}

TEST(SplitBarriers, CanBeSwitchedOff) {
  const std::string whole = "gbuffer trace halo lighting show ";
  EXPECT_EQ(halves(planned(kFrame, true, {.split = false}).plan), whole);
  EXPECT_EQ(halves(planned(kFrame, true, {.no_split = {"frame"}}).plan), whole);
  EXPECT_EQ(halves(planned(kFrame, true, {.no_split = {"albedo"}}).plan), whole);
  EXPECT_EQ(halves(planned(kFrame, true, {.no_split = {"mask"}}).plan), "gbuffer set:albedo trace halo await:albedo lighting show ");
}

TEST(SplitBarriers, HaveReasons) {
  const FramePlan plan = planned(kFrame, true);
  EXPECT_EQ(
      reason_of(plan, "albedo", "split, set"),
      "split, set in front of group 1 and awaited at group 2: what stands between is not waited for; `--no-split=albedo` would make it "
      "whole\n");
  EXPECT_EQ(reason_of(plan, "soft", "not split"), "not split, because its sources stand right in front of its users\n");
  EXPECT_EQ(reason_of(plan, "glow", "not split"),
            "not split, because memory changes hands in it\nnot split, because nothing in between would be waited "
            "for\n");
  EXPECT_EQ(reason_of(planned(kFrame, true, {.no_split = {"albedo"}}), "albedo", "not split"),
            "not split, because memory changes hands in it\nnot split, because `--no-split` names it\n");
}

// The same without the pass that computes: `soft` comes from a rasterised mask, too, and its barrier waits for all that the other would not.
TEST(SplitBarriers, StayWholeWhereAnotherWaitsForAll) {
  std::string body = kFrame;
  const std::string from = "pass trace : compute { read mask as sampled  write soft as storage }",
                    to = "pass trace : raster { read mask as sampled in fragment  color flat clear 0  draw host }";
  body.replace(body.find(from), from.size(), to);
  body.replace(body.find("read soft as storage"), 20, "read flat as sampled");
  body = "image flat : rgba8 view\n" + body;
  const FramePlan plan = planned(body, true);
  EXPECT_EQ(halves(plan.plan), "gbuffer trace halo lighting show ");
  EXPECT_EQ(reason_of(plan, "albedo", "another"), "another barrier of the group makes the same stages wait\n");
}

// One event for all barriers that are set and awaited at the same places.
TEST(SplitBarriers, ShareAnEvent) {
  std::string body = kFrame;
  body.insert(0, "image normal : rgba8 view\n");
  body.replace(body.find("color mask"), 10, "color normal clear 0  color mask");
  body.replace(body.find("read albedo"), 11, "read normal as sampled  read albedo");
  const PlanData plan = planned(body, true).plan;
  EXPECT_EQ(halves(plan), "gbuffer set:normal albedo trace halo await:normal albedo lighting show ");
  EXPECT_EQ(std::count_if(plan.groups.begin(), plan.groups.end(), [](const BarrierGroup& group) { return group.event != kNone; }), 1);
  EXPECT_EQ(plan.groups.back().event, 0u) << "split groups come after all others";
}

// Conditions do not matter: barriers run either way.
TEST(SplitBarriers, GoOverPassesThatMayBeSkipped) {
  std::string body = kFrame;
  const size_t begin = body.find("pass halo"), end = body.find("pass lighting");
  body.insert(end, "} ");
  body.insert(begin, "if host sometimes { ");
  body.replace(body.find("color glow clear 0"), 18, "color glow");
  body.replace(body.find("pass trace"), 0, "pass dark : raster { color glow clear 0 }\n");
  const FramePlan plan = planned(body, true);
  EXPECT_NE(halves(plan.plan).find("set:albedo"), std::string::npos) << halves(plan.plan);
  EXPECT_EQ(plan.unproved, 0u);
}

TEST(SplitBarriers, NeverCountAsPointsOfTheirQueue) {
  const PlanData with = planned(kFrame, true).plan, without = planned(kFrame, false).plan;
  ASSERT_EQ(with.acquires.size(), without.acquires.size());
  for (size_t i = 0; i < with.acquires.size(); ++i) EXPECT_EQ(with.acquires[i].point, without.acquires[i].point);
  for (size_t i = 0; i < with.releases.size(); ++i) EXPECT_EQ(with.releases[i].point, without.releases[i].point);
  EXPECT_EQ(with.estimated_heap_bytes, without.estimated_heap_bytes);
}

}  // namespace
}  // namespace rg::compiler
