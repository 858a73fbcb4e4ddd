#include "compiler/spectrum/kept_choice.h"

#include <bit>
#include <utility>

namespace rg::compiler {
namespace {

class Writer {
 public:
  void put(uint32_t number) { words.push_back(number); }
  void put(double number) {
    const auto bits = std::bit_cast<uint64_t>(number);
    words.insert(words.end(), {static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32)});
  }
  template <class A, class B>
  void put(const std::pair<A, B>& pair) {
    put(pair.first), put(pair.second);
  }
  void put(const MaskWeight& row) { put(row.mask), put(row.weight); }
  void put(const Additive& terms) { put(terms.base), put(terms.features), put(terms.pairs); }
  void put(const CostModel& costs) { put(costs.work), put(costs.registers), put(costs.measured); }
  template <class T>
  void put(const std::vector<T>& rows) {
    put(static_cast<uint32_t>(rows.size()));
    for (const T& row : rows) put(row);
  }
  Words words;
};

// After the first fault it gives zeros and empty tables.
class Reader {
 public:
  explicit Reader(const Words& words) : words_(words) {}
  void get(uint32_t& number) {
    good_ = good_ && at_ < words_.size();
    number = good_ ? words_[at_++] : 0;
  }
  void get(double& number) {
    uint32_t low = 0, high = 0;
    get(low), get(high);
    number = std::bit_cast<double>(uint64_t{low} | uint64_t{high} << 32);
  }
  template <class A, class B>
  void get(std::pair<A, B>& pair) {
    get(pair.first), get(pair.second);
  }
  void get(Additive& terms) { get(terms.base), get(terms.features), get(terms.pairs); }
  void get(CostModel& costs) { get(costs.work), get(costs.registers), get(costs.measured); }
  template <class T>
  void get(std::vector<T>& rows) {
    uint32_t count = 0;
    get(count);
    good_ = good_ && count <= words_.size() - at_;
    rows.resize(good_ ? count : 0);
    for (T& row : rows) get(row);
  }
  bool done() const { return good_ && at_ == words_.size(); }

 private:
  const Words& words_;
  size_t at_ = 0;
  bool good_ = true;
};

bool fits(const KeptChoice& kept, const SpectrumProblem& problem) {
  const ModeChoice& choice = kept.choice;
  if (choice.modes.empty() || choice.modes.size() > problem.modes || choice.costs.size() != choice.modes.size()) return false;
  if (choice.mode_of.size() != problem.histogram.size() || kept.costs.work.features.size() != problem.features) return false;
  for (const uint32_t mode : choice.mode_of)
    if (mode >= choice.modes.size()) return false;
  return choice.modes.back() == static_cast<Mask>((uint64_t{1} << problem.features) - 1);
}

}  // namespace

Digest choice_key(const SpectrumProblem& problem, const Digest& sources) {
  Writer out;
  out.put(problem.features), out.put(problem.needs), out.put(problem.histogram), out.put(problem.costs), out.put(problem.modes);
  Sha256 hash;
  hash.add_part("spectrum choice " RGC_METHOD).add_part(hex(sources));
  return hash.add_part({reinterpret_cast<const char*>(out.words.data()), out.words.size() * sizeof(uint32_t)}).finish();
}

std::optional<KeptChoice> find_choice(const ShaderCache& cache, const Digest& key, const SpectrumProblem& problem) {
  const auto found = cache.find(key);
  if (!found || found->size() != 1) return std::nullopt;
  Reader in((*found)[0]);
  KeptChoice kept;
  uint32_t exact = 0;
  in.get(kept.costs), in.get(kept.choice.modes), in.get(kept.choice.costs), in.get(kept.choice.mode_of);
  in.get(kept.choice.expected), in.get(kept.choice.bound), in.get(exact), in.get(kept.choice.one_kernel), in.get(kept.choice.kernel_per_mask);
  kept.choice.exact = exact != 0;
  return in.done() && fits(kept, problem) ? std::optional(std::move(kept)) : std::nullopt;
}

void store_choice(const ShaderCache& cache, const Digest& key, const KeptChoice& kept) {
  const ModeChoice& choice = kept.choice;
  Writer out;
  out.put(kept.costs), out.put(choice.modes), out.put(choice.costs), out.put(choice.mode_of);
  out.put(choice.expected), out.put(choice.bound), out.put(uint32_t{choice.exact}), out.put(choice.one_kernel), out.put(choice.kernel_per_mask);
  cache.store(key, {out.words});
}

}  // namespace rg::compiler
