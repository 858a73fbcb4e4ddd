#include "tests/unit/runtime/test_plan.h"

namespace rg::test {

TestPlan::TestPlan() = default;
TestPlan::TestPlan(const TestPlan&) = default;
TestPlan::TestPlan(TestPlan&&) noexcept = default;
TestPlan& TestPlan::operator=(const TestPlan&) = default;
TestPlan& TestPlan::operator=(TestPlan&&) noexcept = default;
TestPlan::~TestPlan() = default;

void TestPlan::barriers(std::vector<ImageBarrier> images, std::vector<BufferBarrier> buffers, std::vector<MemoryBarrier> memory) {
  BarrierGroup group;
  group.first_image = static_cast<Index>(image_barriers.size()), group.image_count = static_cast<uint32_t>(images.size());
  group.first_buffer = static_cast<Index>(buffer_barriers.size()), group.buffer_count = static_cast<uint32_t>(buffers.size());
  group.first_memory = static_cast<Index>(memory_barriers.size()), group.memory_count = static_cast<uint32_t>(memory.size());
  image_barriers.insert(image_barriers.end(), images.begin(), images.end());
  buffer_barriers.insert(buffer_barriers.end(), buffers.begin(), buffers.end());
  memory_barriers.insert(memory_barriers.end(), memory.begin(), memory.end());
  steps.push_back({StepKind::barriers, add(groups, group)});
}

Index TestPlan::pass(Pass row, std::vector<Access> touched) {
  row.first_access = static_cast<Index>(accesses.size()), row.access_count = static_cast<uint32_t>(touched.size());
  accesses.insert(accesses.end(), touched.begin(), touched.end());
  const Index index = add(passes, row);
  steps.push_back({StepKind::pass, index});
  return index;
}

Index TestPlan::transfer(std::string_view name, std::vector<Transfer> rows, std::vector<Access> touched) {
  Pass row;
  row.name = name, row.kind = PassKind::transfer;
  row.work.kind = WorkKind::transfers;
  row.work.first_transfer = static_cast<Index>(transfers.size()), row.work.transfer_count = static_cast<uint32_t>(rows.size());
  transfers.insert(transfers.end(), rows.begin(), rows.end());
  return pass(row, std::move(touched));
}

void TestPlan::end_batch(Index queue, std::vector<Wait> waited, Stages signal_stages) {
  Batch batch;
  batch.queue = queue;
  for (const Batch& before : batches) batch.first_step += before.step_count;
  batch.step_count = static_cast<uint32_t>(steps.size()) - batch.first_step;
  batch.first_wait = static_cast<Index>(waits.size()), batch.wait_count = static_cast<uint32_t>(waited.size());
  waits.insert(waits.end(), waited.begin(), waited.end());
  batch.first_signal = static_cast<Index>(signals.size()), batch.signal_count = signal_stages != 0 ? 1 : 0;
  uint64_t value = 1;
  for (const Batch& before : batches)
    if (before.queue == queue) value += before.signal_count;
  if (signal_stages != 0) signals.push_back({value, signal_stages});
  for (const Step& step : std::span(steps).subspan(batch.first_step))
    if (step.kind == StepKind::pass) passes[step.index].queue = queue;
  batches.push_back(batch);
}

Plan TestPlan::view() {
  std::vector<Batch>& listed = batches.empty() ? one_batch : batches;
  one_batch.assign(1, {0, 0, static_cast<uint32_t>(steps.size()), 0, 0, 0, 0});
  Plan plan = base;
  if (plan.name.empty()) plan.name = "test";
  plan.exprs = exprs, plan.extents = extents, plan.resources = resources, plan.queues = queues, plan.batches = listed, plan.steps = steps;
  plan.groups = groups, plan.memory_barriers = memory_barriers, plan.image_barriers = image_barriers, plan.buffer_barriers = buffer_barriers;
  plan.entry = entry, plan.acquires = acquires, plan.releases = releases, plan.alias_clocks = alias_clocks, plan.passes = passes,
  plan.accesses = accesses;
  plan.renderings = renderings, plan.attachments = attachments, plan.vertex_buffers = vertex_buffers, plan.shaders = shaders,
  plan.pipelines = pipelines, plan.pipeline_shaders = pipeline_shaders, plan.sample_locations = sample_locations;
  plan.bindings = bindings, plan.samplers = samplers, plan.params = params, plan.pass_params = pass_params, plan.transfers = transfers;
  plan.mip_limits = mip_limits, plan.conditions = conditions, plan.waits = waits, plan.signals = signals;
  return plan;
}

ClearAndCopy clear_and_copy() {
  ClearAndCopy t;
  TestPlan& p = t.plan;
  p.extents.push_back({"view", 2, {8, 4, 1}, {64, 64, 1}});
  const Index width = p.extent_axis(0), height = p.extent_axis(1), area = p.binary(ExprOp::mul, width, height);
  const Index bytes = p.binary(ExprOp::mul, area, p.constant(4));
  t.color = p.image("color", kRgba8, width, height, kCopySrc | kCopyDst);
  t.result = p.buffer("result", bytes, kCopyDst, Lifetime::readback);
  p.entry.push_back({{t.color, 0}, {}, stage::copy, access::none, Layout::undefined, kNone, true});
  p.barriers({discard(t.color, stage::clear, access::transfer_write, Layout::transfer_dst, stage::copy)});
  Transfer clear;
  clear.kind = TransferKind::clear_color, clear.dst = {t.color, 0};
  clear.value = {{0x3f800000, 0, 0x3f800000, 0x3f800000}};  // 1, 0, 1, 1
  t.clear = p.transfer("clear", {clear}, {touches({t.color, 0}, stage::clear, access::transfer_write, Layout::transfer_dst, true)});
  p.barriers(
      {transition(t.color, stage::clear, access::transfer_write, Layout::transfer_dst, stage::copy, access::transfer_read, Layout::transfer_src)});
  Transfer copy;
  copy.kind = TransferKind::copy_image_to_buffer, copy.src = {t.color, 0}, copy.dst = {t.result, 0};
  t.copy = p.transfer("copy", {copy},
                      {touches({t.color, 0}, stage::copy, access::transfer_read, Layout::transfer_src, false),
                       touches({t.result, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
  p.barriers({}, {to_host(t.result)});
  return t;
}

}  // namespace rg::test
