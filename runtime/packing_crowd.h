// Part of packing.h: many items that live together, without a list of who meets whom.
#pragma once

#include <functional>
#include <map>
#include <queue>

#include "runtime/packing_values.h"

namespace rg::packing::detail {

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

// Both decodes of crowds do without conflict lists. In the order given, each item on the highest of what lives with it:
inline Placement stack_crowd(std::span<const Item> items, const Load& load, const Order& order) {
  Placement placement{std::vector<uint64_t>(items.size()), 0, load.peak};
  Skyline skyline(load.times.size());
  for (const uint32_t i : order) {
    const size_t begin = load.at(items[i].begin), end = load.at(items[i].end);
    placement.offsets[i] = align_up(skyline.highest(begin, end), items[i].alignment);
    skyline.raise(begin, end, placement.offsets[i] + items[i].bytes);
    placement.heap_bytes = std::max(placement.heap_bytes, placement.offsets[i] + items[i].bytes);
  }
  return placement;
}

// Lowest offset first. Offsets only rise, so an item is looked at again only when it is the lowest by what was known; gives nothing where items would
// be looked at more than `looks` times in all, as they are where everything lives together.
inline Placement decode_crowd(std::span<const Item> items, const Load& load, const Order& order, size_t looks) {
  Placement placement{std::vector<uint64_t>(items.size()), 0, load.peak};
  Skyline skyline(load.times.size());
  std::vector<std::pair<uint64_t, uint32_t>> heap;  // offset, rank
  for (uint32_t rank = 0; rank < order.size(); ++rank) heap.emplace_back(0, rank);
  for (; !heap.empty() && looks > 0; --looks) {
    std::pop_heap(heap.begin(), heap.end(), std::greater<>());
    const uint32_t item = order[heap.back().second];
    const size_t begin = load.at(items[item].begin), end = load.at(items[item].end);
    const uint64_t offset = align_up(skyline.highest(begin, end), items[item].alignment);
    if (offset != heap.back().first) {
      heap.back().first = offset;
      std::push_heap(heap.begin(), heap.end(), std::greater<>());
      continue;
    }
    heap.pop_back();
    skyline.raise(begin, end, offset + items[item].bytes);
    placement.offsets[item] = offset;
    placement.heap_bytes = std::max(placement.heap_bytes, offset + items[item].bytes);
  }
  if (!heap.empty()) placement.heap_bytes = std::numeric_limits<uint64_t>::max();
  return placement;
}

// Bytes that are free at one moment: what lies between those in use, as offset and size, and all from `top` on.
class FreeBytes {
 public:
  // The lowest place that fits.
  uint64_t take(uint64_t bytes, uint64_t alignment) {
    for (auto gap = gaps_.begin(); gap != gaps_.end(); ++gap) {
      const auto [offset, size] = *gap;
      const uint64_t begin = align_up(offset, alignment);
      if (begin + bytes > offset + size) continue;
      if (begin == offset)
        gaps_.erase(gap);
      else
        gap->second = begin - offset;
      if (offset + size > begin + bytes) gaps_[begin + bytes] = offset + size - begin - bytes;
      return begin;
    }
    const uint64_t begin = align_up(top_, alignment);
    if (begin > top_) gaps_[top_] = begin - top_;
    top_ = begin + bytes;
    return begin;
  }
  void give(uint64_t offset, uint64_t bytes) {
    auto next = gaps_.lower_bound(offset);
    if (next != gaps_.end() && offset + bytes == next->first) bytes += next->second, next = gaps_.erase(next);
    if (next != gaps_.begin())
      if (auto before = std::prev(next); before->first + before->second == offset)
        offset = before->first, bytes += before->second, gaps_.erase(before);
    if (offset + bytes == top_)
      top_ = offset;
    else
      gaps_[offset] = bytes;
  }

 private:
  std::map<uint64_t, uint64_t> gaps_;
  uint64_t top_ = 0;
};

// As an allocator would do it that knows nothing of what comes: each item, when its life begins or, backwards, ends, at the lowest place that is
// free. With items of one size nothing is better. O(n log n + n * gaps).
inline Placement sweep_crowd(std::span<const Item> items, const Load& load, bool forward) {
  Placement placement{std::vector<uint64_t>(items.size()), 0, load.peak};
  const auto begins = [&](uint32_t i) { return forward ? int64_t{items[i].begin} : -int64_t{items[i].end}; };
  const auto ends = [&](uint32_t i) { return forward ? int64_t{items[i].end} : -int64_t{items[i].begin}; };
  Order order(items.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return std::pair(begins(a), items[b].bytes) < std::pair(begins(b), items[a].bytes); });
  FreeBytes free;
  std::priority_queue<std::pair<int64_t, uint32_t>, std::vector<std::pair<int64_t, uint32_t>>, std::greater<>> alive;  // by end
  for (const uint32_t i : order) {
    for (; !alive.empty() && alive.top().first <= begins(i); alive.pop())
      free.give(placement.offsets[alive.top().second], items[alive.top().second].bytes);
    placement.offsets[i] = free.take(items[i].bytes, items[i].alignment);
    placement.heap_bytes = std::max(placement.heap_bytes, placement.offsets[i] + items[i].bytes);
    alive.emplace(ends(i), i);
  }
  return placement;
}

// Of items whose lives meet. O(n log n).
inline uint64_t count_meeting_pairs(std::span<const Item> items) {
  std::vector<uint32_t> begins, ends;
  for (const Item& item : items) begins.push_back(item.begin), ends.push_back(item.end);
  std::sort(begins.begin(), begins.end()), std::sort(ends.begin(), ends.end());
  uint64_t pairs = 0;
  for (size_t begun = 0, ended = 0; begun < begins.size(); ++begun) {
    while (ended < ends.size() && ends[ended] <= begins[begun]) ++ended;
    pairs += begun - std::min(begun, ended);
  }
  return pairs;
}

inline Placement sweep_crowd(std::span<const Item> items, const Load& load) {
  Placement forward = sweep_crowd(items, load, true);
  if (forward.heap_bytes == load.peak) return forward;
  Placement backward = sweep_crowd(items, load, false);
  return backward.heap_bytes < forward.heap_bytes ? std::move(backward) : std::move(forward);
}

// Looks at each item for a part of the effort on it: a decode that does not end by then seldom ends soon.
inline Placement pack_crowd(std::span<const Item> items, uint64_t effort) {
  const Load load = load_of(items);
  const auto [T, Z, W, A] = measures_of(items);
  const size_t n = items.size(), looks = std::clamp<size_t>(effort / 16, 16 * n, 256 * n);
  Placement best = sweep_crowd(items, load);
  const auto keep = [&](Placement placement) {
    if (placement.heap_bytes < best.heap_bytes) best = std::move(placement);
  };
  for (const Order& order : {sorted(n, {&T, &A, &W}), sorted(n, {&T, &W, &A}), sorted(n, {&A}), sorted(n, {&W, &A, &T})}) {
    if (best.heap_bytes > load.peak) keep(stack_crowd(items, load, order));
    if (best.heap_bytes > load.peak) keep(decode_crowd(items, load, order, looks));
  }
  return best;
}

}  // namespace rg::packing::detail
