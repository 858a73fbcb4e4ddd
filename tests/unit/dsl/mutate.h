// Seeded damage to source texts.
#pragma once

#include <cstdint>
#include <string>

namespace rg::dsl {

struct Random {  // xorshift64*: the same numbers everywhere
  uint64_t state;
  explicit Random(uint64_t seed) : state(seed * 2685821657736338717ull + 1442695040888963407ull) {}
  uint64_t next();
  uint64_t below(uint64_t count) { return (next() >> 16) % count; }
};

// Deletes, repeats, swaps, splices or overwrites bytes or tokens in one to four places.
std::string mutate(const std::string& text, Random& random);

struct TokenMutation {
  std::string text;
  uint32_t line = 0;  // of the damaged token
  std::string what;   // for a person
};
// Deletes one token, repeats it, or replaces it by another of the file.
TokenMutation mutate_token(const std::string& text, Random& random);

}  // namespace rg::dsl
