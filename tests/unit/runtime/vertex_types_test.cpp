#include "runtime/vertex_types.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rg::test {
namespace {

static_assert(sizeof(Normalized<uint8_t, 4>) == 4 && sizeof(Half<2>) == 4 && sizeof(Rgb10a2) == 4 && sizeof(Bgra8) == 4);
static_assert(Normalized<uint8_t, 2>(1, 0.5f).value[1] == 128);  // at compile time

// Vulkan 1.3, 43.1: fixed-point conversions round to nearest and clamp.
TEST(VertexTypes, NormalizedNumbersAreClampedAndRounded) {
  const Normalized<uint8_t, 4> tint(0, 1, 2, -1);
  EXPECT_EQ(tint.value[0], 0);
  EXPECT_EQ(tint.value[1], 255);
  EXPECT_EQ(tint.value[2], 255);
  EXPECT_EQ(tint.value[3], 0);
  const Normalized<int8_t, 3> normal(-1, 0.25f, 1);
  EXPECT_EQ(normal.value[0], -127);
  EXPECT_EQ(normal.value[1], 32);
  EXPECT_EQ(normal.value[2], 127);
  EXPECT_EQ((Normalized<uint16_t, 1>(1.0f).value[0]), 65535);
  EXPECT_EQ((Normalized<int16_t, 1>(std::nanf("")).value[0]), -32767);
  for (int i = -127; i <= 127; ++i) EXPECT_EQ(normalized<int8_t>(static_cast<float>(i) / 127), i);
}

// What a half stands for, by the definition of IEEE 754-2008, 3.4.
double value_of(uint16_t bits) {
  const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
  const double magnitude = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return bits & 0x8000 ? -magnitude : magnitude;
}

TEST(VertexTypes, HalvesAreTheNearest) {
  for (uint32_t bits = 0; bits < 0x7C00; ++bits) {
    const double value = value_of(static_cast<uint16_t>(bits));
    ASSERT_EQ(half_bits(static_cast<float>(value)), bits);
    ASSERT_EQ(half_bits(static_cast<float>(-value)), bits | 0x8000);
    if (bits + 1 == 0x7C00) break;
    const double next = value_of(static_cast<uint16_t>(bits + 1)), middle = (value + next) / 2;
    ASSERT_EQ(half_bits(static_cast<float>(middle)), bits + bits % 2);  // ties to even
    ASSERT_EQ(half_bits(std::nextafter(static_cast<float>(middle), 0.0f)), bits);
    ASSERT_EQ(half_bits(std::nextafter(static_cast<float>(middle), 1e9f)), bits + 1);
  }
  EXPECT_EQ(half_bits(65519.996f), 0x7BFF);
  EXPECT_EQ(half_bits(65520.0f), 0x7C00);
  EXPECT_EQ(half_bits(-1e30f), 0xFC00);
  EXPECT_EQ(half_bits(std::nanf("")) & 0x7E00, 0x7E00);
}

TEST(VertexTypes, WordsHoldTheirComponentsInOrder) {
  EXPECT_EQ(Rgb10a2(1, 0, 0, 0).bits, 0x3FFu);
  EXPECT_EQ(Rgb10a2(0, 1, 0, 1).bits, 0xC00FFC00u);
  EXPECT_EQ(Rgb10a2(0, 0, 0.5f, 0).bits, 512u << 20);
  const Bgra8 tint(1, 0.5f, 0, 1);
  EXPECT_EQ(tint.r, 255);
  EXPECT_EQ(tint.g, 128);
  EXPECT_EQ(tint.b, 0);
  EXPECT_EQ(tint.a, 255);
}

}  // namespace
}  // namespace rg::test
