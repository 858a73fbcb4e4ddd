// A successor makes the pipelines that have changed and no other; whoever is left last destroys what both have.
#include <optional>

#include "runtime/functions.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

struct Reuse : testing::Test {
  // How many pipelines a successor by `edited` makes of an instance of `plan`.
  size_t made(test::TestPlan& plan, test::TestPlan& edited) {
    Result<GraphInstance> first = GraphInstance::create(device, plan.view(), {});
    EXPECT_TRUE(first) << first.error().message;
    log.clear();
    Result<GraphInstance> second = GraphInstance::create_successor(*first, edited.view(), {});
    EXPECT_TRUE(second) << second.error().message;
    return test::calls(log, "vkCreateGraphicsPipelines").size() + test::calls(log, "vkCreateComputePipelines").size();
  }
  template <class Change>
  size_t made_after(Change change) {
    test::Tint before = test::tint(), after = test::tint();
    change(after);
    return made(before.plan, after.plan);
  }

  std::string log;
  NullCounters counters;
  Device device = Device::null(&log, {.counters = &counters});
};

TEST_F(Reuse, NothingIsMadeWhereNothingChanged) {
  EXPECT_EQ(made_after([](test::Tint&) {}), 0u);
  test::Counter a = test::counter(), b = test::counter();
  EXPECT_EQ(made(a.plan, b.plan), 0u);
}

TEST_F(Reuse, WhatAPipelineIsMadeOfMakesAnother) {
  using T = test::Tint;
  static const uint32_t kOther[] = {0x07230203, 0x00010500, 0, 1, 0};
  EXPECT_EQ(made_after([](T& t) { t.plan.shaders[t.plan.pipeline_shaders[t.plan.pipelines[0].first_shader]].words = kOther; }), 1u);
  EXPECT_EQ(made_after([](T& t) { t.plan.pipelines[0].raster.depth_bias_slope = 1; }), 1u);
  EXPECT_EQ(made_after([](T& t) { t.plan.pipelines[0].raster.depth_bounds = true; }), 1u);
  EXPECT_EQ(made_after([](T& t) { t.plan.resources[t.final].format = test::kR32f; }), 1u);
  EXPECT_EQ(made_after([](T& t) { t.plan.bindings[t.plan.passes[t.tint].first_binding].stages |= test::kVertexBit; }), 1u);
  EXPECT_EQ(made_after([](T& t) { t.plan.passes[t.tint].name = "another"; }), 1u) << "passes are found by name";
}

TEST_F(Reuse, WhereSampleLocationsStandIsOfNoConsequence) {
  const auto with = [](test::Tint& t, Index first, float x) {
    t.plan.sample_locations.assign(first + 1, {x, 0.5f});
    t.plan.pipelines[0].raster.first_sample_location = first;
    t.plan.pipelines[0].raster.sample_location_count = 1;
  };
  test::Tint a = test::tint(), b = test::tint(), c = test::tint();
  with(a, 0, 0.25f), with(b, 3, 0.25f), with(c, 0, 0.75f);
  EXPECT_EQ(made(a.plan, b.plan), 0u);
  EXPECT_EQ(made(a.plan, c.plan), 1u);
}

TEST_F(Reuse, SharedPipelinesLiveAsLongAsTheLastOfThem) {
  for (const bool first_goes_first : {true, false}) {
    test::Tint plan = test::tint();
    Result<GraphInstance> made = GraphInstance::create(device, plan.plan.view(), {});
    ASSERT_TRUE(made);
    std::optional<GraphInstance> first = std::move(*made);
    made = GraphInstance::create_successor(*first, plan.plan.view(), {});
    ASSERT_TRUE(made);
    std::optional<GraphInstance> second = std::move(*made);
    log.clear();
    (first_goes_first ? first : second).reset();
    EXPECT_TRUE(test::calls(log, "vkDestroyPipeline pipeline").empty());
    log.clear();
    (first_goes_first ? second : first).reset();
    EXPECT_FALSE(log.empty());
  }
  EXPECT_EQ(counters.live_handles, 0u);
  EXPECT_EQ(counters.wrong_destroys, 0u);
}

}  // namespace
}  // namespace rg
