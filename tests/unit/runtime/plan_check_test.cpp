// A plan that points outside itself is refused with the row that does.
#include "runtime/plan_check.h"

#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

template <class Break>
std::string fault(Break&& break_plan) {
  test::Tint t = test::tint();
  break_plan(t.plan);
  const Status status = check_plan(t.plan.view());
  if (status) return "no error";
  EXPECT_EQ(status.error().code, ErrorCode::invalid_plan);
  return status.error().message;
}

TEST(PlanCheck, AcceptsWhatIsWhole) {
  EXPECT_EQ(fault([](test::TestPlan&) {}), "no error");
}

TEST(PlanCheck, NamesTheRow) {
  using P = test::TestPlan;
  EXPECT_EQ(fault([](P& p) { p.base.version = 9; }), "plan `test` has version 9; this runtime runs version 1");
  EXPECT_EQ(fault([](P& p) { p.exprs[2].a = 2; }), "plan `test`: expression 2: first operand");
  EXPECT_EQ(fault([](P& p) { p.exprs[0].value = 3; }), "plan `test`: expression 0: extent");
  EXPECT_EQ(fault([](P& p) { p.resources[1].width = 99; }), "plan `test`: resource 1: size");
  EXPECT_EQ(fault([](P& p) { p.resources[0].samples = 3; }), "plan `test`: resource 0: samples");
  EXPECT_EQ(fault([](P& p) { p.resources[0].lifetime = Lifetime::readback; }), "plan `test`: resource 0: only buffers are read back");
  EXPECT_EQ(fault([](P& p) { p.resources[0].lifetime = Lifetime::imported; }), "plan `test`: resource 0: import slot");
  EXPECT_EQ(fault([](P& p) { p.resources[0].lazy = true; }), "plan `test`: resource 0: lazy, and no transient that is only an attachment");
  EXPECT_EQ(fault([](P& p) { p.groups[1].image_count = 9; }), "plan `test`: group 1: image barriers");
  EXPECT_EQ(fault([](P& p) { p.image_barriers[2].image.resource = 2; }), "plan `test`: image barrier 2: image");
  EXPECT_EQ(fault([](P& p) { p.buffer_barriers[0].buffer.resource = kNone; }), "plan `test`: buffer barrier 0: buffer");
  EXPECT_EQ(fault([](P& p) { p.acquires.push_back({0, 0, 0, 1, 0, 0}); }), "plan `test`: acquire 0: no release");
  EXPECT_EQ(fault([](P& p) { p.renderings[0].color_count = 7; }), "plan `test`: rendering 0: colours");
  EXPECT_EQ(fault([](P& p) { p.renderings[1].depth = 5; }), "plan `test`: rendering 1: depth or stencil");
  EXPECT_EQ(fault([](P& p) { p.attachments[1].ref.resource = 2; }), "plan `test`: attachment 1: image");
  EXPECT_EQ(fault([](P& p) { p.attachments[1].slices = 1; }), "plan `test`: attachment 1: slices");
  EXPECT_EQ(fault([](P& p) { p.renderings[1].view_mask = 2; }), "plan `test`: rendering 1: more views than layers");
  EXPECT_EQ(fault([](P& p) { p.passes[1].work.vertex_buffer_count = 1; }), "plan `test`: pass 1: vertex buffers");
  EXPECT_EQ(fault([](P& p) { p.vertex_buffers.push_back({{0, 0}, kNone}); }), "plan `test`: vertex buffer 0: buffer");
  EXPECT_EQ(fault([](P& p) { p.passes[1].work.kind = WorkKind::draw_indexed; }), "plan `test`: pass 1: an indexed draw without indices");
  EXPECT_EQ(fault([](P& p) { p.passes[1].work.index_bytes = 3; }), "plan `test`: pass 1: bytes of an index");
  EXPECT_EQ(fault([](P& p) { p.passes[1].work.first = 999; }), "plan `test`: pass 1: draw");
  EXPECT_EQ(fault([](P& p) { p.pipelines[0].shader_count = 3; }), "plan `test`: pipeline 0: shaders");
  EXPECT_EQ(fault([](P& p) { p.pipeline_shaders[1] = 2; }), "plan `test`: pipeline shader 1: shader");
  EXPECT_EQ(fault([](P& p) { p.bindings[0].sampler = 1; }), "plan `test`: binding 0: sampler");
  EXPECT_EQ(fault([](P& p) { p.bindings[0].ref.resource = 2; }), "plan `test`: binding 0: image");
  EXPECT_EQ(fault([](P& p) { p.transfers[0].dst.resource = 0; }), "plan `test`: transfer 0: target");
  EXPECT_EQ(fault([](P& p) { p.passes[1].pipeline = 1; }), "plan `test`: pass 1: pipeline");
  EXPECT_EQ(fault([](P& p) { p.passes[1].params_count = 1; }), "plan `test`: pass 1: parameter blocks");
  EXPECT_EQ(fault([](P& p) { p.passes[0].kind = PassKind::compute; }), "plan `test`: pass 0: attachments outside a raster pass");
  EXPECT_EQ(fault([](P& p) { p.steps[1].index = 17; }), "plan `test`: step 1: index");
  EXPECT_EQ(fault([](P& p) { p.batches.push_back({3, 0, 0, 0, 0, 0, 0}); }), "plan `test`: batch 0: queue");
}

