// Every Vulkan call that can fail does, one at a time: an error comes back, nothing leaks, and what existed goes on.
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

constexpr uint32_t kStep = 1;
constexpr uint32_t kData[64] = {};
const std::span<const std::byte> kUpdates[] = {std::as_bytes(std::span(kData))};
const std::span<const std::byte> kParams[] = {std::as_bytes(std::span(&kStep, 1))};
void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

NullOptions counted(NullCounters& counters, uint64_t fail_at = 0, VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY) {
  NullOptions options;
  options.counters = &counters, options.fail_at = fail_at, options.failure = failure;
  return options;
}

FrameInputs inputs() {
  FrameInputs in;
  in.params = kParams, in.callbacks = kIgnore, in.updates = kUpdates;
  return in;
}

// Creates, executes, resizes, reads back and dumps. Returns how many of these failed.
int exercise(Device& device, const Plan& plan, Index result) {
  GraphOptions options;
  options.debug_readback = true;
  Result<GraphInstance> graph = GraphInstance::create(device, plan, options);
  if (!graph) {
    EXPECT_FALSE(graph.error().message.empty());
    return 1;
  }
  int failures = 0;
  auto count = [&](const auto& status) { failures += status ? 0 : 1; };
  count(graph->request_dump(0, plan.accesses[0].ref.resource));
  for (int frame = 0; frame < 3; ++frame) count(graph->execute(inputs()));
  count(graph->take_dump());
  static_cast<void>(graph->pass_statistics());
  const std::vector<int64_t> extents(plan.extents.size() * 3, 3);
  count(graph->resize(extents));
  count(graph->execute(inputs()));
  count(graph->readback(result));
  static_cast<void>(graph->pass_times());
  count(graph->wait_idle());
  return failures;
}

std::string failed_call(const std::string& log) {
  for (const std::string& line : test::lines(log))
    if (line.ends_with(" -> failed")) return line;
  return {};
}

// Object names are for tools; pass_times gives none where it cannot ask (its calls are not logged); a destructor has nobody to tell.
bool may_go_unnoticed(const std::string& log) {
  const std::string call = failed_call(log);
  if (call.empty() || call.starts_with("vkSetDebugUtilsObjectNameEXT")) return true;
  const std::string afterwards = log.substr(log.find(call));
  return call.starts_with("vkWaitSemaphores") && test::calls(afterwards, "vkQueueSubmit2").empty() &&
         !test::calls(afterwards, "vkDestroySemaphore").empty();
}

void fail_every_call(const Plan& plan, Index result, NullOptions options = {}) {
  NullCounters counters;
  options.counters = &counters;
  uint64_t calls = 0;
  {
    Device device = Device::null(nullptr, options);
    EXPECT_EQ(exercise(device, plan, result), 0);
    calls = counters.fallible_calls;
    EXPECT_EQ(counters.live_handles, 0u);
    EXPECT_EQ(counters.wrong_destroys + counters.unmet_waits, 0u);
  }
  ASSERT_GT(calls, 30u);
  for (uint64_t fail_at = 1; fail_at <= calls; ++fail_at) {
    counters = {};
    std::string log;
    options.fail_at = fail_at;
    Device device = Device::null(&log, options);
    const bool noticed = exercise(device, plan, result) != 0;
    EXPECT_TRUE(noticed || may_go_unnoticed(log)) << "call " << fail_at << ": " << failed_call(log);
    EXPECT_EQ(counters.live_handles, 0u) << "call " << fail_at;
    EXPECT_EQ(counters.wrong_destroys + counters.unmet_waits, 0u) << "call " << fail_at << ": " << failed_call(log);
  }
}

TEST(Failures, OfEveryCallOfAFrameOfThreeQueues) {
  test::Relay t = test::relay();
  NullOptions options;
  options.compute_queues = options.transfer_queues = 1;
  fail_every_call(t.plan.view(), t.result_sum, options);
}

