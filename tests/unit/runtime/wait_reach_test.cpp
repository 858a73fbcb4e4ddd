// Which passes of other queues a group comes after, by waits alone.
#include "runtime/wait_reach.h"

#include <gtest/gtest.h>

#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

enum : Index { kUpload, kAdd, kClear, kCopy };
enum : Index { kDiscarded, kReleased, kAcquired, kToHost };

TEST(WaitReach, FollowsWaitsFromQueueToQueue) {
  test::Relay t = test::relay();
  const WaitReach reach(t.plan.view());
  EXPECT_TRUE(reach.comes_after(kAcquired, kClear));
  EXPECT_TRUE(reach.comes_after(kAcquired, kUpload)) << "what it waits for has waited for that";
  EXPECT_TRUE(reach.comes_after(kDiscarded, kUpload));
  EXPECT_TRUE(reach.comes_after(kDiscarded, kCopy)) << "of the frame before";
}

TEST(WaitReach, KnowsNothingOfTheGroupsOwnQueue) {
  test::Relay t = test::relay();
  const WaitReach reach(t.plan.view());
  EXPECT_FALSE(reach.comes_after(kAcquired, kCopy));
  EXPECT_FALSE(reach.comes_after(kDiscarded, kAdd));
  EXPECT_FALSE(reach.comes_after(kReleased, kClear));
}

TEST(WaitReach, ReachesNothingWithoutAWait) {
  test::Relay t = test::relay();
  t.plan.batches[2].wait_count = 0;
  const WaitReach reach(t.plan.view());
  EXPECT_FALSE(reach.comes_after(kAcquired, kClear));
  EXPECT_FALSE(reach.comes_after(kAcquired, kUpload));
  EXPECT_TRUE(reach.comes_after(kDiscarded, kUpload));
}

}  // namespace
}  // namespace rg
