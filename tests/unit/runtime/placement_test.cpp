// Memory: what shares bytes, what hands them on, and what mips and ranges become at other extents.
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using Placement = test::NullTest;

TEST_F(Placement, OrderedLivesShareBytes) {
  test::Aliased t = test::aliased();
  GraphInstance graph = make(t.plan);
  const MemoryReport memory = graph.memory();
  EXPECT_EQ(memory.heap_bytes, 65536u);
  EXPECT_EQ(memory.unaliased_bytes, 131072u);
  EXPECT_EQ(memory.lower_bound_bytes, 65536u);
  EXPECT_EQ(memory.host_bytes, 4u * 16384);  // two buffers, two frames in flight
  EXPECT_EQ(memory.persistent_bytes, 0u);
  const std::vector<PlacedResource> placed = graph.placements();
  ASSERT_EQ(placed.size(), 6u);
  EXPECT_EQ(placed[0].name, "a");
  EXPECT_EQ(placed[0].offset, placed[1].offset);
}

TEST_F(Placement, LivesOfUnknownOrderDoNot) {
  test::Aliased t = test::aliased();
  t.plan.alias_clocks[1] = kNone;  // b may not give its bytes back to a
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(graph.memory().heap_bytes, 131072u);
}

TEST_F(Placement, HandOffsNameTheLastUsersOfTheBytes) {
  test::Aliased t = test::aliased();
  t.plan.image_barriers[2].src_stages = stage::none;  // b alone would wait for nobody
  GraphInstance graph = make(t.plan);
  const std::vector<std::string> barriers = test::calls(frame(graph), "vkCmdPipelineBarrier2");
  // One memory barrier, and the same first scope in the barrier that discards.
  EXPECT_EQ(barriers.at(2).substr(barriers[2].find('[')),
            "[memory 0x100000000/0x0->0x800000000/0x1000][image2 0x100000000/0x0->0x800000000/0x1000 layout 0->7 aspects 1 mips 0+1 layers 0+1]");
  GraphOptions options;
  options.aliasing = false;
  GraphInstance apart = make(t.plan, options);
  EXPECT_EQ(test::calls(frame(apart), "vkCmdPipelineBarrier2").at(2).find("memory"), std::string::npos);
}

TEST_F(Placement, PoisonFillsWhatIsAcquired) {
  test::Aliased t = test::aliased();
  GraphOptions options;
  options.poison = true;
  GraphInstance graph = make(t.plan, options);
  const std::string text = frame(graph);
  const std::vector<std::string> clears = test::calls(text, "vkCmdClearColorImage");
  ASSERT_EQ(clears.size(), 4u);
  EXPECT_NE(clears[0].find("image1 7 0x7fc07fc0"), std::string::npos);
  EXPECT_NE(clears[2].find("image2 7 0x7fc07fc0"), std::string::npos);
  EXPECT_NE(text.find("layout 7->7"), std::string::npos);  // the plan's barrier starts from the fill
}

TEST_F(Placement, PoisonFillsOnceWhereTheGroupHasPhases) {
  test::Aliased t = test::aliased();
  const Index history = t.plan.buffer("history", t.plan.constant(64), test::kStorageBuffer, Lifetime::history);
  t.plan.resources[history].copies = 2;
  t.plan.groups[0].first_buffer = static_cast<Index>(t.plan.buffer_barriers.size()), t.plan.groups[0].buffer_count = 1;
  t.plan.buffer_barriers.push_back(
      test::buffer_barrier({history, 1}, stage::compute_shader, access::shader_storage_write, stage::compute_shader, access::shader_storage_read));
  GraphOptions options;
  options.poison = true;
  GraphInstance graph = make(t.plan, options);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(test::calls(frame(graph), "vkCmdClearColorImage").size(), 4u);
}

