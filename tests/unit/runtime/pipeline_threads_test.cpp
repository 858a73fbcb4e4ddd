// Pipelines made by several threads are those that one makes, and fail as with one.
#include <sys/resource.h>

#include <array>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

#include "runtime/device_state.h"
#include "runtime/workers.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

constexpr std::array<std::string_view, 8> kNames = {"add0", "add1", "add2", "add3", "add4", "add5", "add6", "add7"};

// A pass after the other adds to a buffer, each with a shader and a pipeline of its own.
test::TestPlan adds() {
  test::TestPlan p;
  const Index bytes = p.constant(64 * 4), one = p.constant(1);
  const Index from = p.buffer("from", bytes, test::kStorageBuffer), to = p.buffer("to", bytes, test::kStorageBuffer);
  for (const std::string_view name : kNames) test::add_shader_pass(p, name, {from, 0}, {to, 0}, one);
  return p;
}

// What the driver sees.
struct Driver {
  PFN_vkCreateShaderModule create_shader = nullptr;
  PFN_vkCreateComputePipelines create = nullptr;
  std::vector<VkShaderModule> shaders;  // of the passes of `adds`, in their order
  std::mutex mutex;
  std::condition_variable changed;
  uint32_t calls = 0, inside = 0, most_inside = 0, failed = 0;
  bool wait_for_company = false;                   // the first call goes on when another has come
  Index fails_late = kNone, fails = kNone;         // passes; the one fails when the other has
  std::map<VkPipeline, VkPipelineLayout> layouts;  // of what was made

  // Far longer than anything takes: a wait that ends by itself is a failure.
  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, Condition condition) {
    EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(60), condition));
  }
};
Driver* driver = nullptr;

VkResult VKAPI_CALL create_shader(VkDevice device, const VkShaderModuleCreateInfo* info, const VkAllocationCallbacks* allocator,
                                  VkShaderModule* shader) {
  const VkResult result = driver->create_shader(device, info, allocator, shader);
  driver->shaders.push_back(*shader);
  return result;
}

VkResult VKAPI_CALL create(VkDevice device, VkPipelineCache cache, uint32_t count, const VkComputePipelineCreateInfo* infos,
                           const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  std::unique_lock lock(driver->mutex);
  ++driver->calls;
  driver->most_inside = std::max(driver->most_inside, ++driver->inside);
  driver->changed.notify_all();
  if (driver->wait_for_company) driver->wait(lock, [] { return driver->most_inside > 1; });
  const auto pass = static_cast<Index>(std::ranges::find(driver->shaders, infos->stage.module) - driver->shaders.begin());
  const bool late = pass == driver->fails_late, fails = late || pass == driver->fails;
  if (late) driver->wait(lock, [] { return driver->failed == 1; });
  const VkResult result = fails ? VK_ERROR_OUT_OF_HOST_MEMORY : driver->create(device, cache, count, infos, allocator, pipelines);
  if (result == VK_SUCCESS) driver->layouts[*pipelines] = infos->layout;
  driver->failed += fails ? 1 : 0;
  --driver->inside;
  driver->changed.notify_all();
  return result;
}

struct PipelineThreads : testing::Test {
  PipelineThreads() {
    driver = &seen;
    seen.create_shader = std::exchange(device.state().vk.CreateShaderModule, create_shader);
    seen.create = std::exchange(device.state().vk.CreateComputePipelines, create);
  }
  ~PipelineThreads() override { driver = nullptr; }

  Result<GraphInstance> make(uint32_t pipeline_threads, uint32_t threads = 1, Parallel parallel = {}) {
    GraphOptions options;
    options.pipeline_threads = pipeline_threads, options.threads = threads, options.parallel = parallel;
    seen.shaders.clear();
    return GraphInstance::create(device, plan.view(), options);
  }

  Driver seen;
  test::TestPlan plan = adds();
  std::string log;
  NullCounters counters;
  Device device = Device::null(&log, {.counters = &counters});
};

TEST_F(PipelineThreads, MakeOneOfEachPassAndItsLayout) {
  for (const uint32_t threads : {1u, 2u, 5u, 64u}) {
    seen.layouts.clear(), seen.calls = 0;
    const Result<GraphInstance> graph = make(threads);
    ASSERT_TRUE(graph) << graph.error().message;
    EXPECT_EQ(seen.calls, kNames.size());
    for (Index p = 0; p < kNames.size(); ++p)
      EXPECT_EQ(seen.layouts.at(graph->pass_info(p).pipeline), graph->pass_info(p).layout) << threads << ' ' << kNames[p];
  }
  EXPECT_EQ(counters.live_handles, 0u);
}

