// The antichain bound against brute force on small orders, and against the load over time where the order is that of intervals.
#include "compiler/antichain.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "runtime/packing.h"

namespace rg::compiler {
namespace {

using Edges = std::vector<std::pair<uint32_t, uint32_t>>;

std::vector<std::vector<bool>> closure(size_t count, const Edges& edges) {
  std::vector<std::vector<bool>> before(count, std::vector<bool>(count));
  for (const auto& [a, b] : edges) before[a][b] = true;
  for (size_t via = 0; via < count; ++via)
    for (size_t a = 0; a < count; ++a)
      for (size_t b = 0; b < count; ++b)
        if (before[a][via] && before[via][b]) before[a][b] = true;
  return before;
}

uint64_t brute_force(const std::vector<uint64_t>& weights, const Edges& edges) {
  const auto before = closure(weights.size(), edges);
  uint64_t best = 0;
  for (uint32_t set = 0; set < 1u << weights.size(); ++set) {
    uint64_t sum = 0;
    bool ordered = false;
    for (size_t a = 0; a < weights.size(); ++a) {
      if (!(set >> a & 1)) continue;
      sum += weights[a];
      for (size_t b = 0; b < weights.size(); ++b) ordered |= (set >> b & 1) && before[a][b];
    }
    if (!ordered) best = std::max(best, sum);
  }
  return best;
}

TEST(Antichain, NothingWeighsNothing) { EXPECT_EQ(max_weight_antichain({}, {}), 0u); }

TEST(Antichain, AChainWeighsItsHeaviest) {
  const std::vector<uint64_t> weights = {3, 9, 4};
  EXPECT_EQ(max_weight_antichain(weights, Edges{{0, 1}, {1, 2}}), 9u);
}

TEST(Antichain, OrderPassesThroughNodesWithoutWeight) {
  const std::vector<uint64_t> weights = {5, 0, 6};
  EXPECT_EQ(max_weight_antichain(weights, Edges{{0, 1}, {1, 2}}), 6u);
  EXPECT_EQ(max_weight_antichain(weights, Edges{{0, 1}}), 11u);
}

TEST(Antichain, AgreesWithBruteForce) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::vector<uint64_t> weights(1 + random() % 10);
    for (uint64_t& weight : weights) weight = random() % 4 == 0 ? 0 : random() % 50;
    Edges edges;
    for (uint32_t b = 1; b < weights.size(); ++b)
      for (uint32_t a = 0; a < b; ++a)
        if (random() % 3 == 0) edges.emplace_back(a, b);
    EXPECT_EQ(max_weight_antichain(weights, edges), brute_force(weights, edges)) << "seed " << seed;
  }
}

TEST(Antichain, IsTheLoadOverTimeForIntervals) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<packing::Item> items(200);
    for (packing::Item& item : items)
      item = {1 + random() % 1000, 1, static_cast<uint32_t>(random() % 100), 0}, item.end = item.begin + 1 + random() % 20;
    std::vector<uint64_t> weights;
    Edges edges;
    for (uint32_t a = 0; a < items.size(); ++a) {
      weights.push_back(items[a].bytes);
      for (uint32_t b = 0; b < items.size(); ++b)
        if (items[a].end <= items[b].begin) edges.emplace_back(a, b);
    }
    EXPECT_EQ(max_weight_antichain(weights, edges), packing::lower_bound(items)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace rg::compiler
