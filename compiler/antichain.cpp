#include "compiler/antichain.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace rg::compiler {
namespace {

constexpr uint64_t kUnlimited = std::numeric_limits<uint64_t>::max() / 4;

// Maximum flow by Dinic: rounds of a breadth-first levelling and augmentation along level edges, without recursion.
class Flow {
 public:
  explicit Flow(size_t nodes) : first_(nodes, kEnd) {}

  void add(uint32_t from, uint32_t to, uint64_t capacity) {
    push(from, to, capacity);
    push(to, from, 0);
  }

  uint64_t maximum(uint32_t source, uint32_t sink) {
    uint64_t total = 0;
    while (find_levels(source, sink)) {
      next_ = first_;
      while (const uint64_t pushed = augment(source, sink)) total += pushed;
    }
    return total;
  }

 private:
  static constexpr uint32_t kEnd = std::numeric_limits<uint32_t>::max();
  struct Arc {
    uint32_t to = 0, next = kEnd;
    uint64_t capacity = 0;
  };

  void push(uint32_t from, uint32_t to, uint64_t capacity) {
    arcs_.push_back({to, first_[from], capacity});
    first_[from] = static_cast<uint32_t>(arcs_.size() - 1);
  }

  bool find_levels(uint32_t source, uint32_t sink) {
    level_.assign(first_.size(), kEnd);
    level_[source] = 0;
    std::vector<uint32_t> queue{source};
    for (size_t head = 0; head < queue.size(); ++head) {
      for (uint32_t arc = first_[queue[head]]; arc != kEnd; arc = arcs_[arc].next) {
        const uint32_t to = arcs_[arc].to;
        if (arcs_[arc].capacity == 0 || level_[to] != kEnd) continue;
        level_[to] = level_[queue[head]] + 1;
        queue.push_back(to);
      }
    }
    return level_[sink] != kEnd;
  }

  // One path from source to sink along rising levels; dead ends are not entered again in this round.
  uint64_t augment(uint32_t source, uint32_t sink) {
    path_.clear();
    uint32_t node = source;
    while (node != sink) {
      uint32_t& arc = next_[node];
      while (arc != kEnd && (arcs_[arc].capacity == 0 || level_[arcs_[arc].to] != level_[node] + 1)) arc = arcs_[arc].next;
      if (arc != kEnd) {
        path_.push_back(arc);
        node = arcs_[arc].to;
        continue;
      }
      if (path_.empty()) return 0;
      level_[node] = kEnd;
      node = arcs_[path_.back() ^ 1].to;
      path_.pop_back();
    }
    uint64_t least = kUnlimited;
    for (const uint32_t arc : path_) least = std::min(least, arcs_[arc].capacity);
    for (const uint32_t arc : path_) arcs_[arc].capacity -= least, arcs_[arc ^ 1].capacity += least;
    return least;
  }

  std::vector<uint32_t> first_, level_, next_, path_;
  std::vector<Arc> arcs_;
};

// Without edges that two others imply; the order stays. O(edges * nodes / 64).
std::vector<std::pair<uint32_t, uint32_t>> without_implied(uint32_t count, std::span<const std::pair<uint32_t, uint32_t>> edges) {
  const size_t words = (count + 63) / 64;
  std::vector<uint64_t> after(count * words), implied(words);
  std::vector<std::vector<uint32_t>> next(count);
  for (const auto& [from, to] : edges) after[from * words + to / 64] |= uint64_t{1} << (to % 64), next[from].push_back(to);
  std::vector<std::pair<uint32_t, uint32_t>> kept;
  for (uint32_t from = 0; from < count; ++from) {
    std::fill(implied.begin(), implied.end(), 0);
    for (const uint32_t over : next[from])
      for (size_t w = 0; w < words; ++w) implied[w] |= after[over * words + w];
    for (const uint32_t to : next[from])
      if (!(implied[to / 64] >> (to % 64) & 1)) kept.emplace_back(from, to);
  }
  return kept;
}

}  // namespace

uint64_t max_weight_antichain(std::span<const uint64_t> weights, std::span<const std::pair<uint32_t, uint32_t>> edges) {
  const uint32_t count = static_cast<uint32_t>(weights.size());
  const auto in = [](uint32_t node) { return 2 * node; };
  const auto out = [](uint32_t node) { return 2 * node + 1; };
  const uint32_t source = 2 * count, sink = source + 1;
  Flow flow(2 * size_t{count} + 2);
  for (uint32_t node = 0; node < count; ++node) {
    if (weights[node] > 0) flow.add(source, out(node), weights[node]), flow.add(in(node), sink, weights[node]);
    flow.add(in(node), out(node), kUnlimited);  // an order may pass through
  }
  for (const auto& [before, after] : without_implied(count, edges)) flow.add(out(before), in(after), kUnlimited);
  return std::accumulate(weights.begin(), weights.end(), uint64_t{0}) - flow.maximum(source, sink);
}

}  // namespace rg::compiler
