#include "dsl/format_table.h"

namespace rg::dsl {
namespace {

constexpr auto F = Numeric::floating;
constexpr auto N = Numeric::unorm;
constexpr auto M = Numeric::snorm;
constexpr auto U = Numeric::uint;
constexpr auto I = Numeric::sint;
constexpr auto B = Numeric::block;
constexpr auto G = Numeric::srgb;

constexpr FormatInfo kFormats[] = {
    {},
#define RG_FORMAT(name, vk, cls, bytes, width, height, aspects, numeric) {#name, vk, bytes, width, height, aspects, numeric},
#include "dsl/format.def"
#undef RG_FORMAT
};

}  // namespace

const FormatInfo& info(Format format) { return kFormats[static_cast<size_t>(format)]; }
const char* name(Format format) { return info(format).name; }

Format find_format(std::string_view name) {
  for (size_t i = 1; i < std::size(kFormats); ++i)
    if (name == kFormats[i].name) return static_cast<Format>(i);
  return Format::none;
}

std::vector<std::string_view> format_names() {
  std::vector<std::string_view> names;
  for (size_t i = 1; i < std::size(kFormats); ++i) names.push_back(kFormats[i].name);
  return names;
}

}  // namespace rg::dsl
