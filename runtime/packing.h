// The heap packer: places items with known lifetimes, sizes and alignments into the smallest heap it can find.
//
//   bytes                     An item occupies [offset, offset + bytes) while it lives, [begin, end).
//     ^   +-------+           Items that live at the same time must not share bytes.
//     |   |   b   +---+
//     |   +---+---+ c |       Lower bound: the greatest sum of bytes living at one time. It is reached almost always,
//     |   | a |   |   |       and then the placement is proven to be optimal.
//     +---+---+---+---+--> time
//
// Method, stage by stage, each ending it all at the lower bound:
//   1. decode "lowest offset first": always place the item whose lowest legal offset is smallest, ties by a static order; two orders,
//      a third where conflicts are given
//   2. repair by ejection (packing_ejection.h) at the bound and at capacities between it and the best, for three quarters of the effort
//   3. exact search (packing_search.h) at such capacities for the rest, where effort is large enough to set it up
// Where millions of pairs would conflict nothing of this is tried: packing_crowd.h.
// Deterministic: effort counts work, never time. Cost: O(conflicts * log n) a decode.
//
// Header only, standard library only: compiler and runtime place with the same code.
#pragma once

#include <functional>

#include "runtime/packing_crowd.h"
#include "runtime/packing_ejection.h"
#include "runtime/packing_search.h"
#include "runtime/packing_values.h"

namespace rg::packing {

// Conflicts looked at in all; about 10 ns each. Stages that always run may exceed it.
inline constexpr uint64_t kDefaultEffort = 2'000'000;
// About a millisecond: for placing again while a frame waits, at creation and resize.
inline constexpr uint64_t kPlacementEffort = 100'000;

namespace detail {

inline uint64_t top_of(std::span<const Item> items, const std::vector<uint64_t>& offsets) {
  uint64_t top = 0;
  for (size_t i = 0; i < items.size(); ++i) top = std::max(top, offsets[i] + items[i].bytes);
  return top;
}

inline constexpr uint64_t kFirstShare = 1000;  // an item: enough for most

class Packer {
 public:
  // `by_lives`: the conflicts are those of items whose lives meet.
  Packer(std::span<const Item> items, const std::vector<Conflict>& conflicts, bool by_lives, uint64_t lower_bound, uint64_t effort)
      : items_(items), neighbours_(neighbours(items.size(), conflicts)), by_lives_(by_lives), bound_(lower_bound), effort_(effort) {
    best_.lower_bound_bytes = lower_bound;
    best_.heap_bytes = std::numeric_limits<uint64_t>::max();
  }

  Placement run() {
    if (items_.empty()) return {{}, 0, bound_};
    const size_t n = items_.size();
    const auto [T, Z, W, A] = measures_of(items_);
    decode_lowest_first(sorted(n, {&T, &A, &W}));
    if (!done()) decode_lowest_first(sorted(n, {&T, &W, &A}));
    if (!done() && !by_lives_) {  // what load is to lives
      const std::vector<uint64_t> met = bytes_met();
      decode_lowest_first(sorted(n, {&met, &A}));
    }
    if (!done()) repair();
    return std::move(best_);
  }

 private:
  bool done() const { return best_.heap_bytes <= bound_; }

  void keep(const std::vector<uint64_t>& offsets, uint64_t heap) {
    if (heap < best_.heap_bytes) best_.offsets = offsets, best_.heap_bytes = heap;
  }

  std::vector<uint64_t> bytes_met() const {
    std::vector<uint64_t> met(items_.size());
    for (uint32_t i = 0; i < items_.size(); ++i)
      for (const uint32_t other : neighbours_.of(i)) met[i] += items_[other].bytes;
    return met;
  }

  // Of all unplaced items, the one that can lie lowest; gives up where it cannot beat the best.
  void decode_lowest_first(const Order& order) {
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
      if (top >= best_.heap_bytes) return;
      raise_neighbours(item, end);
    }
    keep(offsets_, top);
  }
  struct Candidate {
    uint64_t offset = 0;
    uint32_t rank = 0;
  };
  static bool later(const Candidate& a, const Candidate& b) { return a.offset != b.offset ? a.offset > b.offset : a.rank > b.rank; }

  void raise_neighbours(uint32_t item, uint64_t end) {
    for (const uint32_t other : neighbours_.of(item)) {
      if (placed_[other] || offsets_[other] >= end) continue;
      offsets_[other] = align_up(end, items_[other].alignment);
      heap_.push_back({offsets_[other], rank_[other]});
      std::push_heap(heap_.begin(), heap_.end(), later);
    }
  }

  // At the bound, then between it and the best, again and again with more effort. The first steps are the same whatever the effort: more is never
  // worse.
  void repair() {
    Ejection ejection(items_, neighbours_);
    std::vector<uint64_t> offsets;
    for (uint64_t work = 0, share = kFirstShare * items_.size();; share *= 2) {
      for (const uint64_t quarters : {0, 2, 3}) {
        if (done() || work >= effort_) return;
        const uint64_t capacity = bound_ + (best_.heap_bytes - bound_ - 1) / 4 * quarters;
        offsets = best_.offsets;
        if (ejection.run(offsets, capacity, std::min(share, effort_ - work))) keep(offsets, top_of(items_, offsets));
        work += ejection.work() + 1;
      }
    }
  }

  std::span<const Item> items_;
  Neighbours neighbours_;
  bool by_lives_;
  uint64_t bound_, effort_;
  Placement best_;
  Order rank_;
  std::vector<uint64_t> offsets_;
  std::vector<char> placed_;
  std::vector<Candidate> heap_;
};

// Restarted exact search at one capacity: every order plain and with favoured failures, in turn, with growing limits.
class Fitting {
 public:
  Fitting(std::span<const Item> items, uint64_t capacity) : search_(2, Search(items, capacity)), orders_(search_orders(items)) {}

