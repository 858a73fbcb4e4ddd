#include <algorithm>
#include <cmath>
#include <numeric>

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

// Lists of numbers by row, one after the other.
struct Lists {
  std::vector<uint32_t> first, values;
  std::span<const uint32_t> of(uint32_t row) const { return {values.data() + first[row], first[row + 1] - first[row]}; }
};

class Annealer {
 public:
  Annealer(const SegmentProblem& problem, const Segments& start, uint32_t count, uint64_t seed)
      : problem_(problem),
        before_(predecessors(problem)),
        after_(successors(problem)),
        segments_(start),
        live_(count),
        energy_(count),
        stamp_(problem.items.size()),
        random_{seed * 0x9E3779B97F4A7C15},
        sweep_every_(std::max<uint64_t>(256, problem.nodes / 40)),
        long_move_(uint64_t{2} * count > problem.nodes ? 1024 : SIZE_MAX) {
    list_users();
    for (const auto& item : problem.items) weights_.push_back(static_cast<double>(item.bytes));
    intervals_.resize(problem.items.size());
    count_live();
    best_ = segments_, best_peak_ = std::max(1.0, *std::max_element(live_.begin(), live_.end()));
    set_scale(best_peak_);
  }

  Segments run(uint64_t evaluations, bool warm) {
    const uint64_t first = warm ? 0 : evaluations * 6 / 10;
    if (!warm) cool(first);
    segments_ = best_;
    count_live();
    squeeze(evaluations - first);
    return best_;
  }

  // What else keeps the peak: `evaluations` moves that nothing but the peak holds back.
  Segments drift(uint64_t evaluations) {
    squeezes_ = true, heat_ = kHeat;
    target_ = best_peak_;
    set_scale(target_);
    const auto keep = [&] {
      if (*std::max_element(live_.begin(), live_.end()) <= target_) best_ = segments_;
    };
    for (uint64_t i = 1, spent = 0; spent < evaluations; ++i) {
      spent += step();
      if (i % sweep_every_ == 0) keep();
    }
    keep();
    return best_;
  }

 private:
  void list_users() {
    users_.first.push_back(0);
    items_of_.first.assign(problem_.nodes + 1, 0);
    for (const auto& item : problem_.items) {
      users_.values.insert(users_.values.end(), item.users.begin(), item.users.end());
      users_.first.push_back(static_cast<uint32_t>(users_.values.size()));
      for (const uint32_t user : item.users) ++items_of_.first[user + 1];
    }
    std::partial_sum(items_of_.first.begin(), items_of_.first.end(), items_of_.first.begin());
    items_of_.values.resize(users_.values.size());
    std::vector<uint32_t> next(items_of_.first.begin(), items_of_.first.end() - 1);
    for (uint32_t i = 0; i < problem_.items.size(); ++i)
      for (const uint32_t user : users_.of(i)) items_of_.values[next[user]++] = i;
  }
  SegmentInterval interval(uint32_t item) const {
    SegmentInterval result;
    for (const uint32_t user : users_.of(item))
      result.begin = std::min(result.begin, segments_[user]), result.end = std::max(result.end, segments_[user]);
    return result;
  }

  // All segments near the peak at once, smoothly.
  void cool(uint64_t evaluations) {
    constexpr double kHot = 0.5, kCold = 0.0005;
    for (uint64_t i = 0, spent = 0; spent < evaluations; ++i) {
      const double progress = static_cast<double>(spent) / static_cast<double>(evaluations);
      if (i % (4 * sweep_every_) == 0) heat_ = kHot * std::pow(kCold / kHot, progress), rescale();
      spent += step();
    }
    rescale();
  }

  // Only what is above a target counts, so that everything else drifts freely; the target falls whenever it is met. Boundaries that drift left
  // without use go where it is tight.
  void squeeze(uint64_t evaluations) {
    squeezes_ = true, heat_ = kHeat;
    lower_target();
    for (uint64_t i = 0, spent = 0; spent < evaluations; ++i) {
      if (i % sweep_every_ == 0) {
        if (note_peak()) lower_target();
        move_boundary();
        find_hot_nodes(target_);
      }
      spent += step();
    }
    note_peak();
  }
  void lower_target() {
    constexpr double kStep = 0.01;
    target_ = best_peak_ * (1 - kStep);
    set_scale(target_);
  }
  bool note_peak() {
    const double peak = *std::max_element(live_.begin(), live_.end());
    if (peak >= best_peak_) return false;
    best_peak_ = peak, best_ = segments_;
    return true;
  }

  void count_live() {
    std::vector<double> change(live_.size() + 1);  // whole bytes, whose sums are exact
    for (uint32_t i = 0; i < problem_.items.size(); ++i) {
      intervals_[i] = interval(i);
      change[intervals_[i].begin] += weights_[i], change[intervals_[i].end + 1] -= weights_[i];
    }
    std::partial_sum(change.begin(), change.end() - 1, live_.begin());
    count_energy();
  }
  void set_scale(double peak) {
    inverse_ = 1 / std::max(1.0, peak);
    count_energy();
  }
  void count_energy() {
    for (size_t s = 0; s < live_.size(); ++s) energy_[s] = energy(live_[s]);
  }

