// Barriers in two halves on a real driver, under validation: the texels of plans without events.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/e2e/split_frame.h"

namespace rg::test {
namespace {

size_t events_of(const PlanData& plan) {
  return static_cast<size_t>(std::count_if(plan.groups.begin(), plan.groups.end(), [](const BarrierGroup& group) { return group.event != kNone; }));
}

TEST(SplitBarriers, TexelsAreThoseOfWholeOnes) {
  compiler::PlanOptions apart, whole;
  apart.reorder = whole.reorder = false;  // else `more` runs where it is in nobody's way
  whole.split = false;
  EXPECT_GT(events_of(compile_files(kSplitFrame, apart).graphs[0].plans[0].plan), 0u);
  EXPECT_EQ(events_of(compile_files(kSplitFrame, whole).graphs[0].plans[0].plan), 0u);
  const auto with = run(kSplitFrame, 3, true, {}, apart), without = run(kSplitFrame, 3, true, {}, whole);
  if (!with || !without) GTEST_SKIP() << "no device";
  EXPECT_EQ(*with, *without);
  ASSERT_EQ(with->size(), 64u);
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 0; x < 8; ++x) EXPECT_EQ((*with)[8 * y + x], 7 + 3 * (256 * x + x) + 65536 * y) << x << ", " << y;
}

}  // namespace
}  // namespace rg::test
