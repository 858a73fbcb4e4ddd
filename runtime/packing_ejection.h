// Repair of a placement that is too high: what sticks out of the capacity is taken out and put back in, one by one, each where it drives out what is
// easiest to place elsewhere; what is driven out waits for its turn. Whatever found no free place becomes harder to drive out itself.
//
// Guided ejection search, after Nagata and Braysy, "A Powerful Route Minimization Heuristic for the Vehicle Routing Problem with Time Windows"
// (Operations Research Letters 2009). Incomplete: it ends with a placement or gives up. A step costs O(conflicts * log) of one item, however many
// items there are, so a few bad places of a large heap are repaired where decoders would start from nothing each time.
#pragma once

#include "runtime/packing_values.h"

namespace rg::packing::detail {

class Ejection {
 public:
  Ejection(std::span<const Item> items, const Neighbours& neighbours)
      : items_(items), neighbours_(neighbours), offset_(items.size()), penalty_(items.size(), 1), placed_(items.size()) {}

  // Makes `offsets` fit into `capacity`, or leaves them alone.
  bool run(std::vector<uint64_t>& offsets, uint64_t capacity, uint64_t effort) {
    start(offsets, capacity);
    for (work_ = 0; !out_.empty() && work_ < effort;) put_in(take_hardest());
    if (out_.empty()) offsets = offset_;
    return out_.empty();
  }
  uint64_t work() const { return work_; }  // of the last run

 private:
  // Offsets, counted in alignments of the item: bits 23 and up. Then 0 where a neighbour ends, 1 where one begins; then which.
  using Mark = uint64_t;
  static constexpr uint32_t kPlaceBits = 23, kBegins = 1u << 22;

  void start(const std::vector<uint64_t>& offsets, uint64_t capacity) {
    capacity_ = capacity, offset_ = offsets;
    out_.clear();
    for (uint32_t i = 0; i < items_.size(); ++i) {
      placed_[i] = offset_[i] + items_[i].bytes <= capacity_;
      if (!placed_[i]) out_.push_back(i);
    }
  }

  uint32_t take_hardest() {
    const auto hardness = [&](uint32_t item) { return penalty_[item] * items_[item].bytes; };
    const auto hardest = std::max_element(out_.begin(), out_.end(), [&](uint32_t a, uint32_t b) { return hardness(a) < hardness(b); });
    const uint32_t item = *hardest;
    *hardest = out_.back();
    out_.pop_back();
    return item;
  }

  void put_in(uint32_t item) {
    const uint64_t begin = find_place(item), end = begin + items_[item].bytes;
    bool is_free = true;
    for (const uint32_t other : neighbours_.of(item)) {
      if (!placed_[other] || offset_[other] >= end || offset_[other] + items_[other].bytes <= begin) continue;
      placed_[other] = 0, is_free = false;
      out_.push_back(other);
    }
    penalty_[item] += !is_free;
    offset_[item] = begin, placed_[item] = 1;
  }

  // The offset at which what lies in the way weighs least, any of several. A neighbour lies in the way of offsets between its begin less the item's
  // bytes, and its end, both exclusive; rounding them to the item's alignment changes nothing for offsets that are aligned.
  uint64_t find_place(uint32_t item) {
    const auto [size, alignment, life_begin, life_end] = items_[item];
    const uint64_t highest = (capacity_ - size) / alignment;
    const std::span<const uint32_t> others = neighbours_.of(item);
    marks_.assign({0, highest << kPlaceBits}), weights_.assign(1, 0);
    uint64_t weight = 0;
    for (const uint32_t other : others) {
      if (!placed_[other]) continue;
      const uint64_t begin = offset_[other], end = (begin + items_[other].bytes + alignment - 1) / alignment,
                     own = penalty_[other] * (1 + neighbours_.of(other).size());
      if (begin >= size && (begin - size) / alignment <= highest)
        marks_.push_back((begin - size) / alignment << kPlaceBits | kBegins | weights_.size());
      else if (begin < size)
        weight += own;
      if (end <= highest) marks_.push_back(end << kPlaceBits | weights_.size());
      weights_.push_back(own);
    }
    work_ += others.size() + 2 * marks_.size() + 8;
    std::sort(marks_.begin(), marks_.end());
    return lightest(weight) * alignment;
  }
  uint64_t lightest(uint64_t weight) {
    uint64_t least = std::numeric_limits<uint64_t>::max(), place = 0;
    uint32_t equals = 0;
    for (size_t i = 0; i < marks_.size();) {
      const uint64_t at = marks_[i] >> kPlaceBits;
      for (; i < marks_.size() && marks_[i] >> kPlaceBits == at && !(marks_[i] & kBegins); ++i) weight -= weights_[marks_[i] & (kBegins - 1)];
      if (weight <= least) {
        equals = weight < least ? 1 : equals + 1;
        least = weight;
        if (random_.below(equals) == 0) place = at;
      }
      for (; i < marks_.size() && marks_[i] >> kPlaceBits == at; ++i) weight += weights_[marks_[i] & (kBegins - 1)];
    }
    return place;
  }

  std::span<const Item> items_;
  const Neighbours& neighbours_;
  uint64_t capacity_ = 0;
  std::vector<uint64_t> offset_, penalty_;
  std::vector<char> placed_;
  std::vector<uint32_t> out_;
  std::vector<Mark> marks_;
  std::vector<uint64_t> weights_;  // of neighbours in the way; the first is nobody's
  Random random_;
  uint64_t work_ = 0;
};

}  // namespace rg::packing::detail
