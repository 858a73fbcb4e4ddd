// One value a queue. Most things stay on the queue where they begin, so that one lies apart and the rest is usually empty.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace rg::verify {

template <class T>
class ByQueue {
 public:
  explicit ByQueue(uint32_t home = 0) : home_(home) {}
  const T& get(uint32_t queue) const {
    static const T kNothing{};
    if (queue == home_) return value_;
    for (const auto& [other, value] : others_)
      if (other == queue) return value;
    return kNothing;
  }
  T& at(uint32_t queue) {
    if (queue == home_) return value_;
    for (auto& [other, value] : others_)
      if (other == queue) return value;
    return others_.emplace_back(queue, T{}).second;
  }
  // visit(queue, value), home first, the others as they came.
  template <class Visit>
  void each(Visit visit) const {
    visit(home_, value_);
    for (const auto& [queue, value] : others_) visit(queue, value);
  }

 private:
  uint32_t home_ = 0;
  T value_{};
  std::vector<std::pair<uint32_t, T>> others_;
};

}  // namespace rg::verify
