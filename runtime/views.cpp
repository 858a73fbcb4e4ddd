#include "runtime/views.h"

#include <algorithm>

#include "runtime/errors.h"
#include "runtime/resolve.h"

namespace rg {

namespace {

VkImageViewType view_type(const ViewRequest& request) {
  switch (request.dimension) {
    case Dimension::d1:
      return request.arrayed ? VK_IMAGE_VIEW_TYPE_1D_ARRAY : VK_IMAGE_VIEW_TYPE_1D;
    case Dimension::d3:
      return VK_IMAGE_VIEW_TYPE_3D;
    case Dimension::cube:
      return request.arrayed ? VK_IMAGE_VIEW_TYPE_CUBE_ARRAY : VK_IMAGE_VIEW_TYPE_CUBE;
    default:
      return request.arrayed ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  }
}

// Layers that a view of this type shows: the others are one layer whatever the range says.
uint32_t layer_count(const ViewRequest& request, const VkImageSubresourceRange& range) {
  if (request.arrayed) return range.layerCount;
  return request.dimension == Dimension::cube ? std::min(range.layerCount, 6u) : 1u;
}

VkImageViewCreateInfo view_info(const Context& context, const ViewRequest& request, const VkImageSubresourceRange& range) {
  const Resource& resource = context.plan.resources[request.ref.resource];
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.viewType = view_type(request);
  info.format = static_cast<VkFormat>(request.format != Format::undefined ? request.format : resource.format);
  info.subresourceRange = range;
  info.subresourceRange.layerCount = layer_count(request, range);
  if (request.all_aspects) info.subresourceRange.aspectMask = resource.aspects;
  if (request.slices != 0) info.subresourceRange.baseArrayLayer = request.slice, info.subresourceRange.layerCount = request.slices;
  return info;
}

VkImageViewUsageCreateInfo usage_info(const ViewRequest& request) {
  VkImageViewUsageCreateInfo usage{};
  usage.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO;
  usage.usage = request.usage;
  return usage;
}

bool covers_image(const Resource& resource, const SizedResource& size, const ViewRequest& request, const VkImageViewCreateInfo& info) {
  const VkImageSubresourceRange& range = info.subresourceRange;
  const bool all = range.baseMipLevel == 0 && range.levelCount == size.mips && range.baseArrayLayer == 0 && range.layerCount == size.layers;
  return all && request.dimension == resource.dimension && info.format == static_cast<VkFormat>(resource.format) &&
         range.aspectMask == resource.aspects;
}

ViewRef add_imported(const Context& context, Sized& sized, const ViewRequest& request, const VkImageViewCreateInfo& info) {
  ImportedView& view = sized.imported_views.emplace_back();
  view.resource = request.ref.resource;
  view.info = info;
  view.usage = usage_info(request);
  view.whole = covers_image(context.plan.resources[request.ref.resource], sized.resources[request.ref.resource], request, info);
  return {request.ref, 0, static_cast<Index>(sized.imported_views.size() - 1), true};
}

Result<UniqueView> create_view(const Context& context, VkImageViewCreateInfo info, const VkImageViewUsageCreateInfo& usage, VkImage image,
                               std::string_view name) {
  info.pNext = &usage;
  info.image = image;
  VkImageView view = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateImageView(context.device.device, &info, context.vk().allocator, &view), "vkCreateImageView", name));
  return UniqueView(context.vk(), context.device.device, view);
}

Status update_view(const Context& context, ImportedView& view, const ImportedImage& image, uint64_t frame) {
  if (view.whole && image.view != VK_NULL_HANDLE) {
    view.current = image.view;
    return Done{};
  }
  ImportedView::Entry* oldest = &view.entries[0];
  for (ImportedView::Entry& entry : view.entries) {
    if (entry.image == image.image && entry.view) {
      entry.frame = frame;
      view.current = entry.view.get();
      return Done{};
    }
    if (!entry.view || (oldest->view && entry.frame < oldest->frame)) oldest = &entry;
  }
  Result<UniqueView> created = create_view(context, view.info, view.usage, image.image, context.plan.resources[view.resource].name);
  if (!created) return created.error();
  view.replaced |= static_cast<bool>(oldest->view);
  *oldest = {image.image, std::move(*created), frame};
  view.current = oldest->view.get();
  return Done{};
}

}  // namespace

Result<ViewRef> create_views(const Context& context, Sized& sized, const ViewRequest& request) {
  const VkImageSubresourceRange range = image_range(context, sized, request.ref.resource, request.range);
  if (range.levelCount == 0) return ViewRef{request.ref, 0, kNone, false};
  const VkImageViewCreateInfo info = view_info(context, request, range);
  const SizedResource& resource = sized.resources[request.ref.resource];
  if (resource.count == 0) return add_imported(context, sized, request, info);
  const ViewRef ref{request.ref, static_cast<uint32_t>(sized.views.size()), kNone, true};
  for (uint32_t copy = 0; copy < resource.count; ++copy) {
    const VkImage image = sized.images[resource.first + copy];
    Result<UniqueView> view = create_view(context, info, usage_info(request), image, context.plan.resources[request.ref.resource].name);
    if (!view) return view.error();
    sized.views.push_back(std::move(*view));
  }
  return ref;
}

Status update_imported_views(const Context& context, Sized& sized, const std::vector<Import>& imports, uint64_t frame) {
  for (ImportedView& view : sized.imported_views) {
    const ImportedImage& image = imports[context.plan.resources[view.resource].import_slot].image;
    RG_TRY(update_view(context, view, image, frame));
  }
  return Done{};
}

}  // namespace rg
