#include "compiler/spectrum/facility.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <set>

namespace rg::compiler {
namespace {

constexpr double kTiny = 1e-12;

// A candidate with the masks it serves.
struct Candidate {
  Mask set = 0;
  double cost = 0;
  std::vector<uint32_t> serves;  // indices of masks
};

class Search {
 public:
  explicit Search(const Facilities& problem) : p_(problem) {
    full_cost_ = p_.cost[p_.full()];
    lambda_.assign(p_.masks.size(), 0.0);
  }

  FacilityChoice run() {
    seed_pool();
    take(greedy());
    interchange();
    for (size_t i = 0; i < lambda_.size(); ++i) lambda_[i] = p_.weights[i] * serving_cost(i);
    bound_ = cheapest_service();
    for (int round = 0; round < kRounds && !closed(); ++round) {
      ascend(round);
      price();
      if (!closed()) interchange_from(selected_);
    }
    interchange();
    const bool enumerated = !closed() && enumerate();
    return {best_sets_, upper_, std::min(enumerated ? upper_ : bound_, upper_), enumerated || closed()};
  }

 private:
  static constexpr int kRounds = 5;
  static constexpr size_t kPoolLimit = 8000, kPriced = 1500, kAscentSteps[kRounds] = {50, 60, 60, 60, 80};
  static constexpr uint64_t kEnumerated = 200'000'000;

  bool closed() const { return upper_ - bound_ <= kTiny * upper_; }

  // ---- candidates

  void add_candidate(Mask set) {
    if (set == p_.full() || pool_.size() >= kPoolLimit || !known_.insert(set).second) return;
    Candidate candidate{set, p_.cost[set], {}};
    for (uint32_t i = 0; i < p_.masks.size(); ++i)
      if ((p_.masks[i] & ~set) == 0) candidate.serves.push_back(i);
    if (!candidate.serves.empty()) pool_.push_back(std::move(candidate));
  }

  void seed_pool() {
    std::vector<uint32_t> order(p_.masks.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return p_.weights[a] > p_.weights[b]; });
    constexpr size_t kHeavy = 1200, kPaired = 40;
    for (size_t i = 0; i < std::min(order.size(), kHeavy); ++i) add_candidate(p_.masks[order[i]]);
    for (size_t i = 0; i < std::min(order.size(), kPaired); ++i)
      for (size_t j = 0; j < i; ++j) add_candidate(p_.masks[order[i]] | p_.masks[order[j]]);
    for (uint32_t bit = 0; bit < p_.bits; ++bit) add_candidate(p_.full() & ~(Mask{1} << bit));
  }

  // ---- primal side

  double serving_cost(size_t i) const {
    double least = full_cost_;
    for (const Mask set : best_sets_)
      if ((p_.masks[i] & ~set) == 0) least = std::min(least, p_.cost[set]);
    return least;
  }

  double cheapest_service() const {
    double sum = 0;
    for (size_t i = 0; i < p_.masks.size(); ++i) sum += p_.weights[i] * p_.cost[p_.masks[i]];
    return sum;
  }

  void take(const std::vector<Mask>& sets) {
    const double value = expected_cost(p_, sets);
    if (value >= upper_) return;
    upper_ = value;
    best_sets_ = sets;
  }

  std::vector<Mask> greedy() const {
    std::vector<double> now(p_.masks.size(), full_cost_);
    std::vector<Mask> sets;
    while (sets.size() < p_.open) {
      const Candidate* best = nullptr;
      double best_gain = kTiny;
      for (const Candidate& candidate : pool_) {
        double gain = 0;
        for (const uint32_t i : candidate.serves) gain += p_.weights[i] * std::max(0.0, now[i] - candidate.cost);
        if (gain > best_gain) best_gain = gain, best = &candidate;
      }
      if (best == nullptr) break;
      sets.push_back(best->set);
      for (const uint32_t i : best->serves) now[i] = std::min(now[i], best->cost);
    }
    return sets;
  }

  // Exchanges one set for a candidate as long as that helps; first and second service of every mask make a pass linear in what candidates serve.
  void interchange() {
    constexpr int kPasses = 80;
    for (int pass = 0; pass < kPasses; ++pass)
      if (!exchange_best() && !tighten() && !look_around()) return;
  }

  // Candidates one feature away from the best sets; false if there were none that are new.
  bool look_around() {
    const size_t before = pool_.size();
    for (const Mask set : std::vector<Mask>(best_sets_))
      for (uint32_t bit = 0; bit < p_.bits; ++bit) add_candidate(set ^ Mask{1} << bit);
    return pool_.size() > before;
  }

