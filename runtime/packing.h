// The heap packer: places items with known lifetimes, sizes and alignments into the smallest heap it can find.
//
//   bytes                     An item occupies [offset, offset + bytes) while it lives, [begin, end).
//     ^   +-------+           Items that live at the same time must not share bytes.
//     |   |   b   +---+
//     |   +---+---+ c |       Lower bound: the greatest sum of bytes living at one time. It is reached almost always,
//     |   | a |   |   |       and then the placement is proven to be optimal.
//     +---+---+---+---+--> time
//
// Method (measured against every published planner we know of): decode "lowest offset first": always place the item whose lowest legal offset
// is smallest, ties by a static order; eight orders; then first and best fit by size, life and area; then swaps of ranks under a budget. Every stage
// stops at the lower bound. Deterministic: effort counts work, never time. Cost: O(conflicts * log n) a decode.
//
// Header only, standard library only: compiler and runtime place with the same code.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace rg::packing {

struct Item {
  uint64_t bytes = 0;
  uint64_t alignment = 1;       // any positive number
  uint32_t begin = 0, end = 1;  // half-open life; begin < end
};
using Conflict = std::pair<uint32_t, uint32_t>;  // two items that must not share bytes, in any order

struct Placement {
  std::vector<uint64_t> offsets;  // by item
  uint64_t heap_bytes = 0, lower_bound_bytes = 0;
};

// Conflicts looked at in all; about 10 ns each. Stages that always run may exceed it.
inline constexpr uint64_t kDefaultEffort = 2'000'000;

namespace detail {

// Items that conflict with each item, as flat lists.
struct Neighbours {
  std::vector<size_t> first;
  std::vector<uint32_t> items;
  std::span<const uint32_t> of(uint32_t item) const { return {items.data() + first[item], first[item + 1] - first[item]}; }
};

inline Neighbours neighbours(size_t count, const std::vector<Conflict>& conflicts) {
  Neighbours result;
  result.first.assign(count + 1, 0);
  for (const auto& [a, b] : conflicts) ++result.first[a + 1], ++result.first[b + 1];
  for (size_t i = 0; i < count; ++i) result.first[i + 1] += result.first[i];
  result.items.resize(conflicts.size() * 2);
  std::vector<size_t> next(result.first.begin(), result.first.end() - 1);
  for (const auto& [a, b] : conflicts) result.items[next[a]++] = b, result.items[next[b]++] = a;
  return result;
}

// Items by begin, and visits each pair whose lives meet until `visit` gives false. O(n log n + pairs).
template <class Visit>
bool for_each_meeting_pair(std::span<const Item> items, Visit visit) {
  std::vector<uint32_t> by_begin(items.size());
  std::iota(by_begin.begin(), by_begin.end(), 0u);
  std::stable_sort(by_begin.begin(), by_begin.end(), [&](uint32_t a, uint32_t b) { return items[a].begin < items[b].begin; });
  std::vector<uint32_t> alive;
  for (const uint32_t item : by_begin) {
    std::erase_if(alive, [&](uint32_t other) { return items[other].end <= items[item].begin; });
    for (const uint32_t other : alive)
      if (!visit(other, item)) return false;
    alive.push_back(item);
  }
  return true;
}

// Beyond this many pairs the conflict lists cost more than they are worth; see Skyline.
inline constexpr size_t kMostPairs = 4'000'000;

inline uint64_t align_up(uint64_t value, uint64_t alignment) { return (value + alignment - 1) / alignment * alignment; }

// Live bytes at each distinct time, for bounds and orders.
struct Load {
  std::vector<uint32_t> times;  // sorted begins and ends
  std::vector<uint64_t> live;   // in [times[i], times[i + 1])
  uint64_t peak = 0;
  size_t at(uint32_t time) const { return static_cast<size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin()); }
};
inline Load load_of(std::span<const Item> items) {
  Load load;
  for (const Item& item : items) load.times.insert(load.times.end(), {item.begin, item.end});
  std::sort(load.times.begin(), load.times.end());
  load.times.erase(std::unique(load.times.begin(), load.times.end()), load.times.end());
  std::vector<int64_t> change(load.times.size() + 1);
  for (const Item& item : items)
    change[load.at(item.begin)] += static_cast<int64_t>(item.bytes), change[load.at(item.end)] -= static_cast<int64_t>(item.bytes);
  int64_t now = 0;
  for (size_t i = 0; i < load.times.size(); ++i) {
    now += change[i];
    load.live.push_back(static_cast<uint64_t>(now));
    load.peak = std::max(load.peak, static_cast<uint64_t>(now));
  }
  return load;
}

