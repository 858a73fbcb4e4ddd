// Instances that follow each other, share a heap, record into the engine's commands, and change their active extents.
#include "runtime/functions.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using Turns = test::NullTest;

const uint32_t kStep = 1;
const std::span<const std::byte> kParams[] = {std::as_bytes(std::span(&kStep, 1))};
void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

FrameInputs inputs() {
  FrameInputs in;
  in.params = kParams, in.callbacks = kIgnore;
  return in;
}

TEST_F(Turns, ASuccessorGoesOnWithTheHistory) {
  test::Counter t = test::counter();
  GraphInstance first = make(t.plan);
  for (int frame = 0; frame < 3; ++frame) this->frame(first, inputs());
  EXPECT_TRUE(first.history_valid(t.state));
  log.clear();
  GraphOptions options;
  options.frames_in_flight = 4;
  Result<GraphInstance> second = GraphInstance::create_successor(first, t.plan.view(), options);
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(second->frame(), 3u);
  EXPECT_TRUE(second->history_valid(t.state));
  EXPECT_EQ(test::calls(log, "vkCreateBuffer bytes 256 usage 0x23").size(), 0u);  // `state` is shared
  EXPECT_TRUE(test::calls(log, "vkCmdFillBuffer").empty());
  const std::string text = frame(*second, inputs());
  // It waits for the first one's last frame, and begins behind everything.
  EXPECT_NE(test::calls(text, "vkQueueSubmit2").at(0).find("wait semaphore1="), std::string::npos);
  EXPECT_EQ(test::calls(text, "vkCmdPipelineBarrier2").at(0).substr(32), "[memory 0x10000/0x10000->0x10000/0x18000]");
  // Copies go on in their phase: frame 3 writes the copy that frame 1 wrote.
  EXPECT_NE(text.find("buffer2"), std::string::npos);
}

TEST_F(Turns, AnotherShapeStartsAgain) {
  test::Counter t = test::counter(), other = test::counter();
  other.plan.resources[other.state].bytes = other.plan.constant(128 * 4);
  GraphInstance first = make(t.plan);
  frame(first, inputs());
  Result<GraphInstance> second = GraphInstance::create_successor(first, other.plan.view(), {});
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_FALSE(second->history_valid(t.state));
  EXPECT_FALSE(test::calls(log, "vkCmdFillBuffer").empty());
}

TEST_F(Turns, InstancesAlternateWithoutWaitingOnTheHost) {
  test::Counter t = test::counter();
  GraphInstance a = make(t.plan);
  frame(a, inputs());
  Result<GraphInstance> b = GraphInstance::create_successor(a, t.plan.view(), {});
  ASSERT_TRUE(b) << b.error().message;
  log.clear();
  GraphInstance* turn[] = {&*b, &a};
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(turn[i % 2]->continue_from(*turn[(i + 1) % 2]));
    ASSERT_TRUE(turn[i % 2]->execute(inputs()));
    EXPECT_EQ(turn[i % 2]->frame(), static_cast<uint64_t>(i) + 2);
  }
  EXPECT_EQ(test::calls(log, "vkQueueSubmit2").size(), 4u);
}

TEST_F(Turns, AHeapIsOneAllocationAndUsersWaitForEachOther) {
  test::Aliased t = test::aliased();
  GraphOptions options;
  options.heap = make_transient_heap();
  GraphInstance a = make(t.plan, options);
  Result<GraphInstance> b = GraphInstance::create(device, t.plan.view(), options);
  ASSERT_TRUE(b) << b.error().message;
  EXPECT_EQ(test::calls(log, "vkAllocateMemory bytes 65536 type 0").size(), 0u);  // the transients' block is there already
  EXPECT_EQ(test::calls(frame(a), "vkQueueSubmit2").at(0).find("wait"), std::string::npos);
  EXPECT_NE(test::calls(frame(*b), "vkQueueSubmit2").at(0).find("wait"), std::string::npos);
  EXPECT_EQ(test::calls(frame(*b), "vkQueueSubmit2").at(0).find("wait"), std::string::npos);
  EXPECT_NE(test::calls(frame(a), "vkQueueSubmit2").at(0).find("wait"), std::string::npos);
}

