// Whole frames on a driver, with validation listening: results and silence.
#include "tests/unit/device/fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using Frames = test::DeviceTest;
using test::TestPlan;

void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

std::span<const std::byte> bytes_of(const uint32_t& value) { return std::as_bytes(std::span(&value, 1)); }

void count_up(Device& device, uint32_t frames_in_flight) {
  test::Counter t = test::counter();
  GraphOptions options;
  options.frames_in_flight = frames_in_flight;
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), options);
  ASSERT_TRUE(graph) << graph.error().message;
  uint32_t expected = 7;
  for (uint32_t frame = 0; frame < 5; ++frame) {
    const uint32_t step = frame + 1;
    const std::span<const std::byte> params[] = {bytes_of(step)};
    FrameInputs inputs;
    inputs.params = params;
    RG_ASSERT_OK(graph->execute(inputs));
    expected += step;
    if (frame % 2 == 1) continue;  // frames that nobody waits for overlap
    const auto result = graph->readback(t.result);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(test::as<uint32_t>(*result), std::vector<uint32_t>(64, expected)) << "frame " << frame;
  }
}

TEST_F(Frames, HistoryCarriesValuesOverFrames) {
  RG_OPEN_DEVICE(device, true);
  for (uint32_t frames_in_flight = 1; frames_in_flight <= 4; ++frames_in_flight) count_up(device, frames_in_flight);
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

TEST_F(Frames, InvalidationStartsOneResourceAgain) {
  RG_OPEN_DEVICE(device, true);
  for (uint32_t frames_in_flight = 1; frames_in_flight <= 4; ++frames_in_flight) {
    test::Counter t = test::counter();
    GraphOptions options;
    options.frames_in_flight = frames_in_flight;
    Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), options);
    ASSERT_TRUE(graph) << graph.error().message;
    const uint32_t step = 10;
    const std::span<const std::byte> params[] = {bytes_of(step)};
    FrameInputs inputs;
    inputs.params = params;
    uint32_t expected = 7;
    for (uint32_t frame = 0; frame < 12; ++frame) {
      if (frame % 5 == 3) {
        RG_ASSERT_OK(graph->invalidate(t.state));
        expected = 7;
      }
      RG_ASSERT_OK(graph->execute(inputs));
      expected += step;
      if (frame % 3 != 1) continue;
      EXPECT_EQ(test::as<uint32_t>(*graph->readback(t.result)), std::vector<uint32_t>(64, expected)) << "frame " << frame;
    }
  }
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

