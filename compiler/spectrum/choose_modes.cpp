#include "compiler/spectrum/choose_modes.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "compiler/spectrum/facility.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

constexpr uint32_t kMostBits = 20;  // sets are enumerated

Mask full_set(uint32_t features) { return static_cast<Mask>((uint64_t{1} << features) - 1); }

// Features that occur in the same masks are one bit of the reduced problem, those in none another.
struct Reduction {
  std::vector<Mask> groups;  // by reduced bit
  Mask expand(Mask reduced) const {
    Mask set = 0;
    for (size_t b = 0; b < groups.size(); ++b)
      if (reduced >> b & 1) set |= groups[b];
    return set;
  }
  Mask reduce(Mask set) const {
    Mask reduced = 0;
    for (size_t b = 0; b < groups.size(); ++b)
      if (set & groups[b]) reduced |= Mask{1} << b;
    return reduced;
  }
};

// Beyond kMostBits the rarest features share one bit: choices stay feasible, the bound no longer covers those that tell them apart.
Reduction reduce(const SpectrumProblem& problem, const std::map<Mask, double>& weights, bool& lost) {
  std::map<std::vector<bool>, Mask> columns;
  std::map<std::vector<bool>, double> by_column;
  std::map<Mask, double> use;
  for (uint32_t f = 0; f < problem.features; ++f) {
    std::vector<bool> column;
    double weight = 0;
    for (const auto& [mask, w] : weights) {
      column.push_back(mask >> f & 1);
      weight += (mask >> f & 1) ? w : 0;
    }
    columns[column] |= Mask{1} << f;
    by_column[column] = weight;
  }
  Reduction reduction;
  for (const auto& [column, group] : columns) reduction.groups.push_back(group), use[group] = by_column[column];
  std::sort(reduction.groups.begin(), reduction.groups.end(), [&](Mask a, Mask b) { return use[a] != use[b] ? use[a] > use[b] : a < b; });
  lost = reduction.groups.size() > kMostBits;
  while (reduction.groups.size() > kMostBits) {
    reduction.groups[kMostBits - 1] |= reduction.groups.back();
    reduction.groups.pop_back();
  }
  return reduction;
}

// By reduced set: the cheapest kernel that serves it, itself or a superset, and its cost.
struct Kernels {
  std::vector<double> cost;
  std::vector<Mask> set;
};
Kernels cheapest_kernels(const SpectrumProblem& problem, const Reduction& reduction) {
  const auto bits = static_cast<uint32_t>(reduction.groups.size());
  const CostTable costs(problem.costs);
  Kernels kernels;
  for (size_t s = 0; s < size_t{1} << bits; ++s) {
    kernels.set.push_back(close(problem, reduction.expand(static_cast<Mask>(s))));
    kernels.cost.push_back(costs(kernels.set.back()));
  }
  for (uint32_t bit = 0; bit < bits; ++bit)
    for (size_t s = 0; s < kernels.cost.size(); ++s) {
      const size_t wider = s | size_t{1} << bit;
      if (kernels.cost[wider] < kernels.cost[s]) kernels.cost[s] = kernels.cost[wider], kernels.set[s] = kernels.set[wider];
    }
  return kernels;
}

// Modes that serve something, by cost; the full set last, whatever it costs.
void finish(const SpectrumProblem& problem, std::vector<Mask> sets, ModeChoice& choice) {
  const Mask full = full_set(problem.features);
  std::sort(sets.begin(), sets.end());
  sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  std::erase(sets, full);
  std::stable_sort(sets.begin(), sets.end(), [&](Mask a, Mask b) { return cost(problem.costs, a) < cost(problem.costs, b); });
  sets.push_back(full);
  std::vector<bool> used(sets.size(), false);
  used.back() = true;
  for (const MaskWeight& row : problem.histogram)
    if (row.weight > 0) used[mode_for(sets, row.mask)] = true;
  for (size_t s = 0; s < sets.size(); ++s)
    if (used[s]) choice.modes.push_back(sets[s]);
  for (const Mask mode : choice.modes) choice.costs.push_back(cost(problem.costs, mode));
  for (const MaskWeight& row : problem.histogram) choice.mode_of.push_back(mode_for(choice.modes, row.mask));
}

}  // namespace

Mask close(const SpectrumProblem& problem, Mask mask) {
  for (Mask before = ~mask; before != mask;) {
    before = mask;
    for (uint32_t f = 0; f < problem.needs.size(); ++f)
      if (mask >> f & 1) mask |= problem.needs[f];
  }
  return mask;
}

std::vector<double> group_shares(const SpectrumProblem& problem, const std::vector<Mask>& modes) {
  std::vector<double> shares(modes.size(), 0);
  double whole = 0;
  for (const MaskWeight& row : problem.histogram) shares[mode_for(modes, row.mask)] += row.weight, whole += row.weight;
  if (whole <= 0) return {};
  for (double& share : shares) share /= whole;
  return shares;
}

uint32_t mode_for(const std::vector<Mask>& modes, Mask mask) {
  for (uint32_t k = 0; k < modes.size(); ++k)
    if ((mask & ~modes[k]) == 0) return k;
  return static_cast<uint32_t>(modes.size() - 1);
}

ModeChoice choose_modes(const SpectrumProblem& problem) {
  RG_CHECK(problem.features >= 1 && problem.features <= 32 && problem.modes >= 1, "a spectrum has 1 to 32 features and a mode");
  std::map<Mask, double> weights;
  double total = 0;
  for (const MaskWeight& row : problem.histogram) {
    if (row.weight <= 0) continue;
    weights[close(problem, row.mask & full_set(problem.features))] += row.weight;
    total += row.weight;
  }
  ModeChoice choice;
  choice.one_kernel = cost(problem.costs, full_set(problem.features));
  if (weights.empty()) {
    finish(problem, {}, choice);
    choice.expected = choice.bound = choice.kernel_per_mask = choice.one_kernel;
    choice.exact = true;
    return choice;
  }
  bool lost = false;
  const Reduction reduction = reduce(problem, weights, lost);
  const Kernels kernels = cheapest_kernels(problem, reduction);

  Facilities facilities;
  facilities.bits = static_cast<uint32_t>(reduction.groups.size());
  facilities.cost = kernels.cost;
  facilities.open = problem.modes - 1;
  std::map<Mask, double> merged;
  for (const auto& [mask, weight] : weights) merged[reduction.reduce(mask)] += weight / total;
  for (const auto& [mask, weight] : merged) facilities.masks.push_back(mask), facilities.weights.push_back(weight);
  const FacilityChoice found = choose_facilities(facilities);

  std::vector<Mask> sets;
  for (const Mask set : found.sets) sets.push_back(kernels.set[set]);
  finish(problem, std::move(sets), choice);
  for (const MaskWeight& row : problem.histogram)
    if (row.weight > 0) choice.expected += row.weight / total * choice.costs[mode_for(choice.modes, row.mask)];
  for (const auto& [mask, weight] : merged) choice.kernel_per_mask += weight * kernels.cost[mask];
  choice.exact = found.exact && !lost;
  choice.bound = choice.exact ? choice.expected : std::min(choice.expected, lost ? choice.kernel_per_mask : found.bound);
  return choice;
}

}  // namespace rg::compiler
