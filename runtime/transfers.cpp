#include "runtime/transfers.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "runtime/errors.h"
#include "runtime/formats.h"
#include "runtime/resolve.h"

namespace rg {

namespace {

bool is_image(const Context& context, Ref ref) { return ref.resource != kNone && context.plan.resources[ref.resource].kind == ResourceKind::image; }

// The layout that the pass's accesses put the image into; `writes` tells source from target where a pass copies within one image.
VkImageLayout layout_of(const Context& context, const Pass& pass, Ref ref, uint32_t mip, bool writes) {
  for (const Access& access : context.plan.accesses.subspan(pass.first_access, pass.access_count)) {
    const bool covers = mip >= access.range.mip && (access.range.mips == kRemaining || mip - access.range.mip < access.range.mips);
    if (access.ref == ref && access.writes == writes && covers) return static_cast<VkImageLayout>(access.layout);
  }
  return writes ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
}

VkImageSubresourceLayers layers_at(const VkImageSubresourceRange& range, uint32_t step) {
  return {range.aspectMask, range.baseMipLevel + step, range.baseArrayLayer, range.layerCount};
}

VkExtent3D smaller(const VkExtent3D& a, const VkExtent3D& b) {
  return {std::min(a.width, b.width), std::min(a.height, b.height), std::min(a.depth, b.depth)};
}

VkOffset3D corner(const VkExtent3D& extent) {
  return {static_cast<int32_t>(extent.width), static_cast<int32_t>(extent.height), static_cast<int32_t>(extent.depth)};
}

// Both sides of a transfer between images, clamped to what exists.
struct ImagePair {
  VkImageSubresourceRange src{}, dst{};
  uint32_t mips = 0;
  VkExtent3D src_extent{}, dst_extent{};  // of mip 0
  FormatInfo src_format{}, dst_format{};
};

// Texels of one axis of the source that the destination has, too. A block of the one is a block of the other, whatever their shapes.
uint32_t common_side(uint32_t src, uint32_t src_block, uint32_t dst, uint32_t dst_block) {
  const uint32_t blocks = std::min((src + src_block - 1) / src_block, (dst + dst_block - 1) / dst_block);
  return std::min(src, blocks * src_block);
}

ImagePair image_pair(const Context& context, const Sized& sized, const Transfer& transfer) {
  ImagePair pair;
  pair.src = image_range(context, sized, transfer.src.resource, transfer.src_range);
  pair.dst = image_range(context, sized, transfer.dst.resource, transfer.dst_range);
  pair.mips = std::min(pair.src.levelCount, pair.dst.levelCount);
  pair.src.layerCount = pair.dst.layerCount = std::min(pair.src.layerCount, pair.dst.layerCount);
  pair.src_extent = sized.resources[transfer.src.resource].extent;
  pair.dst_extent = sized.resources[transfer.dst.resource].extent;
  pair.src_format = format_info(static_cast<VkFormat>(context.plan.resources[transfer.src.resource].format));
  pair.dst_format = format_info(static_cast<VkFormat>(context.plan.resources[transfer.dst.resource].format));
  return pair;
}

void add_copies(const ImagePair& pair, TransferTable& table) {
  for (uint32_t i = 0; i < pair.mips; ++i) {
    const VkExtent3D src = mip_extent(pair.src_extent, pair.src.baseMipLevel + i), dst = mip_extent(pair.dst_extent, pair.dst.baseMipLevel + i);
    const VkExtent3D extent{common_side(src.width, pair.src_format.block_width, dst.width, pair.dst_format.block_width),
                            common_side(src.height, pair.src_format.block_height, dst.height, pair.dst_format.block_height),
                            std::min(src.depth, dst.depth)};
    table.copies.push_back({layers_at(pair.src, i), {}, layers_at(pair.dst, i), {}, extent});
  }
}

void add_resolves(const ImagePair& pair, TransferTable& table) {
  for (uint32_t i = 0; i < pair.mips; ++i) {
    const VkExtent3D extent = smaller(mip_extent(pair.src_extent, pair.src.baseMipLevel + i), mip_extent(pair.dst_extent, pair.dst.baseMipLevel + i));
    table.resolves.push_back({layers_at(pair.src, i), {}, layers_at(pair.dst, i), {}, extent});
  }
}

void add_blits(const ImagePair& pair, TransferTable& table) {
  for (uint32_t i = 0; i < pair.mips; ++i) {
    VkImageBlit blit{};
    blit.srcSubresource = layers_at(pair.src, i);
    blit.srcOffsets[1] = corner(mip_extent(pair.src_extent, pair.src.baseMipLevel + i));
    blit.dstSubresource = layers_at(pair.dst, i);
    blit.dstOffsets[1] = corner(mip_extent(pair.dst_extent, pair.dst.baseMipLevel + i));
    table.blits.push_back(blit);
  }
}

// Mips one after the other, tightly packed from `offset`.
void add_buffer_copies(const Context& context, const Sized& sized, Index image, Range range, VkDeviceSize offset, TransferTable& table) {
  const VkImageSubresourceRange clamped = image_range(context, sized, image, range);
  for (uint32_t i = 0; i < clamped.levelCount; ++i) {
    VkBufferImageCopy copy{};
    copy.bufferOffset = offset;
    copy.imageSubresource = layers_at(clamped, i);
    copy.imageSubresource.aspectMask &= ~copy.imageSubresource.aspectMask + 1;  // one aspect a copy
    copy.imageExtent = mip_extent(sized.resources[image].extent, clamped.baseMipLevel + i);
    table.buffer_copies.push_back(copy);
    range.mip = clamped.baseMipLevel + i, range.mips = 1;
    offset += packed_bytes(context, sized, image, range);
  }
}

void add_update(const Context& context, const Sized& sized, const Transfer& transfer, TransferTable& table) {
  if (is_image(context, transfer.dst)) {
    add_buffer_copies(context, sized, transfer.dst.resource, transfer.dst_range, 0, table);
    table.upload_bytes = packed_bytes(context, sized, transfer.dst.resource, transfer.dst_range);
  } else {
    const VkDeviceSize whole = sized.resources[transfer.dst.resource].bytes;
    table.upload_bytes = std::min(table.dst_bytes.size, whole - std::min(whole, table.dst_bytes.offset));
  }
}

void add_regions(const Context& context, const Sized& sized, const Transfer& transfer, TransferTable& table) {
  switch (transfer.kind) {
    case TransferKind::copy_image:
      return add_copies(image_pair(context, sized, transfer), table);
    case TransferKind::blit:
      return add_blits(image_pair(context, sized, transfer), table);
    case TransferKind::resolve:
      return add_resolves(image_pair(context, sized, transfer), table);
    case TransferKind::copy_buffer_to_image:
      return add_buffer_copies(context, sized, transfer.dst.resource, transfer.dst_range, table.src_bytes.offset, table);
    case TransferKind::copy_image_to_buffer:
      return add_buffer_copies(context, sized, transfer.src.resource, transfer.src_range, table.dst_bytes.offset, table);
    case TransferKind::clear_color:
    case TransferKind::clear_depth_stencil:
      table.range = image_range(context, sized, transfer.dst.resource, transfer.dst_range);
      return;
    case TransferKind::update:
      return add_update(context, sized, transfer, table);
    case TransferKind::copy_buffer:
    case TransferKind::fill:
      return;
  }
}

// Everything a recorded transfer needs to know.
struct Recorder {
  const Context& context;
  const Sized& sized;
  const std::vector<Import>& imports;
  const TransferTable& table;
  VkCommandBuffer commands;
  uint64_t frame;

