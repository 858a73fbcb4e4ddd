// What the runtime must know of a format: texel size and aspects.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace rg {

struct FormatInfo {
  uint32_t block_bytes = 0;  // 0: unknown format
  uint32_t block_width = 1, block_height = 1;
  VkImageAspectFlags aspects = 0;
};
FormatInfo format_info(VkFormat format);

// Bytes of one texel of `aspect` as buffer copies lay it out; 0 where there is none.
uint32_t copy_bytes(VkFormat format, VkImageAspectFlags aspect);

}  // namespace rg
