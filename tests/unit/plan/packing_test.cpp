// The heap packer against an independent validator, brute force on small cases, and known facts.
#include "runtime/packing.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

namespace rg::packing {
namespace {

// The plain statement of what a placement must satisfy, the O(n²) way.
std::optional<std::string> find_fault(const std::vector<Item>& items, const Placement& placement) {
  for (size_t i = 0; i < items.size(); ++i) {
    if (placement.offsets[i] % items[i].alignment != 0) return "item " + std::to_string(i) + " is misaligned";
    if (placement.offsets[i] + items[i].bytes > placement.heap_bytes) return "item " + std::to_string(i) + " sticks out";
    for (size_t j = 0; j < i; ++j) {
      const bool together = items[i].begin < items[j].end && items[j].begin < items[i].end;
      const bool apart =
          placement.offsets[i] + items[i].bytes <= placement.offsets[j] || placement.offsets[j] + items[j].bytes <= placement.offsets[i];
      if (together && !apart) return "items " + std::to_string(j) + " and " + std::to_string(i) + " share bytes while both live";
    }
  }
  return std::nullopt;
}

uint64_t greatest_live_sum(const std::vector<Item>& items) {
  uint64_t greatest = 0;
  for (const Item& at : items) {
    uint64_t sum = 0;
    for (const Item& item : items)
      if (item.begin <= at.begin && at.begin < item.end) sum += item.bytes;
    greatest = std::max(greatest, sum);
  }
  return greatest;
}

// The least heap over all orders, each item as low as it fits: some order gives an optimal placement.
uint64_t brute_force(const std::vector<Item>& items) {
  std::vector<size_t> order(items.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  uint64_t best = UINT64_MAX;
  do {
    std::vector<uint64_t> offsets(items.size(), 0);
    uint64_t heap = 0;
    for (size_t placed = 0; placed < order.size(); ++placed) {
      const Item& item = items[order[placed]];
      uint64_t offset = 0;
      for (bool moved = true; moved;) {
        moved = false;
        for (size_t p = 0; p < placed; ++p) {
          const Item& other = items[order[p]];
          const bool together = item.begin < other.end && other.begin < item.end;
          if (!together || offset + item.bytes <= offsets[order[p]] || offsets[order[p]] + other.bytes <= offset) continue;
          offset = (offsets[order[p]] + other.bytes + item.alignment - 1) / item.alignment * item.alignment;
          moved = true;
        }
      }
      offsets[order[placed]] = offset;
      heap = std::max(heap, offset + item.bytes);
    }
    best = std::min(best, heap);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

std::vector<Item> random_items(uint32_t seed, size_t count, uint32_t times, uint64_t sizes, std::initializer_list<uint64_t> alignments) {
  std::mt19937 random(seed);
  std::vector<Item> items;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t begin = random() % times, length = 1 + random() % std::max(1u, times / 4);
    items.push_back({1 + random() % sizes, *(alignments.begin() + random() % alignments.size()), begin, begin + length});
  }
  return items;
}

TEST(Packing, NothingToPack) {
  const Placement placement = pack(std::vector<Item>{});
  EXPECT_EQ(placement.heap_bytes, 0u);
  EXPECT_TRUE(placement.offsets.empty());
}

TEST(Packing, LivesThatOnlyTouchShareBytes) {
  const std::vector<Item> items = {{100, 1, 0, 2}, {100, 1, 2, 4}};
  const Placement placement = pack(items);
  EXPECT_EQ(placement.heap_bytes, 100u);
  EXPECT_EQ(placement.offsets, (std::vector<uint64_t>{0, 0}));
}

// The one instance of seven items with five sections whose optimum exceeds its load, known from exhaustive search.
TEST(Packing, LoadIsNotAlwaysReachable) {
  const std::vector<Item> items = {{2, 1, 0, 1}, {2, 1, 0, 2}, {1, 1, 1, 3}, {1, 1, 1, 4}, {1, 1, 2, 4}, {2, 1, 3, 5}, {2, 1, 4, 5}};
  const Placement placement = pack(items);
  EXPECT_EQ(placement.lower_bound_bytes, 4u);
  EXPECT_EQ(placement.heap_bytes, 5u);
  EXPECT_EQ(find_fault(items, placement), std::nullopt);
}

TEST(Packing, SmallCasesReachTheOptimum) {
  for (uint32_t seed = 0; seed < 150; ++seed) {
    const std::vector<Item> items = random_items(seed, 3 + seed % 5, 6, 8, {1});
    const Placement placement = pack(items);
    ASSERT_EQ(find_fault(items, placement), std::nullopt) << "seed " << seed;
    ASSERT_EQ(placement.heap_bytes, brute_force(items)) << "seed " << seed;
  }
}

TEST(Packing, RandomPlacementsAreValidAndNearTheBound) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const std::vector<Item> items = random_items(seed, 20 + seed * 5, 40, 1000, {1, 4, 64});
    const Placement placement = pack(items, 200'000);
    ASSERT_EQ(find_fault(items, placement), std::nullopt) << "seed " << seed;
    ASSERT_EQ(placement.lower_bound_bytes, greatest_live_sum(items)) << "seed " << seed;
    ASSERT_LE(placement.heap_bytes, placement.lower_bound_bytes * 115 / 100) << "seed " << seed;
  }
}

TEST(Packing, SameInputSamePlacement) {
  const std::vector<Item> items = random_items(7, 120, 30, 1000, {1, 256});
  EXPECT_EQ(pack(items).offsets, pack(items).offsets);
}

TEST(Packing, ConflictsOverrideLives) {
  const std::vector<Item> items = {{100, 1, 0, 1}, {100, 1, 1, 2}, {50, 1, 2, 3}};
  const Placement placement = pack(items, {{0, 1}});
  EXPECT_EQ(placement.heap_bytes, 200u);
  EXPECT_NE(placement.offsets[0], placement.offsets[1]);
}

// Ejection repairs a heap as high as all items together, whatever their conflicts and alignments, or leaves it alone.
TEST(Packing, EjectionRepairsWhatSticksOut) {
  size_t repaired = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const std::vector<Item> items = random_items(seed, 20 + seed * 3, 40, 1000, {1, 4, 64});
    std::vector<Conflict> pairs;
    detail::for_each_meeting_pair(items, [&](uint32_t a, uint32_t b) { return pairs.emplace_back(a, b), true; });
    Placement placement;
    for (const Item& item : items) {
      placement.offsets.push_back(detail::align_up(placement.heap_bytes, item.alignment));
      placement.heap_bytes = placement.offsets.back() + item.bytes;
    }
    const detail::Neighbours neighbours = detail::neighbours(items.size(), pairs);
    const std::vector<uint64_t> before = placement.offsets;
    const uint64_t capacity = greatest_live_sum(items) * 105 / 100;
    const bool fits = detail::Ejection(items, neighbours).run(placement.offsets, capacity, 2'000'000);
    if (fits) placement.heap_bytes = capacity;
    ASSERT_EQ(find_fault(items, placement), std::nullopt) << "seed " << seed;
    if (!fits) {
      ASSERT_EQ(placement.offsets, before) << "seed " << seed;
    }
    repaired += fits;
  }
  EXPECT_GE(repaired, 55u);
}

TEST(Packing, MoreEffortIsNeverWorse) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const std::vector<Item> items = random_items(seed, 150, 40, 1000, {1});
    uint64_t last = UINT64_MAX;
    for (const uint64_t effort : {0, 30'000, 100'000, 300'000, 599'000}) {
      const uint64_t heap = pack(items, effort).heap_bytes;
      EXPECT_LE(heap, last) << "seed " << seed << ", effort " << effort;
      last = heap;
    }
  }
}

