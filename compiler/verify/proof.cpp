#include "compiler/verify/proof.h"

#include <algorithm>
#include <iterator>

namespace rg::verify {

Proof unite(const Proof& a, const Proof& b) {
  Proof result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

void intersect(Proof& a, const Proof& b) {
  Proof result;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  a = std::move(result);
}

void subtract(Proof& a, const Proof& b) {
  Proof result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  a = std::move(result);
}

bool contains(const Proof& a, const Proof& b) { return std::includes(a.begin(), a.end(), b.begin(), b.end()); }

void Alternatives::add(Proof next) {
  if (!proof)
    proof = std::move(next);
  else
    intersect(*proof, next);
}

}  // namespace rg::verify
