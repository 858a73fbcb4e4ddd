// Values of the heap packer, and what its stages share: who conflicts, how much lives when, in which order to look at items.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
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

namespace detail {

// xorshift64: small, fast, and the same everywhere.
struct Random {
  uint64_t state = 0x9E3779B97F4A7C15;
  uint32_t below(uint32_t n) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<uint32_t>((state >> 32) * n >> 32);
  }
};

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

// Beyond this many pairs the conflict lists cost more than they are worth; see packing_crowd.h.
inline constexpr size_t kMostPairs = 4'000'000;

inline uint64_t align_up(uint64_t value, uint64_t alignment) { return (value + alignment - 1) / alignment * alignment; }

// Live bytes at each distinct time, for bounds and orders.
struct Load {
  std::vector<uint32_t> times;  // sorted begins and ends
  std::vector<uint64_t> live;   // in [times[i], times[i + 1])
  std::vector<uint32_t> index;  // by time, where times are so dense that a table is small
  uint64_t peak = 0;
  size_t at(uint32_t time) const {
    return !index.empty() ? index[time] : static_cast<size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin());
  }
};
inline void list_times(std::span<const Item> items, Load& load) {
  uint32_t last = 0;
  for (const Item& item : items) last = std::max(last, item.end);
  if (last < 4 * items.size() + 64) {
    load.index.assign(last + size_t{1}, 0);
    for (const Item& item : items) load.index[item.begin] = load.index[item.end] = 1;
    for (uint32_t time = 0; time <= last; ++time)
      if (load.index[time]) load.index[time] = static_cast<uint32_t>(load.times.size()), load.times.push_back(time);
    return;
  }
  for (const Item& item : items) load.times.insert(load.times.end(), {item.begin, item.end});
  std::sort(load.times.begin(), load.times.end());
  load.times.erase(std::unique(load.times.begin(), load.times.end()), load.times.end());
}
inline Load load_of(std::span<const Item> items) {
  Load load;
  list_times(items, load);
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

inline Measures measures_of(std::span<const Item> items) {
  Measures m;
  m.load = greatest_load(items, load_of(items));
  for (const Item& item : items) {
    m.size.push_back(item.bytes);
    m.width.push_back(item.end - item.begin);
    m.area.push_back(item.bytes * (item.end - item.begin));
  }
  return m;
}

}  // namespace detail
}  // namespace rg::packing