  // Interchange from another start; the better end stays.
  void interchange_from(const std::vector<Mask>& sets) {
    const std::vector<Mask> known_sets = std::move(best_sets_);
    const double known = upper_;
    best_sets_ = sets;
    upper_ = expected_cost(p_, sets);
    interchange();
    if (upper_ < known) return;
    upper_ = known;
    best_sets_ = known_sets;
  }

  bool exchange_best() {
    const size_t count = best_sets_.size();
    std::vector<double> first(p_.masks.size(), full_cost_), second(p_.masks.size(), full_cost_);
    std::vector<size_t> by(p_.masks.size(), count);
    for (size_t i = 0; i < p_.masks.size(); ++i) {
      for (size_t s = 0; s < count; ++s) {
        if ((p_.masks[i] & ~best_sets_[s]) != 0) continue;
        const double c = p_.cost[best_sets_[s]];
        if (c < first[i])
          second[i] = first[i], first[i] = c, by[i] = s;
        else
          second[i] = std::min(second[i], c);
      }
    }
    std::vector<double> loss(count + 1, 0.0);  // of giving up each set; the last row: none is given up
    for (size_t i = 0; i < p_.masks.size(); ++i)
      if (by[i] < count) loss[by[i]] += p_.weights[i] * (second[i] - first[i]);
    double best_delta = -kTiny * upper_;
    size_t best_out = count;
    Mask best_in = 0;
    std::vector<double> delta(count + 1);
    for (const Candidate& candidate : pool_) {
      double gain = 0;
      delta = loss;
      for (const uint32_t i : candidate.serves) {
        if (candidate.cost < first[i]) {
          gain += p_.weights[i] * (first[i] - candidate.cost);
          if (by[i] < count) delta[by[i]] -= p_.weights[i] * (second[i] - first[i]);
        } else if (by[i] < count && candidate.cost < second[i]) {
          delta[by[i]] -= p_.weights[i] * (second[i] - candidate.cost);
        }
      }
      const size_t last = count < p_.open ? count + 1 : count;
      for (size_t out = count < p_.open ? count : 0; out < last; ++out)
        if (delta[out] - gain < best_delta) best_delta = delta[out] - gain, best_out = out, best_in = candidate.set;
    }
    if (best_delta >= -kTiny * upper_) return false;
    std::vector<Mask> sets = best_sets_;
    if (best_out < count)
      sets[best_out] = best_in;
    else
      sets.push_back(best_in);
    const double before = upper_;
    take(sets);
    return upper_ < before;
  }

  // Every set shrinks to the union of what it serves.
  bool tighten() {
    std::vector<Mask> unions(best_sets_.size(), 0);
    for (const Mask mask : p_.masks) {
      size_t best = best_sets_.size();
      double least = full_cost_;
      for (size_t s = 0; s < best_sets_.size(); ++s)
        if ((mask & ~best_sets_[s]) == 0 && p_.cost[best_sets_[s]] < least) least = p_.cost[best_sets_[s]], best = s;
      if (best < unions.size()) unions[best] |= mask;
    }
    const double before = upper_;
    for (const Mask set : unions) add_candidate(set);
    take(unions);
    return upper_ < before - kTiny * before;
  }

  // ---- dual side

  double gain_of(const Candidate& candidate) const {
    double gain = 0;
    for (const uint32_t i : candidate.serves) gain += std::max(0.0, lambda_[i] - p_.weights[i] * candidate.cost);
    return gain;
  }

  double full_gain() const {
    double gain = 0;
    for (size_t i = 0; i < p_.masks.size(); ++i) gain += std::max(0.0, lambda_[i] - p_.weights[i] * full_cost_);
    return gain;
  }

