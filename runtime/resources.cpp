#include "runtime/resources.h"

#include <algorithm>
#include <bit>

#include "runtime/errors.h"
#include "runtime/formats.h"
#include "runtime/memory.h"
#include "runtime/resolve.h"

namespace rg {

namespace {

constexpr VkDeviceSize kMostBytes = VkDeviceSize{1} << 40;  // of a buffer: what is larger comes from a wrapped expression

uint32_t physical_copies(const Context& context, const Resource& resource) {
  switch (resource.lifetime) {
    case Lifetime::imported:
      return 0;
    case Lifetime::history:
      return std::max(resource.copies, 1u);
    case Lifetime::readback:
      return context.frames_in_flight;  // the host reads one while the device writes another
    default:
      return 1;
  }
}

uint32_t dimension_value(const Context& context, const Sized& sized, Index expr) {
  return static_cast<uint32_t>(std::clamp<int64_t>(evaluate(context, sized, expr), 1, UINT32_MAX));
}

uint32_t full_chain(const VkExtent3D& extent) { return static_cast<uint32_t>(std::bit_width(std::max({extent.width, extent.height, extent.depth}))); }

uint32_t dimension_limit(const VkPhysicalDeviceLimits& limits, Dimension dimension) {
  switch (dimension) {
    case Dimension::d1:
      return limits.maxImageDimension1D;
    case Dimension::d3:
      return limits.maxImageDimension3D;
    case Dimension::cube:
      return limits.maxImageDimensionCube;
    default:
      return limits.maxImageDimension2D;
  }
}

Status check_image_limits(const Context& context, const Resource& resource, const SizedResource& sized) {
  const uint32_t limit = dimension_limit(context.device.limits, resource.dimension),
                 largest = std::max({sized.extent.width, sized.extent.height, sized.extent.depth});
  if (largest > limit)
    return Error{ErrorCode::unsupported, "image `" + std::string(resource.name) + "`: a side of " + std::to_string(largest) +
                                             " texels; this device allows " + std::to_string(limit)};
  if (sized.layers > context.device.limits.maxImageArrayLayers)
    return Error{ErrorCode::unsupported, "image `" + std::string(resource.name) + "`: " + std::to_string(sized.layers) +
                                             " layers; this device allows " + std::to_string(context.device.limits.maxImageArrayLayers)};
  return Done{};
}

bool has_lazy_memory(const Device::State& device) {
  return find_memory_type(device, UINT32_MAX, VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, 0) != UINT32_MAX;
}

// Only attachments may live on the chip, so whatever else tools do with images keeps them in memory.
VkImageUsageFlags image_usage(const Context& context, const Resource& resource) {
  VkImageUsageFlags usage = resource.usage;
  const bool cleared = resource.init == InitKind::clear || (context.poison && resource.lifetime == Lifetime::transient);
  if (cleared) usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (context.debug_readback || usage == 0) usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  if (resource.lazy && usage == resource.usage && has_lazy_memory(context.device)) usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
  return usage;
}

VkBufferUsageFlags buffer_usage(const Context& context, const Resource& resource) {
  VkBufferUsageFlags usage = resource.usage;
  const bool cleared = resource.init == InitKind::clear || (context.poison && resource.lifetime == Lifetime::transient);
  if (cleared) usage |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (context.debug_readback || usage == 0) usage |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
  return usage;
}

VkImageCreateFlags image_flags(const Resource& resource) {
  VkImageCreateFlags flags = 0;
  if (resource.lifetime == Lifetime::transient && !resource.no_alias) flags |= VK_IMAGE_CREATE_ALIAS_BIT;
  if (resource.mutable_format) flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | VK_IMAGE_CREATE_EXTENDED_USAGE_BIT;
  if (resource.dimension == Dimension::cube) flags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
  constexpr VkImageUsageFlags attachment = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (resource.dimension == Dimension::d3 && (resource.usage & attachment) != 0) flags |= VK_IMAGE_CREATE_2D_ARRAY_COMPATIBLE_BIT;
  return flags;
}

VkImageType image_type(Dimension dimension) {
  if (dimension == Dimension::d1) return VK_IMAGE_TYPE_1D;
  return dimension == Dimension::d3 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
}

// Resources of several families: those that the plan declares so, and what the frame reads back, whose writers need no transfer.
template <class Info>
void share(const Context& context, const Resource& resource, Info& info) {
  const bool shared = context.queues.families.size() > 1 && (resource.concurrent || resource.lifetime == Lifetime::readback);
  info.sharingMode = shared ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE;
  if (!shared) return;
  info.queueFamilyIndexCount = static_cast<uint32_t>(context.queues.families.size());
  info.pQueueFamilyIndices = context.queues.families.data();
}

VkImageCreateInfo image_info(const Context& context, const Resource& resource, const SizedResource& sized) {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.flags = image_flags(resource);
  info.imageType = image_type(resource.dimension);
  info.format = static_cast<VkFormat>(resource.format);
  info.extent = sized.extent;
  info.mipLevels = sized.mips;
  info.arrayLayers = sized.layers;
  info.samples = static_cast<VkSampleCountFlagBits>(resource.samples);
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = image_usage(context, resource);
  share(context, resource, info);
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  return info;
}

Status check_image_support(const Context& context, const Resource& resource, const VkImageCreateInfo& info) {
  VkImageFormatProperties properties;
  const VkResult result = context.vk().GetPhysicalDeviceImageFormatProperties(context.device.physical, info.format, info.imageType, info.tiling,
                                                                              info.usage, info.flags, &properties);
  if (result == VK_ERROR_FORMAT_NOT_SUPPORTED || (result == VK_SUCCESS && (properties.sampleCounts & info.samples) == 0))
    return Error{ErrorCode::unsupported, "image `" + std::string(resource.name) + "`: this device does not support format " +
                                             std::to_string(info.format) + " with usage " + std::to_string(info.usage) + " and " +
                                             std::to_string(info.samples) + " samples"};
  return check(result, "vkGetPhysicalDeviceImageFormatProperties", resource.name);
}

Status create_image(const Context& context, const Resource& resource, const SizedResource& size, Index r, Sized& sized) {
  const VkImageCreateInfo info = image_info(context, resource, size);
  RG_TRY(check_image_support(context, resource, info));
  std::vector<UniqueImage>& owner = sized.kept[r] ? sized.kept[r]->images : sized.own_images;
  for (uint32_t copy = 0; copy < size.count; ++copy) {
    VkImage image = VK_NULL_HANDLE;
    RG_TRY(check(context.vk().CreateImage(context.device.device, &info, context.vk().allocator, &image), "vkCreateImage", resource.name));
    owner.emplace_back(context.vk(), context.device.device, image);
    sized.images.push_back(image);
    name_object(context.device, VK_OBJECT_TYPE_IMAGE, image, resource.name);
  }
  if (sized.kept[r]) sized.kept[r]->image = info;
  return Done{};
}

VkBufferCreateInfo buffer_info(const Context& context, const Resource& resource, const SizedResource& size) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size.bytes;
  info.usage = buffer_usage(context, resource);
  share(context, resource, info);
  return info;
}

Status create_buffer(const Context& context, const Resource& resource, const SizedResource& size, Index r, Sized& sized) {
  const VkBufferCreateInfo info = buffer_info(context, resource, size);
  std::vector<UniqueBuffer>& owner = sized.kept[r] ? sized.kept[r]->buffers : sized.own_buffers;
  for (uint32_t copy = 0; copy < size.count; ++copy) {
    VkBuffer buffer = VK_NULL_HANDLE;
    RG_TRY(check(context.vk().CreateBuffer(context.device.device, &info, context.vk().allocator, &buffer), "vkCreateBuffer", resource.name));
    owner.emplace_back(context.vk(), context.device.device, buffer);
    sized.buffers.push_back(buffer);
    name_object(context.device, VK_OBJECT_TYPE_BUFFER, buffer, resource.name);
  }
  if (sized.kept[r]) sized.kept[r]->buffer = info;
  return Done{};
}

// ---- kept contents ------------------------------------------------------------------------------------------------

bool same_shape(const VkImageCreateInfo& a, const VkImageCreateInfo& b) {
  return a.flags == b.flags && a.imageType == b.imageType && a.format == b.format && a.extent.width == b.extent.width &&
         a.extent.height == b.extent.height && a.extent.depth == b.extent.depth && a.mipLevels == b.mipLevels && a.arrayLayers == b.arrayLayers &&
         a.samples == b.samples && a.sharingMode == b.sharingMode && (b.usage & ~a.usage) == 0;
}
bool same_shape(const VkBufferCreateInfo& a, const VkBufferCreateInfo& b) {
  return a.size == b.size && a.sharingMode == b.sharingMode && (b.usage & ~a.usage) == 0;
}

bool fits(const Context& context, const Resource& resource, const SizedResource& size, const Kept& kept) {
  if (resource.kind == ResourceKind::image) return kept.images.size() == size.count && same_shape(kept.image, image_info(context, resource, size));
  return kept.buffers.size() == size.count && same_shape(kept.buffer, buffer_info(context, resource, size));
}

bool is_kept(const Resource& resource) { return resource.lifetime == Lifetime::history || resource.lifetime == Lifetime::persistent; }

// Takes over what `from` has of the same name and shape; false: nothing that fits.
bool carry(const Context& context, const Carried& from, Index r, Sized& sized) {
  const Resource& resource = context.plan.resources[r];
  for (Index other = 0; other < from.plan.resources.size(); ++other) {
    if (from.plan.resources[other].name != resource.name || from.sized.kept[other] == nullptr) continue;
    if (!fits(context, resource, sized.resources[r], *from.sized.kept[other]) || !from.may_carry(context, r, other)) return false;
    sized.kept[r] = from.sized.kept[other];
    sized.carried[r] = true;
    for (const UniqueImage& image : sized.kept[r]->images) sized.images.push_back(image.get());
    for (const UniqueBuffer& buffer : sized.kept[r]->buffers) sized.buffers.push_back(buffer.get());
    return true;
  }
  return false;
}

void size_image(const Context& context, const Resource& resource, Sized& sized, SizedResource& out) {
  out.extent = {dimension_value(context, sized, resource.width), dimension_value(context, sized, resource.height),
                dimension_value(context, sized, resource.depth)};
  out.mips = std::clamp(resource.mips, 1u, full_chain(out.extent));
  out.layers = std::max(resource.layers, 1u);
}

}  // namespace

