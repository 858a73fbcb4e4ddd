#include "runtime/prologue.h"

#include <algorithm>
#include <bit>

#include "runtime/queues.h"
#include "runtime/resolve.h"
#include "runtime/resources.h"

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

void submit_barriers(const Context& context, const std::vector<VkImageMemoryBarrier2>& images, VkCommandBuffer commands) {
  if (images.empty()) return;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = static_cast<uint32_t>(images.size());
  info.pImageMemoryBarriers = images.data();
  context.vk().CmdPipelineBarrier2(commands, &info);
}

// What the first frame will read without having written it. Copies that it overwrites are left alone: their first barrier in the frame
// discards and waits for nothing, so nothing may be pending on them.
bool needs_clear(const Context& context, const Sized& sized, const Boundary& boundary) {
  const Resource& resource = context.plan.resources[boundary.ref.resource];
  if (sized.carried[boundary.ref.resource] || sized.carried_only) return false;
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
    if (sized.resets) barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  }
  submit_barriers(context, barriers, commands);
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
    if (!filled[buffer]) context.vk().CmdFillBuffer(commands, sized.buffers[buffer], 0, VK_WHOLE_SIZE, value.word[0]);
    filled[buffer] = true;
  }
}

// The family that owns a range between frames. Concurrent resources, and everything on one family, belong to the home family.
uint32_t owner_of(const Context& context, const Boundary& boundary) {
  if (boundary.queue == kNone || context.plan.resources[boundary.ref.resource].concurrent) return context.queues.families[0];
  return family_of(context, boundary.queue);
}

bool has_contents(const Context& context, const Sized& sized, const Boundary& boundary) {
  if (sized.resources[boundary.ref.resource].count == 0 || (sized.carried_only && !sized.carried[boundary.ref.resource])) return false;
  return is_image(context, boundary) ? boundary.layout != Layout::undefined : needs_clear(context, sized, boundary);
}

struct Scope {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 accesses = 0;
};

