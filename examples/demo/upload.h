// Buffers and images of the application's own, and a scene in them.
#pragma once

#include <cstring>
#include <functional>
#include <span>

#include "examples/demo/scene.h"
#include "runtime/device.h"
#include "runtime/handles.h"
#include "runtime/result.h"

namespace rg::demo {

// All zero but for its type.
template <class T>
T vulkan_struct(VkStructureType type) {
  T value{};
  value.sType = type;
  return value;
}

struct GpuBuffer {
  UniqueMemory memory;
  UniqueBuffer buffer;
  VkDeviceSize size = 0;
  void* mapped = nullptr;  // coherent; null where the host cannot see it
};
struct GpuImage {
  UniqueMemory memory;
  UniqueImage image;
  UniqueView view;
};
struct ImageShape {
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 1, height = 1, mips = 1, layers = 1;
  VkImageUsageFlags usage = 0;
  bool array_view = false;
};

Result<GpuBuffer> make_buffer(Device& device, VkDeviceSize size, VkBufferUsageFlags usage, bool host_visible);
Result<GpuImage> make_image(Device& device, const ImageShape& shape);
// Records, submits and waits.
Status submit_once(Device& device, const std::function<void(VkCommandBuffer)>& record);

// What of a scene does not change from frame to frame, in the states that passes/scene/scene.rg declares.
struct GpuScene {
  GpuBuffer vertices, indices, materials, props, prop_indices, fog_volumes;
  GpuImage albedo_maps, surface_maps;
};
Result<GpuScene> upload(Device& device, const Scene& scene);

}  // namespace rg::demo
