// What a caller can get wrong, and what the engine brings along every frame.
#include "runtime/device_state.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using Inputs = test::NullTest;

void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};
constexpr RecordFunction kNothing[] = {nullptr};

std::string create_error(Device& device, test::TestPlan& plan, const GraphOptions& options) {
  const Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), options);
  return graph ? "no error" : graph.error().message;
}

TEST_F(Inputs, FramesInFlightAreOneToFour) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  options.frames_in_flight = 5;
  EXPECT_EQ(create_error(device, t.plan, options), "frames in flight: 5 is not in 1 to 4");
}

TEST_F(Inputs, ExtentsKeepToTheirMaximum) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  const int64_t too_large[] = {65, 4, 1};
  options.extents = too_large;
  EXPECT_EQ(create_error(device, t.plan, options), "extent `view`: 65 is not in 1 to 64");
  options.extents = std::span(too_large).first(2);
  EXPECT_EQ(create_error(device, t.plan, options), "extents: 2 values instead of 3");
}

TEST_F(Inputs, ParametersHaveTheirExactSize) {
  test::Counter t = test::counter();
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(test::message(graph.execute({})), "too few parameter blocks");
  const std::byte eight[8] = {};
  const std::span<const std::byte> params[] = {eight};
  FrameInputs inputs;
  inputs.params = params;
  EXPECT_EQ(test::message(graph.execute(inputs)), "parameter block `step` has 8 bytes instead of 4");
}

TEST_F(Inputs, CallbacksArePresent) {
  test::Tint t = test::tint();
  GraphInstance graph = make(t.plan);
  FrameInputs inputs;
  EXPECT_EQ(test::message(graph.execute(inputs)), "no callbacks");
  inputs.callbacks = kNothing;
  EXPECT_EQ(test::message(graph.execute(inputs)), "pass `draw` has no callback");
  inputs.callbacks = kIgnore;
  EXPECT_TRUE(graph.execute(inputs));
}

TEST_F(Inputs, ReadBackNeedsAFrameAndABuffer) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(graph.readback(t.result).error().message, "`result`: no frame was executed since creation or resize");
  frame(graph);
  EXPECT_EQ(graph.readback(t.color).error().message, "resource 0 is no readback buffer");
  EXPECT_EQ(graph.readback(t.result)->size(), 8u * 4 * 4);
}

TEST_F(Inputs, DumpsNeedTheirOption) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(test::message(graph.request_dump(0, t.color)), "dumps need GraphOptions::debug_readback");
  EXPECT_EQ(graph.take_dump().error().message, "no dump was requested and executed");
}

TEST_F(Inputs, DumpsCopyInTheLayoutOfThePass) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  options.debug_readback = true;
  GraphInstance graph = make(t.plan, options);
  ASSERT_TRUE(graph.request_dump(t.copy, t.color));
  const std::string text = frame(graph);
  const std::vector<std::string> copies = test::calls(text, "vkCmdCopyImageToBuffer");
  ASSERT_EQ(copies.size(), 2u);
  EXPECT_NE(text.find("layout 6->6"), std::string::npos);
  const Result<Dump> dump = graph.take_dump();
  ASSERT_TRUE(dump);
  EXPECT_EQ(dump->bytes.size(), 8u * 4 * 4);
  EXPECT_EQ(dump->bytes_per_texel, 4u);
  EXPECT_EQ(test::calls(frame(graph), "vkCmdCopyImageToBuffer").size(), 1u);
}

TEST_F(Inputs, SeveralDumpsOfAFrameAreTakenInTheOrderAsked) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  options.debug_readback = true;
  GraphInstance graph = make(t.plan, options);
  ASSERT_TRUE(graph.request_dump(t.copy, t.result));
  ASSERT_TRUE(graph.request_dump(0, t.color));
  ASSERT_TRUE(graph.request_dump(t.copy, t.color));
  EXPECT_EQ(graph.take_dump().error().message, "no dump was requested and executed");
  const std::string text = frame(graph);
  EXPECT_EQ(test::calls(text, "vkCmdCopyImageToBuffer").size(), 3u);  // one is the frame's own
  EXPECT_EQ(test::calls(text, "vkCmdCopyBuffer(").size() + test::calls(text, "vkCmdCopyBuffer ").size(), 1u);
  EXPECT_EQ(graph.take_dump()->format, Format::undefined);
  EXPECT_EQ(graph.take_dump()->width, 8u);
  EXPECT_EQ(graph.take_dump()->height, 4u);
  EXPECT_EQ(graph.take_dump().error().message, "no dump was requested and executed");
}