// After one failure the same call made again succeeds, and the frames after it are whole.
void retry_every_call(const Plan& plan, NullOptions options) {
  NullCounters counters;
  options.counters = &counters;
  uint64_t created = 0, executed = 0;
  const std::vector<int64_t> extents(plan.extents.size() * 3, 3);
  auto run = [&](GraphInstance& graph, bool retry) {
    auto twice = [&](auto&& call) {
      Status status = call();
      if (!status && retry) status = call();
      EXPECT_TRUE(status) << status.error().message;
    };
    for (int frame = 0; frame < 3; ++frame) twice([&] { return graph.execute(inputs()); });
    twice([&] { return graph.resize(extents); });
    twice([&] { return graph.execute(inputs()); });
    twice([&] { return graph.wait_idle(); });
  };
  {
    Device device = Device::null(nullptr, options);
    Result<GraphInstance> graph = GraphInstance::create(device, plan, {});
    ASSERT_TRUE(graph);
    created = counters.fallible_calls;
    run(*graph, false);
    executed = counters.fallible_calls;
  }
  for (uint64_t fail_at = 1; fail_at <= executed; ++fail_at) {
    counters = {};
    options.fail_at = fail_at;
    std::string log;
    Device device = Device::null(&log, options);
    {
      Result<GraphInstance> graph = GraphInstance::create(device, plan, {});
      if (!graph) graph = GraphInstance::create(device, plan, {});
      ASSERT_TRUE(graph) << graph.error().message;
      run(*graph, true);
      EXPECT_TRUE(fail_at <= created || graph->frame() == 4) << "call " << fail_at;
    }
    EXPECT_EQ(counters.live_handles, 0u) << "call " << fail_at;
    EXPECT_EQ(counters.wrong_destroys + counters.unmet_waits, 0u) << "call " << fail_at << ": " << failed_call(log);
  }
}

TEST(Failures, AreOverAtTheNextTry) {
  test::Counter counter = test::counter();
  retry_every_call(counter.plan.view(), {});
  test::Tint tint = test::tint();
  retry_every_call(tint.plan.view(), {});
  test::Relay relay = test::relay();
  NullOptions options;
  options.compute_queues = options.transfer_queues = 1;
  retry_every_call(relay.plan.view(), options);
}

TEST(Failures, ALostDeviceIsReportedOnceAndLeftAlone) {
  test::Relay t = test::relay();
  NullCounters counters;
  NullOptions options;
  options.counters = &counters, options.failure = VK_ERROR_DEVICE_LOST, options.fails_from_then_on = true;
  options.compute_queues = options.transfer_queues = 1;
  uint64_t calls = 0;
  {
    Device device = Device::null(nullptr, options);
    EXPECT_EQ(exercise(device, t.plan.view(), t.result_sum), 0);
    calls = counters.fallible_calls;
  }
  for (options.fail_at = 1; options.fail_at <= calls; ++options.fail_at) {
    counters = {};
    {
      Device device = Device::null(nullptr, options);
      Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
      if (!graph) {
        EXPECT_EQ(graph.error().code, ErrorCode::device_lost) << graph.error().message;
        const uint64_t before = counters.fallible_calls;
        EXPECT_EQ(GraphInstance::create(device, t.plan.view(), {}).error().code, ErrorCode::device_lost);
        EXPECT_EQ(device.wait_idle().error().code, ErrorCode::device_lost);
        EXPECT_EQ(counters.fallible_calls, before);
        continue;
      }
      Status status = graph->execute(inputs());
      for (int frame = 0; frame < 8 && status; ++frame) status = graph->execute(inputs());
      if (status) continue;
      EXPECT_EQ(status.error().code, ErrorCode::device_lost) << status.error().message;
      const uint64_t before = counters.fallible_calls;
      EXPECT_EQ(graph->execute(inputs()).error().code, ErrorCode::device_lost);
      EXPECT_EQ(graph->resize({}).error().code, ErrorCode::device_lost);
      EXPECT_EQ(graph->wait_idle().error().code, ErrorCode::device_lost);
      EXPECT_EQ(counters.fallible_calls, before);
    }
    EXPECT_EQ(counters.live_handles, 0u) << "call " << options.fail_at;
  }
}