// Greatest live sum over each item's life: T. A sparse table answers in O(1) after O(m log m).
inline std::vector<uint64_t> greatest_load(std::span<const Item> items, const Load& load) {
  std::vector<std::vector<uint64_t>> table{load.live};
  for (size_t width = 1; 2 * width <= load.live.size(); width *= 2) {
    const std::vector<uint64_t>& last = table.back();
    std::vector<uint64_t> next(last.size() - width);
    for (size_t i = 0; i < next.size(); ++i) next[i] = std::max(last[i], last[i + width]);
    table.push_back(std::move(next));
  }
  std::vector<uint64_t> result;
  for (const Item& item : items) {
    const size_t begin = load.at(item.begin), end = load.at(item.end);
    size_t level = 0;
    while (size_t{2} << level <= end - begin) ++level;
    result.push_back(std::max(table[level][begin], table[level][end - (size_t{1} << level)]));
  }
  return result;
}

struct Measures {
  std::vector<uint64_t> load, size, width, area;  // T, Z, W, A
};
using Order = std::vector<uint32_t>;

// Items by the named measures, greatest first, then by index.
inline Order sorted(size_t count, std::initializer_list<const std::vector<uint64_t>*> keys) {
  Order order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    for (const auto* key : keys)
      if ((*key)[a] != (*key)[b]) return (*key)[a] > (*key)[b];
    return false;
  });
  return order;
}

// Heights over time, for crowds: each item lies on the highest of what lives with it. O(log n) an item, whatever the number of pairs.
class Skyline {
 public:
  explicit Skyline(size_t times) : size_(std::max<size_t>(times, 1)), height_(4 * size_, 0), assigned_(4 * size_, 0) {}

  uint64_t highest(size_t begin, size_t end) const { return highest(1, 0, size_, begin, end); }
  void raise(size_t begin, size_t end, uint64_t height) { raise(1, 0, size_, begin, end, height); }

 private:
  uint64_t highest(size_t node, size_t low, size_t high, size_t begin, size_t end) const {
    if (end <= low || high <= begin) return 0;
    if (begin <= low && high <= end) return height_[node];
    const size_t middle = (low + high) / 2;
    const uint64_t below = std::max(highest(2 * node, low, middle, begin, end), highest(2 * node + 1, middle, high, begin, end));
    return std::max(assigned_[node], below);
  }
  // New heights are never below those they replace, so marks need not be pushed down: the greatest mark on the way counts.
  void raise(size_t node, size_t low, size_t high, size_t begin, size_t end, uint64_t height) {
    if (end <= low || high <= begin) return;
    height_[node] = std::max(height_[node], height);
    if (begin <= low && high <= end) {
      assigned_[node] = std::max(assigned_[node], height);
      return;
    }
    const size_t middle = (low + high) / 2;
    raise(2 * node, low, middle, begin, end, height);
    raise(2 * node + 1, middle, high, begin, end, height);
  }
  size_t size_;
  std::vector<uint64_t> height_, assigned_;
};

