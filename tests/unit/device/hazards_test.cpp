// Planted hazards: a correct frame, one row of its plan broken, and the validation layer must say so. If it stays silent, then its silence
// about correct frames means nothing.
#include "tests/unit/device/fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

class Hazards : public test::DeviceTest {
 protected:
  // Runs frames without waiting for any, so that hazards between submits are hazards.
  void run(test::TestPlan& plan) {
    RG_OPEN_DEVICE(device, true);
    ASSERT_TRUE(device.validating());
    GraphOptions options;
    options.frames_in_flight = 4;
    Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), options);
    ASSERT_TRUE(graph) << graph.error().message;
    const uint32_t step = 1;
    const std::span<const std::byte> params[] = {std::as_bytes(std::span(&step, 1))};
    const std::vector<uint32_t> given(64, 5);
    const std::span<const std::byte> updates[] = {std::as_bytes(std::span(given))};
    FrameInputs inputs;
    inputs.params = params, inputs.callbacks = kIgnore, inputs.updates = updates;
    for (int frame = 0; frame < 4; ++frame) RG_ASSERT_OK(graph->execute(inputs));
    RG_ASSERT_OK(graph->wait_idle());
    ran = true;
    count = device.validation_messages();
  }
  void expect(std::string_view text) {
    if (!ran) return;
    EXPECT_TRUE(reported(text)) << "reported instead:\n" << all_messages();
    EXPECT_EQ(count, messages.size());
  }

  bool ran = false;
  uint64_t count = 0;
};

TEST_F(Hazards, NothingIsReportedForTheCorrectFrames) {
  test::Counter counter = test::counter();
  run(counter.plan);
  test::Tint tint = test::tint();
  run(tint.plan);
  test::Aliased aliased = test::aliased();
  run(aliased.plan);
  EXPECT_EQ(messages.size(), 0u) << all_messages();
}

TEST_F(Hazards, NothingIsReportedForEvents) {
  test::Split t = test::split();
  run(t.plan);
  EXPECT_EQ(messages.size(), 0u) << all_messages();
}

TEST_F(Hazards, ReadBeforeTheEventIsAwaited) {
  test::Split t = test::split();
  std::swap(t.plan.steps[test::kAwaitStep], t.plan.steps[test::kAwaitStep + 1]);
  run(t.plan);
  expect("vkCmdCopyBuffer: Hazard READ_AFTER_WRITE");
}

TEST_F(Hazards, WriteAfterTheEventIsSet) {
  test::Split t = test::split();
  std::swap(t.plan.steps[test::kSetStep], t.plan.steps[test::kSetStep - 1]);
  run(t.plan);
  expect("vkCmdCopyBuffer: Hazard READ_AFTER_WRITE");
}

TEST_F(Hazards, ReadAfterWriteInOneCommandBuffer) {
  test::Counter t = test::counter();
  t.plan.groups[1].buffer_count = 0;  // state -> copy
  run(t.plan);
  expect("vkCmdCopyBuffer: Hazard READ_AFTER_WRITE");
}

TEST_F(Hazards, ExecutionOnlyBarrierForAReadAfterWrite) {
  test::Counter t = test::counter();
  t.plan.buffer_barriers[2].src_accesses = access::none;
  run(t.plan);
  expect("vkCmdCopyBuffer: Hazard READ_AFTER_WRITE");
}

TEST_F(Hazards, WrongSourceStage) {
  test::Counter t = test::counter();
  t.plan.buffer_barriers[2].src_stages = stage::fragment_shader;
  run(t.plan);
  expect("vkCmdCopyBuffer: Hazard READ_AFTER_WRITE");
}

TEST_F(Hazards, ReadAfterWriteAcrossSubmits) {
  test::Counter t = test::counter();
  t.plan.groups[0].buffer_count = 0;  // state.prev(1), written by the frame before
  run(t.plan);
  expect("vkQueueSubmit2: Hazard READ_AFTER_WRITE");
}

TEST_F(Hazards, WriteAfterReadAcrossSubmits) {
  test::Counter t = test::counter();
  t.plan.buffer_barriers[1].src_stages = stage::fragment_shader;  // state, read and copied by frames before
  run(t.plan);
  expect("vkQueueSubmit2: Hazard WRITE_AFTER_READ");
}

TEST_F(Hazards, WrongLayout) {
  test::ClearAndCopy t = test::clear_and_copy();
  t.plan.image_barriers[1].new_layout = Layout::general;
  run(t.plan);
  expect("VK_IMAGE_LAYOUT_GENERAL");
}

TEST_F(Hazards, AttachmentWriteBeforeTransition) {
  test::Tint t = test::tint();
  t.plan.image_barriers[1].src_stages = stage::compute_shader, t.plan.image_barriers[1].src_accesses = access::none;  // scene -> sampled
  run(t.plan);
  expect("vkCmdPipelineBarrier2: Hazard WRITE_AFTER_WRITE");
}

TEST_F(Hazards, AttachmentWriteBeforeSampling) {
  test::Tint t = test::tint();
  t.plan.image_barriers[1].dst_stages = stage::compute_shader;
  run(t.plan);
  expect("vkCmdDraw: Hazard READ_AFTER_WRITE");
}

TEST_F(Hazards, AttachmentOverwrittenWhileItIsSampled) {
  test::Tint t = test::tint();
  t.plan.image_barriers[0].src_stages = stage::none;  // scene of the frame before
  run(t.plan);
  expect("vkQueueSubmit2: Hazard WRITE_AFTER_READ");
}

TEST_F(Hazards, MemoryTakenOverFromAnUnfinishedUser) {
  test::Aliased t = test::aliased();
  t.plan.releases[0].stages = stage::none;            // a says that nothing has to finish
  t.plan.image_barriers[2].src_stages = stage::none;  // b discards without waiting
  run(t.plan);
  expect("Hazard WRITE_AFTER_READ");
}

// The relay with a picture that the queues share, instead of handing it over.
test::Relay shared_relay() {
  test::Relay t = test::relay();
  t.plan.resources[t.picture].concurrent = true;
  t.plan.groups[1].image_count = 0;  // the release
  ImageBarrier& barrier = t.plan.image_barriers[t.plan.groups[2].first_image];
  barrier.src_queue = barrier.dst_queue = kNone;
  return t;
}

TEST_F(Hazards, NothingIsReportedWhereAQueueWaitsForAnother) {
  test::Relay t = shared_relay();
  run(t.plan);
  EXPECT_EQ(messages.size(), 0u) << all_messages();
}

// While the layer watches, barriers behind waits name the writes that are waited for. Where nothing waits, they must not.
TEST_F(Hazards, TransitionOfAnImageThatAnotherQueueStillWrites) {
  test::Relay t = shared_relay();
  t.plan.batches[2].wait_count = 0;
  run(t.plan);
  expect("Hazard");
}

}  // namespace
}  // namespace rg
