#include <algorithm>
#include <cmath>

#include "compiler/segment_graph.h"

namespace rg::compiler {
namespace {

// xorshift64: small, fast, and the same everywhere.
struct Random {
  uint64_t state = 1;
  uint32_t below(uint32_t n) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<uint32_t>((state >> 32) * n >> 32);
  }
  double unit() { return static_cast<double>(below(1u << 24)) / (1u << 24); }
};

class Annealer {
 public:
  Annealer(const SegmentProblem& problem, const Segments& start, uint32_t count, uint64_t seed)
      : problem_(problem),
        before_(predecessors(problem)),
        after_(successors(problem)),
        segments_(start),
        live_(count),
        items_of_(problem.nodes),
        stamp_(problem.items.size()),
        random_{seed * 0x9E3779B97F4A7C15} {
    for (uint32_t i = 0; i < problem.items.size(); ++i) {
      for (const uint32_t user : problem.items[i].users) items_of_[user].push_back(i);
      intervals_.push_back(interval_of(problem.items[i], segments_));
      weights_.push_back(static_cast<double>(problem.items[i].bytes));
      for (uint32_t s = intervals_[i].begin; s <= intervals_[i].end; ++s) live_[s] += weights_[i];
    }
    best_ = segments_, best_peak_ = std::max(1.0, *std::max_element(live_.begin(), live_.end()));
    inverse_ = 1 / best_peak_;
  }

  Segments run(uint64_t evaluations) {
    const uint64_t first = evaluations * 3 / 10;
    cool(first);
    segments_ = best_;
    count_live();
    squeeze(evaluations - first);
    return best_;
  }

 private:
  // All segments near the peak at once, smoothly.
  void cool(uint64_t evaluations) {
    constexpr double kHot = 0.5, kCold = 0.0005;
    for (uint64_t i = 0; i < evaluations; ++i) {
      const double progress = static_cast<double>(i) / static_cast<double>(evaluations);
      if ((i & 1023) == 0) heat_ = kHot * std::pow(kCold / kHot, progress), rescale();
      step();
    }
    rescale();
  }

  // Only what is above a target counts, so that everything else drifts freely; the target falls whenever it is met. Boundaries that drift left
  // without use go where it is tight.
  void squeeze(uint64_t evaluations) {
    constexpr double kHeat = 0.003;
    squeezes_ = true, heat_ = kHeat;
    lower_target();
    for (uint64_t i = 0; i < evaluations; ++i) {
      if ((i & 255) == 0) {
        if (note_peak()) lower_target();
        if ((i & 4095) == 0) move_boundary();
        find_hot_nodes(target_);
      }
      step();
    }
    note_peak();
  }
  void lower_target() {
    constexpr double kStep = 0.01;
    target_ = best_peak_ * (1 - kStep);
    inverse_ = 1 / std::max(1.0, target_);
  }
  bool note_peak() {
    const double peak = *std::max_element(live_.begin(), live_.end());
    if (peak >= best_peak_) return false;
    best_peak_ = peak, best_ = segments_;
    return true;
  }

  void count_live() {
    std::fill(live_.begin(), live_.end(), 0.0);
    for (uint32_t i = 0; i < problem_.items.size(); ++i) {
      intervals_[i] = interval_of(problem_.items[i], segments_);
      for (uint32_t s = intervals_[i].begin; s <= intervals_[i].end; ++s) live_[s] += weights_[i];
    }
  }

  // Joins two segments that neither an edge nor the target keeps apart and opens an empty one beside a segment that is too full. O(problem).
  void move_boundary() {
    const auto count = static_cast<uint32_t>(live_.size());
    std::vector<double> begins(count);
    for (uint32_t i = 0; i < intervals_.size(); ++i) begins[intervals_[i].begin] += weights_[i];
    std::vector<bool> tied(count);
    for (uint32_t node = 0; node < problem_.nodes; ++node)
      for (const auto& link : after_.of(node)) tied[segments_[node]] = tied[segments_[node]] || (link.gap == 1 && segments_[link.node] == segments_[node] + 1);
    std::vector<uint32_t> spare, full;
    for (uint32_t s = 0; s < count; ++s) {
      if (s + 1 < count && !tied[s] && live_[s] + begins[s + 1] <= target_) spare.push_back(s);
      if (live_[s] > target_) full.push_back(s);
    }
    if (spare.empty() || full.empty()) return;
    const uint32_t join = spare[random_.below(static_cast<uint32_t>(spare.size()))], tight = full[random_.below(static_cast<uint32_t>(full.size()))];
    if (tight == join || tight == join + 1) return;
    const uint32_t empty = (tight > join ? tight - 1 : tight) + random_.below(2);
    for (uint32_t& segment : segments_) {
      segment -= segment > join;
      segment += segment >= empty;
    }
    count_live();
  }

