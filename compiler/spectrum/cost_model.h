// What a kernel costs as a function of its feature set, in any unit that is the same for all kernels.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace rg::compiler {

using Mask = uint32_t;  // bit i: feature i of the spectrum

// base + features + pairs.
struct Additive {
  double base = 1;
  std::vector<double> features;                // by bit
  std::vector<std::pair<Mask, double>> pairs;  // added where the set holds both bits
};
double evaluate(const Additive& terms, Mask set);

// Work times what registers cost in occupancy. Kernels that were measured cost what was measured, and others no less than those of their subsets and
// no more than those of their supersets.
struct CostModel {
  Additive work;
  Additive registers{0, {}, {}};                  // scalars alive; 0: they cost nothing
  std::vector<std::pair<Mask, double>> measured;  // ascending by set
};
// 1.00 up to 32 registers, 1.05 to 48, 1.15 to 64, 1.30 to 96, 1.50 to 128, 2.00 beyond: where common hardware loses waves.
double register_factor(double registers);
double cost(const CostModel& model, Mask set);

// The same function, for very many sets.
class CostTable {
 public:
  explicit CostTable(const CostModel& model);
  double operator()(Mask set) const;

 private:
  struct Terms {
    double base = 0, features[32] = {}, pairs[32][32] = {};
    std::vector<std::pair<Mask, double>> wider;  // of more than two bits
    explicit Terms(const Additive& terms);
    double sum(Mask set) const;
  };
  Terms work_, registers_;
  const CostModel& model_;
};

// Terms that reproduce the samples of the empty set, single features and pairs; other samples are ignored. A missing sample leaves its term 0.
Additive fit_terms(uint32_t features, const std::vector<std::pair<Mask, double>>& samples);
// Whether samples of these sets determine the base and the term of every feature. O(sets x features^2).
bool tell_apart(uint32_t features, const std::vector<std::pair<Mask, double>>& samples);
// Estimates, brought to the unit of the measured times by the one factor that fits those both know best; and the times themselves.
std::vector<std::pair<Mask, double>> complete_times(const std::vector<std::pair<Mask, double>>& estimates,
                                                    const std::vector<std::pair<Mask, double>>& times);
// base and features by least squares with a little damping towards equal shares, for samples of any sets.
Additive fit_least_squares(uint32_t features, const std::vector<std::pair<Mask, double>>& samples);

}  // namespace rg::compiler
