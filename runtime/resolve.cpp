#include "runtime/resolve.h"

#include <algorithm>

#include "runtime/formats.h"

namespace rg {

void evaluate_all(const Context& context, Sized& sized) {
  sized.values.reserve(context.plan.exprs.size());
  evaluate_again(context, sized);
}

namespace {

// As evaluate() of plan.h where that is defined. A plan from a file may ask for more: sums and products then wrap, as unsigned numbers do, and the
// sizes that come out are refused or clamped like any others.
int64_t apply(ExprOp op, int64_t a, int64_t b) {
  const auto x = static_cast<uint64_t>(a), y = static_cast<uint64_t>(b);
  switch (op) {
    case ExprOp::add:
      return static_cast<int64_t>(x + y);
    case ExprOp::sub:
      return static_cast<int64_t>(x - y);
    case ExprOp::mul:
      return static_cast<int64_t>(x * y);
    case ExprOp::floor_div:
      return b <= 0 ? 0 : a / b;
    case ExprOp::ceil_div:
      return b <= 0 ? 0 : a / b + (a % b > 0 ? 1 : 0);
    case ExprOp::min:
      return std::min(a, b);
    case ExprOp::max:
      return std::max(a, b);
    case ExprOp::mip:
      return b < 0 || b > 62 ? 1 : std::max<int64_t>(a >> b, 1);
    default:
      return 0;
  }
}

}  // namespace

void evaluate_again(const Context& context, Sized& sized) {
  sized.values.clear();
  const auto value_of = [&](Index operand) { return operand == kNone ? 1 : sized.values[operand]; };
  for (const Expr& expr : context.plan.exprs) {
    if (expr.op == ExprOp::constant)
      sized.values.push_back(expr.value);
    else if (expr.op == ExprOp::extent)
      sized.values.push_back(sized.extents[static_cast<size_t>(expr.value)]);
    else
      sized.values.push_back(apply(expr.op, value_of(expr.a), value_of(expr.b)));
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