  // Joins two segments that neither an edge nor the target keeps apart and opens an empty one beside a segment that is too full. O(problem).
  void move_boundary() {
    const auto count = static_cast<uint32_t>(live_.size());
    std::vector<double> begins(count);
    for (uint32_t i = 0; i < intervals_.size(); ++i) begins[intervals_[i].begin] += weights_[i];
    std::vector<bool> tied(count);
    for (uint32_t node = 0; node < problem_.nodes; ++node)
      for (const auto& link : after_.of(node))
        tied[segments_[node]] = tied[segments_[node]] || (link.gap == 1 && segments_[link.node] == segments_[node] + 1);
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
    set_scale(best_peak_);
    find_hot_nodes(0.9 * peak);
  }
  // Those whose moves can lower a segment above the threshold.
  void find_hot_nodes(double threshold) {
    full_before_.assign(live_.size() + 1, 0);
    for (size_t s = 0; s < live_.size(); ++s) full_before_[s + 1] = full_before_[s] + (live_[s] > threshold);
    hot_.clear();
    for (uint32_t i = 0; i < intervals_.size(); ++i) {
      if (full_before_[intervals_[i].end + 1] == full_before_[intervals_[i].begin]) continue;
      const auto users = users_.of(i);
      hot_.insert(hot_.end(), users.begin(), users.end());
    }
  }
  uint32_t pick_node() {
    return !hot_.empty() && random_.below(4) != 0 ? hot_[random_.below(static_cast<uint32_t>(hot_.size()))] : random_.below(problem_.nodes);
  }

  uint32_t pick_target(uint32_t node) {
    uint32_t low = 0, high = static_cast<uint32_t>(live_.size()) - 1;
    for (const auto& link : before_.of(node)) low = std::max(low, segments_[link.node] + link.gap);
    for (const auto& link : after_.of(node)) high = std::min(high, segments_[link.node] - link.gap);
    if (low < high && random_.below(4) != 0) return low + random_.below(high - low + 1);
    if (random_.below(2)) return std::min(high + 1, static_cast<uint32_t>(live_.size()) - 1);  // pushes its successors
    return low > 0 ? low - 1 : low;                                                            // pushes its predecessors
  }

  // Gives what it counts for: one, and in a chain more where items of a thousand segments move, so that a move that takes long is one of few.
  uint64_t step() {
    const uint32_t node = pick_node(), target = pick_target(node);
    if (target == segments_[node]) return 1;
    moved_.clear();
    if (!push(node, target)) return undo_segments(), 1;
    const double change = apply();
    const uint64_t counts = changes_ < long_move_ ? 1 : changes_ / (long_move_ / 2);
    if (change > 0 && (change > kHopeless * heat_ || random_.unit() >= std::exp(-change / heat_)))
      undo();
    else
      note_best();
    return counts;
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
    touched_.clear(), changes_ = 0;
    double change = 0;
    for (const auto& [node, from] : moved_)
      for (const uint32_t item : items_of_.of(node)) {
        if (stamp_[item] == mark_) continue;
        stamp_[item] = mark_;
        const SegmentInterval now = interval(item);
        if (now.begin == intervals_[item].begin && now.end == intervals_[item].end) continue;
        touched_.push_back({item, intervals_[item]});
        change += replace(item, now);
      }
    return change;
  }
  void undo() {
    undo_segments();
    for (const Touched& touched : touched_) intervals_[touched.item] = touched.was;
    for (size_t i = changes_; i-- > 0;) live_[changed_[i].segment] = changed_[i].live, energy_[changed_[i].segment] = changed_[i].energy;
  }

  double add(uint32_t begin, uint32_t end, double weight) {                                           // half-open
    if (changed_.size() < changes_ + (end - begin)) changed_.resize(2 * (changes_ + (end - begin)));  // never cleared: most moves log a few rows
    Changed* log = changed_.data() + changes_;
    changes_ += end - begin;
    double *live = live_.data(), *energies = energy_.data(), change = 0;
    for (uint32_t s = begin; s < end; ++s, ++log) {
      const double was = energies[s], now = energy(live[s] + weight);
      *log = {s, live[s], was};
      live[s] += weight, energies[s] = now;
      change += now - was;
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

  static constexpr size_t kMostPushed = 16;
  static constexpr double kHeat = 0.003, kHopeless = 20;  // of the squeeze; heats above which a move is not tried
  struct Moved {
    uint32_t node, from;
  };
  struct Touched {
    uint32_t item;
    SegmentInterval was;
  };
  struct Changed {
    uint32_t segment;
    double live, energy;
  };
  const SegmentProblem& problem_;
  SegmentLinks before_, after_;
  Segments segments_, best_;
  std::vector<double> live_, energy_, weights_;  // by segment; by item
  Lists users_, items_of_;                       // by item; by node
  std::vector<SegmentInterval> intervals_;
  std::vector<uint64_t> stamp_;
  Random random_;
  uint64_t sweep_every_;  // moves between looks at the whole problem, which then take no more than a share of the time
  size_t long_move_;      // rows that a move changes and counts as one; where most nodes have a segment of their own, moves are few and go far
  std::vector<Moved> moved_;
  std::vector<Touched> touched_;
  std::vector<Changed> changed_;
  size_t changes_ = 0;  // rows of `changed_` that count
  std::vector<uint32_t> hot_, full_before_;
  uint64_t mark_ = 0;
  double inverse_ = 1, heat_ = 0, best_peak_ = 0, target_ = 0;
  bool squeezes_ = false;
};

}  // namespace

Segments anneal_segments(const SegmentProblem& problem, const Segments& start, uint32_t count, uint64_t evaluations, uint64_t seed, bool warm) {
  if (problem.nodes == 0 || problem.items.empty()) return start;
  return Annealer(problem, start, count, seed).run(evaluations, warm);
}

Segments drift_segments(const SegmentProblem& problem, const Segments& start, uint64_t evaluations, uint64_t seed) {
  if (problem.nodes == 0 || problem.items.empty()) return start;
  const uint32_t count = *std::max_element(start.begin(), start.end()) + 1;
  return Annealer(problem, start, count, seed).drift(evaluations);
}

}  // namespace rg::compiler
