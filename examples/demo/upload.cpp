#include "examples/demo/upload.h"

#include <algorithm>

#include "examples/demo/frame_data.h"
#include "examples/demo/textures.h"

namespace rg::demo {
namespace {

Error out_of_memory(const char* what, VkDeviceSize bytes) {
  return {ErrorCode::out_of_memory,
          std::string(what) + " of " + std::to_string(bytes) + " bytes cannot be allocated on the device; use a smaller scene or size"};
}
Error driver_error(const char* call, VkResult result) {
  return {result == VK_ERROR_DEVICE_LOST ? ErrorCode::device_lost : ErrorCode::driver, std::string(call) + " failed with " + std::to_string(result)};
}

Result<UniqueMemory> allocate(Device& device, const VkMemoryRequirements& needs, bool host_visible, const char* what) {
  const VkMemoryPropertyFlags wanted = host_visible ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
  const VkMemoryPropertyFlags preferred = host_visible ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  const uint32_t type = device.memory_type(needs.memoryTypeBits, wanted, preferred);
  const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  if (type == UINT32_MAX || device.vk().AllocateMemory(device.handle(), &info, nullptr, &memory) != VK_SUCCESS)
    return out_of_memory(what, needs.size);
  return UniqueMemory(device.vk(), device.handle(), memory);
}

// Copies that one command buffer makes from one staging buffer.
struct Staging {
  std::vector<std::byte> bytes;
  std::vector<std::function<void(const DeviceFunctions&, VkCommandBuffer, VkBuffer)>> copies;
};

size_t stage(Staging& staging, const void* data, size_t size) {
  const size_t offset = (staging.bytes.size() + 15) / 16 * 16;
  staging.bytes.resize(offset + size);
  std::memcpy(staging.bytes.data() + offset, data, size);
  return offset;
}

template <class T>
Result<GpuBuffer> stage_buffer(Device& device, Staging& staging, const std::vector<T>& data, VkBufferUsageFlags usage) {
  const size_t size = data.size() * sizeof(T);
  auto buffer = make_buffer(device, std::max<size_t>(size, 64), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false);
  if (!buffer || size == 0) return buffer;
  const size_t offset = stage(staging, data.data(), size);
  staging.copies.push_back([target = buffer->buffer.get(), offset, size](const DeviceFunctions& vk, VkCommandBuffer commands, VkBuffer from) {
    const VkBufferCopy region{offset, 0, size};
    vk.CmdCopyBuffer(commands, from, target, 1, &region);
  });
  return buffer;
}

void image_barrier(const DeviceFunctions& vk, VkCommandBuffer commands, VkImage image, bool to_copy) {
  auto barrier = vulkan_struct<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
  barrier.srcStageMask = to_copy ? VK_PIPELINE_STAGE_2_NONE : VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = to_copy ? 0 : VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = to_copy ? VK_PIPELINE_STAGE_2_COPY_BIT : VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  barrier.dstAccessMask = to_copy ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
  barrier.oldLayout = to_copy ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  barrier.newLayout = to_copy ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  auto info = vulkan_struct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vk.CmdPipelineBarrier2(commands, &info);
}

std::vector<VkBufferImageCopy> mip_copies(size_t offset, uint32_t layer) {
  std::vector<VkBufferImageCopy> regions;
  for (uint32_t mip = 0; mip < kTextureMips; ++mip) {
    const uint32_t size = kTextureSize >> mip;
    regions.push_back({offset, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, mip, layer, 1}, {0, 0, 0}, {size, size, 1}});
    offset += size_t{size} * size * 4;
  }
  return regions;
}

Result<GpuImage> stage_layers(Device& device, Staging& staging, const Scene& scene, bool albedo) {
  const VkFormat format = albedo ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
  auto image = make_image(
      device, {format, kTextureSize, kTextureSize, kTextureMips, kTextureLayers, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, true});
  if (!image) return image;
  std::vector<VkBufferImageCopy> regions;
  for (uint32_t layer = 0; layer < scene.textures.size(); ++layer) {
    const std::vector<uint8_t> mips = make_mips(albedo ? scene.textures[layer].albedo : scene.textures[layer].surface, albedo);
    const std::vector<VkBufferImageCopy> more = mip_copies(stage(staging, mips.data(), mips.size()), layer);
    regions.insert(regions.end(), more.begin(), more.end());
  }
  staging.copies.push_back([target = image->image.get(), regions](const DeviceFunctions& vk, VkCommandBuffer commands, VkBuffer from) {
    image_barrier(vk, commands, target, true);
    vk.CmdCopyBufferToImage(commands, from, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, static_cast<uint32_t>(regions.size()), regions.data());
    image_barrier(vk, commands, target, false);
  });
  return image;
}

// Copies before, the graph's first reads after.
void make_visible(const DeviceFunctions& vk, VkCommandBuffer commands) {
  auto barrier = vulkan_struct<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                         VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT;
  auto info = vulkan_struct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  vk.CmdPipelineBarrier2(commands, &info);
}

Status run_copies(Device& device, const Staging& staging) {
  auto buffer = make_buffer(device, staging.bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
  if (!buffer) return buffer.error();
  std::memcpy(buffer->mapped, staging.bytes.data(), staging.bytes.size());
  return submit_once(device, [&](VkCommandBuffer commands) {
    for (const auto& copy : staging.copies) copy(device.vk(), commands, buffer->buffer.get());
    make_visible(device.vk(), commands);
  });
}

}  // namespace

namespace {

// Whatever queues the plan chooses may use it.
template <class Info>
void share(const Device& device, Info& info) {
  if (device.queue_families().size() < 2) return;
  info.sharingMode = VK_SHARING_MODE_CONCURRENT;
  info.queueFamilyIndexCount = static_cast<uint32_t>(device.queue_families().size());
  info.pQueueFamilyIndices = device.queue_families().data();
}

}  // namespace

Result<GpuBuffer> make_buffer(Device& device, VkDeviceSize size, VkBufferUsageFlags usage, bool host_visible) {
  const DeviceFunctions& vk = device.vk();
  auto info = vulkan_struct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = usage;
  share(device, info);
  VkBuffer handle = VK_NULL_HANDLE;
  if (const VkResult result = vk.CreateBuffer(device.handle(), &info, nullptr, &handle); result != VK_SUCCESS)
    return driver_error("vkCreateBuffer", result);
  GpuBuffer buffer;
  buffer.buffer = UniqueBuffer(vk, device.handle(), handle);
  buffer.size = size;
  VkMemoryRequirements needs;
  vk.GetBufferMemoryRequirements(device.handle(), handle, &needs);
  auto memory = allocate(device, needs, host_visible, "a buffer");
  if (!memory) return memory.error();
  buffer.memory = std::move(*memory);
  if (const VkResult result = vk.BindBufferMemory(device.handle(), handle, buffer.memory.get(), 0); result != VK_SUCCESS)
    return driver_error("vkBindBufferMemory", result);
  if (!host_visible) return buffer;
  const VkResult result = vk.MapMemory(device.handle(), buffer.memory.get(), 0, VK_WHOLE_SIZE, 0, &buffer.mapped);
  if (result != VK_SUCCESS) return driver_error("vkMapMemory", result);
  return buffer;
}

Result<GpuImage> make_image(Device& device, const ImageShape& shape) {
  const DeviceFunctions& vk = device.vk();
  auto info = vulkan_struct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = shape.format;
  info.extent = {shape.width, shape.height, 1};
  info.mipLevels = shape.mips;
  info.arrayLayers = shape.layers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = shape.usage;
  share(device, info);
  VkImage handle = VK_NULL_HANDLE;
  if (const VkResult result = vk.CreateImage(device.handle(), &info, nullptr, &handle); result != VK_SUCCESS)
    return driver_error("vkCreateImage", result);
  GpuImage image;
  image.image = UniqueImage(vk, device.handle(), handle);
  VkMemoryRequirements needs;
  vk.GetImageMemoryRequirements(device.handle(), handle, &needs);
  auto memory = allocate(device, needs, false, "an image");
  if (!memory) return memory.error();
  image.memory = std::move(*memory);
  if (const VkResult result = vk.BindImageMemory(device.handle(), handle, image.memory.get(), 0); result != VK_SUCCESS)
    return driver_error("vkBindImageMemory", result);
  auto view = vulkan_struct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = handle;
  view.viewType = shape.array_view ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  view.format = shape.format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, shape.mips, 0, shape.layers};
  VkImageView view_handle = VK_NULL_HANDLE;
  if (const VkResult result = vk.CreateImageView(device.handle(), &view, nullptr, &view_handle); result != VK_SUCCESS)
    return driver_error("vkCreateImageView", result);
  image.view = UniqueView(vk, device.handle(), view_handle);
  return image;
}

