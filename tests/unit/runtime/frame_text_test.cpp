// One frame as the calls it makes.
#include "tests/unit/runtime/null_fixture.h"

namespace rg {
namespace {

using FrameText = test::NullTest;

TEST_F(FrameText, EstablishesNothingForTransientsThatAreDiscarded) {
  test::ClearAndCopy t = test::clear_and_copy();
  ASSERT_TRUE(GraphInstance::create(device, t.plan.view(), {}));
  EXPECT_TRUE(test::calls(log, "vkCmdPipelineBarrier2").empty());
  EXPECT_EQ(test::calls(log, "vkCreateImage ").at(0),
            "vkCreateImage type 1 format 37 8x4x1 mips 1 layers 1 samples 1 usage 0x3 flags 0x400 -> image1");
}

TEST_F(FrameText, WalksStepsInOrderAndSignalsTheTimeline) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphInstance graph = make(t.plan);
  std::vector<std::string> text = test::lines(frame(graph));
  std::erase_if(text, [](const std::string& line) { return line.find("Label") != std::string::npos || line.find("Timestamp") != std::string::npos; });
  const std::vector<std::string> expected = {
      "vkResetCommandPool command_pool2 0",
      "vkBeginCommandBuffer commands2",
      "vkCmdResetQueryPool commands2 queries1 0 4",
      "vkCmdPipelineBarrier2 commands2 [image1 0x100000000/0x0->0x800000000/0x1000 layout 0->7 aspects 1 mips 0+1 layers 0+1]",
      "vkCmdClearColorImage commands2 image1 7 0x3f800000,0x0,0x3f800000,0x3f800000 1 aspects 1 mips 0+1 layers 0+1",
      "vkCmdPipelineBarrier2 commands2 [image1 0x800000000/0x1000->0x100000000/0x800 layout 7->6 aspects 1 mips 0+1 layers 0+1]",
      "vkCmdCopyImageToBuffer commands2 image1 6 buffer1 1 offset 0 aspects 1 mip 0 layers 0+1 8x4x1",
      "vkCmdPipelineBarrier2 commands2 [buffer1 0x100000000/0x1000->0x4000/0x2000 bytes 0+rest]",
      "vkEndCommandBuffer commands2",
      "vkQueueSubmit2 signal semaphore1=2",
  };
  EXPECT_EQ(text, expected);
}

TEST_F(FrameText, ReadBackBuffersExistOncePerFrameInFlight) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  options.frames_in_flight = 3;
  GraphInstance graph = make(t.plan, options);
  std::vector<std::string> targets;
  for (int i = 0; i < 4; ++i) targets.push_back(test::calls(frame(graph), "vkCmdCopyImageToBuffer").at(0).substr(33, 16));
  EXPECT_EQ(targets, (std::vector<std::string>{"image1 6 buffer1", "image1 6 buffer2", "image1 6 buffer3", "image1 6 buffer1"}));
}

TEST_F(FrameText, WaitsOnlyForTheFrameThatUsedTheSlot) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  options.frames_in_flight = 2;
  GraphInstance graph = make(t.plan, options);
  EXPECT_TRUE(test::calls(frame(graph), "vkWaitSemaphores").empty());
  EXPECT_TRUE(test::calls(frame(graph), "vkWaitSemaphores").empty());
  EXPECT_EQ(test::calls(frame(graph), "vkWaitSemaphores").at(0), "vkWaitSemaphores semaphore1>=2 18446744073709551615");
  EXPECT_EQ(test::calls(frame(graph), "vkWaitSemaphores").at(0), "vkWaitSemaphores semaphore1>=3 18446744073709551615");
}

TEST_F(FrameText, LabelsModulesAndPasses) {
  test::ClearAndCopy t = test::clear_and_copy();
  t.plan.passes[0].module = t.plan.passes[1].module = "post";
  GraphInstance graph = make(t.plan);
  const std::string text = frame(graph);
  EXPECT_EQ(test::calls(text, "vkCmdBeginDebugUtilsLabelEXT"),
            (std::vector<std::string>{"vkCmdBeginDebugUtilsLabelEXT commands2 post", "vkCmdBeginDebugUtilsLabelEXT commands2 clear",
                                      "vkCmdBeginDebugUtilsLabelEXT commands2 copy"}));
  EXPECT_EQ(test::calls(text, "vkCmdEndDebugUtilsLabelEXT").size(), 3u);
}

TEST_F(FrameText, GuardedPassesAreSkippedAndTheirBarriersAreNot) {
  test::ClearAndCopy t = test::clear_and_copy();
  t.plan.conditions = {"cache_miss", "day"};
  t.plan.passes[t.clear].guard = 0b11;
  GraphInstance graph = make(t.plan);
  for (const uint64_t conditions : {0b00, 0b01, 0b10, 0b11}) {
    FrameInputs inputs;
    inputs.conditions = conditions;
    const std::string text = frame(graph, inputs);
    EXPECT_EQ(test::calls(text, "vkCmdClearColorImage").size(), conditions == 0b11 ? 1u : 0u);
    EXPECT_EQ(test::calls(text, "vkCmdPipelineBarrier2").size(), 3u);
    EXPECT_EQ(test::calls(text, "vkCmdCopyImageToBuffer").size(), 1u);
  }
}

TEST_F(FrameText, EmptyGroupsAreNotRecorded) {
  test::ClearAndCopy t = test::clear_and_copy();
  t.plan.barriers({}, {}, {MemoryBarrier{}});
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(test::calls(frame(graph), "vkCmdPipelineBarrier2").size(), 3u);
}

TEST_F(FrameText, TimesOfTheLastFinishedFrame) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphInstance graph = make(t.plan);
  EXPECT_TRUE(graph.pass_times().empty());
  frame(graph);
  const std::vector<PassTime> times = graph.pass_times();
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].pass, "clear");
  EXPECT_DOUBLE_EQ(times[1].ms, 0.001);
}

TEST_F(FrameText, OneSubmitAStepWhereThePassesAreTimedByTheClock) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  options.submit_per_pass = true;
  GraphInstance graph = make(t.plan, options);
  const std::string text = frame(graph);
  EXPECT_EQ(test::calls(text, "vkQueueSubmit2").size(), t.plan.steps.size());
  EXPECT_EQ(test::calls(text, "vkWaitSemaphores").size(), t.plan.steps.size());
  EXPECT_EQ(graph.pass_times().size(), 2u);
}

}  // namespace
}  // namespace rg
