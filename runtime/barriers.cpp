#include "runtime/barriers.h"

#include <numeric>
#include <optional>

#include "runtime/queues.h"
#include "runtime/resolve.h"
#include "runtime/wait_reach.h"

namespace rg {

namespace {

// The specification counts vkCmdFillBuffer to the clears, the validation layer to the copies: barriers that fills take part in name both
// while it watches.
Stages watched(const Context& context, Stages stages) {
  return context.device.validating && (stages & stage::clear) != 0 ? stages | stage::copy : stages;
}

VkMemoryBarrier2 translate(const Context& context, const MemoryBarrier& in) {
  return {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr,        watched(context, in.src_stages), in.src_accesses,
          watched(context, in.dst_stages),    in.dst_accesses};
}

enum class Handover : uint8_t { none, release, acquire, dropped };

// A transfer between two queues of one family is none: its release is dropped, the acquire alone changes the layout.
Handover handover_of(const Context& context, Index group, Index src_queue, Index dst_queue) {
  if (src_queue == kNone || dst_queue == kNone) return Handover::none;
  const bool releases = context.queues.of_group[group] == src_queue;
  if (changes_family(context, src_queue, dst_queue)) return releases ? Handover::release : Handover::acquire;
  return releases ? Handover::dropped : Handover::none;
}

template <class Barrier>
bool dropped(const Context& context, Index group, const Barrier& in) {
  return handover_of(context, group, in.src_queue, in.dst_queue) == Handover::dropped;
}

template <class Out, class In>
void set_families(const Context& context, const In& in, Out& out) {
  out.srcQueueFamilyIndex = out.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  if (!changes_family(context, in.src_queue, in.dst_queue)) return;
  out.srcQueueFamilyIndex = family_of(context, in.src_queue);
  out.dstQueueFamilyIndex = family_of(context, in.dst_queue);
}

VkImageMemoryBarrier2 translate(const Context& context, const ImageBarrier& in, VkImage image, const VkImageSubresourceRange& range) {
  VkImageMemoryBarrier2 out{};
  out.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  out.srcStageMask = in.src_stages;
  out.srcAccessMask = in.src_accesses;
  out.dstStageMask = in.dst_stages;
  out.dstAccessMask = in.dst_accesses;
  out.oldLayout = static_cast<VkImageLayout>(in.old_layout);
  out.newLayout = static_cast<VkImageLayout>(in.new_layout);
  set_families(context, in, out);
  out.image = image;
  out.subresourceRange = range;
  return out;
}

VkBufferMemoryBarrier2 translate(const Context& context, const BufferBarrier& in, const BufferSpan& span) {
  VkBufferMemoryBarrier2 out{};
  out.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
  out.srcStageMask = watched(context, in.src_stages);
  out.srcAccessMask = in.src_accesses;
  out.dstStageMask = watched(context, in.dst_stages);
  out.dstAccessMask = in.dst_accesses;
  set_families(context, in, out);
  out.buffer = span.buffer;
  out.offset = span.offset;
  out.size = span.size;
  return out;
}

bool imported(const Sized& sized, Index resource) { return sized.resources[resource].count == 0; }

uint32_t group_period(const Context& context, const Sized& sized, const BarrierGroup& group) {
  uint32_t period = 1;
  for (const ImageBarrier& barrier : context.plan.image_barriers.subspan(group.first_image, group.image_count))
    period = std::lcm(period, copies_of(sized, barrier.image.resource));
  for (const BufferBarrier& barrier : context.plan.buffer_barriers.subspan(group.first_buffer, group.buffer_count))
    period = std::lcm(period, copies_of(sized, barrier.buffer.resource));
  return period;
}

constexpr Accesses kWrites = access::shader_write | access::color_attachment_write | access::depth_stencil_attachment_write | access::transfer_write |
                             access::host_write | access::memory_write | access::shader_storage_write;

// Where a transfer is none, its acquire relies on a wait for the release's queue. The validation layer loses the writes before such a wait when the
// next thing is a transition: while it watches, the acquire names them once more.
template <class Barriers, class Same>
void name_released_writes(const Barriers& all, Index queue, Same same, VkPipelineStageFlags2& stages, VkAccessFlags2& accesses) {
  for (const auto& other : all) {
    if (other.src_queue != queue || !same(other) || other.src_accesses == 0) continue;
    stages |= other.src_stages, accesses |= other.src_accesses;
  }
}
// The same where an image that queues share changes its layout behind a wait: the writes of the passes of other queues that something waits for.
// Those of the group's own queue, and those that nothing waits for, are the plan's to name: a hazard is reported.
Stages stages_of(const DeviceQueue& queue) {
  if ((queue.flags & VK_QUEUE_GRAPHICS_BIT) != 0) return ~Stages{0};
  return stage::copy | stage::clear | ((queue.flags & VK_QUEUE_COMPUTE_BIT) != 0 ? stage::compute_shader : stage::none);
}
void name_shared_writes(const Context& context, const WaitReach& reach, Index group, const ImageBarrier& in, VkImageMemoryBarrier2& out) {
  if (!context.plan.resources[in.image.resource].concurrent || in.src_accesses != 0 || in.old_layout == Layout::undefined) return;
  const Stages possible = stages_of(queue_of(context, context.queues.of_group[group]));
  for (Index p = 0; p < context.plan.passes.size(); ++p) {
    const Pass& pass = context.plan.passes[p];
    if (!reach.comes_after(group, p)) continue;
    for (const Access& access : context.plan.accesses.subspan(pass.first_access, pass.access_count))
      if (access.ref == in.image && access.writes && (access.stages & ~possible) == 0)
        out.srcStageMask |= access.stages, out.srcAccessMask |= access.accesses & kWrites;
  }
}
void repeat_release(const Context& context, const WaitReach* reach, Index group, const ImageBarrier& in, VkImageMemoryBarrier2& out) {
  if (reach == nullptr) return;
  if (in.src_queue == kNone) return name_shared_writes(context, *reach, group, in, out);
  const bool releases = context.queues.of_group[group] == in.src_queue, transfers = changes_family(context, in.src_queue, in.dst_queue);
  if (releases && transfers && out.dstStageMask == 0) out.dstStageMask = out.srcStageMask;  // it loses a release that nothing comes after
  if (releases || transfers) return;
  auto same = [&](const ImageBarrier& other) { return other.image == in.image && other.range == in.range && other.dst_queue == in.dst_queue; };
  name_released_writes(context.plan.image_barriers, in.src_queue, same, out.srcStageMask, out.srcAccessMask);
}

// What the placement adds to the plan's barriers; see alias.h.
struct Patches {
  struct Scope {
    Stages stages = 0;
    Accesses accesses = 0;
  };
  std::vector<Scope> images;                 // by Plan::image_barriers
  std::vector<const MemoryBarrier*> groups;  // by Plan::groups; null: nothing
  std::optional<WaitReach> reach;            // while the validation layer watches
};

Patches make_patches(const Plan& plan, const alias::HandOffs& hand_offs) {
  Patches patches{std::vector<Patches::Scope>(plan.image_barriers.size()), std::vector<const MemoryBarrier*>(plan.groups.size()), {}};
  for (const alias::GroupPatch& patch : hand_offs.groups) patches.groups[patch.group] = &patch.memory;
  for (const alias::ImagePatch& patch : hand_offs.images)
    for (Index i = patch.first; i < patch.first + patch.count; ++i)
      patches.images[i].stages |= patch.src_stages, patches.images[i].accesses |= patch.src_accesses;
  return patches;
}

// Barriers on mips that do not exist at these extents vanish.
void add_images(const Context& context, const Sized& sized, Index index, const Patches& patches, uint32_t phase, GroupTable& table) {
  const BarrierGroup& group = context.plan.groups[index];
  for (Index i = group.first_image; i < group.first_image + group.image_count; ++i) {
    const ImageBarrier& barrier = context.plan.image_barriers[i];
    const VkImageSubresourceRange range = image_range(context, sized, barrier.image.resource, barrier.range);
    if (range.levelCount == 0 || dropped(context, index, barrier)) continue;
    const VkImage image = imported(sized, barrier.image.resource) ? VkImage(VK_NULL_HANDLE) : image_at(sized, {}, context.plan, barrier.image, phase);
    VkImageMemoryBarrier2& out = table.images.emplace_back(translate(context, barrier, image, range));
    out.srcStageMask |= patches.images[i].stages;
    out.srcAccessMask |= patches.images[i].accesses;
    repeat_release(context, patches.reach ? &*patches.reach : nullptr, index, barrier, out);
  }
}

void add_buffers(const Context& context, const Sized& sized, Index index, uint32_t phase, GroupTable& table) {
  const BarrierGroup& group = context.plan.groups[index];
  for (const BufferBarrier& barrier : context.plan.buffer_barriers.subspan(group.first_buffer, group.buffer_count)) {
    const ByteRange bytes = byte_range(context, sized, barrier.bytes);
    if (bytes.size == 0 || dropped(context, index, barrier)) continue;
    const bool from_engine = imported(sized, barrier.buffer.resource);
    table.buffers.push_back(
        translate(context, barrier, from_engine ? BufferSpan{} : buffer_at(sized, {}, context.plan, barrier.buffer, bytes, phase)));
  }
}

// Same walk as add_images and add_buffers: finds the barriers whose handles come with the frame.
void list_imports(const Context& context, Sized& sized, Index index, GroupTable& table) {
  const BarrierGroup& group = context.plan.groups[index];
  for (uint32_t phase = 0; phase < table.period; ++phase) {
    size_t image = table.images.size() / table.period * phase, buffer = table.buffers.size() / table.period * phase;
    for (const ImageBarrier& barrier : context.plan.image_barriers.subspan(group.first_image, group.image_count)) {
      if (image_range(context, sized, barrier.image.resource, barrier.range).levelCount == 0 || dropped(context, index, barrier)) continue;
      if (imported(sized, barrier.image.resource))
        sized.imported_images.push_back({context.plan.resources[barrier.image.resource].import_slot, &table.images[image]});
      ++image;
    }
    for (const BufferBarrier& barrier : context.plan.buffer_barriers.subspan(group.first_buffer, group.buffer_count)) {
      const ByteRange bytes = byte_range(context, sized, barrier.bytes);
      if (bytes.size == 0 || dropped(context, index, barrier)) continue;
      if (imported(sized, barrier.buffer.resource)) sized.imported_buffers.push_back({barrier.buffer, &table.buffers[buffer], bytes});
      ++buffer;
    }
  }
}

void fill_infos(GroupTable& table) {
  const size_t images = table.images.size() / table.period, buffers = table.buffers.size() / table.period;
  for (uint32_t phase = 0; phase < table.period; ++phase) {
    VkDependencyInfo& info = table.infos.emplace_back();
    info = {};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = static_cast<uint32_t>(table.memory.size());
    info.pMemoryBarriers = table.memory.data();
    info.bufferMemoryBarrierCount = static_cast<uint32_t>(buffers);
    info.pBufferMemoryBarriers = table.buffers.data() + buffers * phase;
    info.imageMemoryBarrierCount = static_cast<uint32_t>(images);
    info.pImageMemoryBarriers = table.images.data() + images * phase;
  }
}

void add_memory(const Context& context, const BarrierGroup& group, const MemoryBarrier* hand_off, GroupTable& table) {
  for (const MemoryBarrier& barrier : context.plan.memory_barriers.subspan(group.first_memory, group.memory_count))
    if (barrier.src_stages != 0 || barrier.src_accesses != 0) table.memory.push_back(translate(context, barrier));
  if (hand_off != nullptr) table.memory.push_back(translate(context, *hand_off));
}

// The execution dependency of a barrier holds for all commands in its scopes, whatever image or buffer it names; the validation layer
// follows it for that one resource only. While it watches, each is said once more without a resource: that orders nothing that was not ordered, but
// for copies where clears are, because of fills.
void add_execution(GroupTable& table, Stages src, Stages dst) {
  for (const VkMemoryBarrier2& barrier : table.memory)
    if ((src & ~barrier.srcStageMask) == 0 && (dst & ~barrier.dstStageMask) == 0) return;
  if (src != 0 && dst != 0) table.memory.push_back({VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, src, 0, dst, 0});
}
void spell_out_execution(const Context& context, GroupTable& table) {
  const auto add = [&](const auto& barrier) { add_execution(table, watched(context, barrier.srcStageMask), watched(context, barrier.dstStageMask)); };
  for (const VkImageMemoryBarrier2& barrier : table.images) add(barrier);
  for (const VkBufferMemoryBarrier2& barrier : table.buffers) add(barrier);
}

}  // namespace

void create_barriers(const Context& context, Sized& sized) {
  alias::HandOffs hand_offs;
  alias::find_hand_offs(context.plan, sized.placed, hand_offs);
  Patches patches = make_patches(context.plan, hand_offs);
  if (context.device.validating) patches.reach.emplace(context.plan);
  sized.groups.resize(context.plan.groups.size());
  for (Index g = 0; g < sized.groups.size(); ++g) {
    const BarrierGroup& group = context.plan.groups[g];
    GroupTable& table = sized.groups[g];
    table.period = group_period(context, sized, group);
    add_memory(context, group, patches.groups[g], table);
    for (uint32_t phase = 0; phase < table.period; ++phase)
      add_images(context, sized, g, patches, phase, table), add_buffers(context, sized, g, phase, table);
    list_imports(context, sized, g, table);
    if (context.device.validating) spell_out_execution(context, table);
    fill_infos(table);
  }
  if (context.poison) add_poison(context, sized);
  for (const GroupTable& table : sized.groups) {
    const VkDependencyInfo& info = table.infos[0];  // alike in every phase but for handles
    const bool empty = info.memoryBarrierCount + info.bufferMemoryBarrierCount + info.imageMemoryBarrierCount == 0;
    sized.group_rows.push_back({empty ? nullptr : table.infos.data(), table.period, table.poison});
  }
}

void update_imported_barriers(const Context& context, Sized& sized, const std::vector<Import>& imports) {
  for (const ImportedImageBarrier& imported : sized.imported_images) imported.barrier->image = imports[imported.slot].image.image;
  for (const ImportedBufferBarrier& imported : sized.imported_buffers) {
    const BufferSpan span = buffer_at(sized, imports, context.plan, imported.ref, imported.bytes, 0);
    imported.barrier->buffer = span.buffer;
    imported.barrier->offset = span.offset;
    imported.barrier->size = span.size;
  }
}

}  // namespace rg
