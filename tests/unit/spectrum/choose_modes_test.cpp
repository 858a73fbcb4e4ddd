// Choices against brute force, and against the promises that hold whatever the sizes.
#include "compiler/spectrum/choose_modes.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

namespace rg::compiler {
namespace {

struct Shape {
  uint32_t features, masks, modes;
  bool needs = false, pairs = false, cheaper_superset = false;
};

SpectrumProblem random_problem(uint32_t seed, const Shape& shape) {
  std::mt19937 random(seed);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  SpectrumProblem problem;
  problem.features = shape.features;
  problem.modes = shape.modes;
  problem.costs.work.base = 1.0 + below(100) / 50.0;
  for (uint32_t f = 0; f < shape.features; ++f) {
    problem.costs.work.features.push_back((1 + below(100)) / 60.0);
    problem.needs.push_back(shape.needs && f > 0 && below(3) == 0 ? Mask{1} << below(f) : 0);
  }
  for (uint32_t f = 1; shape.pairs && f < shape.features; ++f) {
    const double extra = (static_cast<double>(below(40)) - 15) / 80.0;
    problem.costs.work.pairs.emplace_back(Mask{1} << f | Mask{1} << below(f), extra);
  }
  problem.costs.registers = {20, std::vector<double>(shape.features, 6.0), {}};
  for (uint32_t i = 0; i < shape.masks; ++i) {
    Mask mask = static_cast<Mask>(random()) & static_cast<Mask>((uint64_t{1} << shape.features) - 1);
    if (below(2) == 0) mask &= static_cast<Mask>(random());
    const double many = 1.0 + below(1000), few = 1.0 + below(20);
    problem.histogram.push_back({mask, many / few});
  }
  if (shape.cheaper_superset) problem.costs.measured = {{static_cast<Mask>((uint64_t{1} << shape.features) - 2), 0.5}};
  return problem;
}

// Every feasible choice of sets, the full one always among them.
double brute_force(const SpectrumProblem& problem) {
  const Mask full = static_cast<Mask>((uint64_t{1} << problem.features) - 1);
  std::vector<Mask> sets;
  for (Mask set = 0; set < full; ++set)
    if (close(problem, set) == set) sets.push_back(set);
  double total = 0;
  for (const MaskWeight& row : problem.histogram) total += row.weight;
  std::vector<Mask> chosen = {full};
  double best = std::numeric_limits<double>::infinity();
  const auto value = [&] {
    double sum = 0;
    for (const MaskWeight& row : problem.histogram) {
      double least = std::numeric_limits<double>::infinity();
      for (const Mask set : chosen)
        if ((row.mask & ~set) == 0) least = std::min(least, cost(problem.costs, set));
      sum += row.weight / total * least;
    }
    return sum;
  };
  const auto descend = [&](auto&& self, size_t from) -> void {
    best = std::min(best, value());
    if (chosen.size() == problem.modes) return;
    for (size_t s = from; s < sets.size(); ++s) {
      chosen.push_back(sets[s]);
      self(self, s + 1);
      chosen.pop_back();
    }
  };
  descend(descend, 0);
  return best;
}

void expect_sound(const SpectrumProblem& problem, const ModeChoice& choice) {
  const Mask full = static_cast<Mask>((uint64_t{1} << problem.features) - 1);
  ASSERT_FALSE(choice.modes.empty());
  EXPECT_LE(choice.modes.size(), problem.modes);
  EXPECT_EQ(choice.modes.back(), full);
  ASSERT_EQ(choice.mode_of.size(), problem.histogram.size());
  double total = 0, sum = 0;
  for (const Mask mode : choice.modes) EXPECT_EQ(close(problem, mode), mode);
  for (size_t i = 0; i < problem.histogram.size(); ++i) {
    const uint32_t mode = choice.mode_of[i];
    EXPECT_EQ(problem.histogram[i].mask & ~choice.modes[mode], 0u);
    sum += problem.histogram[i].weight * cost(problem.costs, choice.modes[mode]);
    total += problem.histogram[i].weight;
  }
  EXPECT_NEAR(choice.expected, sum / total, 1e-9 * choice.expected);
  EXPECT_LE(choice.bound, choice.expected + 1e-12);
  EXPECT_LE(choice.expected, choice.one_kernel + 1e-12);
}

TEST(ChooseModes, EqualsBruteForceUpToSevenFeaturesAndFourModes) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const Shape shape{2 + seed % 4, 3 + seed % 20, 1 + seed % 4, seed % 2 == 1, seed % 3 == 1, seed % 5 == 4};
    const SpectrumProblem problem = random_problem(seed, shape);
    const ModeChoice choice = choose_modes(problem);
    expect_sound(problem, choice);
    EXPECT_TRUE(choice.exact) << seed;
    EXPECT_NEAR(choice.expected, brute_force(problem), 1e-9) << "seed " << seed;
  }
  for (uint32_t seed = 100; seed < 104; ++seed) {
    const SpectrumProblem problem = random_problem(seed, {6 + seed % 2, 25, 3 + seed / 2 % 2, true, true, false});
    const ModeChoice choice = choose_modes(problem);
    EXPECT_TRUE(choice.exact) << seed;
    EXPECT_NEAR(choice.expected, brute_force(problem), 1e-9) << "seed " << seed;
  }
}

