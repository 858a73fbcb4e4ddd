// The order in which held submissions go.
#include "tests/layer/scheduler.h"

#include <gtest/gtest.h>

namespace rgc_layer {
namespace {

VkSemaphore handle(uintptr_t number) { return reinterpret_cast<VkSemaphore>(number); }
VkSemaphoreSubmitInfo at(uintptr_t semaphore, uint64_t value) {
  return {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, nullptr, handle(semaphore), value, 0, 0};
}

struct Trial {
  explicit Trial(std::optional<uint64_t> seed)
      : scheduler(
            [this](const Submission& s) {
              order.push_back(static_cast<uint32_t>(s.flags));
              return VK_SUCCESS;
            },
            seed) {
    for (const uintptr_t semaphore : {1, 2, 3}) scheduler.add_semaphore(handle(semaphore), true, 0);
    scheduler.add_semaphore(handle(4), false, 0);
  }
  // `name` travels in the flags.
  void submit(uint32_t queue, uint32_t name, std::vector<VkSemaphoreSubmitInfo> waits, std::vector<VkSemaphoreSubmitInfo> signals) {
    Submission submission;
    submission.waits = std::move(waits), submission.signals = std::move(signals), submission.flags = name;
    EXPECT_EQ(scheduler.submit(queue, {submission}), VK_SUCCESS);
  }
  std::vector<uint32_t> order;
  Scheduler scheduler;
};
using Order = std::vector<uint32_t>;

TEST(Scheduler, HoldsASubmissionUntilItsWaitsHaveGone) {
  Trial run(std::nullopt);
  run.submit(0, 1, {at(1, 1)}, {at(2, 1)});
  run.submit(1, 2, {at(2, 1)}, {});
  EXPECT_EQ(run.order, Order{});
  run.submit(2, 3, {}, {at(1, 1)});
  EXPECT_EQ(run.order, (Order{3, 1, 2}));
}

TEST(Scheduler, KeepsTheOrderOfAQueue) {
  Trial run(std::nullopt);
  run.submit(0, 1, {at(1, 1)}, {});
  run.submit(0, 2, {}, {});
  EXPECT_EQ(run.order, Order{});
  run.scheduler.signal_from_host(handle(1), 1);
  EXPECT_EQ(run.order, (Order{1, 2}));
}

TEST(Scheduler, BinarySemaphoresWaitForTheSignalBeforeThem) {
  Trial run(std::nullopt);
  run.submit(0, 1, {at(1, 1)}, {at(4, 0)});
  run.submit(1, 2, {at(4, 0)}, {});
  run.submit(2, 3, {at(77, 0)}, {});  // one that nobody here knows, as a swapchain signals it
  EXPECT_EQ(run.order, Order{3});
  run.submit(2, 4, {}, {at(1, 1)});
  EXPECT_EQ(run.order, (Order{3, 4, 1, 2}));
}

TEST(Scheduler, SeedsHoldEverythingUntilSomebodyWaits) {
  Trial run(7);
  run.submit(0, 1, {}, {at(1, 1)});
  run.submit(1, 2, {}, {at(2, 1)});
  EXPECT_EQ(run.order, Order{});
  const Scheduler::HostWait wait(run.scheduler);
  EXPECT_EQ(run.order.size(), 2u);
  run.submit(2, 3, {}, {});
  EXPECT_EQ(run.order.size(), 3u);
}

TEST(Scheduler, SeedsFindEveryLegalOrderAndNoOther) {
  std::vector<Order> found;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Trial run(seed);
    run.submit(0, 1, {}, {at(1, 1)});
    run.submit(1, 2, {at(1, 1)}, {});
    run.submit(2, 3, {}, {});
    run.scheduler.drain([] { return VK_SUCCESS; });
    if (std::find(found.begin(), found.end(), run.order) == found.end()) found.push_back(run.order);
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<Order>{{1, 2, 3}, {1, 3, 2}, {3, 1, 2}}));
}

}  // namespace
}  // namespace rgc_layer
