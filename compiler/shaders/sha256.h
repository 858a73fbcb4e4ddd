// SHA-256 (FIPS 180-4), for names of cache entries and for noticing damage. Not for secrets.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/shaders/sha256_blocks.h"

namespace rg::compiler {

struct Digest {
  std::array<uint8_t, 32> bytes{};
  friend bool operator==(const Digest&, const Digest&) = default;
  friend auto operator<=>(const Digest&, const Digest&) = default;
};
std::string hex(const Digest& digest);  // 64 lower-case digits

class Sha256 {
 public:
  Sha256& add(std::string_view data);
  // Length first, so that ("ab", "c") and ("a", "bc") differ.
  Sha256& add_part(std::string_view part);
  Sha256& add_number(uint64_t number);
  Digest finish();  // once

 private:
  Sha256Blocks blocks_ = sha256_blocks();
  Sha256State state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<uint8_t, 64> pending_{};
  uint64_t size_ = 0;
};

}  // namespace rg::compiler