TEST(ChooseModes, StaysWithinTwoPercentOfItsBoundWhereItIsNotExact) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    const SpectrumProblem problem = random_problem(seed, {8 + seed, 60 + 100 * seed, 4 + 2 * seed, seed % 2 == 1, true, false});
    const ModeChoice choice = choose_modes(problem);
    expect_sound(problem, choice);
    EXPECT_LE(choice.gap(), 0.02) << "seed " << seed;
  }
}

TEST(ChooseModes, TwentyFeaturesFiveThousandMasksSixteenModes) {
  const SpectrumProblem problem = random_problem(7, {20, 5000, 16, true, true, false});
  const ModeChoice choice = choose_modes(problem);
  expect_sound(problem, choice);
  EXPECT_LE(choice.gap(), 0.02);
  EXPECT_LT(choice.expected, choice.one_kernel);
  EXPECT_EQ(choice.modes, choose_modes(problem).modes);
}

TEST(ChooseModes, ExtremesAndEmptyHistograms) {
  SpectrumProblem problem = random_problem(1, {4, 10, 1});
  EXPECT_NEAR(choose_modes(problem).expected, choose_modes(problem).one_kernel, 1e-12);
  problem.modes = 16;
  const ModeChoice all = choose_modes(problem);
  EXPECT_NEAR(all.expected, all.kernel_per_mask, 1e-12);
  EXPECT_TRUE(all.exact);
  problem.histogram.clear();
  EXPECT_EQ(choose_modes(problem).modes, std::vector<Mask>{15});
}

TEST(ChooseModes, OneMoreKernelNeverCosts) {
  SpectrumProblem problem = random_problem(5, {7, 40, 1, true, true, false});
  double before = std::numeric_limits<double>::infinity();
  for (problem.modes = 1; problem.modes <= 4; ++problem.modes) {
    const double now = choose_modes(problem).expected;
    EXPECT_LE(now, before + 1e-12);
    before = now;
  }
}

TEST(ChooseModes, SharesAreTheWeightThatEachModeServes) {
  SpectrumProblem problem;
  problem.features = 2;
  problem.histogram = {{0, 5}, {1, 2}, {2, 1}, {3, 1}, {0, 1}};
  EXPECT_EQ(group_shares(problem, {0, 1, 3}), (std::vector<double>{0.6, 0.2, 0.2}));
  problem.histogram = {{1, 0}};
  EXPECT_TRUE(group_shares(problem, {3}).empty());
}

TEST(CostModel, FitsWhatItIsGiven) {
  const std::vector<std::pair<Mask, double>> samples = {{0, 2.0}, {1, 3.0}, {2, 2.5}, {3, 4.0}};
  const Additive terms = fit_terms(2, samples);
  for (const auto& [set, value] : samples) EXPECT_DOUBLE_EQ(evaluate(terms, set), value);
  std::vector<std::pair<Mask, double>> measured;
  for (Mask set = 0; set < 16; ++set) measured.emplace_back(set, 1.0 + 0.5 * std::popcount(set));
  const Additive fitted = fit_least_squares(4, measured);
  EXPECT_NEAR(evaluate(fitted, 15), 3.0, 0.01);
  EXPECT_NEAR(fitted.base, 1.0, 0.01);
}

TEST(CostModel, FeaturesAreToldApartByAsManyIndependentSets) {
  EXPECT_FALSE(tell_apart(2, {}));
  EXPECT_FALSE(tell_apart(2, {{0, 1}, {1, 1}}));
  EXPECT_FALSE(tell_apart(2, {{0, 1}, {3, 1}, {3, 2}})) << "always together";
  EXPECT_TRUE(tell_apart(2, {{0, 1}, {1, 1}, {3, 1}}));
  EXPECT_TRUE(tell_apart(2, {{1, 1}, {2, 1}, {3, 1}}));
  EXPECT_FALSE(tell_apart(3, {{1, 1}, {2, 1}, {4, 1}}));
  EXPECT_TRUE(tell_apart(3, {{1, 1}, {2, 1}, {4, 1}, {7, 1}}));
}

TEST(CostModel, EstimatesTakeTheUnitOfTheTimes) {
  using Row = std::pair<Mask, double>;
  const std::vector<Row> rows = complete_times({{0, 100}, {1, 200}, {2, 400}}, {{0, 1}, {2, 4}, {3, 9}});
  EXPECT_EQ(rows, (std::vector<Row>{{0, 1}, {1, 2}, {2, 4}, {3, 9}}));
  const std::vector<Row> between = complete_times({{0, 1}, {1, 1}, {2, 1}}, {{0, 2}, {1, 4}});
  EXPECT_EQ(between, (std::vector<Row>{{0, 2}, {1, 4}, {2, 3}})) << "the mean, where nothing tells them apart";
}

TEST(CostModel, TableAndFunctionAgree) {
  const SpectrumProblem problem = random_problem(3, {9, 1, 2, false, true, true});
  const CostTable table(problem.costs);
  for (Mask set = 0; set < 512; ++set) EXPECT_DOUBLE_EQ(table(set), cost(problem.costs, set));
}

}  // namespace
}  // namespace rg::compiler