inline Placement pack_crowd(std::span<const Item> items) {
  const Load load = load_of(items);
  const std::vector<uint64_t> greatest = greatest_load(items, load);
  std::vector<uint64_t> area, early;
  for (const Item& item : items)
    area.push_back(item.bytes * (item.end - item.begin)), early.push_back(std::numeric_limits<uint32_t>::max() - item.begin);
  Placement best{{}, std::numeric_limits<uint64_t>::max(), load.peak};
  for (const Order& order : {sorted(items.size(), {&greatest, &area}), sorted(items.size(), {&early, &area}), sorted(items.size(), {&area})}) {
    Placement placement{std::vector<uint64_t>(items.size()), 0, load.peak};
    Skyline skyline(load.times.size());
    for (const uint32_t i : order) {
      const size_t begin = load.at(items[i].begin), end = load.at(items[i].end);
      placement.offsets[i] = align_up(skyline.highest(begin, end), items[i].alignment);
      skyline.raise(begin, end, placement.offsets[i] + items[i].bytes);
      placement.heap_bytes = std::max(placement.heap_bytes, placement.offsets[i] + items[i].bytes);
    }
    if (placement.heap_bytes < best.heap_bytes) best = std::move(placement);
  }
  return best;
}

class Packer {
 public:
  Packer(std::span<const Item> items, const std::vector<Conflict>& conflicts, uint64_t lower_bound, uint64_t effort)
      : items_(items), neighbours_(neighbours(items.size(), conflicts)), bound_(lower_bound), effort_(effort) {
    best_.lower_bound_bytes = lower_bound;
    best_.heap_bytes = std::numeric_limits<uint64_t>::max();
  }

  Placement run() {
    if (items_.empty()) return {{}, 0, bound_};
    const Measures m = measure();
    const size_t n = items_.size();
    const auto& [T, Z, W, A] = m;
    const Order skyline[] = {sorted(n, {&T, &A, &W}), sorted(n, {&T, &W, &A}), sorted(n, {&A}), sorted(n, {&Z}),
                             sorted(n, {&W, &A, &T}), sorted(n, {&T, &Z}),     sorted(n, {&W}), sorted(n, {&Z, &W})};
    for (const Order& order : skyline) {
      if (done()) return std::move(best_);
      if (decode_lowest_first(order)) best_order_ = order;
    }
    const Order fits[] = {sorted(n, {&Z}), sorted(n, {&W}), sorted(n, {&A}), sorted(n, {&T, &A, &W})};
    for (const Order& order : fits)
      for (const bool best_fit : {false, true})
        if (!done()) decode_fit(order, best_fit);
    search();
    return std::move(best_);
  }

 private:
  bool done() const { return best_.heap_bytes <= bound_; }

  Measures measure() const {
    const Load load = load_of(items_);
    Measures m;
    m.load = greatest_load(items_, load);
    for (const Item& item : items_) {
      m.size.push_back(item.bytes);
      m.width.push_back(item.end - item.begin);
      m.area.push_back(item.bytes * (item.end - item.begin));
    }
    return m;
  }

  bool keep(const std::vector<uint64_t>& offsets, uint64_t heap) {
    if (heap >= best_.heap_bytes) return false;
    best_.offsets = offsets, best_.heap_bytes = heap;
    return true;
  }