// Ends where the frame's first barriers begin: their source scopes are the boundary's.
Scope entry_scope(const Boundary& boundary) {
  if (boundary.stages != 0) return {boundary.stages, boundary.accesses};
  return {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
}

Scope filled_scope(const Context& context, const Sized& sized, const Boundary& boundary) {
  if (sized.carried[boundary.ref.resource]) return {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT};
  if (!needs_clear(context, sized, boundary)) return {};
  return {is_image(context, boundary) ? VK_PIPELINE_STAGE_2_CLEAR_BIT : kFillStages, VK_ACCESS_2_TRANSFER_WRITE_BIT};
}

// In the plan before, under the same name. Null: that plan is this one.
VkImageLayout carried_layout(const Context& context, const Sized& sized, const Boundary& boundary, const VkImageSubresourceRange& range) {
  const Plan& before = sized.carried_from != nullptr ? *sized.carried_from : context.plan;
  for (Index r = 0; r < before.resources.size(); ++r)
    if (before.resources[r].name == context.plan.resources[boundary.ref.resource].name)
      return static_cast<VkImageLayout>(
          layout_between_frames(before, {r, boundary.ref.age}, range.aspectMask, range.baseMipLevel, range.baseArrayLayer));
  return VK_IMAGE_LAYOUT_UNDEFINED;
}

// What brings the range of an image from where the clears left it to its entry layout.
VkImageMemoryBarrier2 entry_barrier(const Context& context, const Sized& sized, const Boundary& boundary, uint64_t frame) {
  const VkImageSubresourceRange range = image_range(context, sized, boundary.ref.resource, boundary.range);
  VkImageMemoryBarrier2 barrier = image_barrier(image_at(sized, {}, context.plan, boundary.ref, frame), range);
  if (sized.carried[boundary.ref.resource]) barrier.oldLayout = carried_layout(context, sized, boundary, range);
  if (needs_clear(context, sized, boundary)) barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  barrier.newLayout = static_cast<VkImageLayout>(boundary.layout);
  return barrier;
}
VkBufferMemoryBarrier2 entry_buffer_barrier(const Sized& sized, const Boundary& boundary, uint64_t frame) {
  VkBufferMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.buffer = sized.buffers[copy_index(sized.resources[boundary.ref.resource], boundary.ref.age, frame)];
  barrier.size = VK_WHOLE_SIZE;
  return barrier;
}

// The same two structs, filled for a dependency on one queue, for a release or for an acquire.
template <class Barrier>
void set_scopes(Barrier& barrier, Scope src, Scope dst, uint32_t src_family, uint32_t dst_family) {
  barrier.srcStageMask = src.stages, barrier.srcAccessMask = src.accesses;
  barrier.dstStageMask = dst.stages, barrier.dstAccessMask = dst.accesses;
  if (src_family == dst_family) return;
  barrier.srcQueueFamilyIndex = src_family, barrier.dstQueueFamilyIndex = dst_family;
}

struct EntryBarriers {
  std::vector<VkImageMemoryBarrier2> images;
  std::vector<VkBufferMemoryBarrier2> buffers;
  std::vector<uint32_t> released;  // buffers, which may appear in several boundary rows
};

// `family` the home family: transitions and releases; another: its acquires.
void enter(const Context& context, const Sized& sized, const Boundary& boundary, uint64_t frame, uint32_t family, EntryBarriers& out) {
  const uint32_t home = context.queues.families[0], owner = owner_of(context, boundary);
  if (family != home && family != owner) return;
  const Scope src = family == home ? filled_scope(context, sized, boundary) : Scope{};
  const Scope dst = family == owner ? entry_scope(boundary) : Scope{};
  if (is_image(context, boundary)) {
    if (image_range(context, sized, boundary.ref.resource, boundary.range).levelCount == 0) return;
    VkImageMemoryBarrier2 barrier = entry_barrier(context, sized, boundary, frame);
    if (sized.carried[boundary.ref.resource] && barrier.oldLayout == barrier.newLayout) return;  // its owner has it as it should be
    set_scopes(barrier, src, dst, home, owner);
    out.images.push_back(barrier);
    return;
  }
  const uint32_t buffer = copy_index(sized.resources[boundary.ref.resource], boundary.ref.age, frame);
  if (owner != home && std::find(out.released.begin(), out.released.end(), buffer) != out.released.end()) return;
  out.released.push_back(buffer);
  VkBufferMemoryBarrier2 barrier = entry_buffer_barrier(sized, boundary, frame);
  set_scopes(barrier, src, dst, home, owner);
  out.buffers.push_back(barrier);
}

bool record_entry(const Context& context, const Sized& sized, VkCommandBuffer commands, uint64_t frame, uint32_t family) {
  EntryBarriers barriers;
  for (const Boundary& boundary : context.plan.entry)
    if (has_contents(context, sized, boundary)) enter(context, sized, boundary, frame, family, barriers);
  if (barriers.images.empty() && barriers.buffers.empty()) return false;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.bufferMemoryBarrierCount = static_cast<uint32_t>(barriers.buffers.size());
  info.pBufferMemoryBarriers = barriers.buffers.data();
  info.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.images.size());
  info.pImageMemoryBarriers = barriers.images.data();
  context.vk().CmdPipelineBarrier2(commands, &info);
  return true;
}

// What frames before have done to buffers that are filled again. Images have it in barriers of their own.
void wait_for_users(const Context& context, VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstStageMask = kFillStages, barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  context.vk().CmdPipelineBarrier2(commands, &info);
}

}  // namespace

bool record_prologue(const Context& context, const Sized& sized, VkCommandBuffer commands, uint64_t next_frame) {
  if (sized.resets) wait_for_users(context, commands);
  prepare_clears(context, sized, next_frame, commands);
  clear_resources(context, sized, next_frame, commands);
  record_entry(context, sized, commands, next_frame, context.queues.families[0]);
  return true;
}

bool record_first_owner(const Context& context, const Sized& sized, VkCommandBuffer commands, uint64_t next_frame, uint32_t family) {
  return record_entry(context, sized, commands, next_frame, family);
}

}  // namespace rg
