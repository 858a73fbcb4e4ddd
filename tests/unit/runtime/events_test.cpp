// Split barriers are recorded as vkCmdSetEvent2 and vkCmdWaitEvents2 with the same dependency, or whole where something watches the frame.
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

constexpr std::string_view kDependency = "[buffer1 0x800000000/0x1000->0x100000000/0x800 bytes 0+rest]";

class Events : public test::NullTest {
 protected:
  // Names of the calls that order or work, in order.
  static std::string order(const std::string& text) {
    std::string names;
    for (const std::string& line : test::lines(text)) {
      const std::string name = line.substr(0, line.find(' '));
      if (name.starts_with("vkCmd") && name.find("Label") == std::string::npos && name.find("Timestamp") == std::string::npos &&
          name != "vkCmdResetQueryPool")
        names += name.substr(5) + " ";
    }
    return names;
  }
};

TEST_F(Events, HalvesAreTheSameDependency) {
  test::Split t = test::split();
  GraphInstance graph = make(t.plan);
  const std::string text = frame(graph);
  EXPECT_EQ(order(text), "PipelineBarrier2 FillBuffer SetEvent2 FillBuffer WaitEvents2 CopyBuffer PipelineBarrier2 CopyBuffer PipelineBarrier2 ");
  EXPECT_EQ(test::calls(text, "vkCmdSetEvent2").at(0), "vkCmdSetEvent2 commands2 event1 " + std::string(kDependency));
  EXPECT_EQ(test::calls(text, "vkCmdWaitEvents2").at(0), "vkCmdWaitEvents2 commands2 1 event1 " + std::string(kDependency));
}

TEST_F(Events, EachFrameInFlightHasItsOwnAndResetsItWhenItComesBack) {
  test::Split t = test::split();
  GraphOptions options;
  options.frames_in_flight = 3;
  GraphInstance graph = make(t.plan, options);
  for (uint32_t number = 0; number < 7; ++number) {
    const std::string text = frame(graph), event = "event" + std::to_string(1 + number % 3);
    EXPECT_NE(test::calls(text, "vkCmdSetEvent2").at(0).find(event + " "), std::string::npos) << number;
    ASSERT_EQ(test::calls(text, "vkResetEvent").size(), 1u) << number;
    EXPECT_TRUE(test::calls(text, "vkResetEvent")[0].ends_with(event)) << number;
    EXPECT_LT(text.find("vkResetEvent"), text.find("vkBeginCommandBuffer"));
  }
}

TEST_F(Events, AreWholeWhereEveryPassWaits) {
  for (const bool serial : {false, true}) {
    test::Split t = test::split();
    GraphOptions options;
    options.serial = serial, options.submit_per_pass = !serial;
    GraphInstance graph = make(t.plan, options);
    const std::string text = frame(graph);
    EXPECT_EQ(text.find("Event"), std::string::npos);
    const std::string_view masks = kDependency.substr(kDependency.find(' '));
    size_t filled = 0;
    for (const std::string& line : test::calls(text, "vkCmdPipelineBarrier2")) filled += line.ends_with(masks);
    EXPECT_EQ(filled, 2u) << "of a and b";
    EXPECT_LT(text.rfind("vkCmdFillBuffer"), text.find(masks)) << "where it is awaited";
  }
}

// What a dump reads may be in the middle of its transition.
TEST_F(Events, AreWholeInAFrameThatIsDumped) {
  test::Split t = test::split();
  GraphOptions options;
  options.debug_readback = true;
  GraphInstance graph = make(t.plan, options);
  EXPECT_EQ(test::message(graph.request_dump(1, t.b)), "no error");
  EXPECT_EQ(frame(graph).find("vkCmdWaitEvents2"), std::string::npos);
  EXPECT_NE(frame(graph).find("vkCmdWaitEvents2"), std::string::npos);
}

// Statistics are instruments that leave barriers as they are.
TEST_F(Events, AreRecordedUnderInstruments) {
  test::Split t = test::split();
  GraphOptions options;
  options.statistics = true;
  GraphInstance graph = make(t.plan, options);
  const std::string text = frame(graph);
  EXPECT_EQ(test::calls(text, "vkCmdSetEvent2").size(), 1u);
  EXPECT_EQ(test::calls(text, "vkCmdWaitEvents2").size(), 1u);
}

TEST_F(Events, OfABarrierOnNothingAreNotRecorded) {
  test::Split t = test::split();
  t.plan.groups[test::kSplitGroup].buffer_count = 0;
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(order(frame(graph)), "PipelineBarrier2 FillBuffer FillBuffer CopyBuffer PipelineBarrier2 CopyBuffer PipelineBarrier2 ");
}

TEST_F(Events, AreTheSameOverThreads) {
  test::Split t = test::split();
  GraphOptions options;
  options.threads = 3;
  GraphInstance graph = make(t.plan, options);
  const std::string text = frame(graph);
  EXPECT_EQ(test::calls(text, "vkCmdSetEvent2").size(), 1u);
  EXPECT_EQ(test::calls(text, "vkCmdWaitEvents2").size(), 1u);
}

std::string fault(void (*break_plan)(test::TestPlan&)) {
  test::Split t = test::split();
  break_plan(t.plan);
  Device device = Device::null(nullptr);
  const Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  return graph ? "no error" : graph.error().message;
}

TEST(EventPlans, AreCheckedBeforeUse) {
  using P = test::TestPlan;
  EXPECT_EQ(fault([](P&) {}), "no error");
  EXPECT_EQ(fault([](P& p) { p.groups[1].event = 1; }), "plan `test`: group 1: events that are not numbered from 0 on");
  EXPECT_EQ(fault([](P& p) { p.groups[1].event = 99; }), "plan `test`: group 1: event");
  EXPECT_EQ(fault([](P& p) { p.groups[2].event = 0; }), "plan `test`: group 2: event");
  EXPECT_EQ(fault([](P& p) { p.groups[2].event = 1; }), "plan `test`: group 2: an event that is not set in the batch that awaits it");
  EXPECT_EQ(fault([](P& p) { p.groups[1].event = kNone; }), "plan `test`: group 1: set, but not split");
  EXPECT_EQ(fault([](P& p) { p.steps[test::kSetStep].kind = StepKind{3}; }), "plan `test`: step 2: kind");
  EXPECT_EQ(fault([](P& p) { p.steps[test::kSetStep].kind = StepKind::barriers; }), "plan `test`: step 4: recorded twice");
  EXPECT_EQ(fault([](P& p) { std::swap(p.steps[test::kSetStep], p.steps[test::kAwaitStep]); }),
            "plan `test`: group 1: an event that is not set in the batch that awaits it");
  EXPECT_EQ(fault([](P& p) { p.steps.erase(p.steps.begin() + test::kAwaitStep); }), "plan `test`: group 1: an event that nothing awaits");
  EXPECT_EQ(fault([](P& p) { p.buffer_barriers[2].dst_stages |= stage::host; }), "plan `test`: group 1: an event that orders the host");
}

}  // namespace
}  // namespace rg
