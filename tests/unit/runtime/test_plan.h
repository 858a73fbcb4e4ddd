// Plans built by hand, a line a table row, so that tests can also leave rows out.
#pragma once

#include <initializer_list>
#include <vector>

#include "runtime/plan.h"

namespace rg::test {

inline constexpr Format kRgba8 = Format{37}, kR32f = Format{100}, kD32f = Format{126};  // VkFormat
inline constexpr uint32_t kCopySrc = 1, kCopyDst = 2;                                   // usage bits of images and buffers alike
inline constexpr uint32_t kStorageBuffer = 0x20, kUniformBuffer = 0x10, kIndirectBuffer = 0x100;
inline constexpr uint32_t kSampled = 4, kStorage = 8, kColorAttachment = 0x10, kDepthAttachment = 0x20;

struct TestPlan {
  Plan base;
  std::vector<Expr> exprs;
  std::vector<Extent> extents;
  std::vector<Resource> resources;
  std::vector<Queue> queues = {{QueueKind::graphics}};
  std::vector<Batch> batches;
  std::vector<Step> steps;
  std::vector<Wait> waits;
  std::vector<Signal> signals;
  std::vector<BarrierGroup> groups;
  std::vector<MemoryBarrier> memory_barriers;
  std::vector<ImageBarrier> image_barriers;
  std::vector<BufferBarrier> buffer_barriers;
  std::vector<Boundary> entry;
  std::vector<Acquire> acquires;
  std::vector<Release> releases;
  std::vector<Index> alias_clocks;
  std::vector<Pass> passes;
  std::vector<Access> accesses;
  std::vector<Rendering> renderings;
  std::vector<Attachment> attachments;
  std::vector<VertexBuffer> vertex_buffers;
  std::vector<ShaderModule> shaders;
  std::vector<Pipeline> pipelines;
  std::vector<Index> pipeline_shaders;
  std::vector<Binding> bindings;
  std::vector<Sampler> samplers;
  std::vector<Params> params;
  std::vector<Index> pass_params;
  std::vector<Transfer> transfers;
  std::vector<MipLimit> mip_limits;
  std::vector<std::string_view> conditions;

  std::vector<Batch> one_batch;

  template <class Row>
  static Index add(std::vector<Row>& table, Row row) {
    table.push_back(std::move(row));
    return static_cast<Index>(table.size() - 1);
  }

  Index constant(int64_t value) { return add(exprs, Expr{ExprOp::constant, kNone, kNone, value}); }
  Index extent_axis(uint32_t axis) { return add(exprs, Expr{ExprOp::extent, kNone, kNone, axis}); }
  Index binary(ExprOp op, Index a, Index b) { return add(exprs, Expr{op, a, b, 0}); }

  // A 2D image of `width` x `height` expressions.
  Index image(std::string_view name, Format format, Index width, Index height, uint32_t usage, uint32_t aspects = aspect_color) {
    Resource resource;
    resource.name = name, resource.format = format, resource.width = width, resource.height = height, resource.usage = usage,
    resource.aspects = aspects;
    return add(resources, resource);
  }
  Index buffer(std::string_view name, Index bytes, uint32_t usage, Lifetime lifetime = Lifetime::transient) {
    Resource resource;
    resource.name = name, resource.kind = ResourceKind::buffer, resource.bytes = bytes, resource.usage = usage, resource.lifetime = lifetime;
    return add(resources, resource);
  }

  void barriers(std::vector<ImageBarrier> images, std::vector<BufferBarrier> buffers = {}, std::vector<MemoryBarrier> memory = {}) {
    BarrierGroup group;
    group.first_image = static_cast<Index>(image_barriers.size()), group.image_count = static_cast<uint32_t>(images.size());
    group.first_buffer = static_cast<Index>(buffer_barriers.size()), group.buffer_count = static_cast<uint32_t>(buffers.size());
    group.first_memory = static_cast<Index>(memory_barriers.size()), group.memory_count = static_cast<uint32_t>(memory.size());
    image_barriers.insert(image_barriers.end(), images.begin(), images.end());
    buffer_barriers.insert(buffer_barriers.end(), buffers.begin(), buffers.end());
    memory_barriers.insert(memory_barriers.end(), memory.begin(), memory.end());
    steps.push_back({StepKind::barriers, add(groups, group)});
  }