Status submit_once(Device& device, const std::function<void(VkCommandBuffer)>& record) {
  const DeviceFunctions& vk = device.vk();
  const VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                          device.queue_family()};
  VkCommandPool pool_handle = VK_NULL_HANDLE;
  if (const VkResult result = vk.CreateCommandPool(device.handle(), &pool_info, nullptr, &pool_handle); result != VK_SUCCESS)
    return driver_error("vkCreateCommandPool", result);
  const UniqueCommandPool pool(vk, device.handle(), pool_handle);
  const VkCommandBufferAllocateInfo allocate_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_handle,
                                                  VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  if (const VkResult result = vk.AllocateCommandBuffers(device.handle(), &allocate_info, &commands); result != VK_SUCCESS)
    return driver_error("vkAllocateCommandBuffers", result);
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
  vk.BeginCommandBuffer(commands, &begin);
  record(commands);
  if (const VkResult result = vk.EndCommandBuffer(commands); result != VK_SUCCESS) return driver_error("vkEndCommandBuffer", result);
  const VkCommandBufferSubmitInfo buffer_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands, 0};
  auto submit = vulkan_struct<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer_info;
  if (const VkResult result = vk.QueueSubmit2(device.queue(), 1, &submit, VK_NULL_HANDLE); result != VK_SUCCESS)
    return driver_error("vkQueueSubmit2", result);
  if (const VkResult result = vk.QueueWaitIdle(device.queue()); result != VK_SUCCESS) return driver_error("vkQueueWaitIdle", result);
  return Done{};
}

Result<GpuScene> upload(Device& device, const Scene& scene) {
  constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  Staging staging;
  GpuScene gpu;
  Error failure;
  const auto keep = [&failure](auto& target, auto made) {
    if (made)
      target = std::move(*made);
    else
      failure = made.error();
    return static_cast<bool>(made);
  };
  const bool good = keep(gpu.vertices, stage_buffer(device, staging, scene.vertices, storage)) &&
                    keep(gpu.indices, stage_buffer(device, staging, scene.indices, storage)) &&
                    keep(gpu.materials, stage_buffer(device, staging, make_materials(scene), storage)) &&
                    keep(gpu.fog_volumes, stage_buffer(device, staging, make_fog_volumes(scene), storage)) &&
                    keep(gpu.props, stage_buffer(device, staging, scene.prop_vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)) &&
                    keep(gpu.prop_indices, stage_buffer(device, staging, scene.prop_indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT)) &&
                    keep(gpu.albedo_maps, stage_layers(device, staging, scene, true)) &&
                    keep(gpu.surface_maps, stage_layers(device, staging, scene, false));
  if (!good) return failure;
  if (Status copied = run_copies(device, staging); !copied) return copied.error();
  return gpu;
}

}  // namespace rg::demo