TEST_F(PipelineThreads, AreInTheDriverAtTheSameTime) {
  ASSERT_TRUE(make(1));
  EXPECT_EQ(seen.most_inside, 1u);
  seen.wait_for_company = true;
  for (const uint32_t recording : {1u, 2u}) {  // threads of the occasion, and those that record
    seen.most_inside = 0;
    ASSERT_TRUE(make(2, recording));
    EXPECT_EQ(seen.most_inside, 2u);
  }
}

TEST_F(PipelineThreads, AreTheEnginesWhereItLendsSome) {
  uint32_t jobs = 0;
  const Parallel parallel = {[](void* user, uint32_t count, void (*job)(void*, uint32_t), void* data) {
                               *static_cast<uint32_t*>(user) = count;
                               for (uint32_t i = count; i-- > 0;) job(data, i);  // in any order
                             },
                             &jobs};
  ASSERT_TRUE(make(2, 1, parallel));
  EXPECT_EQ(jobs, kNames.size());
  jobs = 0;
  ASSERT_TRUE(make(1, 1, parallel));
  EXPECT_EQ(jobs, 0u) << "one is the caller";
  seen.fails = 2;
  EXPECT_EQ(make(2, 1, parallel).error().message, "`add2`: vkCreateComputePipelines failed with VK_ERROR_OUT_OF_HOST_MEMORY");
}

TEST_F(PipelineThreads, ReportTheFirstThatFailsAndNotTheFastest) {
  seen.fails_late = 2, seen.fails = 5;
  for (const uint32_t recording : {1u, 2u}) {
    seen.failed = seen.calls = 0;
    const Result<GraphInstance> graph = make(2, recording);
    ASSERT_FALSE(graph);
    EXPECT_EQ(graph.error().message, "`add2`: vkCreateComputePipelines failed with VK_ERROR_OUT_OF_HOST_MEMORY");
    EXPECT_EQ(seen.calls, 6u) << "those behind one that failed are not made";
    EXPECT_EQ(counters.live_handles, 0u);
    EXPECT_EQ(counters.wrong_destroys, 0u);
  }
}

TEST_F(PipelineThreads, OnANullDeviceAreOneUnlessAsked) {
  ASSERT_TRUE(make(0, 3));
  const std::string text = log;
  ASSERT_NE(text.find("vkCreateComputePipelines"), std::string::npos);
  Device other = Device::null(&log);
  log.clear();
  GraphOptions options;
  options.threads = 3, options.pipeline_threads = 1;
  ASSERT_TRUE(GraphInstance::create(other, plan.view(), options));
  EXPECT_EQ(log, text);
}

TEST_F(PipelineThreads, AreAtMost64) { EXPECT_EQ(make(65).error().message, "threads that make pipelines: 65 is not in 0 to 64"); }

// Which call is the k-th depends on who is faster; whichever it is, it is reported and nothing stays behind.
TEST(PipelineThreadsFail, InEveryCallWithoutALeak) {
  test::TestPlan plan = adds();
  GraphOptions options;
  options.pipeline_threads = 3;
  NullCounters counters;
  const auto create_with = [&](uint64_t fail_at) {
    counters = {};
    std::string log;
    Device device = Device::null(&log, {.fail_at = fail_at, .counters = &counters});
    const Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), options);
    const std::vector<std::string> all = test::lines(log);
    const auto failed = std::ranges::find_if(all, [](const std::string& line) { return line.ends_with(" -> failed"); });
    EXPECT_EQ(!graph, failed != all.end() && !failed->starts_with("vkSetDebugUtilsObjectNameEXT")) << "call " << fail_at;
    return counters.fallible_calls;
  };
  const uint64_t calls = create_with(0);
  ASSERT_GT(calls, 50u);
  for (uint64_t fail_at = 1; fail_at <= calls; ++fail_at) {
    create_with(fail_at);
    EXPECT_EQ(counters.live_handles, 0u) << "call " << fail_at;
    EXPECT_EQ(counters.wrong_destroys, 0u) << "call " << fail_at;
  }
}

// Address space for a few stacks and no more.
void leave_little_memory() {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t bytes = pages * 4096 + (rlim_t{40} << 20);
  const rlimit limit{bytes, bytes};
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::exit(2);
}

TEST(WorkersDeathTest, ThatTheSystemRefusesAreAnErrorOrDoneWithout) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve more memory than there is";
#endif
  const auto refused = [] {
    leave_little_memory();
    bool thrown = false;
    try {
      Workers all(63);
    } catch (const std::system_error&) {
      thrown = true;
    }
    std::array<int, 100> done{};
    Workers(63, Workers::Missing::done_without)
        .run(
            100, [](void* data, uint32_t i) { ++static_cast<int*>(data)[i]; }, done.data());
    std::exit(thrown && std::ranges::count(done, 1) == 100 ? 0 : 1);
  };
  EXPECT_EXIT(refused(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace rg