TEST_F(Inputs, AResizeForgetsDumpsThatWereNotExecuted) {
  test::ClearAndCopy t = test::clear_and_copy();
  GraphOptions options;
  options.debug_readback = true;
  GraphInstance graph = make(t.plan, options);
  ASSERT_TRUE(graph.request_dump(t.copy, t.color));
  frame(graph);
  ASSERT_TRUE(graph.request_dump(0, t.color));
  const int64_t extents[] = {16, 8, 1};
  ASSERT_TRUE(graph.resize(extents));
  frame(graph);
  EXPECT_EQ(graph.take_dump()->width, 8u);
  EXPECT_FALSE(graph.take_dump());
}

// ---- parameters ---------------------------------------------------------------------------------------------------

TEST_F(Inputs, ParameterBlocksLieInTheSectionOfTheirFrame) {
  test::Counter t = test::counter();
  GraphOptions options;
  options.frames_in_flight = 3;
  GraphInstance graph = make(t.plan, options);
  const uint32_t step = 1;
  const std::span<const std::byte> params[] = {std::as_bytes(std::span(&step, 1))};
  FrameInputs inputs;
  inputs.params = params;
  std::vector<std::string> offsets, sets;
  for (int i = 0; i < 4; ++i) {
    const std::string bind = test::calls(frame(graph, inputs), "vkCmdBindDescriptorSets").at(0);
    offsets.push_back(bind.substr(bind.rfind(' ') + 1));
    sets.push_back(bind.substr(bind.find(" set") + 1, 4));
  }
  EXPECT_EQ(offsets, (std::vector<std::string>{"0", "256", "512", "0"}));
  EXPECT_EQ(sets, (std::vector<std::string>{"set1", "set2", "set1", "set2"}));  // two copies of the history, not three frames
}

// ---- updates ------------------------------------------------------------------------------------------------------

struct Updated {
  test::TestPlan plan;
  Index table = 0;
};
Updated updated() {
  Updated t;
  t.table = t.plan.buffer("table", t.plan.constant(64), test::kCopyDst | test::kUniformBuffer);
  Transfer update;
  update.kind = TransferKind::update, update.dst = {t.table, 0}, update.update_slot = 0;
  t.plan.transfer("upload", {update});
  return t;
}

TEST_F(Inputs, UpdatesAreCopiedFromTheRing) {
  Updated t = updated();
  GraphInstance graph = make(t.plan);
  const std::byte bytes[48] = {};
  const std::span<const std::byte> updates[] = {bytes};
  FrameInputs inputs;
  EXPECT_EQ(test::message(graph.execute(inputs)), "too few updates");
  inputs.updates = updates;
  EXPECT_EQ(test::calls(frame(graph, inputs), "vkCmdCopyBuffer").at(0), "vkCmdCopyBuffer commands2 buffer2 buffer1 1 from 0 to 0 bytes 48");
  EXPECT_EQ(test::calls(frame(graph, inputs), "vkCmdCopyBuffer").at(0), "vkCmdCopyBuffer commands3 buffer2 buffer1 1 from 256 to 0 bytes 48");
  const std::byte too_many[65] = {};
  const std::span<const std::byte> wrong[] = {too_many};
  inputs.updates = wrong;
  EXPECT_EQ(test::message(graph.execute(inputs)), "update of `table`: 65 bytes for 64");
}

// ---- imports ------------------------------------------------------------------------------------------------------

// An imported image, cleared as an attachment and read by `tint` in place of the scene.
test::Tint tint_of_import() {
  test::Tint t = test::tint();
  Resource& scene = t.plan.resources[t.scene];
  scene.lifetime = Lifetime::imported, scene.import_slot = 0, scene.is_surface = true;
  return t;
}

template <class Handle>
Handle handle(uintptr_t value) {
  return reinterpret_cast<Handle>(value);
}

