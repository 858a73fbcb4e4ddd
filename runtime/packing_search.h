// Exact packing of lives into a given capacity: depth first over canonical placements, in which items are placed by rising offset and each lies on
// what lives with it. Complete: where it ends without a placement, there is none.
//
// After Moffitt, "MiniMalloc: A Lightweight Memory Allocator for Hardware-Accelerated Machine Learning" (ASPLOS 2023): canonical order, bounds by
// section, dominance and decomposition are its; restarts that favour items of sections which failed follow Boussemart et al., "Boosting Systematic
// Search by Weighting Constraints" (ECAI 2004).
//
// Exponential in the worst case; a node costs O(conflicts of the item + sections it reaches * items alive in one).
#pragma once

#include "runtime/packing_values.h"

namespace rg::packing::detail {

class Search {
 public:
  enum class Answer : uint8_t { fits, does_not_fit, gave_up };

  Search(std::span<const Item> items, uint64_t capacity) : capacity_(static_cast<int64_t>(capacity)) {
    const Load load = load_of(items);
    const size_t sections = load.live.size() - 1;
    for (const Item& item : items) {
      begin_.push_back(static_cast<uint32_t>(load.at(item.begin))), end_.push_back(static_cast<uint32_t>(load.at(item.end)));
      bytes_.push_back(static_cast<int64_t>(item.bytes)), alignment_.push_back(static_cast<int64_t>(item.alignment));
    }
    list_alive(sections);
    weight_.assign(sections, 0);
    std::vector<Conflict> pairs;
    for_each_meeting_pair(items, [&](uint32_t a, uint32_t b) { return pairs.emplace_back(a, b), true; });
    neighbours_ = neighbours(items.size(), pairs);
  }

  // `order`: what to prefer among items that can lie equally low. `weighted`: items of sections that failed in earlier runs come first.
  Answer run(Order order, bool weighted, uint64_t work_limit) {
    if (weighted) favour_failures(order);
    reset(std::move(order));
    work_limit_ = work_limit;
    return split(0, static_cast<uint32_t>(weight_.size()), by_rank_, {});
  }

  uint64_t work() const { return work_; }  // of the last run
  std::vector<uint64_t> offsets() const { return {offset_.begin(), offset_.end()}; }

 private:
  static constexpr int64_t kPlaced = std::numeric_limits<int64_t>::max() / 4;
  struct Undo {
    int64_t* where;
    int64_t value;
  };
  struct Candidate {
    int64_t offset = 0;
    uint32_t rank = 0;
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
  };

  void list_alive(size_t sections) {
    alive_first_.assign(sections + 1, 0);
    for (size_t i = 0; i < begin_.size(); ++i)
      for (uint32_t s = begin_[i]; s < end_[i]; ++s) ++alive_first_[s + 1];
    std::partial_sum(alive_first_.begin(), alive_first_.end(), alive_first_.begin());
    alive_.resize(alive_first_.back());
    std::vector<uint32_t> next(alive_first_.begin(), alive_first_.end() - 1);
    for (uint32_t i = 0; i < begin_.size(); ++i)
      for (uint32_t s = begin_[i]; s < end_[i]; ++s) alive_[next[s]++] = i;
  }

