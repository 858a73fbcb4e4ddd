#include "runtime/resolve.h"

#include <algorithm>

#include "runtime/formats.h"

namespace rg {

void evaluate_all(const Context& context, Sized& sized) {
  sized.values.reserve(context.plan.exprs.size());
  evaluate_again(context, sized);
}

void evaluate_again(const Context& context, Sized& sized) {
  sized.values.clear();
  auto value_of = [&](Index operand) { return Expr{ExprOp::constant, kNone, kNone, operand == kNone ? 1 : sized.values[operand]}; };
  for (const Expr& expr : context.plan.exprs) {
    const bool leaf = expr.op == ExprOp::constant || expr.op == ExprOp::extent;
    const Expr nodes[] = {leaf ? Expr{} : value_of(expr.a), leaf ? Expr{} : value_of(expr.b), {expr.op, 0, 1, expr.value}};
    sized.values.push_back(evaluate(nodes, 2, sized.extents));
  }
}

ByteRange byte_range(const Context& context, const Sized& sized, const Bytes& bytes) {
  ByteRange range;
  if (bytes.offset != kNone) range.offset = static_cast<VkDeviceSize>(std::max<int64_t>(evaluate(context, sized, bytes.offset), 0));
  if (bytes.size != kNone) range.size = static_cast<VkDeviceSize>(std::max<int64_t>(evaluate(context, sized, bytes.size), 0));
  return range;
}

VkImageSubresourceRange image_range(const Context& context, const Sized& sized, Index resource, const Range& range) {
  const SizedResource& image = sized.resources[resource];
  VkImageSubresourceRange out{};
  out.aspectMask = range.aspects != 0 ? range.aspects : context.plan.resources[resource].aspects;
  if (range.mip >= image.mips || range.layer >= image.layers) return out;
  out.baseMipLevel = range.mip;
  out.levelCount = std::min(range.mips, image.mips - range.mip);
  out.baseArrayLayer = range.layer;
  out.layerCount = std::min(range.layers, image.layers - range.layer);
  return out;
}

uint32_t copies_of(const Sized& sized, Index resource) { return std::max(sized.resources[resource].count, 1u); }

VkImage image_at(const Sized& sized, const std::vector<Import>& imports, const Plan& plan, Ref ref, uint64_t frame) {
  const SizedResource& resource = sized.resources[ref.resource];
  if (resource.count == 0) return imports[plan.resources[ref.resource].import_slot].image.image;
  return sized.images[copy_index(resource, ref.age, frame)];
}

BufferSpan buffer_at(const Sized& sized, const std::vector<Import>& imports, const Plan& plan, Ref ref, const ByteRange& bytes, uint64_t frame) {
  const SizedResource& resource = sized.resources[ref.resource];
  if (resource.count != 0) return {sized.buffers[copy_index(resource, ref.age, frame)], bytes.offset, bytes.size};
  const ImportedBuffer& imported = imports[plan.resources[ref.resource].import_slot].buffer;
  const VkDeviceSize rest = imported.size == VK_WHOLE_SIZE ? VK_WHOLE_SIZE : imported.size - std::min(imported.size, bytes.offset);
  return {imported.buffer, imported.offset + bytes.offset, std::min(bytes.size, rest)};
}

VkImageView view_at(const Sized& sized, const ViewRef& view, uint64_t frame) {
  if (!view.exists || view.ref.resource == kNone) return VK_NULL_HANDLE;
  if (view.imported != kNone) return sized.imported_views[view.imported].current;
  const SizedResource& resource = sized.resources[view.ref.resource];
  return sized.views[view.first + copy_index(resource, view.ref.age, frame) - resource.first].get();
}

VkExtent3D mip_extent(const VkExtent3D& extent, uint32_t mip) {
  return {std::max(extent.width >> mip, 1u), std::max(extent.height >> mip, 1u), std::max(extent.depth >> mip, 1u)};
}

VkDeviceSize packed_bytes(const Context& context, const Sized& sized, Index resource, const Range& range) {
  const auto format = static_cast<VkFormat>(context.plan.resources[resource].format);
  const FormatInfo info = format_info(format);
  const VkImageSubresourceRange clamped = image_range(context, sized, resource, range);
  const VkImageAspectFlags aspect = clamped.aspectMask & (~clamped.aspectMask + 1);
  VkDeviceSize bytes = 0;
  for (uint32_t mip = clamped.baseMipLevel; mip < clamped.baseMipLevel + clamped.levelCount; ++mip) {
    const VkExtent3D extent = mip_extent(sized.resources[resource].extent, mip);
    const VkDeviceSize columns = (extent.width + info.block_width - 1) / info.block_width,
                       rows = (extent.height + info.block_height - 1) / info.block_height;
    bytes += columns * rows * extent.depth * clamped.layerCount * copy_bytes(format, aspect);
  }
  return bytes;
}

}  // namespace rg
