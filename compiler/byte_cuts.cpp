#include "compiler/byte_cuts.h"

#include <algorithm>

namespace rg::compiler {
namespace {

constexpr size_t kMostCuts = 64;

struct Point {
  dsl::Polynomial at;
  ByteCut cut;
};

// Or at the same place: pieces may be empty at some extents.
bool is_behind(dsl::Formulas& formulas, const dsl::Polynomial& a, const dsl::Polynomial& b) { return formulas.never_negative(a - b); }

// False where the point may lie on either side of another.
bool insert(dsl::Formulas& formulas, std::vector<Point>& points, const Point& point) {
  size_t place = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].at.terms() == point.at.terms()) return !point.at.overflown();
    if (is_behind(formulas, point.at, points[i].at))
      place = i + 1;
    else if (!is_behind(formulas, points[i].at, point.at))
      return false;
  }
  points.insert(points.begin() + static_cast<std::ptrdiff_t>(place), point);
  return points.size() <= kMostCuts;
}

Point begin_of(dsl::Formulas& formulas, const dsl::Range& range) { return {formulas.of(range.offset), {range.offset, {}}}; }
Point end_of(dsl::Formulas& formulas, const dsl::Range& range) {
  return {formulas.of(range.offset) + formulas.of(range.size), {range.offset, range.size}};
}

uint64_t number_of(const std::vector<Point>& points, const dsl::Polynomial& at, const Grid& grid) {
  const auto point = std::find_if(points.begin(), points.end(), [&](const Point& each) { return each.at.terms() == at.terms(); });
  return point == points.end() ? UINT64_MAX : grid.bytes[static_cast<size_t>(point - points.begin())];
}

Index plan_expr(const ByteCut& cut, Expressions& exprs) {
  return cut.size.valid() ? exprs.binary(ExprOp::add, index_of(cut.offset), index_of(cut.size)) : index_of(cut.offset);
}

}  // namespace

bool cut_bytes(dsl::Formulas& formulas, const dsl::Resource& buffer, const std::vector<dsl::Range>& ranges, Grid& grid) {
  if (!buffer.count.valid()) return false;
  std::vector<Point> points = {{dsl::Polynomial(0), {}}};
  for (const dsl::Range& range : ranges)
    if (!insert(formulas, points, begin_of(formulas, range)) || !insert(formulas, points, end_of(formulas, range))) return false;
  const dsl::Polynomial total = formulas.of(buffer.count) * dsl::Polynomial(buffer.stride);
  if (points.back().at.terms() == total.terms())
    points.pop_back();
  else if (!is_behind(formulas, total, points.back().at))
    return false;
  for (size_t i = 0; i < points.size(); ++i) grid.bytes.push_back(i), grid.cuts.push_back(points[i].cut);
  grid.bytes.push_back(UINT64_MAX);
  for (const dsl::Range& range : ranges)
    grid.places[{range.offset.value, range.size.value}] = {number_of(points, begin_of(formulas, range).at, grid),
                                                           number_of(points, end_of(formulas, range).at, grid)};
  return true;
}

Bytes bytes_between(const Grid& grid, uint64_t begin, uint64_t end, Expressions& exprs) {
  Bytes bytes;
  if (grid.cuts.empty()) {
    if (begin > 0) bytes.offset = exprs.constant(static_cast<int64_t>(begin));
    if (end != UINT64_MAX) bytes.size = exprs.constant(static_cast<int64_t>(end - begin));
    return bytes;
  }
  if (begin > 0) bytes.offset = plan_expr(grid.cuts[begin], exprs);
  if (end == UINT64_MAX) return bytes;
  const Index last = plan_expr(grid.cuts[end], exprs);
  bytes.size = begin > 0 ? exprs.binary(ExprOp::sub, last, bytes.offset) : last;
  return bytes;
}

}  // namespace rg::compiler
