#include "runtime/memory.h"

#include <algorithm>

#include "runtime/alias.h"
#include "runtime/errors.h"
#include "runtime/packing.h"
#include "runtime/resolve.h"
#include "runtime/resources.h"

namespace rg {

namespace {

enum class Arena : uint8_t { transient, lazy, own, host };

struct Item {  // one physical copy
  Index resource = kNone;
  uint32_t object = 0;  // in Sized::images or Sized::buffers
  bool is_image = true;
  Arena arena = Arena::transient;
  uint32_t type = UINT32_MAX;
  VkDeviceSize bytes = 0, alignment = 1, offset = 0;
  bool dedicated = false;  // memory of its own
};

Arena arena_of(const Resource& resource) {
  if (resource.lifetime == Lifetime::readback) return Arena::host;
  return resource.lifetime == Lifetime::transient ? Arena::transient : Arena::own;
}

constexpr VkMemoryPropertyFlags kHostMemory = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

uint32_t choose_type(const Context& context, Arena arena, uint32_t type_bits) {
  if (arena == Arena::lazy) return find_memory_type(context.device, type_bits, VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, 0);
  if (arena == Arena::host) return find_memory_type(context.device, type_bits, kHostMemory, VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
  return find_memory_type(context.device, type_bits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
}

VkDeviceSize round_up(VkDeviceSize value, VkDeviceSize alignment) { return (value + alignment - 1) / alignment * alignment; }

// A preference is no reason to give up what sharing saves.
VkMemoryRequirements requirements_of(const Context& context, const Sized& sized, Item& item) {
  if (!item.is_image) {
    VkMemoryRequirements requirements;
    context.vk().GetBufferMemoryRequirements(context.device.device, sized.buffers[item.object], &requirements);
    return requirements;
  }
  VkMemoryDedicatedRequirements dedicated{};
  dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS;
  VkMemoryRequirements2 requirements{};
  requirements.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2;
  requirements.pNext = &dedicated;
  VkImageMemoryRequirementsInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2;
  info.image = sized.images[item.object];
  context.vk().GetImageMemoryRequirements2(context.device.device, &info, &requirements);
  const bool shares = item.arena == Arena::transient && context.aliasing && !context.plan.resources[item.resource].no_alias;
  item.dedicated = dedicated.requiresDedicatedAllocation || (dedicated.prefersDedicatedAllocation && !shares);
  return requirements.memoryRequirements;
}

// Buffers and images share heaps, so both keep to the granularity at which they must not meet.
Item make_item(const Context& context, const Sized& sized, Index r, uint32_t object) {
  const Resource& resource = context.plan.resources[r];
  Item item{r, object, resource.kind == ResourceKind::image, arena_of(resource)};
  const VkMemoryRequirements requirements = requirements_of(context, sized, item);
  const VkDeviceSize granularity = std::max<VkDeviceSize>(context.device.limits.bufferImageGranularity, 1);
  item.alignment = std::max(requirements.alignment, granularity);
  item.bytes = round_up(requirements.size, granularity);
  const uint32_t lazy_type = resource.lazy ? choose_type(context, Arena::lazy, requirements.memoryTypeBits) : UINT32_MAX;
  if (lazy_type != UINT32_MAX && resource.lifetime == Lifetime::transient) item.arena = Arena::lazy;
  item.type = item.arena == Arena::lazy ? lazy_type : choose_type(context, item.arena, requirements.memoryTypeBits);
  return item;
}

std::vector<Item> list_items(const Context& context, const Sized& sized) {
  std::vector<Item> items;
  for (Index r = 0; r < sized.resources.size(); ++r)
    for (uint32_t copy = 0; copy < sized.resources[r].count; ++copy) items.push_back(make_item(context, sized, r, sized.resources[r].first + copy));
  return items;
}

// One after the other. Returns the bytes needed.
VkDeviceSize place_side_by_side(const std::vector<Item*>& items) {
  VkDeviceSize end = 0;
  for (Item* item : items) {
    item->offset = round_up(end, item->alignment);
    end = item->offset + item->bytes;
  }
  return end;
}

std::vector<packing::Item> packing_items(const Plan& plan, const std::vector<Item*>& items) {
  const std::vector<alias::GroupInterval> intervals = alias::group_intervals(plan);
  std::vector<packing::Item> out;
  for (const Item* item : items) {
    const alias::GroupInterval& interval = intervals[item->resource];
    const bool used = interval.used() && interval.begin != kNone;
    out.push_back({item->bytes, item->alignment, used ? interval.begin : 0, used ? interval.end + 1 : 1});
  }
  return out;
}

// Transients share bytes where the plan allows it. Returns the bytes needed.
VkDeviceSize place_aliased(const Context& context, const std::vector<Item*>& items, VkDeviceSize& lower_bound) {
  const alias::Sharing allowed(context.plan);
  std::vector<packing::Conflict> conflicts;
  for (uint32_t a = 0; a < items.size(); ++a)
    for (uint32_t b = a + 1; b < items.size(); ++b)
      if (!allowed.may_share(items[a]->resource, items[b]->resource)) conflicts.emplace_back(a, b);
  const packing::Placement placement = packing::pack(packing_items(context.plan, items), conflicts, packing::kPlacementEffort);
  for (size_t i = 0; i < items.size(); ++i) items[i]->offset = placement.offsets[i];
  lower_bound = placement.lower_bound_bytes;
  return placement.heap_bytes;
}

Status bind(const Context& context, const Sized& sized, const Item& item, VkDeviceMemory memory) {
  const std::string_view name = context.plan.resources[item.resource].name;
  if (item.is_image)
    return check(context.vk().BindImageMemory(context.device.device, sized.images[item.object], memory, item.offset), "vkBindImageMemory", name);
  return check(context.vk().BindBufferMemory(context.device.device, sized.buffers[item.object], memory, item.offset), "vkBindBufferMemory", name);
}

Status map_copies(const Context& context, Sized& sized, const std::vector<Item*>& items, VkDeviceMemory memory) {
  void* mapped = nullptr;
  RG_TRY(check(context.vk().MapMemory(context.device.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory", context.plan.name));
  for (const Item* item : items) sized.host_copies[item->object] = {static_cast<std::byte*>(mapped) + item->offset, memory};
  return Done{};
}

VkDeviceSize sum_bytes(const std::vector<Item*>& items) {
  VkDeviceSize sum = 0;
  for (const Item* item : items) sum += item->bytes;
  return sum;
}

VkDeviceSize place(const Context& context, Sized& sized, Arena arena, const std::vector<Item*>& items) {
  if (arena != Arena::transient) {
    const VkDeviceSize heap = place_side_by_side(items);
    (arena == Arena::own ? sized.report.persistent_bytes : arena == Arena::lazy ? sized.report.lazy_bytes : sized.report.host_bytes) += heap;
    return heap;
  }
  VkDeviceSize lower_bound = sum_bytes(items);
  const VkDeviceSize heap = context.aliasing && !items[0]->dedicated ? place_aliased(context, items, lower_bound) : place_side_by_side(items);
  // Hand-offs see all heaps as one range of bytes; what is in none of them is handed to nobody.
  for (const Item* item : items) sized.placed[item->resource] = {sized.report.heap_bytes + item->offset, item->bytes};
  sized.report.heap_bytes += heap;
  sized.report.unaliased_bytes += sum_bytes(items);
  sized.report.lower_bound_bytes += lower_bound;
  return heap;
}

// The heap's block of this type, or a larger one that replaces it for those who come later.
Result<VkDeviceMemory> take_block(const Context& context, Sized& sized, VkDeviceSize bytes, uint32_t type) {
  std::vector<TransientHeap::Block>& blocks = context.heap->blocks;
  auto block = std::find_if(blocks.begin(), blocks.end(), [&](const TransientHeap::Block& b) { return b.type == type; });
  if (block == blocks.end() || block->bytes < bytes) {
    Result<UniqueMemory> memory = allocate_memory(context.device, bytes, type, context.plan.name);
    if (!memory) return memory.error();
    if (block == blocks.end()) block = blocks.insert(blocks.end(), TransientHeap::Block{type, 0, nullptr});
    block->bytes = bytes;
    block->memory = std::make_shared<UniqueMemory>(std::move(*memory));
  }
  sized.shared_memories.push_back(block->memory);
  return block->memory->get();
}

Status place_in_heap(const Context& context, Sized& sized, uint32_t type, const std::vector<Item*>& items) {
  const Result<VkDeviceMemory> memory = take_block(context, sized, place(context, sized, Arena::transient, items), type);
  if (!memory) return memory.error();
  for (const Item* item : items) RG_TRY(bind(context, sized, *item, *memory));
  return Done{};
}

// Memory for these alone; `keep` owns it.
Status place_alone(const Context& context, Sized& sized, const std::vector<Item*>& items, std::vector<UniqueMemory>& keep) {
  const VkDeviceSize bytes = place(context, sized, items[0]->arena, items);
  const VkImage image = items[0]->dedicated ? sized.images[items[0]->object] : VK_NULL_HANDLE;
  Result<UniqueMemory> memory = allocate_memory(context.device, bytes, items[0]->type, context.plan.resources[items[0]->resource].name, image);
  if (!memory) return memory.error();
  for (const Item* item : items) RG_TRY(bind(context, sized, *item, memory->get()));
  keep.push_back(std::move(*memory));
  return Done{};
}

// Memory of its own for a resource that outlives plans.
Status place_kept(const Context& context, Sized& sized, const std::vector<Item*>& copies) {
  Kept& kept = *sized.kept[copies[0]->resource];
  if (!copies[0]->dedicated) return place_alone(context, sized, copies, kept.memories);
  for (Item* copy : copies) RG_TRY(place_alone(context, sized, {copy}, kept.memories));
  return Done{};
}

Status place_all_kept(const Context& context, Sized& sized, std::vector<Item>& items) {
  for (size_t i = 0; i < items.size();) {
    std::vector<Item*> copies;
    const Index resource = items[i].resource;
    for (; i < items.size() && items[i].resource == resource; ++i) copies.push_back(&items[i]);
    if (copies[0]->arena != Arena::own || sized.carried[resource]) continue;
    RG_TRY(place_kept(context, sized, copies));
  }
  return Done{};
}

Status place_arena(const Context& context, Sized& sized, Arena arena, uint32_t type, const std::vector<Item*>& items) {
  if (arena == Arena::transient && context.heap) return place_in_heap(context, sized, type, items);
  const VkDeviceSize heap = place(context, sized, arena, items);
  Result<UniqueMemory> memory = allocate_memory(context.device, heap, type, context.plan.name);
  if (!memory) return memory.error();
  for (const Item* item : items) RG_TRY(bind(context, sized, *item, memory->get()));
  if (arena == Arena::host) RG_TRY(map_copies(context, sized, items, memory->get()));
  sized.memories.push_back(std::move(*memory));
  return Done{};
}

}  // namespace

Result<UniqueMemory> allocate_memory(Device::State& device, VkDeviceSize bytes, uint32_t type, std::string_view name, VkImage dedicated) {
  if (type == UINT32_MAX) return Error{ErrorCode::unsupported, "`" + std::string(name) + "`: the device has no memory of the kind that is needed"};
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = bytes;
  info.memoryTypeIndex = type;
  VkMemoryDedicatedAllocateInfo only{};
  only.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
  only.image = dedicated;
  if (dedicated != VK_NULL_HANDLE) info.pNext = &only;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  RG_TRY(check(device.vk.AllocateMemory(device.device, &info, device.vk.allocator, &memory), "vkAllocateMemory", name));
  return UniqueMemory(device.vk, device.device, memory);
}

Status place_resources(const Context& context, Sized& sized) {
  std::vector<Item> items = list_items(context, sized);
  sized.placed.resize(sized.resources.size());
  RG_TRY(place_all_kept(context, sized, items));
  for (const Arena arena : {Arena::transient, Arena::lazy, Arena::host})
    for (uint32_t type = 0; type < VK_MAX_MEMORY_TYPES; ++type) {
      std::vector<Item*> chosen;
      for (Item& item : items)
        if (item.arena == arena && item.type == type && !item.dedicated) chosen.push_back(&item);
      if (!chosen.empty()) RG_TRY(place_arena(context, sized, arena, type, chosen));
    }
  for (Item& item : items)
    if (item.dedicated && item.arena != Arena::own && item.type != UINT32_MAX) RG_TRY(place_alone(context, sized, {&item}, sized.memories));
  for (const Item& item : items) {
    if (item.type == UINT32_MAX)
      return Error{ErrorCode::unsupported, "`" + std::string(context.plan.resources[item.resource].name) + "`: no memory type fits"};
    sized.placements.push_back({context.plan.resources[item.resource].name, item.offset, item.bytes});
  }
  return Done{};
}

}  // namespace rg
