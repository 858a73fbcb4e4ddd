// Plans replaced under a running frame: taken over at a frame's boundary with everything that goes on, or refused whole while the old one does.
#include "runtime/typed_frame.h"

#include "compiler/codegen/plan_file.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

const uint32_t kOne = 1;
const std::span<const std::byte> kStepParams[] = {std::as_bytes(std::span(&kOne, 1))};

// What generated classes are made of.
class Counting : public TypedFrame {
 public:
  Counting(const Plan& built, GraphInstance instance, const GraphOptions& options) : TypedFrame(built, std::move(instance), options) {}
  Status execute() {
    FrameInputs inputs;
    inputs.params = kStepParams;
    return execute_inputs(inputs);
  }
  using TypedFrame::read_back;
};

PlanFile loaded(test::TestPlan& plan) {
  const Plan view = plan.view();
  const std::string bytes = compiler::emit_plan_file({&view, 1});
  Result<PlanFile> file = PlanFile::parse(std::as_bytes(std::span(bytes)), "x.rgplan");
  EXPECT_TRUE(file) << file.error().message;
  return *file;
}

// The counter of an edited source: its resources come in another order, and a further pass begins the frame.
test::Counter edited() {
  test::Counter t = test::counter();
  const auto move = [](Ref& ref) { ref.resource = ref.resource == kNone ? kNone : 1 - ref.resource; };
  std::swap(t.plan.resources[0], t.plan.resources[1]);
  std::swap(t.state, t.result);
  for (Boundary& row : t.plan.entry) move(row.ref);
  for (BufferBarrier& row : t.plan.buffer_barriers) move(row.buffer);
  for (Access& row : t.plan.accesses) move(row.ref);
  for (Binding& row : t.plan.bindings) move(row.ref);
  for (Transfer& row : t.plan.transfers) move(row.src), move(row.dst);
  return t;
}

class Reload : public testing::Test {
 protected:
  Counting start(const GraphOptions& options = {}) {
    plan = built.plan.view();
    Result<GraphInstance> graph = GraphInstance::create(*device, plan, options);
    EXPECT_TRUE(graph) << graph.error().message;
    return Counting(plan, std::move(*graph), options);
  }
  std::string log;
  NullCounters counters;
  std::optional<Device> device = Device::null(&log, {.counters = &counters});
  test::Counter built = test::counter();
  Plan plan;
};

TEST_F(Reload, GoesOnWithTheHistoryAndTheNames) {
  {
    Counting frame = start();
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(frame.execute());
    test::Counter other = edited();
    ASSERT_NE(other.state, built.state);
    log.clear();
    ASSERT_TRUE(frame.reload(loaded(other.plan)));
    EXPECT_TRUE(test::calls(log, "vkWaitSemaphores").empty()) << "waits for nothing";
    EXPECT_TRUE(test::calls(log, "vkCmdFillBuffer").empty()) << "history is not reset";
    EXPECT_TRUE(test::calls(log, "vkCreateComputePipelines").empty()) << "no shader has changed";
    EXPECT_EQ(frame.frame(), 3u);
    EXPECT_NE(frame.running_plan().resources.data(), plan.resources.data());
    EXPECT_TRUE(frame.history_valid(built.state)) << "by its name, though it is elsewhere";
    ASSERT_TRUE(frame.execute());
    EXPECT_TRUE(frame.read_back(built.result));
    ASSERT_TRUE(frame.invalidate(built.state));
    EXPECT_EQ(frame.read_back(99).error().message, "graph `test`: the plan that runs now has no resource");
    // Back to the plan of before, and to other threads, with no frame in between.
    log.clear();
    ASSERT_TRUE(frame.reload(loaded(built.plan)));
    GraphOptions options;
    options.threads = 2, options.frames_in_flight = 4;
    ASSERT_TRUE(frame.reconfigure(options));
    EXPECT_TRUE(test::calls(log, "vkWaitSemaphores").empty()) << "waits for nothing";
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(frame.execute());
    EXPECT_EQ(frame.frame(), 7u);
  }
  device.reset();
  EXPECT_EQ(counters.live_handles, 0u);
  EXPECT_EQ(counters.wrong_destroys + counters.unmet_waits, 0u);
}

