// What can be said of expressions over extents before the extents are chosen.
#pragma once

#include <map>
#include <vector>

#include "dsl/program.h"

namespace rg::dsl {

// A sum of products of extents, and of nodes that are no sums or products, with whole coefficients: equal formulas are equal values.
class Polynomial {
 public:
  using Product = std::vector<uint32_t>;  // rows of Program::exprs, ascending; empty: the constant

  explicit Polynomial(int64_t constant = 0) { add({}, constant); }
  void add(const Product& product, int64_t factor);
  const std::map<Product, int64_t>& terms() const { return terms_; }
  // Coefficients that do not fit make the whole worthless: nothing is proved of it.
  bool overflown() const { return overflown_; }

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);

 private:
  std::map<Product, int64_t> terms_;  // without zeros
  bool overflown_ = false;
};

// Formulas and bounds of a program's expressions, each looked at once.
class Formulas {
 public:
  explicit Formulas(const Program& program) : program_(program) {}

  // An invalid id is 1. Quotients that come out even are taken apart. O(rows up to `id`), the first time.
  Polynomial of(ExprId id);
  // True where it is proved for all extents within their bounds; false says nothing.
  bool never_negative(Polynomial value);

 private:
  __extension__ typedef __int128 Wide;
  struct Bounds {
    Wide least = 0, greatest = 0;
  };
  struct Quotient;
  void look_at(ExprId id);
  Polynomial formula_of(const Expr& expr, ExprId id) const;
  Bounds bounds_of(const Expr& expr) const;
  Bounds bounds_of(const Polynomial& value) const;
  const Quotient* find_quotient(const Polynomial& value, Quotient& found) const;
  Polynomial without_quotient(const Polynomial& value, const Quotient& quotient) const;
  Polynomial from_least(const Polynomial& value) const;
  static Bounds quotient_of(const Bounds& a, const Bounds& b, bool up);

  const Program& program_;
  std::vector<Polynomial> formulas_;  // by row of Program::exprs
  std::vector<Bounds> bounds_;
};

}  // namespace rg::dsl