  // Of all unplaced items, the one that can lie lowest; gives up where it cannot beat the best.
  bool decode_lowest_first(const Order& order) {
    const size_t n = items_.size();
    rank_.resize(n), offsets_.assign(n, 0), placed_.assign(n, 0), heap_.clear();
    for (uint32_t i = 0; i < n; ++i) rank_[order[i]] = i;
    for (uint32_t i = 0; i < n; ++i) heap_.push_back({0, i});  // by rank: already a heap
    uint64_t top = 0;
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), later);
      const auto [offset, rank] = heap_.back();
      heap_.pop_back();
      const uint32_t item = order[rank];
      if (placed_[item] || offset != offsets_[item]) continue;
      placed_[item] = 1;
      const uint64_t end = offset + items_[item].bytes;
      top = std::max(top, end);
      if (top >= best_.heap_bytes) return false;
      raise_neighbours(item, end);
    }
    return keep(offsets_, top);
  }
  struct Candidate {
    uint64_t offset = 0;
    uint32_t rank = 0;
  };
  static bool later(const Candidate& a, const Candidate& b) { return a.offset != b.offset ? a.offset > b.offset : a.rank > b.rank; }

  void raise_neighbours(uint32_t item, uint64_t end) {
    const auto others = neighbours_.of(item);
    work_ += others.size() + 8;
    for (const uint32_t other : others) {
      if (placed_[other] || offsets_[other] >= end) continue;
      offsets_[other] = align_up(end, items_[other].alignment);
      heap_.push_back({offsets_[other], rank_[other]});
      std::push_heap(heap_.begin(), heap_.end(), later);
    }
  }

  // In a fixed order, each into the first or the tightest gap between its placed neighbours.
  void decode_fit(const Order& order, bool best_fit) {
    offsets_.assign(items_.size(), 0), placed_.assign(items_.size(), 0);
    uint64_t top = 0;
    for (const uint32_t item : order) {
      offsets_[item] = find_gap(item, best_fit);
      placed_[item] = 1;
      top = std::max(top, offsets_[item] + items_[item].bytes);
      if (top >= best_.heap_bytes) return;
    }
    keep(offsets_, top);
  }
  uint64_t find_gap(uint32_t item, bool best_fit) {
    taken_.clear();
    for (const uint32_t other : neighbours_.of(item))
      if (placed_[other]) taken_.emplace_back(offsets_[other], offsets_[other] + items_[other].bytes);
    work_ += taken_.size() * 4 + 8;
    std::sort(taken_.begin(), taken_.end());
    uint64_t floor = 0, chosen = 0, least = std::numeric_limits<uint64_t>::max();
    for (const auto& [begin, end] : taken_) {
      const uint64_t offset = align_up(floor, items_[item].alignment);
      if (begin >= offset + items_[item].bytes && begin - offset < least) {
        if (!best_fit) return offset;
        least = begin - offset, chosen = offset;
      }
      floor = std::max(floor, end);
    }
    return least == std::numeric_limits<uint64_t>::max() ? align_up(floor, items_[item].alignment) : chosen;
  }

  // Swaps two ranks of the best order, keeps what is not worse.
  void search() {
    if (best_order_.empty() || items_.size() < 3) return;
    Order order = best_order_;
    uint64_t state = 0x9E3779B97F4A7C15;
    const auto below = [&](uint32_t n) {
      state ^= state << 13, state ^= state >> 7, state ^= state << 17;
      return static_cast<uint32_t>((state >> 32) * n >> 32);
    };
    while (!done() && work_ < effort_) {
      const uint32_t a = below(static_cast<uint32_t>(order.size())), b = below(static_cast<uint32_t>(order.size()));
      std::swap(order[a], order[b]);
      work_ += order.size();
      if (!decode_lowest_first(order)) std::swap(order[a], order[b]);
    }
  }

  std::span<const Item> items_;
  Neighbours neighbours_;
  uint64_t bound_, effort_, work_ = 0;
  Placement best_;
  Order best_order_, rank_;
  std::vector<uint64_t> offsets_;
  std::vector<char> placed_;
  std::vector<Candidate> heap_;
  std::vector<std::pair<uint64_t, uint64_t>> taken_;
};

}  // namespace detail

// Greatest sum of bytes that live at one time. O(n log n).
inline uint64_t lower_bound(std::span<const Item> items) { return detail::load_of(items).peak; }

// Items conflict where their lives meet.
inline Placement pack(std::span<const Item> items, uint64_t effort = kDefaultEffort) {
  std::vector<Conflict> pairs;
  const bool listed = detail::for_each_meeting_pair(items, [&](uint32_t a, uint32_t b) {
    pairs.emplace_back(a, b);
    return pairs.size() < detail::kMostPairs;
  });
  if (!listed) return detail::pack_crowd(items);
  return detail::Packer(items, pairs, lower_bound(items), effort).run();
}

// Items conflict where `conflicts` says so, whatever their lives, which then serve as hints. Every pair whose lives meet should be among them:
// the lower bound assumes it.
inline Placement pack(std::span<const Item> items, const std::vector<Conflict>& conflicts, uint64_t effort = kDefaultEffort) {
  return detail::Packer(items, conflicts, lower_bound(items), effort).run();
}

}  // namespace rg::packing