Status size_resources(const Context& context, Sized& sized) {
  evaluate_all(context, sized);
  uint32_t images = 0, buffers = 0;
  for (const Resource& resource : context.plan.resources) {
    SizedResource& out = sized.resources.emplace_back();
    const bool is_image = resource.kind == ResourceKind::image;
    out.count = physical_copies(context, resource);
    uint32_t& next = is_image ? images : buffers;
    out.first = next;
    next += out.count;
    if (is_image)
      size_image(context, resource, sized, out);
    else  // the smallest buffer that vkCmdFillBuffer can fill
      out.bytes = resource.bytes == kNone ? 0 : static_cast<VkDeviceSize>(std::max<int64_t>(evaluate(context, sized, resource.bytes), 4));
    sized.active.push_back(out.extent);
    if (!is_image && out.bytes > kMostBytes)
      return Error{ErrorCode::unsupported, "buffer `" + std::string(resource.name) + "`: " + std::to_string(out.bytes) + " bytes"};
    if (is_image && out.count != 0) RG_TRY(check_image_limits(context, resource, out));
  }
  return Done{};
}

void active_extents_of_images(const Context& context, Sized& sized) {
  for (Index r = 0; r < context.plan.resources.size(); ++r) {
    const Resource& resource = context.plan.resources[r];
    if (resource.kind == ResourceKind::image)
      sized.active[r] = {dimension_value(context, sized, resource.width), dimension_value(context, sized, resource.height),
                         dimension_value(context, sized, resource.depth)};
  }
}

