// What reaches the tables of a plan: loads and stores, work, slots, guards, sizes.
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

TEST(Emit, LoadsAndStoresFollowWhatIsThereAndWhatIsNeeded) {
  const FramePlan frame = plan_of(
      "image hdr : rgba16f view\n image depth : d32f view\n"
      "pass first : raster { color hdr clear 0.5  depth depth clear 0.0 }\n"
      "pass second : raster { color hdr  depth depth }\n"
      "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n",
      {.no_merge = {"second"}});
  const Attachment &first = attachment_of(frame.plan, "first", "hdr"), &second_depth = attachment_of(frame.plan, "second", "depth");
  EXPECT_EQ(first.load, LoadOp::clear);
  EXPECT_EQ(first.store, StoreOp::store);
  EXPECT_EQ(first.clear.word[0], 0x3F000000u);
  EXPECT_EQ(attachment_of(frame.plan, "second", "hdr").load, LoadOp::load);
  EXPECT_EQ(second_depth.load, LoadOp::load);
  EXPECT_EQ(second_depth.store, StoreOp::dont_care) << "nobody reads depth afterwards";
  EXPECT_EQ(attachment_of(frame.plan, "show", "backbuffer").load, LoadOp::dont_care);
  EXPECT_EQ(attachment_of(frame.plan, "show", "backbuffer").store, StoreOp::store);
}

TEST(Emit, HistoryIsStoredForTheNextFrame) {
  const FramePlan frame = plan_of(
      "image hdr : rgba16f view history 1 init clear 0\n"
      "pass accumulate : raster { read hdr.prev(1) as sampled in fragment  color hdr covers }\n"
      "pass show : raster { color backbuffer covers }\n");
  EXPECT_EQ(attachment_of(frame.plan, "accumulate", "hdr").store, StoreOp::store);
  EXPECT_EQ(frame.plan.resources[resource_named(frame.plan, "hdr")].copies, 2u);
}

TEST(Emit, RenderingHasTheSizeOfItsMip) {
  const FramePlan frame = plan_of(
      "image hdr : rgba16f view mips 3 output\n"
      "pass draw : raster { color hdr.mip(2) clear 0 }\n"
      "pass show : raster { color backbuffer covers }\n");
  const Rendering& rendering = frame.plan.renderings[pass_named(frame.plan, "draw").rendering];
  const std::vector<int64_t> extents = {64, 40, 1};
  EXPECT_EQ(evaluate(frame.plan.exprs, rendering.width, extents), 16);
  EXPECT_EQ(evaluate(frame.plan.exprs, rendering.height, extents), 10);
  EXPECT_EQ(rendering.color_count, 1u);
  EXPECT_EQ(frame.plan.attachments[rendering.first_color].range.mip, 2u);
  EXPECT_EQ(frame.plan.attachments[rendering.first_color].range.mips, 1u);
}

TEST(Emit, DispatchOverASizeCountsGroups) {
  const FramePlan frame =
      plan_of(program_of_text("module test\nextent view = runtime(64, 64) max(128, 128)\n"
                              "graph frame(surface backbuffer: rgba8 view after copy_src) {\n"
                              "buffer b : u32[4] output\n"
                              "pass work : compute { shader \"x.comp\" group 8 8 1  write b as storage  dispatch over view }\n"
                              "pass show : raster { color backbuffer covers }\n}\n"));
  const Work& work = pass_named(frame.plan, "work").work;
  EXPECT_EQ(work.kind, WorkKind::dispatch);
  const std::vector<int64_t> extents = {65, 40, 1};
  EXPECT_EQ(evaluate(frame.plan.exprs, work.x, extents), 9);
  EXPECT_EQ(evaluate(frame.plan.exprs, work.y, extents), 5);
}

TEST(Emit, HostSlotsFollowTheProgramWhateverIsCulled) {
  const FramePlan frame = plan_of(
      "buffer a : u32[4]\n buffer b : u32[4] output\n"
      "pass dead : compute { write a as storage }\n"
      "pass kept : compute { write b as storage }\n"
      "pass show : raster { color backbuffer covers }\n");
  EXPECT_EQ(pass_named(frame.plan, "kept").host_slot, 1u);
  EXPECT_EQ(pass_named(frame.plan, "show").host_slot, 2u);
  EXPECT_EQ(pass_named(frame.plan, "kept").work.kind, WorkKind::host);
}

TEST(Emit, ConditionsBecomeGuardBits) {
  const FramePlan frame = plan_of(
      "image hdr : rgba16f view\n"
      "pass base : raster { color hdr clear 0 }\n"
      "if host sometimes { pass patch : raster { color hdr } }\n"
      "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n");
  EXPECT_EQ(pass_named(frame.plan, "base").guard, 0u);
  EXPECT_EQ(pass_named(frame.plan, "patch").guard, 1u);
  ASSERT_EQ(frame.plan.conditions.size(), 1u);
  EXPECT_EQ(frame.plan.conditions[0], "sometimes");
}

