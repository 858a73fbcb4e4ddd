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
  // Not inline: in each file that includes this, copying so many tables would take long to compile.
  TestPlan();
  TestPlan(const TestPlan&);
  TestPlan(TestPlan&&) noexcept;
  TestPlan& operator=(const TestPlan&);
  TestPlan& operator=(TestPlan&&) noexcept;
  ~TestPlan();

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
  std::vector<SampleLocation> sample_locations;
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

  void barriers(std::vector<ImageBarrier> images, std::vector<BufferBarrier> buffers = {}, std::vector<MemoryBarrier> memory = {});

  Index pass(Pass row, std::vector<Access> touched = {});
  Index transfer(std::string_view name, std::vector<Transfer> rows, std::vector<Access> touched = {});

  // Ends a batch on `queue` here: it has the steps since the last one. `signal_stages` 0: it signals nothing.
  void end_batch(Index queue, std::vector<Wait> waited = {}, Stages signal_stages = stage::all_commands);

  // Puts every step so far into one batch, where no batch was made by hand.
  Plan view();
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
ClearAndCopy clear_and_copy();

}  // namespace rg::test
