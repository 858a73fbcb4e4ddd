// Lifetimes, allowed pairs, and hand-offs of memory.
#include "runtime/alias.h"
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

// a lives in the first two segments, c in the last two: c may take a's bytes.
constexpr char kChain[] =
    "image a : rgba16f view\n image b : rgba16f view\n image c : rgba16f view\n"
    "pass first : compute { write a as storage }\n"
    "pass second : compute { read a as sampled  write b as storage }\n"
    "pass third : compute { read b as sampled  write c as storage }\n"
    "pass show : raster { read c as sampled in fragment  color backbuffer covers }\n";

// Who may take whose bytes, where they may go to and fro.
std::string pairs_text(const PlanData& plan) {
  const Plan view = plan.view();
  const alias::Sharing sharing(view);
  std::string text;
  for (Index after = 0; after < plan.resources.size(); ++after)
    for (Index before = 0; before < plan.resources.size(); ++before)
      if (sharing.may_share(before, after))
        text += std::string(plan.resources[before].name) + " -> " + std::string(plan.resources[after].name) +
                (sharing.may_follow(before, after, false) ? "\n" : " next frame\n");
  return text;
}

std::vector<alias::Placed> estimated_placement(const PlanData& plan) {
  std::vector<alias::Placed> placed;
  for (const Resource& resource : plan.resources)
    placed.push_back(resource.lifetime == rg::Lifetime::transient ? alias::Placed{resource.estimated_offset, resource.estimated_bytes}
                                                                  : alias::Placed{});
  return placed;
}

TEST(Memory, DisjointLivesMayShareInBothDirections) {
  const FramePlan frame = plan_of(kChain);
  EXPECT_EQ(pairs_text(frame.plan), "c -> a next frame\na -> c\n");
  constexpr uint64_t kAligned = 65536;  // 64 * 64 * 8 bytes, rounded up
  EXPECT_EQ(frame.unaliased_bytes, 3 * kAligned);
  EXPECT_EQ(frame.heap_bytes, 2 * kAligned);
  EXPECT_EQ(frame.lower_bound_bytes, 2 * kAligned);
}

TEST(Memory, NoAliasingOnRequest) {
  const FramePlan frame = plan_of(kChain, {.aliasing = false});
  EXPECT_EQ(pairs_text(frame.plan), "");
  EXPECT_EQ(frame.heap_bytes, frame.unaliased_bytes);
}

TEST(Memory, NoAliasResourcesKeepTheirBytes) {
  std::string body = kChain;
  body.replace(body.find("image a : rgba16f view"), 22, "image a : rgba16f view no alias");
  const FramePlan frame = plan_of(body);
  EXPECT_EQ(pairs_text(frame.plan), "");
  EXPECT_TRUE(frame.plan.resources[resource_named(frame.plan, "a")].no_alias);
}

// What renderings neither load nor store, once they are merged, and nobody else sees.
std::string lazy_text(const FramePlan& frame) {
  std::string text;
  for (const Resource& resource : frame.plan.resources)
    if (resource.lazy) text += std::string(resource.name) + " ";
  return text;
}
TEST(Memory, AttachmentsOfOneRenderingMayLiveOnTheChip) {
  const char* body =
      "image many : rgba16f view samples 4\n image depth : d32f view samples 4\n image one : rgba16f view\n image map : d32f view\n image side : "
      "rgba16f view\n"
      "pass opaque : raster { color many clear 0  depth depth clear 0  draw host {} }\n"
      "pass glass : raster { color many  depth depth  resolve many -> one  draw host {} }\n"
      "pass shadow : raster { depth map clear 0  draw host {} }\n"
      "pass light : compute { read map as sampled  read one as sampled  write side as storage }\n"
      "pass show : raster { read side as sampled in fragment  color backbuffer covers }\n";
  const FramePlan frame = plan_of(body, {.reasons = true});
  EXPECT_EQ(lazy_text(frame), "many depth ");
  EXPECT_EQ(frame.lazy_bytes, 64u * 64 * 4 * (8 + 4));
  EXPECT_LE(frame.heap_beside_lazy_bytes + frame.lazy_bytes, frame.unaliased_bytes);
  EXPECT_LT(frame.heap_beside_lazy_bytes, frame.heap_bytes);
  EXPECT_EQ(lazy_text(plan_of(body, {.merge = false})), "") << "stored by one, loaded by the next";
  EXPECT_EQ(lazy_text(plan_of(body, {.no_discard = {"depth"}})), "many ");
}