TEST_F(Reload, WhatWasReplacedLivesUntilItsFramesAreDone) {
  Counting frame = start();
  ASSERT_TRUE(frame.execute());
  const uint64_t before = counters.live_handles;
  test::Counter other = edited();
  ASSERT_TRUE(frame.reload(loaded(other.plan)));
  EXPECT_GT(counters.live_handles, before);
  const uint64_t both = counters.live_handles;
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(frame.execute());
  EXPECT_EQ(counters.live_handles, both);
  ASSERT_TRUE(frame.execute());
  EXPECT_LT(counters.live_handles, both);
}

// In the order of the calls: another program, another graph, a plan that this device cannot run.
TEST_F(Reload, WhatDoesNotFitIsRefusedWholeAndTheOldPlanGoesOn) {
  Counting frame = start();
  ASSERT_TRUE(frame.execute());
  const uint64_t handles = counters.live_handles;
  test::Counter more = test::counter(), renamed = test::counter(), demanding = edited();
  more.plan.params[0].bytes = 8;
  renamed.plan.base.name = "another";
  demanding.plan.resources[demanding.result].bytes = demanding.plan.constant(int64_t{1} << 45);
  EXPECT_EQ(test::message(frame.reload(loaded(more.plan))),
            "the plan of `test` does not fit this program: parameter block `step` changed; "
            "build the program again with the generated code of the plan");
  EXPECT_EQ(test::message(frame.reload(loaded(renamed.plan))), "the plan file has no plan of graph `test`");
  EXPECT_FALSE(frame.reload(loaded(demanding.plan)));
  EXPECT_EQ(counters.live_handles, handles);
  EXPECT_EQ(frame.running_plan().resources.data(), plan.resources.data());
  EXPECT_TRUE(frame.history_valid(built.state));
  log.clear();
  ASSERT_TRUE(frame.execute());
  EXPECT_EQ(test::calls(log, "vkCmdDispatch").size(), 1u);
  EXPECT_EQ(frame.frame(), 2u);
}

// Every call of a reload fails once: the old plan goes on with its history, and the next try succeeds.
TEST_F(Reload, FailuresOfEveryCallLeaveTheOldPlanRunning) {
  test::Counter other = edited();
  const PlanFile file = loaded(other.plan);
  const auto attempt = [&](uint64_t fail_at) {
    counters = {};
    log.clear();
    device.emplace(Device::null(&log, {.fail_at = fail_at, .counters = &counters}));
    std::pair<uint64_t, uint64_t> calls;
    {
      Counting frame = start();
      EXPECT_TRUE(frame.execute());
      calls.first = counters.fallible_calls;
      const Status reloaded = frame.reload(file);
      calls.second = counters.fallible_calls;
      if (!reloaded) {
        EXPECT_EQ(frame.running_plan().resources.data(), plan.resources.data()) << "call " << fail_at;
        EXPECT_TRUE(frame.history_valid(built.state)) << "call " << fail_at;
        EXPECT_TRUE(frame.execute()) << "call " << fail_at;
        const Status again = frame.reload(file);
        EXPECT_TRUE(again) << "call " << fail_at << ": " << test::message(again);
      }
      EXPECT_TRUE(frame.execute()) << "call " << fail_at;
      EXPECT_EQ(frame.frame(), reloaded ? 2u : 3u);
    }
    device.reset();
    EXPECT_EQ(counters.live_handles, 0u) << "call " << fail_at;
    EXPECT_EQ(counters.wrong_destroys + counters.unmet_waits, 0u) << "call " << fail_at;
    return calls;
  };
  const auto [first, last] = attempt(0);
  ASSERT_GT(last, first + 10);
  for (uint64_t fail_at = first + 1; fail_at <= last; ++fail_at) attempt(fail_at);
}

}  // namespace
}  // namespace rg
