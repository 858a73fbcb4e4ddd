#include "runtime/formats.h"

namespace rg {

namespace {

uint32_t color_bytes(VkFormat format) {
  // Vulkan numbers formats by texel size within each family of channels.
  if (format == VK_FORMAT_R4G4_UNORM_PACK8) return 1;
  if (format <= VK_FORMAT_A1R5G5B5_UNORM_PACK16) return 2;
  if (format <= VK_FORMAT_R8_SRGB) return 1;
  if (format <= VK_FORMAT_R8G8_SRGB) return 2;
  if (format <= VK_FORMAT_B8G8R8_SRGB) return 3;
  if (format <= VK_FORMAT_A2B10G10R10_SINT_PACK32) return 4;
  if (format <= VK_FORMAT_R16_SFLOAT) return 2;
  if (format <= VK_FORMAT_R16G16_SFLOAT) return 4;
  if (format <= VK_FORMAT_R16G16B16_SFLOAT) return 6;
  if (format <= VK_FORMAT_R16G16B16A16_SFLOAT) return 8;
  if (format <= VK_FORMAT_R32_SFLOAT) return 4;
  if (format <= VK_FORMAT_R32G32_SFLOAT) return 8;
  if (format <= VK_FORMAT_R32G32B32_SFLOAT) return 12;
  if (format <= VK_FORMAT_R32G32B32A32_SFLOAT) return 16;
  if (format <= VK_FORMAT_R64_SFLOAT) return 8;
  if (format <= VK_FORMAT_R64G64_SFLOAT) return 16;
  if (format <= VK_FORMAT_R64G64B64_SFLOAT) return 24;
  if (format <= VK_FORMAT_R64G64B64A64_SFLOAT) return 32;
  return 4;  // B10G11R11 and E5B9G9R9
}

uint32_t block_bytes(VkFormat format) {
  const bool half = format <= VK_FORMAT_BC1_RGBA_SRGB_BLOCK || format == VK_FORMAT_BC4_UNORM_BLOCK || format == VK_FORMAT_BC4_SNORM_BLOCK;
  return half ? 8 : 16;
}

FormatInfo depth_info(VkFormat format) {
  constexpr VkImageAspectFlags both = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
  switch (format) {
    case VK_FORMAT_D16_UNORM:
      return {2, 1, 1, VK_IMAGE_ASPECT_DEPTH_BIT};
    case VK_FORMAT_S8_UINT:
      return {1, 1, 1, VK_IMAGE_ASPECT_STENCIL_BIT};
    case VK_FORMAT_D16_UNORM_S8_UINT:
      return {4, 1, 1, both};
    case VK_FORMAT_D24_UNORM_S8_UINT:
      return {4, 1, 1, both};
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return {8, 1, 1, both};
    default:
      return {4, 1, 1, VK_IMAGE_ASPECT_DEPTH_BIT};
  }
}

}  // namespace

FormatInfo format_info(VkFormat format) {
  if (format <= VK_FORMAT_UNDEFINED || format > VK_FORMAT_BC7_SRGB_BLOCK) return {};
  if (format >= VK_FORMAT_BC1_RGB_UNORM_BLOCK) return {block_bytes(format), 4, 4, VK_IMAGE_ASPECT_COLOR_BIT};
  if (format >= VK_FORMAT_D16_UNORM) return depth_info(format);
  return {color_bytes(format), 1, 1, VK_IMAGE_ASPECT_COLOR_BIT};
}

uint32_t copy_bytes(VkFormat format, VkImageAspectFlags aspect) {
  const FormatInfo info = format_info(format);
  if ((info.aspects & aspect) == 0) return 0;
  if (aspect == VK_IMAGE_ASPECT_STENCIL_BIT) return 1;
  if (aspect == VK_IMAGE_ASPECT_DEPTH_BIT) return format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_D16_UNORM_S8_UINT ? 2 : 4;
  return info.block_bytes;
}

}  // namespace rg