TEST_F(Placement, MipsAreClampedToTheFullChain) {
  test::Mips t = test::mips();
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(test::calls(frame(graph), "vkCmdClearColorImage").size(), 4u);
  const int64_t extents[] = {3, 2, 1};
  log.clear();
  ASSERT_TRUE(graph.resize(extents));
  EXPECT_NE(test::calls(log, "vkCreateImage ").at(0).find("3x2x1 mips 2 "), std::string::npos);
  const std::string text = frame(graph);
  EXPECT_EQ(test::calls(text, "vkCmdClearColorImage").size(), 2u);
  EXPECT_EQ(test::calls(text, "vkCmdPipelineBarrier2").size(), 2u);
}

TEST_F(Placement, RangesAreCutAtTheLastMip) {
  test::Mips t = test::mips();
  t.plan.image_barriers[1].range.mips = 3;
  GraphInstance graph = make(t.plan);
  const int64_t extents[] = {4, 4, 1};
  ASSERT_TRUE(graph.resize(extents));
  EXPECT_NE(test::calls(frame(graph), "vkCmdPipelineBarrier2").at(1).find("mips 1+2"), std::string::npos);
}

TEST_F(Placement, ResizedStateLivesUntilItsFramesAreDone) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphInstance graph = make(t.plan);
  frame(graph);
  const int64_t extents[] = {16, 16, 1};
  log.clear();
  ASSERT_TRUE(graph.resize(extents));
  EXPECT_TRUE(test::calls(log, "vkDestroyImage").empty());
  EXPECT_EQ(test::calls(frame(graph), "vkDestroyImage ").size(), 1u);  // a null device is done at once
}

TEST_F(Placement, TooLargeForTheDevice) {
  test::ClearAndCopy t = test::clear_and_copy();
  t.plan.extents[0].maximum[0] = 100000;
  GraphInstance graph = make(t.plan);
  const int64_t extents[] = {20000, 4, 1};
  EXPECT_EQ(test::message(graph.resize(extents)), "image `color`: a side of 20000 texels; this device allows 16384");
}

// ---- memory of its own ----------------------------------------------------------------------------------------------

// Allocations of a new instance: "bytes 65536 type 0".
std::vector<std::string> allocations(Device& device, std::string& log, test::TestPlan& plan, MemoryReport& memory, const GraphOptions& options = {}) {
  log.clear();
  Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), options);
  if (!graph) ADD_FAILURE() << graph.error().message;
  if (graph) memory = graph->memory();
  std::vector<std::string> found;
  for (const std::string& line : test::calls(log, "vkAllocateMemory ")) found.push_back(line.substr(17, line.find(" ->") - 17));
  return found;
}
bool has(const std::vector<std::string>& rows, const std::string& row) { return std::find(rows.begin(), rows.end(), row) != rows.end(); }

TEST_F(Placement, WhatMayLiveOnTheChipLeavesTheHeapWhereThatIs) {
  test::Aliased t = test::aliased();
  const Index chip = t.plan.image("chip", test::kRgba8, t.plan.constant(8), t.plan.constant(8), test::kColorAttachment);
  t.plan.resources[chip].lazy = true;
  Device tiled = Device::null(&log, {.lazy_memory = true});
  MemoryReport memory;
  EXPECT_TRUE(has(allocations(tiled, log, t.plan, memory), "bytes 65536 type 2"));
  EXPECT_NE(log.find("usage 0x50"), std::string::npos) << "a transient colour attachment";
  EXPECT_EQ(memory.heap_bytes, 65536u);
  EXPECT_EQ(memory.lazy_bytes, 65536u);
  EXPECT_FALSE(has(allocations(device, log, t.plan, memory), "bytes 65536 type 2"));
  EXPECT_EQ(memory.heap_bytes, 131072u);
  EXPECT_EQ(memory.lazy_bytes, 0u);
  GraphOptions options;
  options.poison = true;  // fills it, which no attachment could be
  allocations(tiled, log, t.plan, memory, options);
  EXPECT_EQ(memory.lazy_bytes, 0u);
}

