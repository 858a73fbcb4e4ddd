#include "compiler/verify/cells.h"

#include <algorithm>
#include <string_view>

namespace rg::verify {
namespace {

uint64_t end_of(uint64_t begin, uint64_t count, uint64_t limit, uint64_t rest) {
  if (count == rest) return limit;
  return begin + count;
}

std::vector<uint64_t> cuts(const std::vector<Box>& boxes, uint64_t limit, bool mips) {
  std::vector<uint64_t> result{0, limit};
  for (const Box& box : boxes) {
    if (box.empty()) continue;
    result.push_back(std::min(mips ? box.mip_begin : box.layer_begin, limit));
    result.push_back(std::min(mips ? box.mip_end : box.layer_end, limit));
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  if (result.size() == 1) result.push_back(result.front() + 1);
  return result;
}

std::string span_text(const char* what, uint64_t begin, uint64_t end) {
  if (end == begin + 1) return std::string(what) + " " + std::to_string(begin);
  return std::string(what) + "s " + std::to_string(begin) + ".." + std::to_string(end - 1);
}

}  // namespace

uint32_t aspects_of(dsl::Format format) {
  const std::string_view text = dsl::name(format);
  uint32_t aspects = 0;
  if (text.starts_with("d16") || text.starts_with("d24") || text.starts_with("d32")) aspects |= aspect_depth;
  if (text == "s8" || text.ends_with("_s8")) aspects |= aspect_stencil;
  return aspects == 0 ? static_cast<uint32_t>(aspect_color) : aspects;
}

Shape shape_of(const dsl::Program& program, const dsl::Resource& resource, const std::vector<int64_t>& extents) {
  Shape shape;
  shape.image = resource.kind == dsl::ResourceKind::image;
  if (shape.image) {
    shape.aspects = aspects_of(resource.format);
    shape.mips = std::max(resource.mips, 1u);
    shape.layers = std::max(resource.layers, 1u);
    return shape;
  }
  const int64_t count = resource.count.valid() ? dsl::evaluate(program, resource.count, extents) : 1;
  shape.mips = static_cast<uint64_t>(std::max<int64_t>(count * std::max(resource.stride, 1u), 1));
  return shape;
}

Box box_of(const dsl::Program& program, const Shape& shape, const dsl::Range& range, const std::vector<int64_t>& extents) {
  Box box;
  if (!shape.image) {
    box.aspects = 1;
    box.layer_end = 1;
    box.mip_begin = range.offset.valid() ? static_cast<uint64_t>(dsl::evaluate(program, range.offset, extents)) : 0;
    box.mip_end = range.size.valid() ? box.mip_begin + static_cast<uint64_t>(dsl::evaluate(program, range.size, extents)) : shape.mips;
    box.mip_end = std::min(box.mip_end, shape.mips);
    return box;
  }
  box.aspects = range.aspects == 0 ? shape.aspects : range.aspects & shape.aspects;
  box.mip_begin = range.mip;
  box.mip_end = end_of(range.mip, range.mips, shape.mips, dsl::kAll);
  box.layer_begin = range.layer;
  box.layer_end = end_of(range.layer, range.layers, shape.layers, dsl::kAll);
  return box;
}

Box box_of(const Shape& shape, const Range& range) {
  Box box;
  box.aspects = range.aspects == 0 ? shape.aspects : range.aspects;
  box.mip_begin = range.mip;
  box.mip_end = end_of(range.mip, range.mips, shape.mips, kRemaining);
  box.layer_begin = range.layer;
  box.layer_end = end_of(range.layer, range.layers, shape.layers, kRemaining);
  return box;
}

Box box_of(std::span<const Expr> exprs, const Shape& shape, const Bytes& bytes, const std::vector<int64_t>& extents) {
  Box box;
  box.aspects = 1;
  box.layer_end = 1;
  box.mip_begin = bytes.offset == kNone ? 0 : static_cast<uint64_t>(evaluate(exprs, bytes.offset, extents));
  box.mip_end = bytes.size == kNone ? shape.mips : box.mip_begin + static_cast<uint64_t>(evaluate(exprs, bytes.size, extents));
  box.mip_end = std::min(box.mip_end, shape.mips);
  return box;
}

Partition make_partition(const Shape& shape, const std::vector<Box>& boxes) {
  Partition partition;
  partition.shape = shape;
  partition.mip_cuts = cuts(boxes, shape.mips, true);
  partition.layer_cuts = cuts(boxes, shape.layers, false);
  for (uint32_t bit = 1; bit <= aspect_stencil; bit *= 2)
    if (shape.aspects & bit) partition.aspects.push_back(bit);
  return partition;
}

std::vector<uint32_t> cells_in(const Partition& partition, const Box& box) {
  std::vector<uint32_t> cells;
  const size_t mips = partition.mip_cuts.size() - 1, layers = partition.layer_cuts.size() - 1;
  for (size_t a = 0; a < partition.aspects.size(); ++a) {
    if (!(box.aspects & partition.aspects[a])) continue;
    for (size_t m = 0; m < mips; ++m) {
      if (partition.mip_cuts[m] < box.mip_begin || partition.mip_cuts[m] >= box.mip_end) continue;
      for (size_t l = 0; l < layers; ++l)
        if (partition.layer_cuts[l] >= box.layer_begin && partition.layer_cuts[l] < box.layer_end)
          cells.push_back(static_cast<uint32_t>((a * mips + m) * layers + l));
    }
  }
  return cells;
}

uint32_t aspect_of_cell(const Partition& partition, uint32_t cell) {
  return partition.aspects[cell / ((partition.mip_cuts.size() - 1) * (partition.layer_cuts.size() - 1))];
}

uint64_t first_mip_of_cell(const Partition& partition, uint32_t cell) {
  return partition.mip_cuts[cell / (partition.layer_cuts.size() - 1) % (partition.mip_cuts.size() - 1)];
}

std::string cell_text(const Partition& partition, uint32_t cell) {
  const size_t layers = partition.layer_cuts.size() - 1, mips = partition.mip_cuts.size() - 1;
  const size_t layer = cell % layers, mip = cell / layers % mips;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : " ") + part; };
  if (partition.aspects.size() > 1) add(aspect_of_cell(partition, cell) == aspect_depth ? "depth" : "stencil");
  if (mips > 1) add(span_text(partition.shape.image ? "mip" : "byte", partition.mip_cuts[mip], partition.mip_cuts[mip + 1]));
  if (layers > 1) add(span_text("layer", partition.layer_cuts[layer], partition.layer_cuts[layer + 1]));
  return text;
}

}  // namespace rg::verify