  Index pass(Pass row, std::vector<Access> touched = {}) {
    row.first_access = static_cast<Index>(accesses.size()), row.access_count = static_cast<uint32_t>(touched.size());
    accesses.insert(accesses.end(), touched.begin(), touched.end());
    const Index index = add(passes, row);
    steps.push_back({StepKind::pass, index});
    return index;
  }
  Index transfer(std::string_view name, std::vector<Transfer> rows, std::vector<Access> touched = {}) {
    Pass row;
    row.name = name, row.kind = PassKind::transfer;
    row.work.kind = WorkKind::transfers;
    row.work.first_transfer = static_cast<Index>(transfers.size()), row.work.transfer_count = static_cast<uint32_t>(rows.size());
    transfers.insert(transfers.end(), rows.begin(), rows.end());
    return pass(row, std::move(touched));
  }

  // Ends a batch on `queue` here: it has the steps since the last one. `signal_stages` 0: it signals nothing.
  void end_batch(Index queue, std::vector<Wait> waited = {}, Stages signal_stages = stage::all_commands) {
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

  // Puts every step so far into one batch, where no batch was made by hand.
  Plan view() {
    std::vector<Batch>& listed = batches.empty() ? one_batch : batches;
    one_batch.assign(1, {0, 0, static_cast<uint32_t>(steps.size()), 0, 0, 0, 0});
    Plan plan = base;
    if (plan.name.empty()) plan.name = "test";
    plan.exprs = exprs, plan.extents = extents, plan.resources = resources, plan.queues = queues, plan.batches = listed, plan.steps = steps;
    plan.groups = groups, plan.memory_barriers = memory_barriers, plan.image_barriers = image_barriers, plan.buffer_barriers = buffer_barriers;
    plan.entry = entry, plan.acquires = acquires, plan.releases = releases, plan.alias_clocks = alias_clocks, plan.passes = passes,
    plan.accesses = accesses;
    plan.renderings = renderings, plan.attachments = attachments, plan.vertex_buffers = vertex_buffers, plan.shaders = shaders, plan.pipelines = pipelines,
    plan.pipeline_shaders = pipeline_shaders;
    plan.bindings = bindings, plan.samplers = samplers, plan.params = params, plan.pass_params = pass_params, plan.transfers = transfers;
    plan.mip_limits = mip_limits, plan.conditions = conditions, plan.waits = waits, plan.signals = signals;
    return plan;
  }
};

inline ImageBarrier discard(Index image, Stages stages, Accesses accesses, Layout layout, Stages before = 0) {
  ImageBarrier barrier;
  barrier.image = {image, 0}, barrier.src_stages = before, barrier.dst_stages = stages, barrier.dst_accesses = accesses, barrier.new_layout = layout;
  return barrier;
}
inline ImageBarrier transition(Index image, Stages src, Accesses src_accesses, Layout from, Stages dst, Accesses dst_accesses, Layout to) {
  ImageBarrier barrier;
  barrier.image = {image, 0}, barrier.src_stages = src, barrier.src_accesses = src_accesses, barrier.old_layout = from;
  barrier.dst_stages = dst, barrier.dst_accesses = dst_accesses, barrier.new_layout = to;
  return barrier;
}
inline BufferBarrier buffer_barrier(Ref buffer, Stages src, Accesses src_accesses, Stages dst, Accesses dst_accesses) {
  BufferBarrier barrier;
  barrier.buffer = buffer, barrier.src_stages = src, barrier.src_accesses = src_accesses, barrier.dst_stages = dst,
  barrier.dst_accesses = dst_accesses;
  return barrier;
}
inline BufferBarrier to_host(Index buffer, Stages src = stage::copy, Accesses src_accesses = access::transfer_write) {
  return buffer_barrier({buffer, 0}, src, src_accesses, stage::host, access::host_read);
}

inline Access touches(Ref ref, Stages stages, Accesses accesses, Layout layout, bool writes, Range range = {}) {
  Access access;
  access.ref = ref, access.stages = stages, access.accesses = accesses, access.layout = layout, access.writes = writes, access.range = range;
  return access;
}

// clear `color`, copy it to the read-back buffer `result`. Extent "view" 8x4, at most 64x64.
struct ClearAndCopy {
  TestPlan plan;
  Index color = 0, result = 0, clear = 0, copy = 0;
};
inline ClearAndCopy clear_and_copy() {
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
