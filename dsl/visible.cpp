#include "dsl/visible.h"

#include <cstdint>

namespace rg::dsl {
namespace {

struct CodePoint {
  uint32_t value = 0;
  size_t bytes = 1;
  bool valid = false;
};

CodePoint code_point_at(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
  const uint32_t first = byte(0);
  if (first < 0x80) return {first, 1, true};
  const size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return {};
  uint32_t value = first & (0x7fu >> bytes);
  for (size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    value = value << 6 | (byte(i) & 0x3f);
  }
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool valid = value >= kLeast[bytes] && value <= 0x10ffff && (value < 0xd800 || value > 0xdfff);
  return valid ? CodePoint{value, bytes, true} : CodePoint{};
}

bool drives(uint32_t c) {
  const bool control = c < 0x20 || (c >= 0x7f && c < 0xa0);
  const bool direction = (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069) || c == 0x200e || c == 0x200f || c == 0x61c;
  return control || direction || c == 0x2028 || c == 0x2029;
}

}  // namespace

size_t code_points(std::string_view text) {
  size_t count = 0;
  for (size_t at = 0; at < text.size(); at += code_point_at(text, at).bytes) ++count;
  return count;
}

std::string visible(std::string_view text, LineBreaks breaks) {
  std::string shown;
  for (size_t at = 0; at < text.size();) {
    const CodePoint each = code_point_at(text, at);
    const bool stays = each.value == '\t' || (each.value == '\n' && breaks == LineBreaks::kept) || !drives(each.value);
    shown += each.valid && stays ? text.substr(at, each.bytes) : std::string_view("?");
    at += each.bytes;
  }
  return shown;
}

}  // namespace rg::dsl
