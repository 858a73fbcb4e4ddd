// Fields of vertices that are packed: the bytes of a format, made from the numbers that a shader then sees.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rg {

// Nearest of the integers that stand for [0, 1], or for [-1, 1] where they are signed; `most` is the greatest.
template <class Int>
constexpr Int normalized(float number, float most = static_cast<float>(std::numeric_limits<Int>::max())) {
  const float least = std::numeric_limits<Int>::min() < 0 ? -1.0f : 0.0f;
  const float within = number > least ? (number < 1.0f ? number : 1.0f) : least;  // what is no number is `least`
  return static_cast<Int>(within * most + (within < 0 ? -0.5f : 0.5f));
}

// The bits of the nearest 16-bit float; ties go to the even one.
constexpr uint16_t half_bits(float number) {
  const uint32_t bits = std::bit_cast<uint32_t>(number), magnitude = bits & 0x7FFFFFFFu;
  const auto sign = static_cast<uint16_t>(bits >> 16 & 0x8000u);
  if (magnitude > 0x7F800000u) return sign | 0x7E00u;
  if (magnitude >= 0x477FF000u) return sign | 0x7C00u;  // from 65520 on
  if (magnitude < 0x33000001u) return sign;             // up to 2^-25
  const uint32_t exponent = magnitude >> 23;
  const bool tiny = exponent < 113;  // below 2^-14: no hidden bit
  const uint32_t shift = tiny ? 126 - exponent : 13;
  const uint32_t mantissa = tiny ? (magnitude & 0x7FFFFFu) | 0x800000u : magnitude - (112u << 23);
  const uint32_t kept = mantissa >> shift, rest = mantissa & ((1u << shift) - 1), middle = 1u << (shift - 1);
  return static_cast<uint16_t>(sign | (kept + (rest > middle || (rest == middle && (kept & 1)))));
}

// unorm and snorm formats: `Normalized<uint8_t, 4>` is rgba8.
template <class Int, size_t N>
struct Normalized {
  Int value[N] = {};
  constexpr Normalized() = default;
  template <class... Numbers>
  requires(sizeof...(Numbers) == N) constexpr Normalized(Numbers... numbers) : value{normalized<Int>(static_cast<float>(numbers))...} {}
};

// 16-bit floats: `Half<2>` is rg16f.
template <size_t N>
struct Half {
  uint16_t bits[N] = {};
  constexpr Half() = default;
  template <class... Numbers>
  requires(sizeof...(Numbers) == N) constexpr Half(Numbers... numbers) : bits{half_bits(static_cast<float>(numbers))...} {}
};

// Integer formats: `Integers<uint8_t, 4>` is rgba8ui.
template <class Int, size_t N>
struct Integers {
  Int value[N] = {};
};

// rgb10a2: [0, 1] each.
struct Rgb10a2 {
  uint32_t bits = 0;
  constexpr Rgb10a2() = default;
  constexpr Rgb10a2(float r, float g, float b, float a)
      : bits(normalized<uint32_t>(r, 1023) | normalized<uint32_t>(g, 1023) << 10 | normalized<uint32_t>(b, 1023) << 20 |
             normalized<uint32_t>(a, 3) << 30) {}
};

// bgra8: given as red, green, blue, alpha.
struct Bgra8 {
  uint8_t b = 0, g = 0, r = 0, a = 0;
  constexpr Bgra8() = default;
  constexpr Bgra8(float red, float green, float blue, float alpha)
      : b(normalized<uint8_t>(blue)), g(normalized<uint8_t>(green)), r(normalized<uint8_t>(red)), a(normalized<uint8_t>(alpha)) {}
};

}  // namespace rg