  void favour_failures(Order& order) const {
    std::vector<uint64_t> weight(order.size());
    for (uint32_t i = 0; i < weight.size(); ++i) weight[i] = *std::max_element(weight_.begin() + begin_[i], weight_.begin() + end_[i]);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return weight[a] > weight[b]; });
  }

  void reset(Order order) {
    const size_t count = order.size(), sections = weight_.size();
    by_rank_ = std::move(order);
    rank_.resize(count);
    for (uint32_t r = 0; r < count; ++r) rank_[by_rank_[r]] = r;
    lowest_.assign(count, 0), offset_.assign(count, 0);
    floor_.assign(sections, 0), remaining_.assign(sections, 0), crossing_.assign(sections + 1, 0);
    for (size_t i = 0; i < count; ++i) {
      for (uint32_t s = begin_[i]; s < end_[i]; ++s) remaining_[s] += bytes_[i];
      for (uint32_t s = begin_[i] + 1; s < end_[i]; ++s) ++crossing_[s];
    }
    trail_.clear();
    work_ = 0;
  }

  // Unplaced items of sections [low, high), by rank. Where none of them crosses a time, both sides are independent.
  Answer split(uint32_t low, uint32_t high, const std::vector<uint32_t>& items, Candidate last) {
    std::vector<uint32_t> part;
    for (uint32_t from = low, to = low + 1; from < high; from = to++) {
      while (to < high && crossing_[to] != 0) ++to;
      if (from == low && to == high) return place_next(low, high, items, last);
      part.clear();
      for (const uint32_t i : items)
        if (begin_[i] >= from && begin_[i] < to) part.push_back(i);
      const Answer answer = place_next(from, to, part, last);
      if (answer != Answer::fits) return answer;
    }
    return Answer::fits;
  }

  // Every item that may come next in a canonical placement, lowest first.
  std::vector<Candidate> candidates(const std::vector<uint32_t>& items, Candidate last) const {
    // Whoever lies at or above the top of an item that could still be placed leaves room to slide that item under it: no need to try.
    int64_t ceiling = kPlaced;
    for (const uint32_t i : items) ceiling = std::min(ceiling, lowest_[i] + bytes_[i]);
    std::vector<Candidate> result;
    for (const uint32_t i : items)
      if (lowest_[i] < ceiling && Candidate{lowest_[i], rank_[i]} >= last) result.push_back({lowest_[i], rank_[i]});
    std::sort(result.begin(), result.end());
    return result;
  }

  Answer place_next(uint32_t low, uint32_t high, const std::vector<uint32_t>& items, Candidate last) {
    if (items.empty()) return Answer::fits;
    std::vector<uint32_t> rest;
    rest.reserve(items.size());
    for (const Candidate& candidate : candidates(items, last)) {
      work_ += items.size() / 4 + 1;
      if (work_ > work_limit_) return Answer::gave_up;
      const uint32_t item = by_rank_[candidate.rank];
      const size_t mark = trail_.size();
      if (place(item, candidate.offset, low, high)) {
        rest.clear();
        std::copy_if(items.begin(), items.end(), std::back_inserter(rest), [&](uint32_t i) { return i != item; });
        for (uint32_t s = begin_[item] + 1; s < end_[item]; ++s) --crossing_[s];
        const Answer answer = split(low, high, rest, candidate);
        if (answer != Answer::does_not_fit) return answer;
        for (uint32_t s = begin_[item] + 1; s < end_[item]; ++s) ++crossing_[s];
      }
      undo(mark);
    }
    return Answer::does_not_fit;
  }

  // False, with the weight of the section raised, if some section cannot hold what is left for it. Whatever comes later lies at `offset` or above.
  bool place(uint32_t item, int64_t offset, uint32_t low, uint32_t high) {
    const int64_t top = offset + bytes_[item];
    offset_[item] = offset;
    set(lowest_[item], kPlaced);
    for (uint32_t s = begin_[item]; s < end_[item]; ++s) set(remaining_[s], remaining_[s] - bytes_[item]);
    uint32_t left = begin_[item], right = end_[item];
    for (const uint32_t other : neighbours_.of(item)) {
      if (lowest_[other] >= top) continue;
      set(lowest_[other], align_up_signed(top, alignment_[other]));
      left = std::min(left, begin_[other]), right = std::max(right, end_[other]);
    }
    work_ += (neighbours_.of(item).size() + (alive_first_[right] - alive_first_[left]) / 2 + (high - low) / 8) / 8;
    for (uint32_t s = left; s < right; ++s) raise_floor(s);
    if (top > capacity_) return false;
    for (uint32_t s = low; s < high; ++s) {
      if (remaining_[s] == 0 || std::max(floor_[s], offset) + remaining_[s] <= capacity_) continue;
      ++weight_[s];
      return false;
    }
    return true;
  }

  // Nothing unplaced in a section lies lower than the lowest of it can.
  void raise_floor(uint32_t s) {
    if (remaining_[s] == 0) return;
    int64_t floor = kPlaced;
    for (uint32_t k = alive_first_[s]; k < alive_first_[s + 1]; ++k) floor = std::min(floor, lowest_[alive_[k]]);
    if (floor != floor_[s]) set(floor_[s], floor);
  }

  static int64_t align_up_signed(int64_t value, int64_t alignment) { return (value + alignment - 1) / alignment * alignment; }
  void set(int64_t& where, int64_t value) {
    trail_.push_back({&where, where});
    where = value;
  }
  void undo(size_t mark) {
    for (; trail_.size() > mark; trail_.pop_back()) *trail_.back().where = trail_.back().value;
  }

  int64_t capacity_;
  Neighbours neighbours_;
  std::vector<uint32_t> begin_, end_;          // sections of an item
  std::vector<uint32_t> alive_first_, alive_;  // items of a section
  std::vector<int64_t> bytes_, alignment_;     // by item
  std::vector<int64_t> lowest_, offset_;       // by item: least offset on what is placed, kPlaced afterwards; the place
  std::vector<int64_t> floor_, remaining_;     // by section: least offset of what is unplaced, its bytes
  std::vector<uint32_t> crossing_;             // by time: unplaced items alive before and after
  std::vector<uint64_t> weight_;               // by section: failures
  Order by_rank_, rank_;
  std::vector<Undo> trail_;
  uint64_t work_ = 0, work_limit_ = 0;
};

}  // namespace rg::packing::detail
