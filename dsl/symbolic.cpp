#include "dsl/symbolic.h"

#include <algorithm>
#include <optional>

namespace rg::dsl {
namespace {

__extension__ typedef __int128 Wide;
constexpr size_t kMostTerms = 64, kMostFactors = 4;
constexpr Wide kMostBound = Wide{1} << 100;

std::optional<int64_t> narrowed(Wide value) {
  if (value > INT64_MAX || value < INT64_MIN) return std::nullopt;
  return static_cast<int64_t>(value);
}

// The quotient by a constant, if it comes out even whatever the extents are.
std::optional<Polynomial> divided(const Polynomial& value, int64_t by) {
  if (value.overflown()) return std::nullopt;
  Polynomial result;
  for (const auto& [product, factor] : value.terms()) {
    if (factor % by != 0) return std::nullopt;
    result.add(product, factor / by);
  }
  return result;
}

std::optional<int64_t> constant_of(const Polynomial& value) {
  if (value.overflown() || value.terms().size() > 1) return std::nullopt;
  if (value.terms().empty()) return 0;
  return value.terms().begin()->first.empty() ? std::optional(value.terms().begin()->second) : std::nullopt;
}

Polynomial atom(ExprId id) {
  Polynomial result;
  result.add({id.value}, 1);
  return result;
}

constexpr Wide clamped(Wide value) { return std::clamp(value, -kMostBound, kMostBound); }

constexpr Wide product_of(Wide a, Wide b) {
  const auto magnitude = [](Wide x) { return x < 0 ? -x : x; };
  if (a == 0 || b == 0) return 0;
  if (magnitude(a) > kMostBound / magnitude(b)) return (a < 0) == (b < 0) ? kMostBound : -kMostBound;
  return a * b;
}

bool only_adds(const Polynomial& value) {
  return !value.overflown() && std::all_of(value.terms().begin(), value.terms().end(), [](const auto& term) { return term.second >= 0; });
}

}  // namespace

// ---- sums of products -------------------------------------------------------------------------------------------

void Polynomial::add(const Product& product, int64_t factor) {
  if (factor == 0) return;
  const auto at = terms_.emplace(product, 0).first;
  const auto sum = narrowed(Wide{at->second} + factor);
  overflown_ = overflown_ || !sum || terms_.size() > kMostTerms || product.size() > kMostFactors;
  at->second = sum.value_or(1);
  if (at->second == 0) terms_.erase(at);
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial result = a;
  result.overflown_ = a.overflown_ || b.overflown_;
  for (const auto& [product, factor] : b.terms_) result.add(product, factor);
  return result;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + b * Polynomial(-1); }

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial result;
  result.overflown_ = a.overflown_ || b.overflown_;
  for (const auto& [left, x] : a.terms_)
    for (const auto& [right, y] : b.terms_) {
      Polynomial::Product product = left;
      product.insert(product.end(), right.begin(), right.end());
      std::sort(product.begin(), product.end());
      const auto factor = narrowed(Wide{x} * y);
      result.overflown_ = result.overflown_ || !factor;
      result.add(product, factor.value_or(1));
    }
  return result;
}

// ---- bounds -----------------------------------------------------------------------------------------------------

Formulas::Bounds Formulas::quotient_of(const Bounds& a, const Bounds& b, bool up) {
  if (a.least < 0 || b.least < 1) return {-kMostBound, kMostBound};
  const auto divide = [&](Wide x, Wide y) { return up ? (x + y - 1) / y : x / y; };
  return {divide(a.least, b.greatest), divide(a.greatest, b.least)};
}

Formulas::Bounds Formulas::bounds_of(const Expr& expr) const {
  const auto operand = [&](ExprId id) { return id.valid() ? bounds_[id.value] : Bounds{1, 1}; };
  const Bounds a = operand(expr.a), b = operand(expr.b);
  switch (expr.op) {
    case ExprOp::extent: {
      const Extent& row = program_.extents.rows[static_cast<size_t>(expr.value / 3)];
      return {row.minimum[expr.value % 3], row.maximum[expr.value % 3]};
    }
    case ExprOp::floor_div:
    case ExprOp::ceil_div:
      return quotient_of(a, b, expr.op == ExprOp::ceil_div);
    case ExprOp::min:
      return {std::min(a.least, b.least), std::min(a.greatest, b.greatest)};
    case ExprOp::max:
      return {std::max(a.least, b.least), std::max(a.greatest, b.greatest)};
    case ExprOp::mip:
      return {1, std::max<Wide>(a.greatest, 1)};
    default:
      return {-kMostBound, kMostBound};
  }
}

