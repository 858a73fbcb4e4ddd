// What generated frames are made of: see docs/generated.md.
#pragma once

#include <type_traits>
#include <utility>

#include "runtime/functions.h"
#include "runtime/graph.h"
#include "runtime/math_types.h"

namespace rg {

// A member that must be named when its struct is filled: it has no default, so leaving it out does not compile.
template <class T>
struct Required {
  Required() = delete;
  constexpr Required(const T& given) : value(given) {}
  T value;
};

struct Size1 {
  uint32_t width = 1;
};
struct Size2 {
  uint32_t width = 1, height = 1;
};
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

// Inside a raster pass: rendering has begun, viewport and scissor cover the target.
struct RasterRecording : Recording {
  void bind_pipeline(VkPipeline pipeline) const { vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline); }
  void bind_vertices(uint32_t binding, VkBuffer buffer, VkDeviceSize offset = 0) const {
    vk.CmdBindVertexBuffers(commands, binding, 1, &buffer, &offset);
  }
  void bind_indices(VkBuffer buffer, VkDeviceSize offset = 0, VkIndexType type = VK_INDEX_TYPE_UINT32) const {
    vk.CmdBindIndexBuffer(commands, buffer, offset, type);
  }
  void draw(uint32_t vertices, uint32_t instances = 1, uint32_t first_vertex = 0, uint32_t first_instance = 0) const {
    vk.CmdDraw(commands, vertices, instances, first_vertex, first_instance);
  }
  void draw_indexed(uint32_t indices, uint32_t instances = 1, uint32_t first_index = 0, int32_t vertex_offset = 0,
                    uint32_t first_instance = 0) const {
    vk.CmdDrawIndexed(commands, indices, instances, first_index, vertex_offset, first_instance);
  }
};
struct ComputeRecording : Recording {
  void bind_pipeline(VkPipeline pipeline) const { vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline); }
  void dispatch(uint32_t x, uint32_t y = 1, uint32_t z = 1) const { vk.CmdDispatch(commands, x, y, z); }
};

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