// Thousands of items that live together must not cost the square of their number.
TEST(Packing, ManyItemsAtOnceAreStacked) {
  std::vector<Item> items;
  for (uint32_t i = 0; i < 10'000; ++i) items.push_back({64, 64, 0, 10 + i % 7});
  const Placement placement = pack(items);
  EXPECT_EQ(placement.heap_bytes, 640'000u);
  EXPECT_EQ(placement.heap_bytes, placement.lower_bound_bytes);
}

// More than 4,000,000 pairs meet. An allocator that looks at what is free does best with items of one size, and well with others.
TEST(Packing, CrowdsThatComeAndGo) {
  for (const bool even : {true, false}) {
    std::mt19937 random(7);
    std::vector<Item> items;
    for (uint32_t i = 0; i < 4'200; ++i)
      items.push_back({even ? 4096 : 256 * (1 + random() % 64), 256, i, i + 1300 + static_cast<uint32_t>(random() % 600)});
    const Placement placement = pack(items);
    EXPECT_EQ(placement.lower_bound_bytes, greatest_live_sum(items));
    EXPECT_EQ(find_fault(items, placement), std::nullopt);
    EXPECT_LE(placement.heap_bytes, even ? placement.lower_bound_bytes : placement.lower_bound_bytes * 6 / 5);
  }
}

// The exact search finds every optimum and refutes one byte less.
TEST(Packing, FitFindsTheOptimumAndProvesThatNothingIsBetter) {
  for (uint32_t seed = 0; seed < 150; ++seed) {
    const std::vector<Item> items = random_items(seed, 3 + seed % 5, 6, 8, {1, 2});
    const uint64_t optimum = brute_force(items);
    const Fit found = fit(items, optimum, 1'000'000);
    ASSERT_TRUE(found.fits) << "seed " << seed;
    ASSERT_EQ(find_fault(items, found.placement), std::nullopt) << "seed " << seed;
    ASSERT_LE(found.placement.heap_bytes, optimum) << "seed " << seed;
    const Fit refused = fit(items, optimum - 1, 1'000'000);
    ASSERT_FALSE(refused.fits) << "seed " << seed;
    ASSERT_TRUE(refused.proven) << "seed " << seed;
  }
}

// A rectangle cut across and along until there are `count` pieces: they fit together again, without a gap.
std::vector<Item> cut_rectangle(uint32_t seed, size_t count) {
  std::mt19937 random(seed);
  std::vector<Item> pieces = {{1 << 20, 1, 0, 1 << 12}};
  while (pieces.size() < count) {
    Item& piece = pieces[random() % pieces.size()];
    Item other = piece;
    if (random() % 2 == 0 && piece.bytes > 1) {
      other.bytes = 1 + random() % (piece.bytes - 1);
      piece.bytes -= other.bytes;
    } else if (piece.end - piece.begin > 1) {
      other.end = piece.end, piece.end = other.begin = piece.begin + 1 + random() % (piece.end - piece.begin - 1);
    } else {
      continue;
    }
    pieces.push_back(other);
  }
  return pieces;
}

TEST(Packing, PiecesOfARectangleFitTogetherAgain) {
  for (uint32_t seed = 0; seed < 10; ++seed) {
    const std::vector<Item> pieces = cut_rectangle(seed, 30);
    const Fit found = fit(pieces, 1 << 20, 50'000'000);
    ASSERT_TRUE(found.fits) << "seed " << seed;
    ASSERT_EQ(find_fault(pieces, found.placement), std::nullopt) << "seed " << seed;
  }
}

}  // namespace
}  // namespace rg::packing
