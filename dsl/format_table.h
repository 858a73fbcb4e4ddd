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

}  // namespace rg::dsl
