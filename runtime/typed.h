// What generated frames are made of: see docs/generated.md.
#pragma once

#include <type_traits>
#include <utility>

#include "runtime/functions.h"
#include "runtime/graph.h"
#include "runtime/math_types.h"
#include "runtime/typed_frame.h"
#include "runtime/vertex_types.h"

namespace rg {

// A member that must be named when its struct is filled: it has no default, so leaving it out does not compile.
template <class T>
struct Required {
  Required() = delete;
  // Given by name.
  constexpr Required(const T& given) : value(given) {}
  T value;
};

// A member that this plan does without: it may be given, and is not looked at.
template <class T>
struct Unused {
  Unused() = default;
  // Given by name.
  constexpr Unused(const T&) {}
};

// The size of an extent of one axis, in its own unit: texels, froxels, elements.
struct Size1 {
  uint32_t width = 1;
};
// Likewise, of two axes.
struct Size2 {
  uint32_t width = 1, height = 1;
};
// Likewise, of three axes.
struct Size3 {
  uint32_t width = 1, height = 1, depth = 1;
};

// Of a plan, at the initial extents and by the device profile it was compiled for.
struct Figures {
  uint32_t passes = 0, culled = 0, shaders = 0, pipelines = 0;
  uint32_t barrier_groups = 0, memory_barriers = 0, image_barriers = 0, buffer_barriers = 0;
  uint32_t batches = 0, waits = 0;
  uint64_t heap_bytes = 0, unaliased_bytes = 0, lower_bound_bytes = 0;
};

// Of one pass and of one resource of a plan: what `assert` judges in the program, engine tests can static_assert.
//
//   static_assert(rg::overlap(frame::kPassFigures[frame::pass::shadows], frame::kPassFigures[frame::pass::cull]));
struct PassFigures {
  uint32_t position = 0;  // in the serial order of the plan
  uint32_t group = 0;     // barrier groups on its queue before it
  uint32_t batch = 0, queue = 0;
  uint32_t barriers = 0;  // right before it
  uint64_t before = 0;    // bit i: batch i has finished before its batch begins
};
// See PassFigures.
struct ResourceFigures {
  uint64_t bytes = 0, offset = 0;  // estimated, all copies; the offset only of transients
  bool transient = false;
  Index first = kNone, last = kNone;  // positions of its first and last user
};
// Of one pass: each count's greatest over its shaders and their variants, as `assert` judges it. Static: an instruction in a loop counts once.
struct ShaderFigures {
  uint32_t instructions = 0, alu = 0, samples = 0, loads = 0, stores = 0, atomics = 0, branches = 0;
  uint32_t shared_bytes = 0, live_scalars = 0;  // live: 32-bit values alive at once
};
// `a` stands before `b` in the serial order.
constexpr bool runs_before(const PassFigures& a, const PassFigures& b) { return a.position < b.position; }
// No barrier separates the two, or they run on different queues and neither waits for the other.
constexpr bool overlap(const PassFigures& a, const PassFigures& b) {
  if (a.queue == b.queue) return a.group == b.group;
  return a.batch < 64 && b.batch < 64 && (a.before >> b.batch & 1) == 0 && (b.before >> a.batch & 1) == 0;
}
// The two lie in the same bytes, at the initial extents and by the profile's sizes.
constexpr bool share_bytes(const ResourceFigures& a, const ResourceFigures& b) {
  return a.transient && b.transient && a.offset < b.offset + b.bytes && b.offset < a.offset + a.bytes;
}
// Passes from the first user to the last, both counted.
constexpr uint32_t lifetime(const ResourceFigures& resource) { return resource.first == kNone ? 0 : resource.last - resource.first + 1; }

// Inside a raster pass: rendering has begun, viewport and scissor cover the target.
struct RasterRecording : Recording {
  // vkCmdBindPipeline: one of the engine's own, built from PassInfo.
  void bind_pipeline(VkPipeline pipeline) const { vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline); }
  // vkCmdBindVertexBuffers, one binding.
  void bind_vertices(uint32_t binding, VkBuffer buffer, VkDeviceSize offset = 0) const {
    vk.CmdBindVertexBuffers(commands, binding, 1, &buffer, &offset);
  }
  // vkCmdBindIndexBuffer.
  void bind_indices(VkBuffer buffer, VkDeviceSize offset = 0, VkIndexType type = VK_INDEX_TYPE_UINT32) const {
    vk.CmdBindIndexBuffer(commands, buffer, offset, type);
  }
  // vkCmdDraw.
  void draw(uint32_t vertices, uint32_t instances = 1, uint32_t first_vertex = 0, uint32_t first_instance = 0) const {
    vk.CmdDraw(commands, vertices, instances, first_vertex, first_instance);
  }
  // vkCmdDrawIndexed.
  void draw_indexed(uint32_t indices, uint32_t instances = 1, uint32_t first_index = 0, int32_t vertex_offset = 0,
                    uint32_t first_instance = 0) const {
    vk.CmdDrawIndexed(commands, indices, instances, first_index, vertex_offset, first_instance);
  }
};
// Inside a compute pass: barriers are in place.
struct ComputeRecording : Recording {
  // vkCmdBindPipeline.
  void bind_pipeline(VkPipeline pipeline) const { vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline); }
  // vkCmdDispatch: numbers of groups.
  void dispatch(uint32_t x, uint32_t y = 1, uint32_t z = 1) const { vk.CmdDispatch(commands, x, y, z); }
};

// vkCmdPushConstants of the whole block; `stages` as the pass declares them. Generated `push` calls it.
template <class T>
void push_constants(const Recording& recording, VkShaderStageFlags stages, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  recording.vk.CmdPushConstants(recording.commands, recording.pass.layout, stages, 0, sizeof(T), &value);
}

// The bytes of a parameter block or of host data, as FrameInputs wants them.
template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(std::span<const T, 1>(&value, 1));
}

// The elements of a read-back buffer. `bytes` come from mapped memory, aligned for any element.
template <class T>
std::span<const T> elements_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

}  // namespace rg
