// Each frame is legal as built and is broken by taking away one thing.
#include <gtest/gtest.h>

#include "tiny_frame.h"

namespace rg::test {
namespace {

using dsl::Lifetime;
using machine::Divergence;

void expect_legal(const TinyFrame& frame, const machine::MachineOptions& options = {}) {
  for (const Divergence& each : frame.run(options)) ADD_FAILURE() << text(each);
}

// The first divergence is the one given.
void expect_divergence(const TinyFrame& frame, const std::string& pass, const std::string& resource, const std::string& found,
                       const machine::MachineOptions& options = {}) {
  const std::vector<Divergence> divergences = frame.run(options);
  ASSERT_FALSE(divergences.empty()) << "nothing found; `" << pass << "` should find " << found;
  const auto fits = [&](const Divergence& each) {
    return each.pass == pass && each.resource == resource && each.found.find(found) != std::string::npos;
  };
  std::string all;
  for (const Divergence& each : divergences) all += text(each) + "\n";
  EXPECT_TRUE(std::any_of(divergences.begin(), divergences.end(), fits)) << "wanted: " << pass << " finds " << found << " in " << resource << "\n"
                                                                         << all;
  EXPECT_FALSE(divergences[0].schedule.empty());
}

// produce x | consume x
TinyFrame read_after_write() {
  TinyFrame frame;
  const uint32_t x = frame.buffer("x");
  frame.after_last_frame();
  frame.compute("produce", {writes(x)});
  frame.memory(compute_to_compute());
  frame.compute("consume", {reads(x)});
  return frame;
}

TEST(TinyPlans, ReadAfterWrite) { expect_legal(read_after_write()); }
TEST(TinyPlans, ReadAfterWriteWithoutBarrier) {
  TinyFrame frame = read_after_write();
  frame.plan.memory_barriers[1] = {};
  expect_divergence(frame, "consume", "x", "poison");
}
TEST(TinyPlans, ReadAfterWriteNotAvailable) {
  TinyFrame frame = read_after_write();
  frame.plan.memory_barriers[1].src_accesses = access::none;
  expect_divergence(frame, "consume", "x", "poison");
}
TEST(TinyPlans, ReadAfterWriteNotVisible) {
  TinyFrame frame = read_after_write();
  frame.plan.memory_barriers[1].dst_accesses = access::none;
  expect_divergence(frame, "consume", "x", "poison");
}
TEST(TinyPlans, ReadAfterWriteWrongAccess) {
  TinyFrame frame = read_after_write();
  frame.plan.memory_barriers[1].dst_accesses = access::uniform_read;
  expect_divergence(frame, "consume", "x", "poison");
}
TEST(TinyPlans, ReadAfterWriteWrongStage) {
  for (const bool source : {true, false}) {
    TinyFrame frame = read_after_write();
    (source ? frame.plan.memory_barriers[1].src_stages : frame.plan.memory_barriers[1].dst_stages) = stage::copy;
    expect_divergence(frame, "consume", "x", "poison");
  }
}
TEST(TinyPlans, ReadAfterWriteInLaterFrames) {
  TinyFrame frame = read_after_write();
  frame.plan.memory_barriers[0] = {};
  expect_divergence(frame, "consume", "x", "in frame 1");
}
TEST(TinyPlans, PassesSwapped) {
  TinyFrame frame = read_after_write();
  std::swap(frame.plan.steps[1], frame.plan.steps[3]);
  expect_divergence(frame, "consume", "x", "poison");
}
TEST(TinyPlans, PassLeftOut) {
  TinyFrame frame = read_after_write();
  frame.plan.steps.erase(frame.plan.steps.begin() + 1);
  frame.plan.batches[0].step_count = 3;
  expect_divergence(frame, "consume", "x", "poison");
}

// Logical order: waiting for fragment work waits for vertex work too, but makes only what it names available.
TEST(TinyPlans, AvailabilityNamesStagesExactly) {
  TinyFrame frame;
  const uint32_t x = frame.buffer("x");
  frame.memory({.src_stages = stage::compute_shader, .dst_stages = stage::vertex_shader});
  frame.pass("produce", dsl::PassKind::raster, {writes(x)});
  frame.program.graphs.rows[0].passes.rows[0].accesses[0].stages = dsl::stage_vertex;
  frame.memory({stage::vertex_shader, access::shader_storage_write, stage::compute_shader, access::shader_storage_read, BarrierTag::hazard});
  frame.compute("consume", {reads(x)});
  expect_legal(frame);
  frame.plan.memory_barriers[1].src_stages = stage::fragment_shader;
  expect_divergence(frame, "consume", "x", "poison");
}

// a: x -> y | b: x overwritten | c reads both
TinyFrame write_after_read() {
  TinyFrame frame;
  const uint32_t x = frame.buffer("x"), y = frame.buffer("y");
  frame.after_last_frame();
  frame.compute("first", {writes(x)});
  frame.memory(compute_to_compute());
  frame.compute("a", {reads(x), writes(y)});
  frame.memory({.src_stages = stage::compute_shader, .dst_stages = stage::compute_shader});
  frame.compute("b", {writes(x)});
  frame.memory(compute_to_compute());
  frame.compute("c", {reads(x), reads(y)});
  return frame;
}
TEST(TinyPlans, WriteAfterRead) { expect_legal(write_after_read()); }
TEST(TinyPlans, WriteAfterReadWithoutBarrier) {
  TinyFrame frame = write_after_read();
  frame.plan.memory_barriers[2] = {};
  expect_divergence(frame, "a", "x", "`b` in frame 0");
}

TinyFrame write_after_write() {
  TinyFrame frame;
  const uint32_t x = frame.buffer("x");
  frame.after_last_frame();
  frame.compute("first", {writes(x)});
  frame.memory({stage::compute_shader, access::shader_storage_write, stage::compute_shader, access::shader_storage_write, BarrierTag::hazard});
  frame.compute("second", {writes(x)});
  frame.memory(compute_to_compute());
  frame.compute("consume", {reads(x)});
  return frame;
}
TEST(TinyPlans, WriteAfterWrite) { expect_legal(write_after_write()); }
TEST(TinyPlans, WriteAfterWriteBroken) {
  TinyFrame frame = write_after_write();
  frame.plan.memory_barriers[1] = {};
  expect_divergence(frame, "consume", "x", "two unordered writes");
  frame = write_after_write();
  frame.plan.memory_barriers[1].src_accesses = access::none;
  expect_divergence(frame, "consume", "x", "two unordered writes");
  frame = write_after_write();
  frame.plan.memory_barriers[1].dst_accesses = access::none;
  expect_divergence(frame, "consume", "x", "two unordered writes");
}

// clear, then two passes that add in any order, then a reader.
TinyFrame atomic_group() {
  TinyFrame frame;
  const uint32_t x = frame.buffer("x");
  frame.after_last_frame();
  frame.compute("start", {writes(x)});
  const Accesses both = access::shader_storage_read | access::shader_storage_write;
  frame.memory({stage::compute_shader, access::shader_storage_write, stage::compute_shader, both, BarrierTag::hazard});
  frame.compute("add1", {adds(x)});
  frame.compute("add2", {adds(x)});
  frame.memory(compute_to_compute());
  frame.compute("consume", {reads(x)});
  return frame;
}
TEST(TinyPlans, AtomicNeighboursNeedNoOrder) {
  expect_legal(atomic_group());
  TinyFrame frame = atomic_group();
  std::swap(frame.plan.steps[3], frame.plan.steps[4]);
  expect_legal(frame);
}
TEST(TinyPlans, AtomicGroupNeedsItsStartAndEnd) {
  TinyFrame frame = atomic_group();
  frame.plan.memory_barriers[1] = {};
  expect_divergence(frame, "add1", "x", "poison");
  frame = atomic_group();
  frame.plan.memory_barriers[2].src_accesses = access::none;
  expect_divergence(frame, "consume", "x", "`start` in frame 0");
}

// draw color | sample color in compute
TinyFrame color_then_sampled() {
  TinyFrame frame;
  const uint32_t color = frame.image("color");
  frame.images(
      {transition(color, Layout::undefined, Layout::color_attachment,
                  {stage::compute_shader, access::none, stage::color_attachment_output, access::color_attachment_write, BarrierTag::hazard})});
  frame.pass("draw", dsl::PassKind::raster, {colors(color, true)});
  frame.images({transition(
      color, Layout::color_attachment, Layout::shader_read_only,
      {stage::color_attachment_output, access::color_attachment_write, stage::compute_shader, access::shader_sampled_read, BarrierTag::hazard})});
  frame.compute("consume", {samples(color)});
  return frame;
}
TEST(TinyPlans, LayoutTransition) { expect_legal(color_then_sampled()); }
TEST(TinyPlans, LayoutTransitionMissing) {
  TinyFrame frame = color_then_sampled();
  frame.plan.image_barriers[1].new_layout = Layout::color_attachment;
  expect_divergence(frame, "consume", "color", "wrong layout");
  frame = color_then_sampled();
  frame.plan.image_barriers[1].old_layout = Layout::general;
  expect_divergence(frame, "consume", "color", "wrong layout");
}
TEST(TinyPlans, TransitionTooEarlyForLastReader) {
  TinyFrame frame = color_then_sampled();
  frame.plan.image_barriers[0].src_stages = stage::none;
  expect_divergence(frame, "consume", "color", "wrong layout");
}
TEST(TinyPlans, DiscardOfNeededContents) {
  TinyFrame frame = color_then_sampled();
  frame.plan.image_barriers[1].old_layout = Layout::undefined;
  expect_divergence(frame, "consume", "color", "poison");
}
TEST(TinyPlans, LoadAndStoreThatDropContents) {
  TinyFrame frame = color_then_sampled();
  frame.plan.attachments[0].store = StoreOp::dont_care;
  expect_divergence(frame, "consume", "color", "poison");
  frame = color_then_sampled();
  frame.plan.attachments[0].load = LoadOp::dont_care;
  expect_divergence(frame, "consume", "color", "poison");
}

// x and y share bytes: write x, read x | write y, read y.
struct Aliased {
  TinyFrame frame;
  machine::MachineOptions options;
};
Aliased aliased_images() {
  Aliased a;
  const uint32_t x = a.frame.image("x"), y = a.frame.image("y");
  const Stages both = stage::compute_shader | stage::fragment_shader;
  for (const uint32_t image : {x, y}) {
    const bool first = image == x;
    const Stages stage = first ? stage::compute_shader : stage::fragment_shader;
    const dsl::PassKind kind = first ? dsl::PassKind::compute : dsl::PassKind::raster;
    const MemoryBarrier acquire = {both, access::none, stage, access::shader_storage_write, BarrierTag::alias_pair};
    a.frame.group({acquire}, {transition(image, Layout::undefined, Layout::general, acquire)});
    a.frame.pass(first ? "write_x" : "write_y", kind, {stores(image)});
    a.frame.images({transition(image, Layout::general, Layout::shader_read_only,
                               {stage, access::shader_storage_write, stage, access::shader_sampled_read, BarrierTag::hazard})});
    a.frame.pass(first ? "read_x" : "read_y", kind, {samples(image)});
  }
  a.options.placement = {{0, 4096}, {2048, 4096}};
  return a;
}
TEST(TinyPlans, AliasedImages) {
  const Aliased a = aliased_images();
  expect_legal(a.frame, a.options);
}
TEST(TinyPlans, AliasWithoutHandOff) {
  Aliased a = aliased_images();
  a.frame.plan.memory_barriers[1].src_stages = stage::fragment_shader;  // y waits for its own readers of the last frame only
  a.frame.plan.image_barriers[2].src_stages = stage::fragment_shader;
  expect_legal(a.frame);  // without common memory nothing is wrong
  expect_divergence(a.frame, "read_y", "y", "two unordered writes", a.options);
}
TEST(TinyPlans, AliasedLifetimesOverlap) {
  Aliased a = aliased_images();
  a.frame.compute("read_again", {samples(0)});
  expect_divergence(a.frame, "read_again", "x", "poison", a.options);
}

// accumulate: x = f(x.prev(1))
TinyFrame history() {
  TinyFrame frame;
  const uint32_t x = frame.buffer("x", Lifetime::history, 1);
  MemoryBarrier barrier = compute_to_compute();
  barrier.dst_accesses |= access::shader_storage_write;
  frame.memory(barrier);
  frame.compute("accumulate", {reads(x, 1), writes(x)});
  frame.boundary({.ref = {x, 0}, .stages = stage::compute_shader});
  return frame;
}
TEST(TinyPlans, History) { expect_legal(history()); }
TEST(TinyPlans, HistorySwapped) {
  TinyFrame frame = history();
  frame.program.graphs.rows[0].passes.rows[0].accesses[0].age = 0;  // the program means this frame's version, which nobody wrote yet
  frame.program.graphs.rows[0].passes.rows[0].accesses[1].mode = dsl::Mode::update;
  frame.program.graphs.rows[0].resources.rows[0].lifetime = Lifetime::persistent;
  expect_legal(frame);  // a persistent buffer updated in place is the same frame with one copy
  frame = history();
  frame.plan.memory_barriers[0] = {};
  expect_divergence(frame, "accumulate", "x", "initial value");
}

TinyFrame readback() {
  TinyFrame frame;
  const uint32_t x = frame.buffer("x", Lifetime::readback);
  frame.compute("measure", {writes(x)});
  frame.memory({stage::compute_shader, access::shader_storage_write, stage::host, access::host_read, BarrierTag::hazard});
  return frame;
}
TEST(TinyPlans, Readback) { expect_legal(readback()); }
TEST(TinyPlans, ReadbackWithoutHostBarrier) {
  TinyFrame frame = readback();
  frame.plan.memory_barriers[0] = {};
  expect_divergence(frame, "", "x", "poison");
}

// The engine brings `lights` written by compute, each frame; the frame leaves it to compute again.
TinyFrame imported() {
  TinyFrame frame;
  const uint32_t lights = frame.buffer("lights", Lifetime::imported);
  frame.declared(lights).before = {dsl::Role::storage, dsl::stage_compute, true};
  frame.declared(lights).after = {dsl::Role::storage, dsl::stage_compute, false};
  frame.memory({stage::compute_shader, access::shader_storage_write, stage::vertex_shader, access::shader_storage_read, BarrierTag::hazard});
  frame.pass("draw", dsl::PassKind::raster, {reads(lights)});
  frame.program.graphs.rows[0].passes.rows[0].accesses[0].stages = dsl::stage_vertex;
  frame.memory({.src_stages = stage::vertex_shader, .dst_stages = stage::compute_shader, .dst_accesses = access::shader_storage_read});
  return frame;
}
TEST(TinyPlans, Imported) { expect_legal(imported()); }
TEST(TinyPlans, ImportedTakenOrLeftTooEarly) {
  TinyFrame frame = imported();
  frame.plan.memory_barriers[0].src_accesses = access::none;
  expect_divergence(frame, "draw", "lights", "poison");
  frame = imported();
  frame.plan.memory_barriers[1] = {};
  expect_divergence(frame, "draw", "lights", "what the engine brought");
}

}  // namespace
}  // namespace rg::test
