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

uint32_t components(Format format) {
  const std::string_view text = name(format);
  const auto begins = [&](const char* prefix) { return text.starts_with(prefix); };
  if (!info(format).is_color()) return 1;
  if (begins("rgba") || begins("bgra") || begins("rgb10a2") || begins("bc1") || begins("bc2") || begins("bc3") || begins("bc7")) return 4;
  if (begins("r11g11b10") || begins("rgb9e5") || begins("bc6")) return 3;
  if (begins("rg") || begins("bc5")) return 2;
  return 1;
}

bool is_vertex_format(Format format) {
  const FormatInfo& row = info(format);
  if (!row.is_color() || row.is_block() || row.numeric == Numeric::srgb) return false;
  return format != Format::r11g11b10f && format != Format::rgb9e5 && format != Format::rgb10a2ui;
}

Type packed_type(Format format) {
  Type type;
  const Numeric numeric = info(format).numeric;
  type.scalar = numeric == Numeric::uint ? Scalar::u32 : numeric == Numeric::sint ? Scalar::i32 : Scalar::f32;
  type.rows = static_cast<uint8_t>(components(format));
  type.packed = format;
  return type;
}

}  // namespace rg::dsl
