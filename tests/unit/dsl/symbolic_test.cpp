#include "dsl/symbolic.h"

#include <gtest/gtest.h>

#include <random>

namespace rg::dsl {
namespace {

// Two extents: x from 1 to 1000, y from 8 to 64.
struct Symbols {
  Program program;
  ExprId x, y;
  Symbols() {
    Extent extent;
    extent.maximum[0] = 1000;
    program.extents.add(extent);
    extent.minimum[0] = 8, extent.maximum[0] = 64;
    program.extents.add(extent);
    x = add(ExprOp::extent, {}, {}, 0), y = add(ExprOp::extent, {}, {}, 3);
  }
  ExprId add(ExprOp op, ExprId a, ExprId b, int64_t value = 0) { return program.exprs.add({op, a, b, value}); }
  ExprId number(int64_t value) { return add(ExprOp::constant, {}, {}, value); }
  bool not_less(ExprId a, ExprId b) {
    Formulas formulas(program);
    return formulas.never_negative(formulas.of(a) - formulas.of(b));
  }
  bool equal(ExprId a, ExprId b) {
    Formulas formulas(program);
    return formulas.of(a).terms() == formulas.of(b).terms();
  }
};

TEST(Symbolic, SumsAndProductsAreEqualHoweverTheyAreWritten) {
  Symbols s;
  const ExprId sum = s.add(ExprOp::add, s.x, s.y);
  const ExprId square = s.add(ExprOp::mul, sum, sum);
  const ExprId two = s.number(2), product = s.add(ExprOp::mul, s.y, s.x);
  const ExprId parts =
      s.add(ExprOp::add, s.add(ExprOp::mul, s.x, s.x), s.add(ExprOp::add, s.add(ExprOp::mul, two, product), s.add(ExprOp::mul, s.y, s.y)));
  EXPECT_TRUE(s.equal(square, parts));
  EXPECT_FALSE(s.equal(square, product));
  EXPECT_TRUE(s.equal(s.add(ExprOp::sub, sum, s.y), s.x));
  const ExprId even = s.add(ExprOp::floor_div, s.add(ExprOp::mul, s.x, s.number(12)), s.number(4));
  EXPECT_TRUE(s.equal(even, s.add(ExprOp::mul, s.x, s.number(3))));
}

TEST(Symbolic, BoundsOfExtentsDecide) {
  Symbols s;
  EXPECT_TRUE(s.not_less(s.x, s.number(1)));
  EXPECT_FALSE(s.not_less(s.x, s.number(2)));
  EXPECT_TRUE(s.not_less(s.number(1000), s.x));
  EXPECT_TRUE(s.not_less(s.add(ExprOp::mul, s.x, s.y), s.add(ExprOp::mul, s.x, s.number(8))));
  EXPECT_FALSE(s.not_less(s.y, s.x));
  EXPECT_TRUE(s.not_less(s.add(ExprOp::max, s.x, s.y), s.number(8)));
  EXPECT_TRUE(s.not_less(s.number(64), s.add(ExprOp::min, s.x, s.y)));
  EXPECT_TRUE(s.not_less(s.add(ExprOp::mip, s.x, s.number(3)), s.number(1)));
}

TEST(Symbolic, QuotientsAreBoundedByWhatIsDivided) {
  Symbols s;
  const ExprId three = s.number(3);
  const ExprId down = s.add(ExprOp::mul, s.add(ExprOp::floor_div, s.x, three), three),
               up = s.add(ExprOp::mul, s.add(ExprOp::ceil_div, s.x, three), three);
  EXPECT_TRUE(s.not_less(s.x, down));
  EXPECT_TRUE(s.not_less(up, s.x));
  EXPECT_FALSE(s.not_less(down, s.x));
  EXPECT_TRUE(s.not_less(down, s.add(ExprOp::sub, s.x, s.number(2))));
  EXPECT_FALSE(s.not_less(down, s.add(ExprOp::sub, s.x, s.number(1))));
  EXPECT_TRUE(s.not_less(s.add(ExprOp::ceil_div, s.x, three), s.add(ExprOp::floor_div, s.x, three)));
}

TEST(Symbolic, WhatIsTooLargeIsNotProved) {
  Symbols s;
  ExprId power = s.x;
  for (int i = 0; i < 12; ++i) power = s.add(ExprOp::mul, power, power);
  EXPECT_FALSE(s.not_less(power, s.number(1)));
  ExprId doubled = s.x;
  for (int i = 0; i < 80; ++i) doubled = s.add(ExprOp::add, doubled, doubled);
  EXPECT_FALSE(s.not_less(doubled, s.number(1)));
}

// Random formulas: what is said to be never negative is not, at a thousand extents.
TEST(Symbolic, NothingIsProvedThatDoesNotHold) {
  std::mt19937 random(7);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  int proved = 0;
  for (int round = 0; round < 400; ++round) {
    Symbols s;
    std::vector<ExprId> made = {s.x, s.y, s.number(1 + below(5)), s.number(2)};
    for (int i = 0; i < 6; ++i) {
      const ExprId a = made[below(static_cast<uint32_t>(made.size()))], b = made[below(static_cast<uint32_t>(made.size()))];
      constexpr ExprOp kOps[] = {ExprOp::add, ExprOp::sub, ExprOp::mul, ExprOp::min, ExprOp::max};
      const uint32_t pick = below(7);
      if (pick < 5)
        made.push_back(s.add(kOps[pick], a, b));
      else
        made.push_back(s.add(pick == 5 ? ExprOp::floor_div : ExprOp::ceil_div, made[below(2)], made[2 + below(2)]));
    }
    const ExprId a = made.back(), b = made[made.size() - 2];
    if (!s.not_less(a, b)) continue;
    ++proved;
    for (int probe = 0; probe < 1000; ++probe) {
      const std::vector<int64_t> extents = {int64_t{1} + below(1000), 1, 1, int64_t{8} + below(57), 1, 1};
      ASSERT_GE(evaluate(s.program, a, extents), evaluate(s.program, b, extents)) << "round " << round;
    }
  }
  EXPECT_GT(proved, 40);
}

}  // namespace
}  // namespace rg::dsl
