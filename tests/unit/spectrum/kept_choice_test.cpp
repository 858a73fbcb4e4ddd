// Choices that were kept come back as they were, and only for the problem they were made for.
#include "compiler/spectrum/kept_choice.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace rg::compiler {
namespace {

SpectrumProblem make_problem() {
  SpectrumProblem problem;
  problem.features = 3;
  problem.needs = {0, 1, 0};
  problem.histogram = {{0, 5}, {1, 2.5}, {3, 1}, {4, 0.125}};
  problem.costs.work.features.assign(3, 0.1);
  problem.modes = 3;
  return problem;
}

KeptChoice make_choice(const SpectrumProblem& problem) {
  SpectrumProblem costed = problem;
  costed.costs.work = {1.5, {0.25, 0.5, 0.75}, {{5, 0.125}}};
  costed.costs.registers = {12, {1, 2, 3}, {}};
  costed.costs.measured = {{0, 1.25}, {3, 2.0 / 3}};
  return {costed.costs, choose_modes(costed)};
}

void expect_same(const Additive& a, const Additive& b) {
  EXPECT_EQ(a.base, b.base);
  EXPECT_EQ(a.features, b.features);
  EXPECT_EQ(a.pairs, b.pairs);
}
void expect_same(const KeptChoice& a, const KeptChoice& b) {
  expect_same(a.costs.work, b.costs.work);
  expect_same(a.costs.registers, b.costs.registers);
  EXPECT_EQ(a.costs.measured, b.costs.measured);
  EXPECT_EQ(a.choice.modes, b.choice.modes);
  EXPECT_EQ(a.choice.costs, b.choice.costs);
  EXPECT_EQ(a.choice.mode_of, b.choice.mode_of);
  EXPECT_EQ(a.choice.expected, b.choice.expected);
  EXPECT_EQ(a.choice.bound, b.choice.bound);
  EXPECT_EQ(a.choice.exact, b.choice.exact);
  EXPECT_EQ(a.choice.one_kernel, b.choice.one_kernel);
  EXPECT_EQ(a.choice.kernel_per_mask, b.choice.kernel_per_mask);
}

struct Kept : testing::Test {
  std::filesystem::path folder = std::filesystem::temp_directory_path() / ("rgc_kept_choice_" + std::to_string(::getpid()));
  ~Kept() override { std::filesystem::remove_all(folder); }
  const Digest sources = Sha256().add("sources").finish();
};

TEST_F(Kept, ComesBackBitByBit) {
  const ShaderCache cache(folder);
  const SpectrumProblem problem = make_problem();
  const Digest key = choice_key(problem, sources);
  EXPECT_FALSE(find_choice(cache, key, problem));
  const KeptChoice kept = make_choice(problem);
  ASSERT_GE(kept.choice.modes.size(), 2u);
  store_choice(cache, key, kept);
  const auto found = find_choice(cache, key, problem);
  ASSERT_TRUE(found);
  expect_same(*found, kept);
}

TEST_F(Kept, EverythingThatTheChoiceDependsOnIsInTheKey) {
  const Digest key = choice_key(make_problem(), sources);
  EXPECT_EQ(choice_key(make_problem(), sources), key);
  EXPECT_NE(choice_key(make_problem(), Sha256().add("other sources").finish()), key);
  const auto changed = [&](auto change) {
    SpectrumProblem problem = make_problem();
    change(problem);
    return choice_key(problem, sources) != key;
  };
  EXPECT_TRUE(changed([](SpectrumProblem& p) { p.features = 4; }));
  EXPECT_TRUE(changed([](SpectrumProblem& p) { p.needs[2] = 1; }));
  EXPECT_TRUE(changed([](SpectrumProblem& p) { p.histogram[1].weight = 2.25; }));
  EXPECT_TRUE(changed([](SpectrumProblem& p) { p.histogram[1].mask = 2; }));
  EXPECT_TRUE(changed([](SpectrumProblem& p) { p.histogram.pop_back(); }));
  EXPECT_TRUE(changed([](SpectrumProblem& p) { p.modes = 4; }));
  EXPECT_TRUE(changed([](SpectrumProblem& p) { p.costs.measured = {{1, 1}}; }));
}

TEST_F(Kept, WhatDoesNotFitIsNotTaken) {
  const ShaderCache cache(folder);
  const SpectrumProblem problem = make_problem();
  const Digest key = choice_key(problem, sources);
  const auto refused = [&](const std::vector<Words>& modules) {
    cache.store(key, modules);
    return !find_choice(cache, key, problem);
  };
  store_choice(cache, key, make_choice(problem));
  const Words whole = (*cache.find(key))[0];
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({whole, whole}));
  for (size_t size = 0; size < whole.size(); ++size)
    EXPECT_TRUE(refused({Words(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size))})) << size;
  Words longer = whole;
  longer.push_back(0);
  EXPECT_TRUE(refused({longer}));
  EXPECT_TRUE(refused({Words(100, UINT32_MAX)}));
  KeptChoice wrong = make_choice(problem);
  wrong.choice.mode_of[0] = 9;
  store_choice(cache, key, wrong);
  EXPECT_FALSE(find_choice(cache, key, problem));
  SpectrumProblem wider = problem;
  wider.histogram.push_back({2, 1});
  store_choice(cache, key, make_choice(problem));
  EXPECT_TRUE(find_choice(cache, key, problem));
  EXPECT_FALSE(find_choice(cache, key, wider));
}

}  // namespace
}  // namespace rg::compiler
