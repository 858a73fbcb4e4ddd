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

TEST(Harmless, BlendingWithWhatTheRenderingDrew) {
  for (const bool covered : {false, true}) {
    Damaged d;
    const auto x = d.Builder::image("x");
    d.lifetime(x, dsl::Lifetime::transient);
    d.image_barrier(x, Layout::general, Layout::color_attachment, stage::color_attachment_output, 0, stage::color_attachment_output,
                    access::color_attachment_read | access::color_attachment_write, {aspect_color, 0, 1, 0, 1});
    d.raster("draw", {covered ? writes(x, Role::color).covering() : updates(x, Role::color)});
    d.raster("blend", {updates(x, Role::color)});
    d.merge_rendering();
    EXPECT_EQ(d.harmless().unseen(0, 0, access::color_attachment_read), covered ? "blending with what the rendering drew" : "");
    EXPECT_EQ(d.harmless().unseen(0, 0, access::color_attachment_write), "");
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

struct Waiting : Damaged {
  dsl::ResourceId image = depth();
  explicit Waiting(const std::vector<Do>& passes) {
    const Index other = queue(QueueKind::compute);
    batch(other);
    signal(stage::compute_shader);
    batch(0);
    wait(other, 1, stage::vertex_shader | kBoth);
    wait(other, 1, stage::fragment_shader | kBoth);
    for (const Do& access : passes) raster("draw", {access});
  }
};

// As in random graph 6,745: the clear comes after a stage that waits, by a barrier.
TEST(Harmless, WaitForTestsThatABarrierOrders) {
  for (const Stages from : {stage::compute_shader, stage::copy}) {
    Damaged d;
    const auto depth = d.depth();
    const Index other = d.queue(QueueKind::compute);
    d.batch(other);
    d.signal(stage::compute_shader);
    d.batch(0);
    d.wait(other, 1, stage::compute_shader | kBoth);
    d.image_barrier(depth, Layout::general, Layout::general, from, 0, kEarly, 0);
    d.raster("draw", {writes(depth, Role::depth).cleared()});
    EXPECT_EQ(d.harmless().unwaited(0, kEarly), from == stage::compute_shader ? kOwnClear : "");
    EXPECT_EQ(d.harmless().unwaited(0, stage::compute_shader), "");
  }
}

TEST(Harmless, WaitForTestsThatAnEarlierStageWaitsFor) {
  Waiting waiting({writes(dsl::ResourceId{size_t{0}}, Role::depth).cleared(), updates(dsl::ResourceId{size_t{0}}, Role::depth)});
  const Harmless harmless = waiting.harmless();
  EXPECT_EQ(harmless.unwaited(0, kLate), kOwnClear);
  EXPECT_EQ(harmless.unwaited(0, kEarly), kOwnClear);
  EXPECT_EQ(harmless.unwaited(0, stage::vertex_shader), "");
  EXPECT_EQ(harmless.unwaited(1, kLate), kOwnClear) << "early tests wait";
  EXPECT_EQ(harmless.unwaited(1, kEarly), "") << "fragment shaders do not come before early tests";
}

TEST(Harmless, WaitForTestsOfWhatIsKept) {
  Waiting waiting({updates(dsl::ResourceId{size_t{0}}, Role::depth), writes(dsl::ResourceId{size_t{0}}, Role::depth).cleared()});
  EXPECT_EQ(waiting.harmless().unwaited(0, kLate), "");
  EXPECT_EQ(waiting.harmless().unwaited(0, kEarly), "");
}

// Queue 0 writes two mips, queue 1 waits for it, and queue 0 for queue 1; then one mip is written again, and one barrier covers both. As in random
// graph 9,275.
struct RoundTrip : Damaged {
  dsl::ResourceId image = Builder::image("image", dsl::Format::rgba16f, 2);
  dsl::PassId first;
  Stages signalled = stage::compute_shader, waited = stage::fragment_shader;
  bool reads_between = false;
  explicit RoundTrip() { lifetime(image, dsl::Lifetime::transient); }
  std::string narrower() {
    const Index other = queue(QueueKind::compute);
    batch(0);
    first = compute("both", {writes(image)});
    signal(signalled);
    batch(other);
    wait(0, 1, stage::compute_shader);
    signal(stage::all_commands);
    batch(0);
    wait(other, 1, waited);
    if (reads_between) compute("between", {reads(image).mip(1)});
    compute("again", {writes(image).mip(0)});
    image_barrier(image, Layout::general, Layout::general, stage::compute_shader, access::shader_storage_write, stage::fragment_shader,
                  access::shader_storage_read, {aspect_color, 0, 2, 0, 1});
    raster("read", {reads(image)});
    for (Access& row : plan.accesses) row.stages = stage::compute_shader;
    return harmless().narrower(0, 1, 0);
  }
};

TEST(Harmless, PartOfABarrierForWhichASemaphoreHasWaited) {
  RoundTrip trip;
  EXPECT_EQ(trip.narrower(), "part of a barrier for which a semaphore has waited");
  EXPECT_EQ(trip.harmless().narrower(0, 0, 0), "") << "it was written after the wait";
  trip.condition(trip.first, "night");
  EXPECT_EQ(trip.harmless().narrower(0, 1, 0), "") << "the frame before may have written it last";
}

TEST(Harmless, SemaphoresThatDoNotLeadThere) {
  RoundTrip signal, wait, between;
  signal.signalled = stage::copy;
  EXPECT_EQ(signal.narrower(), "");
  wait.waited = stage::vertex_shader;
  EXPECT_EQ(wait.narrower(), "");
  between.reads_between = true;
  EXPECT_EQ(between.narrower(), "");
}

}  // namespace
}  // namespace rg::verify