// Each was found by tests/fuzz/fuzz_plan_file.cpp, or by reading what it could have found.
TEST(PlanCheck, WhatIsNotUsedMustStillBeThere) {
  using P = test::TestPlan;
  EXPECT_EQ(fault([](P& p) { p.groups[0].first_buffer = 1u << 20; }), "plan `test`: group 0: buffer barriers");
  EXPECT_EQ(fault([](P& p) { p.passes[1].work.counts.resource = 99; }), "plan `test`: a table's row 1: resource");
  EXPECT_EQ(fault([](P& p) { p.accesses[1].layout = Layout{UINT32_MAX}; }), "plan `test`: a table's row 1: enumerator");
  EXPECT_EQ(fault([](P& p) { p.bindings[0].type = DescriptorType::sampler; }), "plan `test`: binding 0: a resource that it does not show");
  EXPECT_EQ(fault([](P& p) { p.extents[0].initial[0] = 100; }), "plan `test`: extent 0: initial, smallest and largest value");
  EXPECT_EQ(fault([](P& p) { p.resources[0].layers = 1u << 20; }), "plan `test`: resource 0: mips or layers");
  EXPECT_EQ(fault([](P& p) { p.passes[1].work.kind = WorkKind::dispatch; }), "plan `test`: pass 1: a dispatch outside a compute pass");
  EXPECT_EQ(fault([](P& p) { p.passes[1].work.max_draws = 1u << 30; }), "plan `test`: pass 1: most draws");
}

TEST(PlanCheck, HistoriesOfManyLengthsAreRefused) {
  test::Counter t = test::counter();
  for (const uint32_t copies : {17u, 19u, 23u}) {
    Resource history = t.plan.resources[t.state];
    history.copies = copies;
    const Index index = test::TestPlan::add(t.plan.resources, history);
    t.plan.buffer_barriers.push_back(test::buffer_barrier({index, 0}, stage::copy, 0, stage::copy, 0));
  }
  t.plan.groups.back().first_buffer = 0, t.plan.groups.back().buffer_count = static_cast<uint32_t>(t.plan.buffer_barriers.size());
  EXPECT_EQ(test::message(check_plan(t.plan.view())), "plan `test`: group 2: histories of too many different lengths");
}

// Sizes wrap; what comes out is refused, not undefined.
TEST(PlanCheck, SizesThatOverflowAreRefused) {
  test::ClearAndCopy t = test::clear_and_copy();
  Index value = t.plan.constant(3);
  for (int i = 0; i < 7; ++i) value = t.plan.binary(ExprOp::mul, value, value);
  t.plan.resources[t.result].bytes = t.plan.binary(ExprOp::max, value, t.plan.constant(int64_t{1} << 50));
  Device device = Device::null(nullptr);
  const auto graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.error().code, ErrorCode::unsupported);
}

TEST(PlanCheck, SharedOperandsCostNothing) {
  test::ClearAndCopy t = test::clear_and_copy();
  Index value = t.plan.constant(0);
  for (int i = 0; i < 200; ++i) value = t.plan.binary(ExprOp::add, value, value);  // 2^200 paths
  t.plan.resources[t.color].depth = value;
  Device device = Device::null(nullptr);
  EXPECT_TRUE(GraphInstance::create(device, t.plan.view(), {}));
}

}  // namespace
}  // namespace rg