TEST_F(Inputs, ImportsAreNeeded) {
  test::Tint t = tint_of_import();
  GraphInstance graph = make(t.plan);
  FrameInputs inputs;
  inputs.callbacks = kIgnore;
  EXPECT_EQ(test::message(graph.execute(inputs)), "too few imports: 0 of 1");
  const Import none[] = {Import{}};
  inputs.imports = none;
  EXPECT_EQ(test::message(graph.execute(inputs)), "nothing is imported for `scene`");
}

TEST_F(Inputs, ImportsReachBarriersAttachmentsAndSets) {
  test::Tint t = tint_of_import();
  GraphInstance graph = make(t.plan);
  Import imports[] = {{{handle<VkImage>(70), handle<VkImageView>(80)}, {}}};
  FrameInputs inputs;
  inputs.callbacks = kIgnore, inputs.imports = imports;
  std::string text = frame(graph, inputs);
  EXPECT_NE(test::calls(text, "vkCmdPipelineBarrier2").at(0).find("[image70 "), std::string::npos);
  EXPECT_NE(test::calls(text, "vkCmdBeginRendering").at(0).find("color [view80 "), std::string::npos);
  EXPECT_NE(test::calls(text, "vkUpdateDescriptorSets").at(0).find("view80"), std::string::npos);

  imports[0].image = {handle<VkImage>(71), handle<VkImageView>(81)};
  text = frame(graph, inputs);
  EXPECT_NE(test::calls(text, "vkCmdPipelineBarrier2").at(1).find("[image71 "), std::string::npos);
  EXPECT_NE(test::calls(text, "vkUpdateDescriptorSets").at(0).find("view81"), std::string::npos);
}

TEST_F(Inputs, SetsAreWrittenOnlyWhereAnImportChanged) {
  test::Tint t = tint_of_import();
  GraphInstance graph = make(t.plan);  // two frames in flight: two sets
  Import imports[] = {{{handle<VkImage>(70), handle<VkImageView>(80)}, {}}};
  FrameInputs inputs;
  inputs.callbacks = kIgnore, inputs.imports = imports;
  std::vector<size_t> writes;
  for (int i = 0; i < 4; ++i) writes.push_back(test::calls(frame(graph, inputs), "vkUpdateDescriptorSets").size());
  EXPECT_EQ(writes, (std::vector<size_t>{1, 1, 0, 0}));
}

TEST_F(Inputs, ViewsOfImportsAreMadeOnceAnImage) {
  test::Tint t = tint_of_import();
  GraphInstance graph = make(t.plan);
  Import imports[1];
  FrameInputs inputs;
  inputs.callbacks = kIgnore, inputs.imports = imports;
  std::vector<size_t> created;
  for (int i = 0; i < 7; ++i) {
    imports[0].image.image = handle<VkImage>(70 + static_cast<uintptr_t>(i) % 3);  // a swapchain of three, without views
    created.push_back(test::calls(frame(graph, inputs), "vkCreateImageView").size());
  }
  EXPECT_EQ(created, (std::vector<size_t>{2, 2, 2, 0, 0, 0, 0}));  // as an attachment and as a texture
  for (uintptr_t i = 0; i < 100; ++i) {
    imports[0].image.image = handle<VkImage>(100 + i);
    frame(graph, inputs);
  }
}

TEST_F(Inputs, BuffersAreImportedWithTheirOffset) {
  test::TestPlan p;
  Resource lights;
  lights.name = "lights", lights.kind = ResourceKind::buffer, lights.lifetime = Lifetime::imported, lights.import_slot = 0,
  lights.usage = test::kCopyDst;
  const Index index = test::TestPlan::add(p.resources, lights);
  p.barriers({}, {test::buffer_barrier({index, 0}, stage::copy, access::none, stage::clear, access::transfer_write)});
  Transfer fill;
  fill.kind = TransferKind::fill, fill.dst = {index, 0}, fill.value.word[0] = 5;
  p.transfer("fill", {fill});
  GraphInstance graph = make(p);
  const Import imports[] = {{{}, {handle<VkBuffer>(90), 256, 1024}}};
  FrameInputs inputs;
  inputs.imports = imports;
  const std::string text = frame(graph, inputs);
  EXPECT_EQ(test::calls(text, "vkCmdFillBuffer").at(0), "vkCmdFillBuffer commands2 buffer90 256 1024 5");
  EXPECT_NE(test::calls(text, "vkCmdPipelineBarrier2").at(0).find("bytes 256+1024"), std::string::npos);
}