TEST(Memory, HandOffWaitsForTheLastRealUsers) {
  const FramePlan frame = plan_of(kChain);
  const Plan plan = frame.plan.view();
  alias::HandOffs hand_offs;
  alias::find_hand_offs(plan, estimated_placement(frame.plan), hand_offs);
  // Within the frame: c takes over from a, last read by the compute shader. Next frame: a takes over from c, last read by the fragment shader.
  ASSERT_EQ(hand_offs.groups.size(), 2u);
  EXPECT_EQ(hand_offs.groups[0].group, 0u);
  EXPECT_EQ(hand_offs.groups[0].memory.src_stages, stage::fragment_shader);
  EXPECT_EQ(hand_offs.groups[1].group, 2u);
  EXPECT_EQ(hand_offs.groups[1].memory.src_stages, stage::compute_shader);
  EXPECT_EQ(hand_offs.groups[1].memory.src_accesses, access::none);
  EXPECT_EQ(hand_offs.groups[1].memory.dst_stages, stage::compute_shader);
  EXPECT_EQ(hand_offs.groups[1].memory.dst_accesses, access::shader_storage_write);
  EXPECT_EQ(hand_offs.groups[1].memory.tag, BarrierTag::alias_pair);
  ASSERT_EQ(hand_offs.images.size(), 2u);
  const ImageBarrier& barrier = frame.plan.image_barriers[hand_offs.images[1].first];
  EXPECT_EQ(frame.plan.resources[barrier.image.resource].name, "c");
  EXPECT_EQ(barrier.old_layout, Layout::undefined);
}

TEST(Memory, NothingSharedNothingHandedOver) {
  const FramePlan frame = plan_of(kChain);
  std::vector<alias::Placed> apart = estimated_placement(frame.plan);
  uint64_t offset = 0;
  for (alias::Placed& place : apart) place.offset = offset, offset += place.bytes;
  alias::HandOffs hand_offs;
  alias::find_hand_offs(frame.plan.view(), apart, hand_offs);
  EXPECT_TRUE(hand_offs.groups.empty());
  EXPECT_TRUE(hand_offs.images.empty());
}

TEST(Memory, OnlyTheLastHolderOfEachByteCounts) {
  alias::detail::Owners owners;
  std::vector<Index> seen;
  const auto see = [&](Index owner) { seen.push_back(owner); };
  owners.take(0, 100, 1, see);
  owners.take(50, 100, 2, see);
  owners.take(60, 10, 3, see);
  EXPECT_EQ(seen, (std::vector<Index>{1, 2}));
  seen.clear();
  owners.take(0, 200, 4, see);
  EXPECT_EQ(seen, (std::vector<Index>{1, 2, 3, 2}));
  seen.clear();
  owners.take(10, 10, 4, see);
  EXPECT_TRUE(seen.empty());
}

TEST(Memory, IntervalsFollowTheSteps) {
  const FramePlan frame = plan_of(kChain);
  const auto intervals = alias::group_intervals(frame.plan.view());
  const auto of = [&](const char* name) { return intervals[resource_named(frame.plan, name)]; };
  EXPECT_EQ(of("a").begin, 0u);
  EXPECT_EQ(of("a").end, 1u);
  EXPECT_EQ(of("c").begin, 2u);
  EXPECT_EQ(of("c").end, 3u);
}

// Every transient is acquired in the group before its first use and released by its last users.
TEST(Memory, EveryTransientIsAcquiredAndReleased) {
  const FramePlan frame = plan_of(kChain);
  ASSERT_EQ(frame.plan.acquires.size(), 3u);
  ASSERT_EQ(frame.plan.releases.size(), 3u);
  for (const Acquire& acquire : frame.plan.acquires) {
    EXPECT_EQ(acquire.image_barriers, 1u);
    EXPECT_EQ(frame.plan.image_barriers[acquire.image_barrier].image.resource, acquire.resource);
  }
  EXPECT_EQ(frame.plan.releases[2].stages, stage::fragment_shader);
  EXPECT_EQ(frame.plan.releases[2].accesses, access::none);
}

}  // namespace
}  // namespace rg::compiler
