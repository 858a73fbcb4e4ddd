#include <algorithm>

#include "runtime/barriers.h"
#include "runtime/formats.h"
#include "runtime/queues.h"
#include "runtime/resolve.h"

namespace rg {

namespace {

constexpr uint32_t kPattern = 0x7fc07fc0;  // a NaN as 32-bit and as 16-bit float, an implausible integer
// The specification counts vkCmdFillBuffer to the clears, the validation layer to the copies.
constexpr VkPipelineStageFlags2 kFillStages = VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;
constexpr float kDepthPattern = 0.625f;

// Compute queues clear no depth, transfer queues no images.
bool can_fill(const Context& context, const Acquire& acquire) {
  const Resource& row = context.plan.resources[acquire.resource];
  const VkQueueFlags flags = queue_of(context, context.queues.of_group[acquire.group]).flags;
  const VkQueueFlags needed = (row.aspects & (aspect_depth | aspect_stencil)) != 0 ? VK_QUEUE_GRAPHICS_BIT : VK_QUEUE_COMPUTE_BIT;
  if (row.kind == ResourceKind::image && (flags & needed) == 0) return false;
  return row.kind == ResourceKind::buffer || format_info(static_cast<VkFormat>(row.format)).block_width == 1;
}

// The group's own discarding barrier takes the contents over from the fill.
void start_from_fill(VkImageMemoryBarrier2& barrier) {
  barrier.srcStageMask |= VK_PIPELINE_STAGE_2_CLEAR_BIT;
  barrier.srcAccessMask |= VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
}

VkImageMemoryBarrier2 to_fill(VkImage image, const VkImageSubresourceRange& range) {
  VkImageMemoryBarrier2 out{};
  out.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  out.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  out.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  out.dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
  out.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  out.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  out.srcQueueFamilyIndex = out.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  out.image = image;
  out.subresourceRange = range;
  return out;
}

void poison_images(const Sized& sized, Index resource, GroupTable& group, PoisonTable& poison) {
  const VkImage image = sized.images[sized.resources[resource].first];
  const size_t one_phase = group.images.size() / group.period;  // the same barriers again in every phase
  for (size_t i = 0; i < group.images.size(); ++i) {
    VkImageMemoryBarrier2& barrier = group.images[i];
    if (barrier.image != image || barrier.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED) continue;
    if (i < one_phase) poison.targets.push_back({resource, barrier.subresourceRange});
    if (i < one_phase) poison.images.push_back(to_fill(image, barrier.subresourceRange));
    start_from_fill(barrier);
  }
}

void poison_buffer(const Acquire& acquire, Index resource, GroupTable& group, PoisonTable& poison) {
  poison.targets.push_back({resource, {}});
  const Stages users = (acquire.stages & kFillStages) != 0 ? acquire.stages | kFillStages : acquire.stages;
  group.memory.push_back({VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, kFillStages, VK_ACCESS_2_TRANSFER_WRITE_BIT, users, acquire.accesses});
  for (VkDependencyInfo& info : group.infos) {
    info.memoryBarrierCount = static_cast<uint32_t>(group.memory.size());
    info.pMemoryBarriers = group.memory.data();
  }
}

PoisonTable& poison_of(Sized& sized, GroupTable& group) {
  if (group.poison == kNone) {
    group.poison = static_cast<Index>(sized.poisons.size());
    sized.poisons.emplace_back();
  }
  return sized.poisons[group.poison];
}

void fill_image(const Context& context, const Sized& sized, const PoisonTable::Target& target, VkCommandBuffer commands) {
  const VkImage image = sized.images[sized.resources[target.resource].first];
  if ((target.range.aspectMask & VK_IMAGE_ASPECT_COLOR_BIT) != 0) {
    VkClearColorValue value;
    std::fill(std::begin(value.uint32), std::end(value.uint32), kPattern);
    context.vk().CmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &target.range);
  } else {
    const VkClearDepthStencilValue value{kDepthPattern, 0xa5};
    context.vk().CmdClearDepthStencilImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &target.range);
  }
}

}  // namespace

void add_poison(const Context& context, Sized& sized) {
  for (const Acquire& acquire : context.plan.acquires) {
    if (!can_fill(context, acquire) || sized.resources[acquire.resource].count == 0) continue;
    GroupTable& group = sized.groups[acquire.group];
    PoisonTable& poison = poison_of(sized, group);
    if (context.plan.resources[acquire.resource].kind == ResourceKind::image)
      poison_images(sized, acquire.resource, group, poison);
    else
      poison_buffer(acquire, acquire.resource, group, poison);
  }
}

void record_poison(const Context& context, const Sized& sized, const PoisonTable& poison, VkCommandBuffer commands) {
  const VkMemoryBarrier2 before{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr,     VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                VK_ACCESS_2_MEMORY_WRITE_BIT,       kFillStages, VK_ACCESS_2_TRANSFER_WRITE_BIT};
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &before;
  info.imageMemoryBarrierCount = static_cast<uint32_t>(poison.images.size());
  info.pImageMemoryBarriers = poison.images.data();
  context.vk().CmdPipelineBarrier2(commands, &info);
  for (const PoisonTable::Target& target : poison.targets) {
    if (context.plan.resources[target.resource].kind == ResourceKind::image)
      fill_image(context, sized, target, commands);
    else
      context.vk().CmdFillBuffer(commands, sized.buffers[sized.resources[target.resource].first], 0, VK_WHOLE_SIZE, kPattern);
  }
}

}  // namespace rg