TEST(Failures, OfEveryCallOfAComputeFrame) {
  test::Counter t = test::counter();
  fail_every_call(t.plan.view(), t.result);
}

TEST(Failures, OfEveryCallOfARasterFrame) {
  test::Tint t = test::tint();
  fail_every_call(t.plan.view(), t.result);
}

TEST(Failures, OfEveryCallOfAFrameWithEvents) {
  test::Split t = test::split();
  fail_every_call(t.plan.view(), t.result_a);
}

TEST(Failures, NameTheResourceAndTheCall) {
  test::ClearAndCopy t = test::clear_and_copy();
  std::string log;
  Device device = Device::null(&log);
  ASSERT_TRUE(GraphInstance::create(device, t.plan.view(), {}));
  NullCounters counters;
  std::vector<std::string> messages;
  for (uint64_t fail_at = 1; fail_at <= 30; ++fail_at) {
    Device failing = Device::null(nullptr, counted(counters, fail_at));
    counters = {};
    const Result<GraphInstance> graph = GraphInstance::create(failing, t.plan.view(), {});
    if (graph) continue;
    messages.push_back(graph.error().message);
    EXPECT_EQ(graph.error().code, ErrorCode::out_of_memory) << graph.error().message;
  }
  EXPECT_NE(std::find(messages.begin(), messages.end(), "`color`: vkCreateImage failed with VK_ERROR_OUT_OF_DEVICE_MEMORY"), messages.end());
  EXPECT_NE(std::find(messages.begin(), messages.end(), "`test`: vkAllocateMemory failed with VK_ERROR_OUT_OF_DEVICE_MEMORY"), messages.end());
}

TEST(Failures, OfAResizeLeaveTheOldStateRunning) {
  test::ClearAndCopy t = test::clear_and_copy();
  NullCounters counters;
  NullOptions options = counted(counters);
  uint64_t created = 0, resized = 0;
  const int64_t extents[] = {16, 16, 1};
  {
    Device device = Device::null(nullptr, options);
    Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
    ASSERT_TRUE(graph);
    created = counters.fallible_calls;
    ASSERT_TRUE(graph->resize(extents));
    resized = counters.fallible_calls;
  }
  for (uint64_t fail_at = created + 1; fail_at <= resized; ++fail_at) {
    counters = {};
    options.fail_at = fail_at;
    std::string log;
    Device device = Device::null(&log, options);
    Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
    ASSERT_TRUE(graph);
    const Status status = graph->resize(extents);
    if (status) continue;  // an object name
    log.clear();
    ASSERT_TRUE(graph->execute({}));
    EXPECT_NE(test::calls(log, "vkCmdCopyImageToBuffer").at(0).find("8x4x1"), std::string::npos) << "call " << fail_at;
  }
}

TEST(Failures, OfALostDeviceAreToldApart) {
  test::ClearAndCopy t = test::clear_and_copy();
  NullCounters counters;
  uint64_t before = 0;
  {
    Device device = Device::null(nullptr, counted(counters));
    Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
    ASSERT_TRUE(graph->execute({}));
    before = counters.fallible_calls;
  }
  counters = {};
  Device device = Device::null(nullptr, counted(counters, before, VK_ERROR_DEVICE_LOST));
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph);
  const Status status = graph->execute({});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::device_lost);
  EXPECT_EQ(status.error().message, "`test`: vkQueueSubmit2 failed with VK_ERROR_DEVICE_LOST");
  EXPECT_EQ(graph->frame(), 0u);
}

}  // namespace
}  // namespace rg