  // A high power weighs segments near the peak and still keeps slopes elsewhere, so that a full segment's neighbours empty too.
  double energy(double live) const {
    const double x = live * inverse_;
    if (squeezes_) return std::max(0.0, x - 1);
    const double x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8;
    return x16 * x16;
  }
  void rescale() {
    const double peak = *std::max_element(live_.begin(), live_.end());
    if (peak < best_peak_) best_peak_ = peak, best_ = segments_;
    inverse_ = 1 / std::max(1.0, best_peak_);
    find_hot_nodes(0.9 * peak);
  }
  // Those whose moves can lower a segment above the threshold.
  void find_hot_nodes(double threshold) {
    hot_.clear();
    for (uint32_t i = 0; i < intervals_.size(); ++i) {
      const auto begin = live_.begin() + intervals_[i].begin, end = live_.begin() + intervals_[i].end + 1;
      if (*std::max_element(begin, end) > threshold) hot_.insert(hot_.end(), problem_.items[i].users.begin(), problem_.items[i].users.end());
    }
  }
  uint32_t pick_node() { return !hot_.empty() && random_.below(4) != 0 ? hot_[random_.below(static_cast<uint32_t>(hot_.size()))] : random_.below(problem_.nodes); }

  uint32_t pick_target(uint32_t node) {
    uint32_t low = 0, high = static_cast<uint32_t>(live_.size()) - 1;
    for (const auto& link : before_.of(node)) low = std::max(low, segments_[link.node] + link.gap);
    for (const auto& link : after_.of(node)) high = std::min(high, segments_[link.node] - link.gap);
    if (low < high && random_.below(4) != 0) return low + random_.below(high - low + 1);
    if (random_.below(2)) return std::min(high + 1, static_cast<uint32_t>(live_.size()) - 1);  // pushes its successors
    return low > 0 ? low - 1 : low;                                                            // pushes its predecessors
  }

  void step() {
    const uint32_t node = pick_node(), target = pick_target(node);
    if (target == segments_[node]) return;
    moved_.clear();
    if (!push(node, target)) return undo_segments();
    const double change = apply();
    if (change > 0 && random_.unit() >= std::exp(-change / heat_)) return undo();
    note_best();
  }

  // Moves node to target, and neighbours that are in the way, in both directions. False: does not fit.
  bool push(uint32_t node, uint32_t target) {
    if (target >= live_.size() || moved_.size() >= kMostPushed) return false;
    const bool later = target > segments_[node];
    moved_.push_back({node, segments_[node]});
    segments_[node] = target;
    for (const auto& link : (later ? after_ : before_).of(node)) {
      if (later && segments_[link.node] < target + link.gap && !push(link.node, target + link.gap)) return false;
      if (!later && segments_[link.node] + link.gap > target && (target < link.gap || !push(link.node, target - link.gap))) return false;
    }
    return true;
  }
  void undo_segments() {
    for (size_t i = moved_.size(); i-- > 0;) segments_[moved_[i].node] = moved_[i].from;
  }

  double apply() {
    ++mark_;
    touched_.clear();
    double change = 0;
    for (const auto& [node, from] : moved_)
      for (const uint32_t item : items_of_[node]) {
        if (stamp_[item] == mark_) continue;
        stamp_[item] = mark_;
        const SegmentInterval now = interval_of(problem_.items[item], segments_);
        touched_.push_back({item, intervals_[item]});
        change += replace(item, now);
      }
    return change;
  }
  void undo() {
    undo_segments();
    for (size_t i = touched_.size(); i-- > 0;) replace(touched_[i].item, touched_[i].was);
  }

  double add(uint32_t begin, uint32_t end, double weight) {  // half-open
    double change = 0;
    for (uint32_t s = begin; s < end; ++s) {
      change += energy(live_[s] + weight) - energy(live_[s]);
      live_[s] += weight;
    }
    return change;
  }
  double replace(uint32_t item, SegmentInterval now) {
    const SegmentInterval was = intervals_[item];
    const double weight = weights_[item];
    intervals_[item] = now;
    double change = 0;
    if (now.begin > was.end || now.end < was.begin) return add(was.begin, was.end + 1, -weight) + add(now.begin, now.end + 1, weight);
    if (now.begin < was.begin) change += add(now.begin, was.begin, weight);
    if (now.begin > was.begin) change += add(was.begin, now.begin, -weight);
    if (now.end > was.end) change += add(was.end + 1, now.end + 1, weight);
    if (now.end < was.end) change += add(now.end + 1, was.end + 1, -weight);
    return change;
  }

  void note_best() {
    if (live_.size() > 64 || squeezes_) return;  // a sweep costs more than the move; others look regularly
    const double peak = *std::max_element(live_.begin(), live_.end());
    if (peak < best_peak_) best_peak_ = peak, best_ = segments_;
  }

  static constexpr size_t kMostPushed = 64;
  struct Moved {
    uint32_t node, from;
  };
  struct Touched {
    uint32_t item;
    SegmentInterval was;
  };
  const SegmentProblem& problem_;
  SegmentLinks before_, after_;
  Segments segments_, best_;
  std::vector<double> live_, weights_;
  std::vector<std::vector<uint32_t>> items_of_;
  std::vector<SegmentInterval> intervals_;
  std::vector<uint64_t> stamp_;
  Random random_;
  std::vector<Moved> moved_;
  std::vector<Touched> touched_;
  std::vector<uint32_t> hot_;
  uint64_t mark_ = 0;
  double inverse_ = 1, heat_ = 0, best_peak_ = 0, target_ = 0;
  bool squeezes_ = false;
};

}  // namespace

Segments anneal_segments(const SegmentProblem& problem, const Segments& start, uint32_t count, uint64_t evaluations, uint64_t seed) {
  if (problem.nodes == 0 || problem.items.empty()) return start;
  return Annealer(problem, start, count, seed).run(evaluations);
}

}  // namespace rg::compiler
