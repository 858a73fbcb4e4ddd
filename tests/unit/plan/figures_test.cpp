// What the deferred frame of the benchmarks costs: search effort counts evaluations, so the figures are the same everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "compiler/plan_frame.h"
#include "dsl/front_end.h"

namespace rg::compiler {
namespace {

const dsl::Program& deferred_frame() {
  static const dsl::Program program = [] {
    dsl::Diagnostics diagnostics;
    const auto read = [](const std::string& path, std::string&) -> std::optional<std::string> {
      std::ifstream file(path);
      std::ostringstream text;
      text << file.rdbuf();
      return text.str();
    };
    return dsl::load_program(std::string(RGC_SOURCE_DIR) + "/bench/graphs/g1_deferred.rg", read, diagnostics).program;
  }();
  return program;
}

FramePlan plan_with(PlanOptions options) { return plan_frame(deferred_frame(), dsl::GraphId{size_t{0}}, {}, options); }

// With the copies of the history.
double megabytes(const FramePlan& plan) {
  double bytes = static_cast<double>(plan.heap_bytes);
  for (const Resource& resource : plan.plan.resources)
    if (resource.lifetime == Lifetime::history) bytes += static_cast<double>(resource.estimated_bytes) * resource.copies;
  return bytes / 1e6;
}
size_t boundaries(const FramePlan& plan) { return plan.plan.groups.size() - 2; }  // those at the frame's ends are none

bool has(const FramePlan& plan, const std::string& subject, const std::string& what) {
  return std::any_of(plan.decisions.begin(), plan.decisions.end(), [&](const Decision& d) { return d.subject == subject && d.what == what; });
}

TEST(Figures, TheDefaultWeighsMemory) {
  const FramePlan plan = plan_with({});
  EXPECT_LE(boundaries(plan), 30u);
  EXPECT_LE(megabytes(plan), 172);
  EXPECT_EQ(plan.heap_bytes, plan.lower_bound_bytes);
}

// Two passes draw over each other; as one rendering they would keep what both read at once.
TEST(Figures, RenderingsThatTakeMemoryArePartedWhereMemoryCounts) {
  const FramePlan plan = plan_with({}), barriers = plan_with({.prefer = Prefer::barriers});
  EXPECT_TRUE(has(plan, "vol_apply", "not merged"));
  EXPECT_TRUE(has(plan, "ui", "merged"));
  EXPECT_TRUE(has(barriers, "vol_apply", "merged"));
  EXPECT_LT(boundaries(barriers), boundaries(plan));
  EXPECT_GT(barriers.heap_bytes, plan.heap_bytes);
}

TEST(Figures, FastIsWithinItsBounds) {
  const FramePlan plan = plan_with({.effort = Effort::fast});
  EXPECT_LE(boundaries(plan), 30u);
  EXPECT_LE(megabytes(plan), 184);
}

TEST(Figures, TheFrontierHasNoPointThatAnotherBeats) {
  const auto frontier = plan_with({}).order.frontier;
  ASSERT_GT(frontier.size(), 1u);
  for (size_t i = 1; i < frontier.size(); ++i) {
    EXPECT_LT(frontier[i - 1].groups, frontier[i].groups);
    EXPECT_GT(frontier[i - 1].bytes, frontier[i].bytes);
  }
}

TEST(Figures, TheLongSearchIsNeverBehindTheShortOne) {
  const FramePlan one = plan_with({}), longer = plan_with({.effort = Effort::max});
  const auto worth = [](const FramePlan& plan) {  // of --prefer balance
    const double bytes = static_cast<double>(plan.heap_bytes + 65536);
    return static_cast<double>(plan.plan.groups.size() - 1) * bytes * bytes * bytes;
  };
  EXPECT_LE(worth(longer), worth(one));
}

}  // namespace
}  // namespace rg::compiler