TEST_F(Placement, DriversGetTheMemoryTheyRequire) {
  test::Aliased t = test::aliased();
  MemoryReport memory;
  Device device = Device::null(&log, {.requires_dedicated = true});
  const auto rows = allocations(device, log, t.plan, memory);
  EXPECT_TRUE(has(rows, "bytes 65536 type 0 for image1") && has(rows, "bytes 65536 type 0 for image2"));
  EXPECT_EQ(memory.heap_bytes, 131072u);
}

TEST_F(Placement, WhatDriversPreferGivesWayToSharing) {
  test::Aliased t = test::aliased();
  Device device = Device::null(&log, {.prefers_dedicated = true});
  MemoryReport memory;
  for (const std::string& row : allocations(device, log, t.plan, memory)) EXPECT_EQ(row.find(" for "), std::string::npos) << row;
  EXPECT_EQ(memory.heap_bytes, 65536u);
  t.plan.resources[t.b].no_alias = true;
  const Index past = t.plan.image("past", test::kRgba8, t.plan.constant(8), t.plan.constant(8), test::kSampled);
  t.plan.resources[past].lifetime = Lifetime::history, t.plan.resources[past].copies = 2;
  Device fresh = Device::null(&log, {.prefers_dedicated = true});
  const auto rows = allocations(fresh, log, t.plan, memory);
  for (const char* image : {"2", "3", "4"}) EXPECT_TRUE(has(rows, std::string("bytes 65536 type 0 for image") + image)) << image;
  EXPECT_FALSE(has(rows, "bytes 65536 type 0 for image1"));
  EXPECT_EQ(memory.heap_bytes, 131072u);
  EXPECT_EQ(memory.persistent_bytes, 131072u);
}

// ---- prologue -----------------------------------------------------------------------------------------------------

TEST_F(Placement, PrologueClearsWhatTheFirstFrameReads) {
  test::Counter t = test::counter();
  ASSERT_TRUE(GraphInstance::create(device, t.plan.view(), {}));
  EXPECT_EQ(test::calls(log, "vkCmdFillBuffer"), (std::vector<std::string>{"vkCmdFillBuffer commands1 buffer2 0 18446744073709551615 7"}));
  EXPECT_EQ(test::calls(log, "vkCmdPipelineBarrier2").at(0),
            "vkCmdPipelineBarrier2 commands1 [buffer2 0x900000000/0x1000->0x800/0x400000000 bytes 0+rest]");
}

TEST_F(Placement, PrologueGivesHistoryImagesTheirLayout) {
  test::TestPlan p;
  const Index side = p.constant(4), image = p.image("color", test::kRgba8, side, side, test::kCopyDst);
  p.resources[image].lifetime = Lifetime::history, p.resources[image].copies = 3, p.resources[image].init = InitKind::clear;
  p.entry.push_back({{image, 0}, {}, stage::copy, access::none, Layout::undefined, kNone, true});
  p.entry.push_back({{image, 1}, {}, stage::fragment_shader, access::none, Layout::shader_read_only});
  p.entry.push_back({{image, 2}, {}, stage::fragment_shader, access::none, Layout::shader_read_only});
  ASSERT_TRUE(GraphInstance::create(device, p.view(), {}));
  const std::vector<std::string> clears = test::calls(log, "vkCmdClearColorImage");
  ASSERT_EQ(clears.size(), 2u);  // frame 0 is copy 0: the others are history
  EXPECT_NE(clears[0].find("image3"), std::string::npos);
  EXPECT_NE(clears[1].find("image2"), std::string::npos);
  const std::string barrier = test::calls(log, "vkCmdPipelineBarrier2").at(1);
  EXPECT_NE(barrier.find("[image3 0x800000000/0x1000->0x80/0x0 layout 7->5"), std::string::npos) << barrier;
}

}  // namespace
}  // namespace rg