// `kept` is read into `result`, then overwritten where the condition holds.
struct KeptImage {
  TestPlan plan;
  Index kept = 0, result = 0;
};
KeptImage kept_image() {
  KeptImage t;
  TestPlan& p = t.plan;
  const Index side = p.constant(8);
  t.kept = p.image("kept", test::kR32f, side, side, test::kCopySrc | test::kCopyDst);
  p.resources[t.kept].lifetime = Lifetime::persistent, p.resources[t.kept].init = InitKind::clear;
  p.resources[t.kept].init_value = {{0x3f800000, 0, 0, 0}};  // 1
  t.result = p.buffer("result", p.constant(8 * 8 * 4), test::kCopyDst, Lifetime::readback);
  p.conditions = {"overwrite"};
  p.entry.push_back({{t.kept, 0}, {}, stage::clear, access::transfer_write, Layout::transfer_dst});
  p.barriers({test::transition(t.kept, stage::clear, access::transfer_write, Layout::transfer_dst, stage::copy, access::transfer_read,
                               Layout::transfer_src)});
  Transfer copy, clear;
  copy.kind = TransferKind::copy_image_to_buffer, copy.src = {t.kept, 0}, copy.dst = {t.result, 0};
  p.transfer("read", {copy},
             {test::touches({t.kept, 0}, stage::copy, access::transfer_read, Layout::transfer_src, false),
              test::touches({t.result, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  p.barriers({test::transition(t.kept, stage::copy, 0, Layout::transfer_src, stage::clear, access::transfer_write, Layout::transfer_dst)},
             {test::to_host(t.result)});
  clear.kind = TransferKind::clear_color, clear.dst = {t.kept, 0}, clear.value = {{0x40800000, 0, 0, 0}};  // 4
  const Index overwrite =
      p.transfer("overwrite", {clear}, {test::touches({t.kept, 0}, stage::clear, access::transfer_write, Layout::transfer_dst, true)});
  p.passes[overwrite].guard = 1;
  return t;
}

TEST_F(Frames, APersistentImageIsResetToItsDeclaredValue) {
  RG_OPEN_DEVICE(device, true);
  KeptImage t = kept_image();
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  const auto frame = [&](bool overwrite) {
    FrameInputs inputs;
    inputs.conditions = overwrite ? 1 : 0;
    const Status done = graph->execute(inputs);
    EXPECT_TRUE(done) << done.error().message;
    return test::as<float>(*graph->readback(t.result));
  };
  EXPECT_EQ(frame(true), std::vector<float>(64, 1.0f));
  EXPECT_EQ(frame(false), std::vector<float>(64, 4.0f));
  RG_ASSERT_OK(graph->invalidate(t.kept));
  EXPECT_EQ(frame(false), std::vector<float>(64, 1.0f));
  EXPECT_EQ(frame(true), std::vector<float>(64, 1.0f));
  EXPECT_EQ(frame(false), std::vector<float>(64, 4.0f));
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

TEST_F(Frames, ResizeStartsHistoryAgain) {
  RG_OPEN_DEVICE(device, true);
  test::Counter t = test::counter();
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  const uint32_t step = 10;
  const std::span<const std::byte> params[] = {bytes_of(step)};
  FrameInputs inputs;
  inputs.params = params;
  for (int round = 0; round < 3; ++round) {
    RG_ASSERT_OK(graph->execute(inputs));
    RG_ASSERT_OK(graph->execute(inputs));
    EXPECT_EQ(test::as<uint32_t>(*graph->readback(t.result))[0], 27u);
    RG_ASSERT_OK(graph->execute(inputs));
    RG_ASSERT_OK(graph->resize({}));
  }
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

void swap_red_and_green(Device& device) {
  test::Tint t = test::tint();
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_EQ(graph->pass_info(t.draw).render_pass != VK_NULL_HANDLE, device.validating());
  FrameInputs inputs;
  inputs.callbacks = kIgnore;
  for (const int64_t side : {8, 16, 5}) {
    const int64_t extents[] = {side, 4, 1};
    RG_ASSERT_OK(graph->resize(extents));
    EXPECT_EQ(graph->pass_info(t.tint).extent.width, static_cast<uint32_t>(side));
    for (int frame = 0; frame < 3; ++frame) RG_ASSERT_OK(graph->execute(inputs));
    EXPECT_EQ(test::as<uint32_t>(*graph->readback(t.result)), std::vector<uint32_t>(static_cast<size_t>(side) * 4, 0xffff00ffu));
  }
}

TEST_F(Frames, RasterPassesDrawWithClassicRenderPasses) {
  RG_OPEN_DEVICE(device, true);
  swap_red_and_green(device);
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

TEST_F(Frames, RasterPassesDrawWithDynamicRendering) {
  RG_OPEN_DEVICE(device, false);
  swap_red_and_green(device);
}

TEST_F(Frames, PassesOnMissingMipsAreSkipped) {
  RG_OPEN_DEVICE(device, true);
  test::Mips t = test::mips();
  GraphOptions options;
  options.debug_readback = true;
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), options);
  ASSERT_TRUE(graph) << graph.error().message;
  for (const uint32_t side : {8u, 2u, 1u}) {
    const int64_t extents[] = {side, 1, 1};
    RG_ASSERT_OK(graph->resize(extents));
    uint32_t last = 0;
    while (last < 3 && side >> (last + 1) != 0) ++last;
    RG_ASSERT_OK(graph->request_dump(3, t.image, last));
    RG_ASSERT_OK(graph->execute({}));
    const Result<Dump> dump = graph->take_dump();
    ASSERT_TRUE(dump) << dump.error().message;
    EXPECT_EQ(dump->width, std::max(side >> last, 1u));
    EXPECT_EQ(test::as<float>(dump->bytes)[0], static_cast<float>(last));
    EXPECT_FALSE(graph->request_dump(3, t.image, last + 1));
  }
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

// One aspect of a depth and stencil image is attached, the other left alone.
void attach_depth_only(Device& device, Layout layout, uint32_t aspects) {
  test::TestPlan p;
  const Index side = p.constant(16),
              image = p.image("depth", Format{130}, side, side, test::kDepthAttachment | test::kCopySrc, aspect_depth | aspect_stencil);
  constexpr Stages tests = stage::early_fragment_tests | stage::late_fragment_tests;
  ImageBarrier barrier = test::discard(image, tests, access::depth_stencil_attachment_read | access::depth_stencil_attachment_write, layout, tests);
  barrier.src_accesses = access::depth_stencil_attachment_write, barrier.range.aspects = aspects;
  p.barriers({barrier});
  Attachment depth;
  depth.ref = {image, 0}, depth.range.aspects = aspect_depth, depth.layout = layout, depth.load = LoadOp::clear, depth.clear.word[0] = 0x3f000000;
  Rendering rendering;
  rendering.depth = test::TestPlan::add(p.attachments, depth), rendering.width = rendering.height = side;
  Pass pass;
  pass.name = "prepass", pass.kind = PassKind::raster, pass.rendering = test::TestPlan::add(p.renderings, rendering);
  const Index index = p.pass(pass, {test::touches({image, 0}, tests, access::depth_stencil_attachment_write, layout, true)});
  GraphOptions options;
  options.debug_readback = true;
  Result<GraphInstance> graph = GraphInstance::create(device, p.view(), options);
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_EQ(graph->pass_info(index).stencil_format, VK_FORMAT_UNDEFINED);
  RG_ASSERT_OK(graph->request_dump(index, image));
  for (int frame = 0; frame < 3; ++frame) RG_ASSERT_OK(graph->execute({}));
  const Result<Dump> dump = graph->take_dump();
  ASSERT_TRUE(dump) << dump.error().message;
  EXPECT_EQ(test::as<float>(dump->bytes), std::vector<float>(256, 0.5f));
}

// The stencil of an image whose depth nobody has written: cleared in one pass, tested in the next.
void attach_stencil_only(Device& device, Layout layout, uint32_t aspects) {
  test::TestPlan p;
  const Index side = p.constant(16),
              image = p.image("mask", Format{130}, side, side, test::kDepthAttachment | test::kCopySrc, aspect_depth | aspect_stencil);
  constexpr Stages tests = stage::early_fragment_tests | stage::late_fragment_tests;
  constexpr Accesses all = access::depth_stencil_attachment_read | access::depth_stencil_attachment_write;
  for (const bool first : {true, false}) {
    ImageBarrier barrier = test::discard(image, tests, all, layout, tests);
    barrier.src_accesses = access::depth_stencil_attachment_write, barrier.range.aspects = aspects;
    if (!first) barrier.old_layout = layout;
    p.barriers({barrier});
    Attachment mask;
    mask.ref = {image, 0}, mask.range.aspects = aspect_stencil, mask.layout = layout, mask.load = first ? LoadOp::clear : LoadOp::load;
    mask.clear.word[1] = 7;
    Rendering rendering;
    rendering.stencil = test::TestPlan::add(p.attachments, mask), rendering.width = rendering.height = side;
    Pass pass;
    pass.name = first ? "mark" : "test", pass.kind = PassKind::raster, pass.rendering = test::TestPlan::add(p.renderings, rendering);
    p.pass(pass, {test::touches({image, 0}, tests, access::depth_stencil_attachment_write, layout, true)});
  }
  Result<GraphInstance> graph = GraphInstance::create(device, p.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  for (int frame = 0; frame < 3; ++frame) RG_ASSERT_OK(graph->execute({}));
  RG_ASSERT_OK(graph->wait_idle());
}

TEST_F(Frames, StencilIsAttachedWithoutItsDepth) {
  for (const bool validate : {false, true}) {
    RG_OPEN_DEVICE(device, validate);
    attach_stencil_only(device, Layout::stencil_attachment, aspect_stencil);
    attach_stencil_only(device, Layout::depth_stencil_attachment, aspect_depth | aspect_stencil);
    EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
  }
}

TEST_F(Frames, DepthIsAttachedWithoutItsStencil) {
  for (const bool validate : {false, true}) {
    RG_OPEN_DEVICE(device, validate);
    attach_depth_only(device, Layout::depth_attachment, aspect_depth);
    attach_depth_only(device, Layout::depth_stencil_attachment, aspect_depth | aspect_stencil);
    EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
  }
}

void share_memory(Device& device, bool aliasing, bool poison) {
  test::Aliased t = test::aliased();
  GraphOptions options;
  options.aliasing = aliasing, options.poison = poison;
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), options);
  ASSERT_TRUE(graph) << graph.error().message;
  for (int frame = 0; frame < 4; ++frame) {
    RG_ASSERT_OK(graph->execute({}));
    EXPECT_EQ(test::as<uint32_t>(*graph->readback(t.result_a)), std::vector<uint32_t>(4096, 0xffffffffu));
    EXPECT_EQ(test::as<float>(*graph->readback(t.result_b)), std::vector<float>(4096, 2.0f));
  }
  const MemoryReport memory = graph->memory();
  EXPECT_EQ(memory.heap_bytes, aliasing ? memory.lower_bound_bytes : memory.unaliased_bytes);
  EXPECT_EQ(memory.heap_bytes < memory.unaliased_bytes, aliasing);
}

TEST_F(Frames, TransientsShareMemory) {
  RG_OPEN_DEVICE(device, true);
  for (const bool aliasing : {false, true})
    for (const bool poison : {false, true}) share_memory(device, aliasing, poison);
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

TEST_F(Frames, EachPassInItsOwnSubmitGivesTheSameResult) {
  RG_OPEN_DEVICE(device, true);
  test::Tint t = test::tint();
  GraphOptions options;
  options.submit_per_pass = true;
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), options);
  ASSERT_TRUE(graph) << graph.error().message;
  FrameInputs inputs;
  inputs.callbacks = kIgnore;
  for (int frame = 0; frame < 3; ++frame) RG_ASSERT_OK(graph->execute(inputs));
  EXPECT_EQ(test::as<uint32_t>(*graph->readback(t.result)), std::vector<uint32_t>(32, 0xffff00ffu));
  const std::vector<PassTime> times = graph->pass_times();
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[1].pass, "tint");
  for (const PassTime& time : times) EXPECT_GT(time.ms, 0);
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

TEST_F(Frames, TimestampsAreOfTheLastFinishedFrame) {
  RG_OPEN_DEVICE(device, false);
  test::Tint t = test::tint();
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_TRUE(graph->pass_times().empty());
  FrameInputs inputs;
  inputs.callbacks = kIgnore;
  RG_ASSERT_OK(graph->execute(inputs));
  RG_ASSERT_OK(graph->wait_idle());
  const std::vector<PassTime> times = graph->pass_times();
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[0].pass, "draw");
  for (const PassTime& time : times) EXPECT_GE(time.ms, 0);
}

}  // namespace
}  // namespace rg