  // Largest first; `count` at most as many as there are candidates.
  std::vector<std::pair<double, uint32_t>> largest_gains(const std::vector<uint32_t>& candidates, size_t count) const {
    std::vector<std::pair<double, uint32_t>> gains;
    for (const uint32_t c : candidates) gains.emplace_back(gain_of(pool_[c]), c);
    std::partial_sort(gains.begin(), gains.begin() + static_cast<ptrdiff_t>(count), gains.end(),
                      [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
    gains.resize(count);
    return gains;
  }

  // Subgradient ascent over the most promising of the pool; keeps the multipliers of the best value seen, and what the relaxation selects as primal
  // candidates.
  void ascend(int round) {
    constexpr size_t kActive = 900;
    std::vector<uint32_t> active(pool_.size());
    std::iota(active.begin(), active.end(), 0u);
    const auto promising = largest_gains(active, std::min(kActive, active.size()));
    active.clear();
    for (const auto& [gain, candidate] : promising) active.push_back(candidate);
    std::vector<double> best = lambda_;
    double best_value = -std::numeric_limits<double>::infinity(), scale = 1.0;
    int idle = 0;
    for (size_t step = 0; step < kAscentSteps[round] && scale > 1e-3; ++step) {
      const auto gains = largest_gains(active, std::min<size_t>(p_.open, active.size()));
      double value = std::accumulate(lambda_.begin(), lambda_.end(), 0.0) - full_gain();
      std::vector<double> slack(p_.masks.size(), 1.0);
      std::vector<Mask> sets;
      for (const auto& [gain, index] : gains) {
        const Candidate& candidate = pool_[index];
        value -= gain;
        sets.push_back(candidate.set);
        for (const uint32_t i : candidate.serves) slack[i] -= p_.weights[i] * candidate.cost < lambda_[i];
      }
      for (size_t i = 0; i < slack.size(); ++i) slack[i] -= p_.weights[i] * full_cost_ < lambda_[i];
      take(sets);
      if (value > best_value + kTiny) {
        best_value = value, best = lambda_, idle = 0;
        selected_ = std::move(sets);
      } else if (++idle >= 5) {
        idle = 0, scale *= 0.6, lambda_ = best;
        continue;
      }
      move(slack, value, scale);
    }
    lambda_ = std::move(best);
  }

  // Steps in units of weight: a mask that is served too often or not at all matters as much as it weighs.
  void move(const std::vector<double>& slack, double value, double scale) {
    double norm = 0;
    for (size_t i = 0; i < slack.size(); ++i) norm += p_.weights[i] * slack[i] * slack[i];
    if (norm <= 0) return;
    const double step = scale * std::max(upper_ - value, 1e-9 * upper_) / norm;
    for (size_t i = 0; i < slack.size(); ++i) {
      const double least = p_.weights[i] * p_.cost[p_.masks[i]], most = p_.weights[i] * full_cost_;
      lambda_[i] = std::clamp(lambda_[i] + step * p_.weights[i] * slack[i], least, most + kTiny);
    }
  }

  // sums[s]: the gain of every set s if it cost `price`.
  void gains_at(double price, std::vector<float>& sums) const {
    std::fill(sums.begin(), sums.end(), 0.0f);
    for (size_t i = 0; i < p_.masks.size(); ++i) sums[p_.masks[i]] += static_cast<float>(std::max(0.0, lambda_[i] - p_.weights[i] * price));
    for (uint32_t bit = 0; bit < p_.bits; ++bit) add_subsets(sums, bit);
  }

  // An upper bound of the gain of every set. A gain is a convex function of the price, so between two prices it lies below the chord.
  std::vector<float> bound_gains() const {
    const size_t sets = size_t{1} << p_.bits, steps = p_.bits > 16 ? 12 : 32;
    const double low = *std::min_element(p_.cost.begin(), p_.cost.end()), width = std::max((full_cost_ - low) / static_cast<double>(steps), kTiny);
    std::vector<float> result(sets), below(sets), above(sets);
    gains_at(low, below);
    for (size_t step = 0; step < steps; ++step) {
      const double begin = low + width * static_cast<double>(step), end = step + 1 == steps ? full_cost_ + width : begin + width;
      gains_at(end, above);
      for (size_t s = 0; s < sets; ++s) {
        if (p_.cost[s] < begin || p_.cost[s] >= end) continue;
        const auto share = static_cast<float>((p_.cost[s] - begin) / (end - begin));
        result[s] = below[s] + share * (above[s] - below[s]);
      }
      std::swap(below, above);
    }
    return result;
  }

  static void add_subsets(std::vector<float>& sums, uint32_t bit) {
    const size_t stride = size_t{1} << bit;
    for (size_t base = 0; base < sums.size(); base += 2 * stride)
      for (size_t k = base; k < base + stride; ++k) sums[k + stride] += sums[k];
  }

  // The bound over all sets, and the sets that promise most into the pool.
  void price() {
    constexpr double kRounding = 1.0 + 1e-5;  // of sums in single precision
    gains_ = bound_gains();
    gains_[p_.full()] = 0;
    std::vector<uint32_t> order(gains_.size());
    std::iota(order.begin(), order.end(), 0u);
    const size_t priced = std::min(order.size(), kPriced);
    std::nth_element(order.begin(), order.begin() + static_cast<ptrdiff_t>(priced - 1), order.end(),
                     [&](uint32_t a, uint32_t b) { return gains_[a] != gains_[b] ? gains_[a] > gains_[b] : a < b; });
    std::vector<std::pair<double, Mask>> exact;
    for (size_t k = 0; k < priced; ++k) exact.emplace_back(exact_gain(order[k]), order[k]);
    double rest = 0;
    for (size_t k = priced; k < order.size(); ++k) rest = std::max(rest, static_cast<double>(gains_[order[k]]));
    std::sort(exact.begin(), exact.end(), [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
    double value = std::accumulate(lambda_.begin(), lambda_.end(), 0.0) - full_gain();
    marginal_ = 0;
    for (size_t k = 0; k < p_.open; ++k) {
      const double gain = std::max(k < exact.size() ? exact[k].first : 0.0, rest * kRounding);
      value -= gain;
      marginal_ = gain;
    }
    for (const auto& [gain, set] : exact) gains_[set] = static_cast<float>(gain * kRounding);
    if (value > bound_) bound_ = value;
    value_ = value;
    for (size_t k = 0; k < std::min<size_t>(exact.size(), 500); ++k) add_candidate(exact[k].second);
  }

  double exact_gain(Mask set) const {
    double gain = 0;
    for (size_t i = 0; i < p_.masks.size(); ++i)
      if ((p_.masks[i] & ~set) == 0) gain += std::max(0.0, lambda_[i] - p_.weights[i] * p_.cost[set]);
    return gain;
  }

  // ---- what is left after fixing

  // Sets that a better choice may hold: forcing any other raises the bound above what is known. All of them if nothing was priced.
  std::vector<Mask> survivors() const {
    std::vector<Mask> sets;
    for (size_t s = 0; s < p_.cost.size(); ++s) {
      if (s == p_.full()) continue;
      if (gains_.empty() || value_ + marginal_ - static_cast<double>(gains_[s]) < upper_) sets.push_back(static_cast<Mask>(s));
    }
    return sets;
  }

  // Only unions of masks matter: a set that is none serves no more than the union of what it serves.
  bool is_union(Mask set) const {
    Mask all = 0;
    for (const Mask mask : p_.masks)
      if ((mask & ~set) == 0) all |= mask;
    return all == set;
  }

  // Tries all choices among the survivors; false if there are too many.
  bool enumerate() {
    std::vector<Mask> sets = survivors();
    if (sets.size() > 4096) return false;
    std::erase_if(sets, [&](Mask set) { return !is_union(set); });
    const size_t depth = std::min<size_t>(p_.open, sets.size());
    double choices = 1;
    for (size_t k = 0; k < depth; ++k) choices *= static_cast<double>(sets.size() - k) / static_cast<double>(k + 1);
    if (choices * static_cast<double>(p_.masks.size()) > static_cast<double>(kEnumerated)) return false;
    std::vector<Mask> chosen;
    descend(sets, 0, depth, chosen, std::vector<double>(p_.masks.size(), full_cost_));
    return true;
  }

  void descend(const std::vector<Mask>& sets, size_t from, size_t left, std::vector<Mask>& chosen, const std::vector<double>& now) {
    if (left == 0) {
      double value = 0;
      for (size_t i = 0; i < now.size(); ++i) value += p_.weights[i] * now[i];
      if (value < upper_) upper_ = value, best_sets_ = chosen;
      return;
    }
    for (size_t s = from; s + left <= sets.size(); ++s) {
      std::vector<double> next = now;
      for (size_t i = 0; i < next.size(); ++i)
        if ((p_.masks[i] & ~sets[s]) == 0) next[i] = std::min(next[i], p_.cost[sets[s]]);
      chosen.push_back(sets[s]);
      descend(sets, s + 1, left - 1, chosen, next);
      chosen.pop_back();
    }
  }

  const Facilities& p_;
  std::vector<Candidate> pool_;
  std::set<Mask> known_;
  std::vector<Mask> best_sets_, selected_;  // selected: by the relaxation at its best multipliers
  std::vector<double> lambda_;
  std::vector<float> gains_;  // by set, upper bounds at `lambda_`, of the last pricing
  double full_cost_ = 0, upper_ = std::numeric_limits<double>::infinity(), bound_ = 0, marginal_ = 0, value_ = 0;
};

}  // namespace

double expected_cost(const Facilities& problem, const std::vector<Mask>& sets) {
  double sum = 0;
  for (size_t i = 0; i < problem.masks.size(); ++i) {
    double least = problem.cost[problem.full()];
    for (const Mask set : sets)
      if ((problem.masks[i] & ~set) == 0) least = std::min(least, problem.cost[set]);
    sum += problem.weights[i] * least;
  }
  return sum;
}

FacilityChoice choose_facilities(const Facilities& problem) { return Search(problem).run(); }

}  // namespace rg::compiler
