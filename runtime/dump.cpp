// Copies of a resource's contents as they are right after a pass. A tool: its barriers are as wide as can be.
#include <algorithm>
#include <cstring>

#include "runtime/errors.h"
#include "runtime/formats.h"
#include "runtime/layouts.h"
#include "runtime/record.h"
#include "runtime/resolve.h"
#include "runtime/resources.h"
#include "runtime/timelines.h"

namespace rg {

namespace {

VkImageAspectFlags dumped_aspect(const Resource& resource) {
  for (const VkImageAspectFlags aspect : {VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_ASPECT_DEPTH_BIT})
    if ((resource.aspects & aspect) != 0) return aspect;
  return VK_IMAGE_ASPECT_STENCIL_BIT;
}

Status check_dump(const GraphInstance::State& state, Index pass, Index resource, uint32_t mip) {
  const Plan& plan = state.context.plan;
  if (!state.context.debug_readback) return Error{ErrorCode::invalid_argument, "dumps need GraphOptions::debug_readback"};
  if (pass >= plan.passes.size() || resource >= plan.resources.size()) return Error{ErrorCode::invalid_argument, "no such pass or resource to dump"};
  const Resource& row = plan.resources[resource];
  if (row.kind == ResourceKind::image && row.samples != 1)
    return Error{ErrorCode::unsupported, "`" + std::string(row.name) + "`: multisampled images cannot be copied; dump the resolved one"};
  if (row.kind == ResourceKind::image && mip >= state.sized->resources[resource].mips)
    return Error{ErrorCode::invalid_argument, "`" + std::string(row.name) + "` has no mip " + std::to_string(mip)};
  if (row.kind == ResourceKind::image && format_info(static_cast<VkFormat>(row.format)).block_width != 1)
    return Error{ErrorCode::unsupported, "`" + std::string(row.name) + "`: compressed images are not dumped"};
  return Done{};
}

void shape_image(const GraphInstance::State& state, DumpRequest& dump) {
  const Resource& resource = state.context.plan.resources[dump.resource];
  const SizedResource& size = state.sized->resources[dump.resource];
  const VkExtent3D extent = mip_extent(size.extent, dump.mip);
  dump.shape.format = resource.format;
  dump.shape.width = extent.width;
  dump.shape.height = extent.height;
  dump.shape.depth_or_layers = std::max(extent.depth, size.layers);
  dump.shape.bytes_per_texel = copy_bytes(static_cast<VkFormat>(resource.format), dumped_aspect(resource));
  dump.bytes = VkDeviceSize{extent.width} * extent.height * dump.shape.depth_or_layers * dump.shape.bytes_per_texel;
  for (uint32_t layer = 0; layer < size.layers; ++layer)
    dump.layouts.push_back(
        static_cast<VkImageLayout>(layout_at(state.context.plan, dump.pass, {dump.resource, 0}, dumped_aspect(resource), dump.mip, layer)));
}

void shape_buffer(const GraphInstance::State& state, DumpRequest& dump) {
  dump.bytes = state.sized->resources[dump.resource].bytes;
  dump.shape.width = static_cast<uint32_t>(dump.bytes);
}

VkImageMemoryBarrier2 image_barrier(VkImage image, VkImageAspectFlags aspect, uint32_t mip, uint32_t layer, VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier2 out{};
  out.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  out.srcStageMask = out.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  out.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  out.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  out.oldLayout = from;
  out.newLayout = to;
  out.srcQueueFamilyIndex = out.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  out.image = image;
  out.subresourceRange = {aspect, mip, 1, layer, 1};
  return out;
}

void record_barrier(const FrameRecording& r, const VkImageMemoryBarrier2& barrier) {
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  r.state.context.vk().CmdPipelineBarrier2(r.commands, &info);
}

// `src` without `dst` makes everything visible to the copy, the other way round protects what was copied.
void record_barrier(const FrameRecording& r, VkPipelineStageFlags2 src, VkAccessFlags2 src_access, VkPipelineStageFlags2 dst,
                    VkAccessFlags2 dst_access) {
  const VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, src, src_access, dst, dst_access};
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  r.state.context.vk().CmdPipelineBarrier2(r.commands, &info);
}

void copy_layer(const FrameRecording& r, const DumpRequest& dump, VkImage image, uint32_t layer) {
  const Resource& resource = r.state.context.plan.resources[dump.resource];
  const VkImageLayout layout = dump.layouts[layer];
  if (layout == VK_IMAGE_LAYOUT_UNDEFINED) return;
  const VkImageAspectFlags aspect = dumped_aspect(resource);
  record_barrier(r, image_barrier(image, aspect, dump.mip, layer, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL));
  const VkExtent3D extent = mip_extent(r.state.sized->resources[dump.resource].extent, dump.mip);
  VkBufferImageCopy copy{};
  copy.bufferOffset = dump.bytes / dump.layouts.size() * layer;
  copy.imageSubresource = {aspect, dump.mip, layer, 1};
  copy.imageExtent = extent;
  r.state.context.vk().CmdCopyImageToBuffer(r.commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, dump.buffer.get(), 1, &copy);
  record_barrier(r, image_barrier(image, aspect, dump.mip, layer, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout));
}

void copy_buffer(const FrameRecording& r, const DumpRequest& dump) {
  record_barrier(r, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
  const BufferSpan span = buffer_at(*r.state.sized, r.state.imports, r.state.context.plan, {dump.resource, 0}, {0, dump.bytes}, r.frame);
  const VkBufferCopy copy{span.offset, 0, dump.bytes};
  r.state.context.vk().CmdCopyBuffer(r.commands, span.buffer, dump.buffer.get(), 1, &copy);
  record_barrier(r, VK_PIPELINE_STAGE_2_COPY_BIT, 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0);
}

void record_dump(const FrameRecording& r, const DumpRequest& dump) {
  if (r.state.context.plan.resources[dump.resource].kind == ResourceKind::buffer) {
    copy_buffer(r, dump);
  } else {
    const VkImage image = image_at(*r.state.sized, r.state.imports, r.state.context.plan, {dump.resource, 0}, r.frame);
    for (uint32_t layer = 0; layer < dump.layouts.size(); ++layer) copy_layer(r, dump, image, layer);
  }
  record_barrier(r, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

}  // namespace

void record_dumps(FrameRecording& r, Index pass) {
  for (const DumpRequest& dump : r.state.dumps)
    if (dump.pass == pass && !dump.recorded) record_dump(r, dump);
}

Status GraphInstance::request_dump(Index pass, Index resource, uint32_t mip) {
  RG_TRY(check_dump(*state_, pass, resource, mip));
  DumpRequest dump;
  dump.pass = pass, dump.resource = resource, dump.mip = mip;
  if (state_->context.plan.resources[resource].kind == ResourceKind::image)
    shape_image(*state_, dump);
  else
    shape_buffer(*state_, dump);
  if (dump.bytes == 0)
    return Error{ErrorCode::invalid_argument, "`" + std::string(state_->context.plan.resources[resource].name) + "` has no size of its own to dump"};
  Result<HostBuffer> buffer =
      create_host_buffer(state_->context, dump.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, "dump");
  if (!buffer) return buffer.error();
  dump.memory = std::move(buffer->memory);
  dump.buffer = std::move(buffer->buffer);
  dump.mapped = buffer->mapped;
  state_->dumps.push_back(std::move(dump));
  return Done{};
}

Result<Dump> GraphInstance::take_dump() {
  std::vector<DumpRequest>& dumps = state_->dumps;
  if (dumps.empty() || !dumps.front().recorded) return Error{ErrorCode::invalid_argument, "no dump was requested and executed"};
  RG_TRY(wait_for(*state_, dumps.front().done));
  DumpRequest taken = std::move(dumps.front());
  dumps.erase(dumps.begin());
  taken.shape.bytes.resize(taken.bytes);
  std::memcpy(taken.shape.bytes.data(), taken.mapped, taken.bytes);
  return std::move(taken.shape);
}

}  // namespace rg