Status create_resources(const Context& context, const Carried* from, Sized& sized) {
  sized.kept.resize(sized.resources.size());
  sized.carried.resize(sized.resources.size());
  for (Index r = 0; r < context.plan.resources.size(); ++r) {
    const Resource& resource = context.plan.resources[r];
    if (is_kept(resource) && from != nullptr && carry(context, *from, r, sized)) continue;
    if (is_kept(resource)) sized.kept[r] = std::make_shared<Kept>();
    if (resource.kind == ResourceKind::image)
      RG_TRY(create_image(context, resource, sized.resources[r], r, sized));
    else
      RG_TRY(create_buffer(context, resource, sized.resources[r], r, sized));
  }
  sized.host_copies.resize(sized.buffers.size());
  return place_resources(context, sized);
}

uint32_t find_memory_type(const Device::State& device, uint32_t type_bits, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred) {
  for (const VkMemoryPropertyFlags flags : {wanted | preferred, wanted})
    for (uint32_t type = 0; type < device.memory.memoryTypeCount; ++type)
      if ((type_bits >> type & 1) != 0 && (device.memory.memoryTypes[type].propertyFlags & flags) == flags) return type;
  return UINT32_MAX;
}

Result<HostBuffer> create_host_buffer(const Context& context, VkDeviceSize bytes, VkBufferUsageFlags usage, VkMemoryPropertyFlags preferred,
                                      std::string_view name) {
  Device::State& device = context.device;
  HostBuffer out;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  Resource shared;
  shared.concurrent = true;
  share(context, shared, info);
  VkBuffer buffer = VK_NULL_HANDLE;
  RG_TRY(check(device.vk.CreateBuffer(device.device, &info, device.vk.allocator, &buffer), "vkCreateBuffer", name));
  out.buffer = UniqueBuffer(device.vk, device.device, buffer);
  name_object(device, VK_OBJECT_TYPE_BUFFER, buffer, name);
  VkMemoryRequirements requirements;
  device.vk.GetBufferMemoryRequirements(device.device, buffer, &requirements);
  const uint32_t type =
      find_memory_type(device, requirements.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, preferred);
  Result<UniqueMemory> memory = allocate_memory(device, requirements.size, type, name);
  if (!memory) return memory.error();
  out.memory = std::move(*memory);
  RG_TRY(check(device.vk.BindBufferMemory(device.device, buffer, out.memory.get(), 0), "vkBindBufferMemory", name));
  void* mapped = nullptr;
  RG_TRY(check(device.vk.MapMemory(device.device, out.memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory", name));
  out.mapped = static_cast<std::byte*>(mapped);
  return out;
}

void name_object(const Device::State& device, VkObjectType type, uint64_t handle, std::string_view name) {
  if (device.vk.SetDebugUtilsObjectNameEXT == nullptr) return;
  const std::string text(name);
  VkDebugUtilsObjectNameInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = text.c_str();
  device.vk.SetDebugUtilsObjectNameEXT(device.device, &info);
}

}  // namespace rg
