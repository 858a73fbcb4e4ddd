// Every Vulkan call that can fail does, one at a time: an error comes back, nothing leaks, and what existed goes on.
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

constexpr uint32_t kStep = 1;
const std::span<const std::byte> kParams[] = {std::as_bytes(std::span(&kStep, 1))};
void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

FrameInputs inputs() {
  FrameInputs in;
  in.params = kParams, in.callbacks = kIgnore;
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

void fail_every_call(const Plan& plan, Index result) {
  NullCounters counters;
  uint64_t calls = 0;
  {
    Device device = Device::null(nullptr, {0, VK_SUCCESS, &counters});
    EXPECT_EQ(exercise(device, plan, result), 0);
    calls = counters.fallible_calls;
    EXPECT_EQ(counters.live_handles, 0u);
  }
  ASSERT_GT(calls, 30u);
  for (uint64_t fail_at = 1; fail_at <= calls; ++fail_at) {
    counters = {};
    std::string log;
    Device device = Device::null(&log, {fail_at, VK_ERROR_OUT_OF_DEVICE_MEMORY, &counters});
    const bool noticed = exercise(device, plan, result) != 0;
    EXPECT_TRUE(noticed || may_go_unnoticed(log)) << "call " << fail_at << ": " << failed_call(log);
    EXPECT_EQ(counters.live_handles, 0u) << "call " << fail_at;
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

TEST(Failures, NameTheResourceAndTheCall) {
  test::ClearAndCopy t = test::clear_and_copy();
  std::string log;
  Device device = Device::null(&log);
  ASSERT_TRUE(GraphInstance::create(device, t.plan.view(), {}));
  NullCounters counters;
  std::vector<std::string> messages;
  for (uint64_t fail_at = 1; fail_at <= 30; ++fail_at) {
    Device failing = Device::null(nullptr, {fail_at, VK_ERROR_OUT_OF_DEVICE_MEMORY, &counters});
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
  NullOptions options{0, VK_ERROR_OUT_OF_DEVICE_MEMORY, &counters};
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
    Device device = Device::null(nullptr, {0, VK_SUCCESS, &counters});
    Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
    ASSERT_TRUE(graph->execute({}));
    before = counters.fallible_calls;
  }
  counters = {};
  Device device = Device::null(nullptr, {before, VK_ERROR_DEVICE_LOST, &counters});
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
