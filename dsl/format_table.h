// What a format is made of. The rows are format.def's.
#pragma once

#include <string_view>
#include <vector>

#include "dsl/program.h"

namespace rg::dsl {

enum class Numeric : uint8_t { floating, unorm, snorm, uint, sint, block, srgb };
enum Aspect : uint32_t { aspect_color = 1, aspect_depth = 2, aspect_stencil = 4 };
struct FormatInfo {
  const char* name = "none";
  uint32_t vk = 0;           // VkFormat
  uint32_t block_bytes = 0;  // bytes of a block; a texel where blocks are 1x1
  uint32_t block_width = 1, block_height = 1;
  uint32_t aspects = 0;  // Aspect bits
  Numeric numeric = Numeric::floating;

  bool is_color() const { return aspects == aspect_color; }
  bool is_block() const { return numeric == Numeric::block; }
  bool is_integer() const { return numeric == Numeric::uint || numeric == Numeric::sint; }
};
const FormatInfo& info(Format format);
Format find_format(std::string_view name);  // none if there is no such format
std::vector<std::string_view> format_names();
uint32_t components(Format format);  // of a texel that a shader reads: 3 of r11g11b10f, 1 of depth and stencil
// Whether every device of Vulkan 1.3 reads vertices of the format (specification, required format support: VERTEX_BUFFER_BIT).
bool is_vertex_format(Format format);
// One element of it as shaders see it, with `packed` set.
Type packed_type(Format format);

}  // namespace rg::dsl
