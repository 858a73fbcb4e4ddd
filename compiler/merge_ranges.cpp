#include <algorithm>
#include <tuple>

#include "compiler/synchronise.h"

namespace rg::compiler {
namespace {

// Everything but the place within the resource.
auto meaning(const Frame& frame, const CellBarrier& b) {
  const Cell& cell = frame.cells[b.cell];
  // Both halves of a change of owner have to name the same range, so they stay cell by cell.
  const uint32_t alone = b.src_queue == b.dst_queue ? 0 : b.cell + 1;
  return std::tuple(alone, cell.resource, cell.age, b.range.aspects, b.src_stages, b.src_accesses, b.dst_stages, b.dst_accesses, b.old_layout,
                    b.new_layout, b.tag, b.is_acquire, b.wraps, b.src_queue, b.dst_queue);
}

// Of images: parts of a buffer have no layers that could lie side by side.
bool join_layers(CellBarrier& a, const CellBarrier& b) {
  if (a.range.aspects == 0 || a.range.mip != b.range.mip || a.range.mips != b.range.mips || a.range.layer + a.range.layers != b.range.layer)
    return false;
  a.range.layers += b.range.layers;
  return true;
}
bool join_mips(CellBarrier& a, const CellBarrier& b) {
  if (a.range.aspects == 0 || a.range.layer != b.range.layer || a.range.layers != b.range.layers || a.range.mip + a.range.mips != b.range.mip)
    return false;
  a.range.mips += b.range.mips;
  return true;
}
bool join_bytes(CellBarrier& a, const CellBarrier& b) {
  if (a.range.aspects != 0 || a.end != b.begin) return false;
  a.end = b.end;
  return true;
}

template <class Join>
void join_neighbours(const Frame& frame, std::vector<CellBarrier>& group, Join join) {
  size_t kept = 0;
  for (size_t i = 1; i < group.size(); ++i) {
    if (meaning(frame, group[kept]) != meaning(frame, group[i]) || !join(group[kept], group[i])) std::swap(group[++kept], group[i]);
  }
  if (!group.empty()) group.resize(kept + 1);
}

template <class Place>
void sort_by(const Frame& frame, std::vector<CellBarrier>& group, Place place) {
  std::stable_sort(group.begin(), group.end(), [&](const CellBarrier& a, const CellBarrier& b) {
    return std::tuple_cat(meaning(frame, a), place(a)) < std::tuple_cat(meaning(frame, b), place(b));
  });
}

}  // namespace

void merge_ranges(const Frame& frame, std::vector<CellBarrier>& group) {
  std::stable_sort(group.begin(), group.end(), [](const CellBarrier& a, const CellBarrier& b) { return a.cell < b.cell; });
  const auto neighbours = [&](const CellBarrier& a, const CellBarrier& b) { return frame.cells[a.cell].resource == frame.cells[b.cell].resource; };
  if (std::adjacent_find(group.begin(), group.end(), neighbours) == group.end()) return;  // the usual case: one cell a resource
  sort_by(frame, group, [](const CellBarrier& b) { return std::tuple(b.range.mip, b.range.layer, b.begin); });
  join_neighbours(frame, group, join_bytes);
  join_neighbours(frame, group, join_layers);
  sort_by(frame, group, [](const CellBarrier& b) { return std::tuple(b.range.layer, b.range.layers, b.range.mip, b.begin); });
  join_neighbours(frame, group, join_mips);
  std::stable_sort(group.begin(), group.end(), [&](const CellBarrier& a, const CellBarrier& b) { return a.cell < b.cell; });
}

}  // namespace rg::compiler