// ---- indirect work ------------------------------------------------------------------------------------------------

struct Indirect {
  test::TestPlan plan;
  Pass pass;
};
Indirect indirect() {
  Indirect t;
  test::TestPlan& p = t.plan;
  const Index arguments = p.buffer("arguments", p.constant(256), test::kIndirectBuffer),
              counts = p.buffer("counts", p.constant(4), test::kIndirectBuffer);
  t.pass.name = "indirect", t.pass.kind = PassKind::raster;
  t.pass.work.arguments = {arguments, 0}, t.pass.work.arguments_offset = p.constant(32), t.pass.work.counts = {counts, 0};
  t.pass.work.max_draws = 4;
  return t;
}

TEST_F(Inputs, IndirectWorkReadsItsArgumentsAtTheirOffset) {
  Indirect t = indirect();
  auto& [p, pass] = t;
  for (const WorkKind kind :
       {WorkKind::draw_indirect, WorkKind::draw_indexed_indirect, WorkKind::draw_indirect_count, WorkKind::draw_indexed_indirect_count}) {
    pass.work.kind = kind, pass.work.stride = kind == WorkKind::draw_indirect || kind == WorkKind::draw_indirect_count ? 16 : 20;
    p.pass(pass);
  }
  pass.kind = PassKind::compute, pass.work.kind = WorkKind::dispatch_indirect;
  p.pass(pass);
  GraphInstance graph = make(p);
  const std::string text = frame(graph);
  EXPECT_EQ(test::calls(text, "vkCmdDrawIndirect ").at(0), "vkCmdDrawIndirect commands2 buffer1 32 4 16");
  EXPECT_EQ(test::calls(text, "vkCmdDrawIndexedIndirect ").at(0), "vkCmdDrawIndexedIndirect commands2 buffer1 32 4 20");
  EXPECT_EQ(test::calls(text, "vkCmdDrawIndirectCount").at(0), "vkCmdDrawIndirectCount commands2 buffer1 32 buffer2 0 4 16");
  EXPECT_EQ(test::calls(text, "vkCmdDrawIndexedIndirectCount").at(0), "vkCmdDrawIndexedIndirectCount commands2 buffer1 32 buffer2 0 4 20");
  EXPECT_EQ(test::calls(text, "vkCmdDispatchIndirect").at(0), "vkCmdDispatchIndirect commands2 buffer1 32");
}

TEST_F(Inputs, DrawsAreCallsOfTheirOwnWhereTheDeviceWantsThem) {
  Indirect t = indirect();
  t.pass.work.kind = WorkKind::draw_indexed_indirect, t.pass.work.stride = 20;
  t.plan.pass(t.pass);
  device.state().multi_draw_indirect = false;
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(test::calls(frame(graph), "vkCmdDrawIndexedIndirect "),
            (std::vector<std::string>{"vkCmdDrawIndexedIndirect commands2 buffer1 32 1 20", "vkCmdDrawIndexedIndirect commands2 buffer1 52 1 20",
                                      "vkCmdDrawIndexedIndirect commands2 buffer1 72 1 20", "vkCmdDrawIndexedIndirect commands2 buffer1 92 1 20"}));
}

TEST_F(Inputs, CountedDrawsAreRefusedWithoutTheFeature) {
  for (const WorkKind kind : {WorkKind::draw_indirect_count, WorkKind::draw_indexed_indirect_count}) {
    Indirect t = indirect();
    t.pass.work.kind = kind, t.pass.work.stride = kind == WorkKind::draw_indirect_count ? 16 : 20;
    t.plan.pass(t.pass);
    device.state().draw_indirect_count = true;
    EXPECT_TRUE(GraphInstance::create(device, t.plan.view(), {}));
    device.state().draw_indirect_count = false;
    const auto refused = GraphInstance::create(device, t.plan.view(), {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
    EXPECT_EQ(refused.error().message, "pass `indirect` takes the number of its draws from a buffer, which `null` cannot (drawIndirectCount)");
  }
}

}  // namespace
}  // namespace rg