  VkImage src_image() const { return image_at(sized, imports, context.plan, table.transfer->src, frame); }
  VkImage dst_image() const { return image_at(sized, imports, context.plan, table.transfer->dst, frame); }
  BufferSpan src_buffer() const { return buffer_at(sized, imports, context.plan, table.transfer->src, table.src_bytes, frame); }
  BufferSpan dst_buffer() const { return buffer_at(sized, imports, context.plan, table.transfer->dst, table.dst_bytes, frame); }
};

template <class Region>
uint32_t count(const std::vector<Region>& regions) {
  return static_cast<uint32_t>(regions.size());
}

VkDeviceSize bytes_from(const Sized& sized, Index resource, const ByteRange& bytes) {
  const VkDeviceSize whole = sized.resources[resource].bytes;
  if (bytes.size != VK_WHOLE_SIZE || whole == 0) return bytes.size;
  return whole - std::min(whole, bytes.offset);
}

void record_copy_buffer(const Recorder& r) {
  const BufferSpan src = r.src_buffer(), dst = r.dst_buffer();
  const VkDeviceSize bytes = std::min(bytes_from(r.sized, r.table.transfer->src.resource, {r.table.src_bytes.offset, src.size}),
                                      bytes_from(r.sized, r.table.transfer->dst.resource, {r.table.dst_bytes.offset, dst.size}));
  const VkBufferCopy copy{src.offset, dst.offset, bytes};
  if (bytes != 0 && bytes != VK_WHOLE_SIZE) r.context.vk().CmdCopyBuffer(r.commands, src.buffer, dst.buffer, 1, &copy);
}

void record_clear(const Recorder& r) {
  if (r.table.range.levelCount == 0) return;
  if (r.table.transfer->kind == TransferKind::clear_color) {
    VkClearColorValue value;
    std::copy(std::begin(r.table.transfer->value.word), std::end(r.table.transfer->value.word), value.uint32);
    r.context.vk().CmdClearColorImage(r.commands, r.dst_image(), r.table.dst_layout, &value, 1, &r.table.range);
  } else {
    const VkClearDepthStencilValue value{std::bit_cast<float>(r.table.transfer->value.word[0]), r.table.transfer->value.word[1]};
    r.context.vk().CmdClearDepthStencilImage(r.commands, r.dst_image(), r.table.dst_layout, &value, 1, &r.table.range);
  }
}

void record_fill(const Recorder& r) {
  const BufferSpan dst = r.dst_buffer();
  if (dst.size != 0) r.context.vk().CmdFillBuffer(r.commands, dst.buffer, dst.offset, dst.size, r.table.transfer->value.word[0]);
}

constexpr size_t kMostMips = 16;

void record_update(const Recorder& r) {
  const VkDeviceSize base = r.frame % r.context.frames_in_flight * r.sized.ring.section + r.table.upload_offset;
  if (is_image(r.context, r.table.transfer->dst)) {
    std::array<VkBufferImageCopy, kMostMips> copies;
    const size_t mips = std::min(r.table.buffer_copies.size(), kMostMips);
    for (size_t i = 0; i < mips; ++i) copies[i] = r.table.buffer_copies[i], copies[i].bufferOffset += base;
    r.context.vk().CmdCopyBufferToImage(r.commands, r.sized.ring.buffer.get(), r.dst_image(), r.table.dst_layout, static_cast<uint32_t>(mips),
                                        copies.data());
  } else {
    const BufferSpan dst = r.dst_buffer();
    const VkBufferCopy copy{base, dst.offset, r.table.upload_now};
    if (copy.size != 0) r.context.vk().CmdCopyBuffer(r.commands, r.sized.ring.buffer.get(), dst.buffer, 1, &copy);
  }
}

// An imported buffer brings its size with the frame.
void record_buffer_image(const Recorder& r) {
  const bool to_image = r.table.transfer->kind == TransferKind::copy_buffer_to_image;
  const BufferSpan span = to_image ? r.src_buffer() : r.dst_buffer();
  const VkDeviceSize shift = span.offset - (to_image ? r.table.src_bytes.offset : r.table.dst_bytes.offset);
  std::array<VkBufferImageCopy, kMostMips> copies;
  const size_t mips = std::min(r.table.buffer_copies.size(), kMostMips);
  for (size_t i = 0; i < mips; ++i) copies[i] = r.table.buffer_copies[i], copies[i].bufferOffset += shift;
  if (mips == 0) return;
  const auto regions = static_cast<uint32_t>(mips);
  if (to_image)
    r.context.vk().CmdCopyBufferToImage(r.commands, span.buffer, r.dst_image(), r.table.dst_layout, regions, copies.data());
  else
    r.context.vk().CmdCopyImageToBuffer(r.commands, r.src_image(), r.table.src_layout, span.buffer, regions, copies.data());
}

void record_copy_image(const Recorder& r) {
  if (r.table.copies.empty()) return;
  r.context.vk().CmdCopyImage(r.commands, r.src_image(), r.table.src_layout, r.dst_image(), r.table.dst_layout, count(r.table.copies),
                              r.table.copies.data());
}

void record_blit(const Recorder& r) {
  if (r.table.blits.empty()) return;
  const VkFilter filter = r.table.transfer->linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  r.context.vk().CmdBlitImage(r.commands, r.src_image(), r.table.src_layout, r.dst_image(), r.table.dst_layout, count(r.table.blits),
                              r.table.blits.data(), filter);
}

void record_resolve(const Recorder& r) {
  if (r.table.resolves.empty()) return;
  r.context.vk().CmdResolveImage(r.commands, r.src_image(), r.table.src_layout, r.dst_image(), r.table.dst_layout, count(r.table.resolves),
                                 r.table.resolves.data());
}

}  // namespace

std::vector<TransferTable> create_transfers(const Context& context, const Sized& sized, const Pass& pass) {
  std::vector<TransferTable> tables;
  for (const Transfer& transfer : context.plan.transfers.subspan(pass.work.first_transfer, pass.work.transfer_count)) {
    TransferTable& table = tables.emplace_back();
    table.transfer = &transfer;
    table.src_bytes = byte_range(context, sized, transfer.src_bytes);
    table.dst_bytes = byte_range(context, sized, transfer.dst_bytes);
    if (is_image(context, transfer.src)) table.src_layout = layout_of(context, pass, transfer.src, transfer.src_range.mip, false);
    if (is_image(context, transfer.dst)) table.dst_layout = layout_of(context, pass, transfer.dst, transfer.dst_range.mip, true);
    add_regions(context, sized, transfer, table);
  }
  return tables;
}

namespace {

Status write_update(const Context& context, Sized& sized, TransferTable& table, std::span<const std::byte> bytes, uint64_t frame) {
  const bool exact = is_image(context, table.transfer->dst);
  if (bytes.size() > table.upload_bytes || (exact && bytes.size() != table.upload_bytes))
    return Error{ErrorCode::invalid_argument, "update of `" + std::string(context.plan.resources[table.transfer->dst.resource].name) +
                                                  "`: " + std::to_string(bytes.size()) + " bytes for " + std::to_string(table.upload_bytes)};
  table.upload_now = bytes.size();
  std::byte* section = sized.ring.mapped + frame % context.frames_in_flight * sized.ring.section;
  if (!bytes.empty()) std::memcpy(section + table.upload_offset, bytes.data(), bytes.size());
  return Done{};
}

}  // namespace

Status write_updates(const Context& context, Sized& sized, const FrameInputs& inputs, uint64_t frame) {
  for (const TransferRef& update : sized.updates) {
    PassTable& pass = sized.passes[update.pass];
    if (!pass.runs || (context.plan.passes[update.pass].guard & ~inputs.conditions) != 0) continue;
    TransferTable& table = pass.transfers[update.transfer];
    RG_TRY(write_update(context, sized, table, inputs.updates[table.transfer->update_slot], frame));
  }
  return Done{};
}

void resize_transfer(const Context& context, const Sized& sized, TransferTable& table) {
  const TransferKind kind = table.transfer->kind;
  if (kind != TransferKind::copy_image && kind != TransferKind::blit && kind != TransferKind::resolve) return;
  table.copies.clear(), table.blits.clear(), table.resolves.clear();  // keeps its room
  add_regions(context, sized, *table.transfer, table);
}

void record_transfer(const Context& context, const Sized& sized, const std::vector<Import>& imports, const TransferTable& transfer,
                     VkCommandBuffer commands, uint64_t frame) {
  const Recorder recorder{context, sized, imports, transfer, commands, frame};
  switch (transfer.transfer->kind) {
    case TransferKind::copy_image:
      return record_copy_image(recorder);
    case TransferKind::copy_buffer:
      return record_copy_buffer(recorder);
    case TransferKind::copy_buffer_to_image:
    case TransferKind::copy_image_to_buffer:
      return record_buffer_image(recorder);
    case TransferKind::blit:
      return record_blit(recorder);
    case TransferKind::clear_color:
    case TransferKind::clear_depth_stencil:
      return record_clear(recorder);
    case TransferKind::fill:
      return record_fill(recorder);
    case TransferKind::update:
      return record_update(recorder);
    case TransferKind::resolve:
      return record_resolve(recorder);
  }
}

}  // namespace rg