Formulas::Bounds Formulas::bounds_of(const Polynomial& value) const {
  if (value.overflown()) return {-kMostBound, kMostBound};
  Bounds sum;
  for (const auto& [product, factor] : value.terms()) {
    Bounds term{factor, factor};
    for (const uint32_t node : product) {
      const Bounds& b = bounds_[node];
      const Wide corners[] = {product_of(term.least, b.least), product_of(term.least, b.greatest), product_of(term.greatest, b.least),
                              product_of(term.greatest, b.greatest)};
      term = {*std::min_element(std::begin(corners), std::end(corners)), *std::max_element(std::begin(corners), std::end(corners))};
    }
    sum = {clamped(sum.least + term.least), clamped(sum.greatest + term.greatest)};
  }
  return sum;
}

// ---- quotients against what is divided ----------------------------------------------------------------------------

// A term that is a quotient by a constant, alone: a / c lies within (a - c, a], rounded up within [a, a + c), all divided by c.
struct Formulas::Quotient {
  Polynomial::Product product;
  int64_t factor = 0, divisor = 0;
  ExprId dividend;
  bool up = false;
};
const Formulas::Quotient* Formulas::find_quotient(const Polynomial& value, Quotient& found) const {
  for (const auto& [product, factor] : value.terms()) {
    if (product.size() != 1) continue;
    const Expr& expr = program_.exprs.rows[product[0]];
    if (expr.op != ExprOp::floor_div && expr.op != ExprOp::ceil_div) continue;
    const auto divisor = constant_of(formulas_[expr.b.value]);
    if (!divisor || *divisor <= 0 || bounds_[expr.a.value].least < 0) continue;  // below 0 division rounds the other way
    found = {product, factor, *divisor, expr.a, expr.op == ExprOp::ceil_div};
    return &found;
  }
  return nullptr;
}

// Times the divisor, with the quotient replaced by the least (where it is subtracted, the greatest) that it can be.
Polynomial Formulas::without_quotient(const Polynomial& value, const Quotient& quotient) const {
  Polynomial rest = value;
  rest.add(quotient.product, -quotient.factor);
  Polynomial bound = formulas_[quotient.dividend.value];
  if (quotient.factor > 0 && !quotient.up) bound = bound - Polynomial(quotient.divisor - 1);
  if (quotient.factor < 0 && quotient.up) bound = bound + Polynomial(quotient.divisor - 1);
  return rest * Polynomial(quotient.divisor) + bound * Polynomial(quotient.factor);
}

// In terms of how far each factor is above its least: a sum of what is added only cannot be negative.
Polynomial Formulas::from_least(const Polynomial& value) const {
  Polynomial sum;
  for (const auto& [product, factor] : value.terms()) {
    Polynomial term(factor);
    for (const uint32_t node : product) {
      const auto least = narrowed(bounds_[node].least);
      Polynomial above = Polynomial(least.value_or(0));
      above.add({node}, 1);
      term = least ? term * above : Polynomial(-1);
    }
    sum = sum + term;
  }
  return sum;
}

bool Formulas::never_negative(Polynomial value) {
  constexpr int kMostQuotients = 8;
  for (int i = 0; i <= kMostQuotients && !value.overflown(); ++i) {
    if (bounds_of(value).least >= 0 || only_adds(from_least(value))) return true;
    Quotient quotient;
    if (!find_quotient(value, quotient)) return false;
    value = without_quotient(value, quotient);
  }
  return false;
}

// ---- expressions --------------------------------------------------------------------------------------------------

Polynomial Formulas::formula_of(const Expr& expr, ExprId id) const {
  const auto operand = [&](ExprId each) { return each.valid() ? formulas_[each.value] : Polynomial(1); };
  switch (expr.op) {
    case ExprOp::constant:
      return Polynomial(expr.value);
    case ExprOp::add:
      return operand(expr.a) + operand(expr.b);
    case ExprOp::sub:
      return operand(expr.a) - operand(expr.b);
    case ExprOp::mul:
      return operand(expr.a) * operand(expr.b);
    case ExprOp::floor_div:
    case ExprOp::ceil_div: {
      const auto by = constant_of(operand(expr.b));
      const auto even = by && *by > 0 ? divided(operand(expr.a), *by) : std::nullopt;
      return even ? *even : atom(id);
    }
    default:
      return atom(id);
  }
}

// Operands precede the nodes that use them.
void Formulas::look_at(ExprId id) {
  while (formulas_.size() <= id.value) {
    const ExprId next{formulas_.size()};
    const Expr& expr = program_.exprs[next];
    formulas_.push_back(formula_of(expr, next));
    const bool is_atom = formulas_.back().terms() == atom(next).terms();
    bounds_.push_back(is_atom ? bounds_of(expr) : bounds_of(formulas_.back()));
  }
}

Polynomial Formulas::of(ExprId id) {
  if (!id.valid()) return Polynomial(1);
  look_at(id);
  return formulas_[id.value];
}

}  // namespace rg::dsl