  Search::Answer run(uint64_t effort) {
    const uint64_t round = 250 * (orders_.front().size() + 50);
    for (uint64_t plain = round, weighted = round / 2;; plain *= 2, weighted += weighted / 4) {
      for (const bool favour : {true, false}) {
        for (const Order& order : orders_) {
          if (work_ >= effort) return Search::Answer::gave_up;
          const Search::Answer answer = search_[favour].run(order, favour, std::min(favour ? weighted : plain, effort - work_));
          work_ += search_[favour].work() + 1;
          if (answer == Search::Answer::fits) offsets_ = search_[favour].offsets();
          if (answer != Search::Answer::gave_up) return answer;
        }
      }
    }
  }
  uint64_t work() const { return work_; }
  std::vector<uint64_t>& offsets() { return offsets_; }

 private:
  // By load, conflicts, life and area: none is best everywhere.
  static std::vector<Order> search_orders(std::span<const Item> items) {
    const auto [T, Z, W, A] = measures_of(items);
    std::vector<uint64_t> meets(items.size());
    for_each_meeting_pair(items, [&](uint32_t a, uint32_t b) { return ++meets[a], ++meets[b], true; });
    const size_t n = items.size();
    return {sorted(n, {&T, &meets}), sorted(n, {&W, &A, &T}), sorted(n, {&T, &A, &W}), sorted(n, {&T, &W, &A})};
  }

  std::vector<Search> search_;  // plain; with weights
  std::vector<Order> orders_;
  std::vector<uint64_t> offsets_;
  uint64_t work_ = 0;
};

// Beyond this many items a node of the exact search costs too much; below this much effort an item, setting it up does.
inline constexpr size_t kMostSearched = 2000;
inline constexpr uint64_t kLeastSearchEffort = 4000;

// Looks for a placement below `best`. Less room is not always harder to search, because bounds then cut more: so the bound itself is tried first and
// the room between in several steps, again and again with more effort.
inline void search_below(std::span<const Item> items, Placement& best, uint64_t effort) {
  uint64_t spent = 0, least = best.lower_bound_bytes;  // nothing below `least` is possible
  for (uint64_t share = std::max<uint64_t>(effort / 32, 1);; share *= 2) {
    for (const uint64_t sixteenths : {0, 4, 8, 12, 15}) {
      if (spent >= effort || best.heap_bytes <= least) return;
      const uint64_t capacity = least + (best.heap_bytes - least - 1) / 16 * sixteenths;
      Fitting fitting(items, capacity);
      const Search::Answer answer = fitting.run(std::min(share, effort - spent));
      spent += fitting.work() + items.size();
      if (answer == Search::Answer::does_not_fit) least = capacity + 1;
      if (answer == Search::Answer::fits) best.offsets = std::move(fitting.offsets()), best.heap_bytes = top_of(items, best.offsets);
    }
  }
}

}  // namespace detail

// Greatest sum of bytes that live at one time. O(n log n).
inline uint64_t lower_bound(std::span<const Item> items) { return detail::load_of(items).peak; }

// Items conflict where their lives meet.
inline Placement pack(std::span<const Item> items, uint64_t effort = kDefaultEffort) {
  if (items.size() > detail::kMostSearched && detail::count_meeting_pairs(items) > detail::kMostPairs / 4)
    if (Placement swept = detail::sweep_crowd(items, detail::load_of(items)); swept.heap_bytes == swept.lower_bound_bytes) return swept;
  std::vector<Conflict> pairs;
  const bool listed = detail::for_each_meeting_pair(items, [&](uint32_t a, uint32_t b) {
    pairs.emplace_back(a, b);
    return pairs.size() < detail::kMostPairs;
  });
  if (!listed) return detail::pack_crowd(items, effort);
  const bool searched = items.size() <= detail::kMostSearched && effort >= detail::kLeastSearchEffort * items.size();
  const uint64_t repairs = searched ? effort / 4 * 3 : effort;
  Placement best = detail::Packer(items, pairs, true, lower_bound(items), repairs).run();
  if (searched) detail::search_below(items, best, effort - repairs);
  return best;
}

// A placement of `capacity` bytes at most. `proven`: there is none if the placement is empty; else the effort ran out.
struct Fit {
  Placement placement;
  bool fits = false, proven = false;
};
inline Fit fit(std::span<const Item> items, uint64_t capacity, uint64_t effort) {
  const uint64_t bound = lower_bound(items);
  if (items.empty() || bound > capacity) return {{{}, 0, bound}, items.empty(), true};
  detail::Fitting fitting(items, capacity);
  const auto answer = fitting.run(effort);
  if (answer != detail::Search::Answer::fits) return {{{}, 0, bound}, false, answer == detail::Search::Answer::does_not_fit};
  return {{fitting.offsets(), detail::top_of(items, fitting.offsets()), bound}, true, true};
}

// Items conflict where `conflicts` says so, whatever their lives, which then serve as hints. Every pair whose lives meet should be among them:
// the lower bound assumes it. `known_bound`: what conflicts say beyond that; no less than any item.
inline Placement pack(std::span<const Item> items, const std::vector<Conflict>& conflicts, uint64_t effort = kDefaultEffort,
                      uint64_t known_bound = 0) {
  return detail::Packer(items, conflicts, false, std::max(lower_bound(items), known_bound), effort).run();
}

}  // namespace rg::packing
