// Which damage a class takes for harmless, on small plans by hand; that nothing more survives, random graphs show.
#include "compiler/verify/harmless.h"

#include "tests/unit/verify/litmus.h"

namespace rg::verify {
namespace {

constexpr Stages kEarly = stage::early_fragment_tests, kLate = stage::late_fragment_tests, kBoth = kEarly | kLate;
constexpr Accesses kTest = access::depth_stencil_attachment_read, kDraw = access::depth_stencil_attachment_write;
constexpr const char* kOwnClear = "tests against the pass's own clear";

struct Damaged : Builder {
  dsl::ResourceId depth(uint32_t layers = 1) {
    const dsl::ResourceId id = image("depth", dsl::Format::d32f, 1, layers);
    lifetime(id, dsl::Lifetime::transient);
    planned(id).aspects = aspect_depth;
    return id;
  }
  void barrier(dsl::ResourceId id, Accesses accesses, uint32_t layers = 1) {
    image_barrier(id, Layout::general, Layout::general, stage::compute_shader, 0, kBoth, accesses, {aspect_depth, 0, 1, 0, layers});
  }
  Plan plan_now;
  Harmless harmless() {
    plan_now = view();
    return {program, dsl::GraphId{size_t{0}}, plan_now, plan.program_pass};
  }
};

TEST(Harmless, TestBehindAClearNeedsNothingFromBefore) {
  Damaged d;
  const auto depth = d.depth();
  d.barrier(depth, kTest);
  d.raster("draw", {writes(depth, Role::depth).cleared()});
  const Harmless harmless = d.harmless();
  EXPECT_EQ(harmless.unseen(0, kLate, 0), kOwnClear);
  EXPECT_EQ(harmless.unseen(0, 0, kTest), kOwnClear);
  EXPECT_EQ(harmless.unseen(0, kEarly, 0), "") << "the clear itself";
  EXPECT_EQ(harmless.unseen(0, stage::fragment_shader, 0), "");
  EXPECT_EQ(harmless.unseen(0, 0, access::shader_sampled_read), "");
}

TEST(Harmless, LateTestsHaveToSeeTheWriteBefore) {
  Damaged d;
  const auto depth = d.depth();
  d.barrier(depth, kTest | kDraw);
  d.raster("draw", {writes(depth, Role::depth).cleared()});
  EXPECT_EQ(d.harmless().unseen(0, kLate, 0), "");
  EXPECT_EQ(d.harmless().unseen(0, 0, kDraw), "");
  EXPECT_EQ(d.harmless().unseen(0, 0, kTest), kOwnClear);
}

TEST(Harmless, TestOfWhatIsKeptSeesWhatWasBefore) {
  Damaged d;
  const auto depth = d.depth();
  d.barrier(depth, kTest);
  d.raster("draw", {updates(depth, Role::depth)});
  d.raster("again", {writes(depth, Role::depth).cleared()});
  EXPECT_EQ(d.harmless().unseen(0, kLate, 0), "");
  EXPECT_EQ(d.harmless().unseen(0, 0, kTest), "");
}

TEST(Harmless, EveryLayerIsClearedFirst) {
  for (const bool cleared : {false, true}) {
    Damaged d;
    const auto depth = d.depth(2);
    d.barrier(depth, kTest, kRemaining);
    d.raster("one", {writes(depth, Role::depth).cleared().layer(0)});
    d.raster("two", {(cleared ? writes(depth, Role::depth).cleared() : updates(depth, Role::depth)).layer(1)});
    EXPECT_EQ(d.harmless().unseen(0, 0, kTest), cleared ? kOwnClear : "");
  }
}

TEST(Harmless, NextFrameMayTest) {
  for (const dsl::Lifetime lifetime : {dsl::Lifetime::transient, dsl::Lifetime::persistent}) {
    Damaged d;
    const auto depth = d.depth();
    d.lifetime(depth, lifetime);
    d.barrier(depth, kTest);
    EXPECT_EQ(d.harmless().unseen(0, 0, kTest), lifetime == dsl::Lifetime::transient ? kOwnClear : "");
  }
}

TEST(Harmless, WaitForTestsThatAnEarlierStageWaitsFor) {
  for (const bool cleared : {false, true}) {
    Damaged d;
    const auto depth = d.depth();
    const Index other = d.queue(QueueKind::compute);
    d.batch(other);
    d.signal(stage::compute_shader);
    d.batch(0);
    d.wait(other, 1, stage::vertex_shader | kBoth);
    d.wait(other, 1, kBoth);
    d.raster("draw", {cleared ? writes(depth, Role::depth).cleared() : updates(depth, Role::depth)});
    const Harmless harmless = d.harmless();
    EXPECT_EQ(harmless.unwaited(0, kLate), cleared ? kOwnClear : "");
    EXPECT_EQ(harmless.unwaited(0, kEarly), cleared ? kOwnClear : "");
    EXPECT_EQ(harmless.unwaited(0, stage::vertex_shader), "");
    EXPECT_EQ(harmless.unwaited(1, kLate), "");
  }
}

}  // namespace
}  // namespace rg::verify
