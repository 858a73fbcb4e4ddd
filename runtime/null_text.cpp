#include "runtime/null_text.h"

#include <string_view>

namespace rg {

namespace {

void pair(NullLine& line, std::string_view name, uint64_t value) {
  line.text(name);
  line.number(value);
}

void extent(NullLine& line, const VkExtent3D& value) {
  line.number(value.width);
  pair(line, "x", value.height);
  pair(line, "x", value.depth);
}

void scope(NullLine& line, uint64_t src_stages, uint64_t src_accesses, uint64_t dst_stages, uint64_t dst_accesses) {
  line.hex(src_stages), line.text("/"), line.hex(src_accesses), line.text("->");
  line.hex(dst_stages), line.text("/"), line.hex(dst_accesses);
}

template <class Barrier>
void families(NullLine& line, const Barrier& barrier) {
  if (barrier.srcQueueFamilyIndex == barrier.dstQueueFamilyIndex) return;
  pair(line, " family ", barrier.srcQueueFamilyIndex);
  pair(line, "->", barrier.dstQueueFamilyIndex);
}

void layers(NullLine& line, const VkImageSubresourceLayers& value) {
  pair(line, "aspects ", value.aspectMask);
  pair(line, " mip ", value.mipLevel);
  pair(line, " layers ", value.baseArrayLayer);
  pair(line, "+", value.layerCount);
}

void attachment(NullLine& line, std::string_view name, const VkRenderingAttachmentInfo* info) {
  if (info == nullptr) return;
  line.text(name);
  line.handle(info->imageView);
  pair(line, " layout ", info->imageLayout);
  pair(line, " load ", info->loadOp);
  pair(line, " store ", info->storeOp);
  if (info->resolveMode != VK_RESOLVE_MODE_NONE) line.text(" resolve "), line.handle(info->resolveImageView);
  line.text("]");
}

}  // namespace

void print_struct(NullLine& line, const VkDependencyInfo& info) {
  for (uint32_t i = 0; i < info.memoryBarrierCount; ++i) {
    const VkMemoryBarrier2& b = info.pMemoryBarriers[i];
    line.text("[memory "), scope(line, b.srcStageMask, b.srcAccessMask, b.dstStageMask, b.dstAccessMask), line.text("]");
  }
  for (uint32_t i = 0; i < info.bufferMemoryBarrierCount; ++i) {
    const VkBufferMemoryBarrier2& b = info.pBufferMemoryBarriers[i];
    line.text("["), line.handle(b.buffer), line.text(" "), scope(line, b.srcStageMask, b.srcAccessMask, b.dstStageMask, b.dstAccessMask);
    pair(line, " bytes ", b.offset);
    line.text("+"), b.size == VK_WHOLE_SIZE ? line.text("rest") : line.number(b.size), families(line, b), line.text("]");
  }
  for (uint32_t i = 0; i < info.imageMemoryBarrierCount; ++i) {
    const VkImageMemoryBarrier2& b = info.pImageMemoryBarriers[i];
    line.text("["), line.handle(b.image), line.text(" "), scope(line, b.srcStageMask, b.srcAccessMask, b.dstStageMask, b.dstAccessMask);
    pair(line, " layout ", b.oldLayout), pair(line, "->", b.newLayout), line.text(" ");
    print_struct(line, b.subresourceRange);
    families(line, b);
    line.text("]");
  }
}

void print_struct(NullLine& line, const VkGraphicsPipelineCreateInfo& info) {
  const auto chained = [](const auto* state) {
    return state == nullptr || state->pNext == nullptr ? VK_STRUCTURE_TYPE_MAX_ENUM : static_cast<const VkBaseInStructure*>(state->pNext)->sType;
  };
  if (info.pDepthStencilState != nullptr && info.pDepthStencilState->depthBoundsTestEnable == VK_TRUE) {
    line.text(" [depth bounds "), line.real(info.pDepthStencilState->minDepthBounds), line.text(" "),
        line.real(info.pDepthStencilState->maxDepthBounds);
    line.text("]");
  }
  if (chained(info.pRasterizationState) == VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_CONSERVATIVE_STATE_CREATE_INFO_EXT) line.text(" [conservative]");
  if (chained(info.pMultisampleState) != VK_STRUCTURE_TYPE_PIPELINE_SAMPLE_LOCATIONS_STATE_CREATE_INFO_EXT) return;
  const auto& locations = static_cast<const VkPipelineSampleLocationsStateCreateInfoEXT*>(info.pMultisampleState->pNext)->sampleLocationsInfo;
  line.text(" [samples at");
  for (uint32_t i = 0; i < locations.sampleLocationsCount; ++i)
    line.text(i == 0 ? " " : ", "), line.real(locations.pSampleLocations[i].x), line.text(" "), line.real(locations.pSampleLocations[i].y);
  line.text("]");
}

void print_struct(NullLine& line, const VkRenderingInfo& info) {
  print_struct(line, info.renderArea);
  pair(line, " layers ", info.layerCount);
  if (info.viewMask != 0) line.text(" views "), line.hex(info.viewMask);
  for (uint32_t i = 0; i < info.colorAttachmentCount; ++i) attachment(line, " color [", &info.pColorAttachments[i]);
  attachment(line, " depth [", info.pDepthAttachment);
  attachment(line, " stencil [", info.pStencilAttachment);
}

void print_struct(NullLine& line, const VkRenderPassBeginInfo& info) {
  line.handle(info.renderPass), line.text(" "), line.handle(info.framebuffer), line.text(" ");
  print_struct(line, info.renderArea);
}

void print_struct(NullLine& line, const VkImageCreateInfo& info) {
  pair(line, "type ", info.imageType), pair(line, " format ", info.format), line.text(" ");
  extent(line, info.extent);
  pair(line, " mips ", info.mipLevels), pair(line, " layers ", info.arrayLayers), pair(line, " samples ", info.samples);
  line.text(" usage "), line.hex(info.usage), line.text(" flags "), line.hex(info.flags);
  if (info.sharingMode == VK_SHARING_MODE_CONCURRENT) line.text(" shared");
}

void print_struct(NullLine& line, const VkBufferCreateInfo& info) {
  pair(line, "bytes ", info.size);
  line.text(" usage "), line.hex(info.usage);
  if (info.sharingMode == VK_SHARING_MODE_CONCURRENT) line.text(" shared");
}

void print_struct(NullLine& line, const VkImageViewCreateInfo& info) {
  line.handle(info.image);
  pair(line, " type ", info.viewType), pair(line, " format ", info.format), line.text(" ");
  print_struct(line, info.subresourceRange);
}

void print_struct(NullLine& line, const VkMemoryAllocateInfo& info) {
  pair(line, "bytes ", info.allocationSize), pair(line, " type ", info.memoryTypeIndex);
  const auto* next = static_cast<const VkBaseInStructure*>(info.pNext);
  if (next != nullptr && next->sType == VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO)
    line.text(" for "), line.handle(reinterpret_cast<const VkMemoryDedicatedAllocateInfo*>(next)->image);
}

void print_struct(NullLine& line, const VkSubmitInfo2& info) {
  for (uint32_t i = 0; i < info.waitSemaphoreInfoCount; ++i) {
    line.text("wait "), line.handle(info.pWaitSemaphoreInfos[i].semaphore);
    pair(line, "=", info.pWaitSemaphoreInfos[i].value), line.text(" ");
  }
  for (uint32_t i = 0; i < info.signalSemaphoreInfoCount; ++i) {
    line.text(i == 0 ? "signal " : " signal "), line.handle(info.pSignalSemaphoreInfos[i].semaphore);
    pair(line, "=", info.pSignalSemaphoreInfos[i].value);
  }
}

void print_struct(NullLine& line, const VkPipelineCacheCreateInfo& info) { pair(line, "bytes ", info.initialDataSize); }

void print_struct(NullLine& line, const VkImageCopy& info) {
  layers(line, info.srcSubresource), line.text(" -> "), layers(line, info.dstSubresource), line.text(" "), extent(line, info.extent);
}

void print_struct(NullLine& line, const VkImageResolve& info) {
  layers(line, info.srcSubresource), line.text(" -> "), layers(line, info.dstSubresource), line.text(" "), extent(line, info.extent);
}

void print_struct(NullLine& line, const VkImageBlit& info) {
  layers(line, info.srcSubresource);
  pair(line, " ", static_cast<uint64_t>(info.srcOffsets[1].x)), pair(line, "x", static_cast<uint64_t>(info.srcOffsets[1].y)), line.text(" -> ");
  layers(line, info.dstSubresource);
  pair(line, " ", static_cast<uint64_t>(info.dstOffsets[1].x)), pair(line, "x", static_cast<uint64_t>(info.dstOffsets[1].y));
}

void print_struct(NullLine& line, const VkBufferCopy& info) {
  pair(line, "from ", info.srcOffset), pair(line, " to ", info.dstOffset), pair(line, " bytes ", info.size);
}

void print_struct(NullLine& line, const VkBufferImageCopy& info) {
  pair(line, "offset ", info.bufferOffset), line.text(" "), layers(line, info.imageSubresource), line.text(" "), extent(line, info.imageExtent);
}

void print_struct(NullLine& line, const VkImageSubresourceRange& info) {
  pair(line, "aspects ", info.aspectMask), pair(line, " mips ", info.baseMipLevel), pair(line, "+", info.levelCount);
  pair(line, " layers ", info.baseArrayLayer), pair(line, "+", info.layerCount);
}

void print_struct(NullLine& line, const VkViewport& info) { line.real(info.width), line.text("x"), line.real(info.height); }

void print_struct(NullLine& line, const VkRect2D& info) { pair(line, "", info.extent.width), pair(line, "x", info.extent.height); }

void print_struct(NullLine& line, const VkClearColorValue& info) {
  for (int i = 0; i < 4; ++i) line.text(i == 0 ? "" : ","), line.hex(info.uint32[i]);
}

void print_struct(NullLine& line, const VkClearDepthStencilValue& info) { line.real(info.depth), pair(line, ",", info.stencil); }

void print_struct(NullLine& line, const VkSemaphoreWaitInfo& info) {
  for (uint32_t i = 0; i < info.semaphoreCount; ++i) {
    line.text(i == 0 ? "" : " "), line.handle(info.pSemaphores[i]);
    pair(line, ">=", info.pValues[i]);
  }
}

void print_struct(NullLine& line, const VkDescriptorSet& info) { line.handle(info); }
void print_struct(NullLine& line, const VkBuffer& info) { line.handle(info); }
void print_struct(NullLine& line, const VkEvent& info) { line.handle(info); }

void print_struct(NullLine& line, const VkWriteDescriptorSet& info) {
  line.handle(info.dstSet);
  pair(line, " binding ", info.dstBinding), pair(line, " type ", info.descriptorType);
  if (info.pImageInfo != nullptr) {
    line.text(" "), line.handle(info.pImageInfo->imageView), pair(line, " layout ", info.pImageInfo->imageLayout);
    line.text(" "), line.handle(info.pImageInfo->sampler);
  }
  if (info.pBufferInfo != nullptr) {
    line.text(" "), line.handle(info.pBufferInfo->buffer);
    pair(line, " bytes ", info.pBufferInfo->offset), line.text("+");
    info.pBufferInfo->range == VK_WHOLE_SIZE ? line.text("rest") : line.number(info.pBufferInfo->range);
  }
}

void print_struct(NullLine& line, const VkDebugUtilsLabelEXT& info) { line.text(info.pLabelName); }

void print_struct(NullLine& line, const uint32_t& info) { line.number(info); }

}  // namespace rg
