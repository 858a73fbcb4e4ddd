#include "runtime/prologue.h"

#include <algorithm>
#include <bit>

#include "runtime/resolve.h"

namespace rg {

namespace {

// The specification counts vkCmdFillBuffer to the clears, the validation layer to the copies.
constexpr VkPipelineStageFlags2 kFillStages = VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;

bool cleared(const Resource& resource) { return resource.init == InitKind::clear; }

VkImageMemoryBarrier2 image_barrier(VkImage image, const VkImageSubresourceRange& range) {
  VkImageMemoryBarrier2 out{};
  out.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  out.srcQueueFamilyIndex = out.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  out.image = image;
  out.subresourceRange = range;
  return out;
}

void submit_barriers(const Context& context, const std::vector<VkImageMemoryBarrier2>& images, const std::vector<VkMemoryBarrier2>& memory,
                     VkCommandBuffer commands) {
  if (images.empty() && memory.empty()) return;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = static_cast<uint32_t>(memory.size());
  info.pMemoryBarriers = memory.data();
  info.imageMemoryBarrierCount = static_cast<uint32_t>(images.size());
  info.pImageMemoryBarriers = images.data();
  context.vk().CmdPipelineBarrier2(commands, &info);
}

// What the first frame will read without having written it. Copies that it overwrites are left alone: their first barrier in the frame
// discards and waits for nothing, so nothing may be pending on them.
bool needs_clear(const Context& context, const Sized& sized, const Boundary& boundary) {
  const Resource& resource = context.plan.resources[boundary.ref.resource];
  if (!cleared(resource) || boundary.discard || sized.resources[boundary.ref.resource].count == 0) return false;
  if (resource.kind == ResourceKind::buffer) return true;
  return boundary.layout != Layout::undefined && image_range(context, sized, boundary.ref.resource, boundary.range).levelCount != 0;
}

bool is_image(const Context& context, const Boundary& boundary) { return context.plan.resources[boundary.ref.resource].kind == ResourceKind::image; }

void prepare_clears(const Context& context, const Sized& sized, uint64_t frame, VkCommandBuffer commands) {
  std::vector<VkImageMemoryBarrier2> barriers;
  for (const Boundary& boundary : context.plan.entry) {
    if (!needs_clear(context, sized, boundary) || !is_image(context, boundary)) continue;
    const VkImageSubresourceRange range = image_range(context, sized, boundary.ref.resource, boundary.range);
    VkImageMemoryBarrier2& barrier = barriers.emplace_back(image_barrier(image_at(sized, {}, context.plan, boundary.ref, frame), range));
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  }
  submit_barriers(context, barriers, {}, commands);
}

void clear_image(const Context& context, VkImage image, const VkImageSubresourceRange& range, const ClearValue& value, VkCommandBuffer commands) {
  if ((range.aspectMask & VK_IMAGE_ASPECT_COLOR_BIT) != 0) {
    VkClearColorValue color;
    std::copy(std::begin(value.word), std::end(value.word), color.uint32);
    context.vk().CmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1, &range);
  } else {
    const VkClearDepthStencilValue depth{std::bit_cast<float>(value.word[0]), value.word[1]};
    context.vk().CmdClearDepthStencilImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &depth, 1, &range);
  }
}

void clear_resources(const Context& context, const Sized& sized, uint64_t frame, VkCommandBuffer commands) {
  std::vector<bool> filled(sized.buffers.size());
  for (const Boundary& boundary : context.plan.entry) {
    if (!needs_clear(context, sized, boundary)) continue;
    const ClearValue& value = context.plan.resources[boundary.ref.resource].init_value;
    if (is_image(context, boundary)) {
      const VkImageSubresourceRange range = image_range(context, sized, boundary.ref.resource, boundary.range);
      clear_image(context, image_at(sized, {}, context.plan, boundary.ref, frame), range, value, commands);
      continue;
    }
    const uint32_t buffer = copy_index(sized.resources[boundary.ref.resource], boundary.ref.age, frame);
    if (!filled[buffer]) context.vk().CmdFillBuffer(commands, sized.buffers[buffer].get(), 0, VK_WHOLE_SIZE, value.word[0]);
    filled[buffer] = true;
  }
}

// Ends where the frame's first barriers begin: their source scopes are the boundary's.
void enter_image(const Context& context, const Sized& sized, const Boundary& boundary, uint64_t frame, std::vector<VkImageMemoryBarrier2>& barriers) {
  const VkImageSubresourceRange range = image_range(context, sized, boundary.ref.resource, boundary.range);
  if (range.levelCount == 0 || boundary.layout == Layout::undefined) return;
  VkImageMemoryBarrier2& barrier = barriers.emplace_back(image_barrier(image_at(sized, {}, context.plan, boundary.ref, frame), range));
  if (needs_clear(context, sized, boundary)) {
    barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  }
  barrier.newLayout = static_cast<VkImageLayout>(boundary.layout);
  barrier.dstStageMask = boundary.stages != 0 ? boundary.stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = boundary.stages != 0 ? boundary.accesses : VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
}

void enter(const Context& context, const Sized& sized, uint64_t frame, VkCommandBuffer commands) {
  std::vector<VkImageMemoryBarrier2> images;
  std::vector<VkMemoryBarrier2> memory;
  for (const Boundary& boundary : context.plan.entry) {
    if (sized.resources[boundary.ref.resource].count == 0) continue;
    if (is_image(context, boundary))
      enter_image(context, sized, boundary, frame, images);
    else if (needs_clear(context, sized, boundary))
      memory.push_back({VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, kFillStages, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                        boundary.stages != 0 ? boundary.stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                        boundary.stages != 0 ? boundary.accesses : VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT});
  }
  submit_barriers(context, images, memory, commands);
}

}  // namespace

void record_prologue(const Context& context, const Sized& sized, VkCommandBuffer commands, uint64_t next_frame) {
  prepare_clears(context, sized, next_frame, commands);
  clear_resources(context, sized, next_frame, commands);
  enter(context, sized, next_frame, commands);
}

}  // namespace rg