TEST_F(Turns, OwnCommandsGetTheFrameInParts) {
  test::Relay t = test::relay();
  constexpr uint32_t given[64] = {};
  const std::span<const std::byte> updates[] = {std::as_bytes(std::span(given))};
  GraphInstance graph = make(t.plan);
  VkCommandPoolCreateInfo pool_info{};
  VkCommandPool pool = VK_NULL_HANDLE;
  ASSERT_EQ(device.vk().CreateCommandPool(device.handle(), &pool_info, nullptr, &pool), VK_SUCCESS);
  VkCommandBuffer commands[2];
  VkCommandBufferAllocateInfo info{};
  info.commandPool = pool, info.commandBufferCount = 2;
  ASSERT_EQ(device.vk().AllocateCommandBuffers(device.handle(), &info, commands), VK_SUCCESS);
  const OwnCommands parts[] = {{commands[0], 1}, {commands[1], kNone}};
  FrameInputs in = inputs();
  in.updates = updates;
  const VkSemaphore done = reinterpret_cast<VkSemaphore>(uintptr_t{2});  // one that the null device knows
  ASSERT_TRUE(graph.use_commands(parts, {done, 1}));
  const std::string text = frame(graph, in);
  EXPECT_TRUE(test::calls(text, "vkQueueSubmit2").empty());
  EXPECT_TRUE(test::calls(text, "vkBeginCommandBuffer").empty());
  EXPECT_FALSE(test::calls(text, "vkCmdCopyBuffer").empty());
  EXPECT_FALSE(test::calls(text, "vkCmdDispatch").empty());
  // Where batches would wait, everything waits: three times, and once behind the prologue.
  size_t waits = 0;
  for (const std::string& line : test::calls(text, "vkCmdPipelineBarrier2")) waits += line.ends_with("[memory 0x10000/0x10000->0x10000/0x18000]");
  EXPECT_EQ(waits, 4u);
  EXPECT_EQ(graph.frame(), 1u);
  EXPECT_EQ(test::message(graph.use_commands({}, {done, 2})), "graph `test`: own commands need 1 to 64 command buffers and a timeline semaphore");
  const OwnCommands wrong[] = {{commands[0], 2}, {commands[1], 0}, {commands[1], kNone}};
  ASSERT_TRUE(graph.use_commands(wrong, {done, 2}));
  EXPECT_EQ(test::message(graph.execute(in)), "own commands: their last passes are not in the order in which passes are recorded");
  device.vk().DestroyCommandPool(device.handle(), pool, nullptr);
}

TEST_F(Turns, OneResourceIsResetBetweenFrames) {
  test::Counter t = test::counter();
  GraphInstance graph = make(t.plan);
  for (int i = 0; i < 3; ++i) frame(graph, inputs());
  ASSERT_TRUE(graph.invalidate(t.state));
  ASSERT_TRUE(graph.invalidate(t.state));  // once is enough
  EXPECT_TRUE(graph.history_valid(t.state));
  const std::string text = frame(graph, inputs());
  EXPECT_FALSE(test::calls(frame(graph, inputs()), "vkCmdFillBuffer").size());  // the frame after is as usual
  // Behind everything before, the copy that this frame reads gets its value again; the one it writes is left alone.
  const std::vector<std::string> fills = test::calls(text, "vkCmdFillBuffer"), submits = test::calls(text, "vkQueueSubmit2");
  ASSERT_EQ(fills.size(), 1u);
  EXPECT_TRUE(fills[0].ends_with(" 7") || fills[0].find("0x7") != std::string::npos) << fills[0];
  EXPECT_EQ(test::calls(text, "vkCmdPipelineBarrier2").at(0).substr(32), "[memory 0x10000/0x10000->0x900000000/0x1000]");
  ASSERT_EQ(submits.size(), 2u);
  EXPECT_NE(submits[0].find("wait semaphore1="), std::string::npos);
  EXPECT_EQ(test::calls(text, "vkCreateBuffer").size() + test::calls(text, "vkAllocateMemory").size(), 0u);
}

TEST_F(Turns, HistoryIsInvalidUntilAFrameWroteAgain) {
  test::Counter t = test::counter();
  GraphInstance graph = make(t.plan);
  frame(graph, inputs());
  EXPECT_TRUE(graph.history_valid(t.state));
  ASSERT_TRUE(graph.invalidate(t.state));
  ASSERT_FALSE(graph.execute({}));  // no parameters: the reset has happened, the frame has not
  EXPECT_FALSE(graph.history_valid(t.state));
  frame(graph, inputs());
  EXPECT_TRUE(graph.history_valid(t.state));
}

TEST_F(Turns, OnlyWhatDeclaresAValueIsReset) {
  test::Counter t = test::counter();
  t.plan.resources[t.state].init = InitKind::none;
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(test::message(graph.invalidate(t.state)), "`state` declares no initial value to go back to");
  EXPECT_EQ(test::message(graph.invalidate(t.result)), "graph `test`: only history and persistent resources are invalidated; `result` is neither");
  EXPECT_EQ(test::message(graph.invalidate(99)), "graph `test`: only history and persistent resources are invalidated");
}

TEST_F(Turns, ActiveExtentsPlaceNothing) {
  test::Tint t = test::tint();
  GraphInstance graph = make(t.plan);
  const int64_t half[] = {4, 2, 1}, larger[] = {16, 4, 1}, whole[] = {8, 4, 1};
  log.clear();
  ASSERT_TRUE(graph.set_active(half));
  EXPECT_EQ(log, "");
  std::string text = frame(graph, inputs());
  for (const std::string& line : test::calls(text, "vkCmdBeginRendering")) EXPECT_NE(line.find("4x2"), std::string::npos) << line;
  EXPECT_EQ(test::message(graph.set_active(larger)), "active extent 16 is larger than the one that memory was placed for: 8; resize first");
  ASSERT_TRUE(graph.set_active(whole));
  text = frame(graph, inputs());
  for (const std::string& line : test::calls(text, "vkCmdBeginRendering")) EXPECT_NE(line.find("8x4"), std::string::npos) << line;
}

}  // namespace
}  // namespace rg
