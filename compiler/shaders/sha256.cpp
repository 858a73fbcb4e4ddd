#include "compiler/shaders/sha256.h"

#include <algorithm>
#include <cstring>

namespace rg::compiler {

Sha256& Sha256::add(std::string_view data) {
  const auto* at = reinterpret_cast<const uint8_t*>(data.data());
  size_t left = data.size();
  const size_t used = size_ % 64;
  size_ += left;
  if (used > 0) {
    const size_t taken = std::min(left, 64 - used);
    std::memcpy(pending_.data() + used, at, taken);
    at += taken, left -= taken;
    if (used + taken < 64) return *this;
    blocks_(state_, pending_.data(), 1);
  }
  blocks_(state_, at, left / 64);
  at += left / 64 * 64, left %= 64;
  if (left > 0) std::memcpy(pending_.data(), at, left);
  return *this;
}

Sha256& Sha256::add_number(uint64_t number) {
  char bytes[8];
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(number >> (8 * i));
  return add({bytes, 8});
}

Sha256& Sha256::add_part(std::string_view part) { return add_number(part.size()).add(part); }

Digest Sha256::finish() {
  const uint64_t bits = size_ * 8;
  const size_t used = size_ % 64;
  char padding[72] = {static_cast<char>(0x80)};
  const size_t zeros = (used < 56 ? 56 : 120) - used;
  add({padding, zeros});
  char length[8];
  for (int i = 0; i < 8; ++i) length[i] = static_cast<char>(bits >> (56 - 8 * i));
  add({length, 8});
  Digest digest;
  for (size_t i = 0; i < 32; ++i) digest.bytes[i] = static_cast<uint8_t>(state_[i / 4] >> (24 - 8 * (i % 4)));
  return digest;
}

std::string hex(const Digest& digest) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const uint8_t byte : digest.bytes) text += {kDigits[byte >> 4], kDigits[byte & 15]};
  return text;
}

}  // namespace rg::compiler