TEST(Emit, TransfersKnowTheirSides) {
  const FramePlan frame = plan_of(
      "image a : rgba8 view\n image b : rgba8 view\n buffer c : u32[16]\n"
      "pass draw : raster { color a clear 0 }\n"
      "pass move : transfer { copy a -> b  fill c 7 }\n"
      "pass show : raster { read b as sampled in fragment  read c as storage in fragment  color backbuffer covers }\n");
  const Work& work = pass_named(frame.plan, "move").work;
  ASSERT_EQ(work.kind, WorkKind::transfers);
  ASSERT_EQ(work.transfer_count, 2u);
  const Transfer &copy = frame.plan.transfers[work.first_transfer], &fill = frame.plan.transfers[work.first_transfer + 1];
  EXPECT_EQ(copy.kind, TransferKind::copy_image);
  EXPECT_EQ(copy.src.resource, resource_named(frame.plan, "a"));
  EXPECT_EQ(copy.dst.resource, resource_named(frame.plan, "b"));
  EXPECT_EQ(fill.kind, TransferKind::fill);
  EXPECT_EQ(fill.value.word[0], 7u);
  constexpr uint32_t kTransferSource = 0x1, kColorAttachment = 0x10;
  EXPECT_EQ(frame.plan.resources[copy.src.resource].usage, kTransferSource | kColorAttachment);
}

TEST(Emit, SamePlanTwice) {
  const std::string body =
      "image a : rgba16f view\n image b : rgba16f view mips 4\n"
      "pass one : compute { write a as storage }\n"
      "for i in 0..4 { pass two[i] : compute { read a as sampled  write target = b.mip(i) as storage } }\n"
      "pass show : raster { read b as sampled in fragment  color backbuffer covers }\n";
  const FramePlan first = plan_of(body, {.reasons = true}), second = plan_of(body, {.reasons = true});
  EXPECT_EQ(schedule_text(first.plan), schedule_text(second.plan));
  EXPECT_EQ(first.decisions, second.decisions);
  EXPECT_EQ(first.heap_bytes, second.heap_bytes);
}

TEST(Emit, EveryPassResourceAndBarrierIsExplained) {
  const FramePlan frame = plan_of(
      "image hdr : rgba16f view\n buffer lost : u32[4]\n"
      "pass light : compute { write hdr as storage }\n"
      "pass dead : compute { write lost as storage }\n"
      "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n",
      {.reasons = true});
  const auto has = [&](const std::string& subject, const std::string& what, const std::string& reason) {
    for (const Decision& decision : frame.decisions)
      if (decision.subject == subject && decision.what == what && decision.reason.find(reason) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(has("light", "kept", "`hdr` is used by `show`"));
  EXPECT_TRUE(has("dead", "culled", "nothing observable depends on `lost`"));
  EXPECT_TRUE(has("show", "scheduled", "read after write on `hdr` with `light`"));
  EXPECT_TRUE(has("hdr", "placed", "65536 bytes"));
  EXPECT_TRUE(has("group 1", "barrier", "`hdr`: read after write"));
}

// A pass that can stand in one place only is not told of others, and what the engine takes after the frame is no read of a pass.
TEST(Emit, ExplanationsDoNotContradictThemselves) {
  const auto reason = [](const FramePlan& frame, const std::string& subject, const std::string& what) {
    std::string last;
    for (const Decision& decision : frame.decisions)
      if (decision.subject == subject && decision.what == what) last = decision.reason;
    return last;
  };
  const FramePlan alone = plan_of("pass show : raster { color backbuffer clear 0 }\n", {.reasons = true});
  EXPECT_EQ(reason(alone, "show", "scheduled"), "after group 0");
  EXPECT_EQ(reason(alone, "backbuffer", "barrier"), "in group 1: for `after copy_src`; who comes after the frame finds it in that state");
  const FramePlan two = plan_of(
      "image a : rgba8 view output\n image b : rgba8 view\n pass one : compute { write b as storage }\n"
      "pass two : compute { read b as sampled  write a as storage }\n pass show : raster { color backbuffer clear 0 }\n",
      {.reasons = true});
  EXPECT_EQ(reason(two, "two", "scheduled"),
            "after group 1, as early as it can: read after write on `b` with `one` just before; without that access it could run earlier");
}

TEST(Emit, TheStencilBesideAResolvedDepthStays) {
  const FramePlan frame = plan_of(
      "image d : d32f_s8 view samples 4\n image r : d32f_s8 view output\n"
      "pass draw : raster { depth d clear 1  stencil d clear 0  resolve d.depth -> r.depth  draw host }\n"
      "pass show : raster { color backbuffer clear 0 }\n");
  const Rendering& rendering = frame.plan.renderings[pass_named(frame.plan, "draw").rendering];
  EXPECT_EQ(frame.plan.attachments[rendering.depth].resolve.resource, resource_named(frame.plan, "r"));
  EXPECT_EQ(frame.plan.attachments[rendering.stencil].resolve.resource, kNone);
}

}  // namespace
}  // namespace rg::compiler
