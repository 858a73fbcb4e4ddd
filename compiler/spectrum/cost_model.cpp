#include "compiler/spectrum/cost_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace rg::compiler {
namespace {

// Solves the symmetric positive definite system in place; Gauss without pivoting is safe there.
std::vector<double> solve(std::vector<std::vector<double>> a, std::vector<double> b) {
  const size_t n = b.size();
  for (size_t k = 0; k < n; ++k) {
    for (size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (size_t k = n; k-- > 0;) {
    for (size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

// What is known of the set, or `estimate` between what is known of those below and above it.
template <class Estimate>
double among_measured(const CostModel& model, Mask set, Estimate estimate) {
  double least = 0, most = std::numeric_limits<double>::infinity();
  for (const auto& [other, value] : model.measured) {
    if (other == set) return value;
    if ((other & ~set) == 0) least = std::max(least, value);
    if ((set & ~other) == 0) most = std::min(most, value);
  }
  return std::max(least, std::min(most, estimate()));
}

}  // namespace

double evaluate(const Additive& terms, Mask set) {
  double sum = terms.base;
  for (size_t i = 0; i < terms.features.size(); ++i)
    if (set >> i & 1) sum += terms.features[i];
  for (const auto& [both, value] : terms.pairs)
    if ((set & both) == both) sum += value;
  return sum;
}

double register_factor(double registers) {
  constexpr std::pair<double, double> kSteps[] = {{32, 1.0}, {48, 1.05}, {64, 1.15}, {96, 1.3}, {128, 1.5}};
  for (const auto& [limit, factor] : kSteps)
    if (registers <= limit) return factor;
  return 2.0;
}

double cost(const CostModel& model, Mask set) {
  return among_measured(model, set, [&] { return std::max(0.0, evaluate(model.work, set)) * register_factor(evaluate(model.registers, set)); });
}

CostTable::Terms::Terms(const Additive& terms) : base(terms.base) {
  std::copy_n(terms.features.begin(), std::min<size_t>(terms.features.size(), 32), features);
  for (const auto& [both, value] : terms.pairs) {
    if (std::popcount(both) == 2)
      pairs[std::countr_zero(both)][31 - std::countl_zero(both)] += value;
    else
      wider.emplace_back(both, value);
  }
}

double CostTable::Terms::sum(Mask set) const {
  double total = base;
  for (Mask rest = set; rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    total += features[i];
    for (Mask others = rest & (rest - 1); others != 0; others &= others - 1) total += pairs[i][std::countr_zero(others)];
  }
  for (const auto& [all, value] : wider)
    if ((set & all) == all) total += value;
  return total;
}

CostTable::CostTable(const CostModel& model) : work_(model.work), registers_(model.registers), model_(model) {}

double CostTable::operator()(Mask set) const {
  return among_measured(model_, set, [&] { return std::max(0.0, work_.sum(set)) * register_factor(registers_.sum(set)); });
}

Additive fit_terms(uint32_t features, const std::vector<std::pair<Mask, double>>& samples) {
  const std::map<Mask, double> by_set(samples.begin(), samples.end());
  const auto sample = [&](Mask set, double otherwise) {
    const auto found = by_set.find(set);
    return found == by_set.end() ? otherwise : found->second;
  };
  Additive terms;
  terms.base = sample(0, 1);
  for (uint32_t i = 0; i < features; ++i) terms.features.push_back(sample(Mask{1} << i, terms.base) - terms.base);
  for (const auto& [set, value] : by_set) {
    if (std::popcount(set) != 2) continue;
    const double alone = evaluate({terms.base, terms.features, {}}, set);
    if (value != alone) terms.pairs.emplace_back(set, value - alone);
  }
  return terms;
}

bool tell_apart(uint32_t features, const std::vector<std::pair<Mask, double>>& samples) {
  // Rows reduced modulo a prime: of zeros and ones, so that independent rows stay independent but for primes that divide a minor.
  constexpr uint64_t kPrime = 2147483647;
  const size_t n = features + 1;
  std::vector<std::vector<uint64_t>> pivots(n);  // by leading column
  size_t rank = 0;
  for (const auto& [set, value] : samples) {
    std::vector<uint64_t> row(n, 1);
    for (size_t i = 0; i < features; ++i) row[i] = set >> i & 1;
    for (size_t column = 0; column < n; ++column) {
      if (row[column] == 0) continue;
      if (pivots[column].empty()) {
        pivots[column] = std::move(row);
        ++rank;
        break;
      }
      const uint64_t a = pivots[column][column], b = row[column];
      for (size_t i = column; i < n; ++i) row[i] = (row[i] * a + (kPrime - pivots[column][i]) * b) % kPrime;
    }
  }
  return rank == n;
}

std::vector<std::pair<Mask, double>> complete_times(const std::vector<std::pair<Mask, double>>& estimates,
                                                    const std::vector<std::pair<Mask, double>>& times) {
  const std::map<Mask, double> timed(times.begin(), times.end());
  double products = 0, squares = 0;  // the factor that leaves the least squares
  for (const auto& [set, estimate] : estimates)
    if (const auto time = timed.find(set); time != timed.end()) products += estimate * time->second, squares += estimate * estimate;
  std::map<Mask, double> all;
  for (const auto& [set, estimate] : estimates) all.emplace(set, squares > 0 ? estimate * products / squares : estimate);
  for (const auto& [set, time] : timed) all[set] = time;
  return {all.begin(), all.end()};
}

Additive fit_least_squares(uint32_t features, const std::vector<std::pair<Mask, double>>& samples) {
  const size_t n = features + 1;  // the last unknown is the base
  std::vector<std::vector<double>> a(n, std::vector<double>(n, 0.0));
  std::vector<double> b(n, 0.0);
  const auto has = [&](Mask set, size_t i) { return i == features || (set >> i & 1) ? 1.0 : 0.0; };
  double mean = 0;
  for (const auto& [set, value] : samples) {
    mean += value / static_cast<double>(samples.size());
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j < n; ++j) a[i][j] += has(set, i) * has(set, j);
      b[i] += has(set, i) * value;
    }
  }
  const double damping = 1e-3, share = mean / static_cast<double>(n);
  for (size_t i = 0; i < n; ++i) a[i][i] += damping, b[i] += damping * share;
  std::vector<double> x = solve(std::move(a), std::move(b));
  Additive terms;
  terms.base = x.back();
  x.pop_back();
  for (double& each : x) each = std::max(each, 0.0);  // a feature never makes a kernel cheaper
  terms.features = std::move(x);
  return terms;
}

}  // namespace rg::compiler
