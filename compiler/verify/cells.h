// Locations. Every resource is cut into cells so that each range that occurs in program or plan is a set of whole cells:
//
//   image   mip and layer counts cut at every range end, aspects apart     mips  [0][1][2..8]   x layers [0..5] x {depth, stencil}
//   buffer  bytes cut at every offset and end that occurs                  bytes [0, 256) [256, end)
//
// So the cost follows the number of distinct ranges, not the number of subresources. Copies of history resources share one partition.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::verify {

// A range in numbers: half-open in mips, layers and bytes.
struct Box {
  uint32_t aspects = 0;
  uint64_t mip_begin = 0, mip_end = 0, layer_begin = 0, layer_end = 0;  // buffers: mips hold bytes, layers [0, 1)
  bool empty() const { return aspects == 0 || mip_begin >= mip_end || layer_begin >= layer_end; }
  friend bool operator==(const Box&, const Box&) = default;
};

// What the partition needs to know of one resource.
struct Shape {
  bool image = false;
  uint32_t aspects = 1;  // buffers: 1
  uint64_t mips = 1;     // buffers: bytes
  uint32_t layers = 1;
  friend bool operator==(const Shape&, const Shape&) = default;
};

struct Partition {
  Shape shape;
  std::vector<uint64_t> mip_cuts, layer_cuts;  // sorted, first 0, last the count
  std::vector<uint32_t> aspects;               // single bits
  uint32_t cell_count() const { return static_cast<uint32_t>(aspects.size() * (mip_cuts.size() - 1) * (layer_cuts.size() - 1)); }
  friend bool operator==(const Partition&, const Partition&) = default;
};

// Aspect bits of a format; the checker's own reading of its name.
uint32_t aspects_of(dsl::Format format);
// At the given extents. Images take declared maxima of mips.
Shape shape_of(const dsl::Program& program, const dsl::Resource& resource, const std::vector<int64_t>& extents);
Box box_of(const dsl::Program& program, const Shape& shape, const dsl::Range& range, const std::vector<int64_t>& extents);
Box box_of(const Shape& shape, const Range& range);
Box box_of(std::span<const Expr> exprs, const Shape& shape, const Bytes& bytes, const std::vector<int64_t>& extents);

Partition make_partition(const Shape& shape, const std::vector<Box>& boxes);
// Cells inside `box`, ascending. `box` must be one the partition was made with, or made of whole cells.
std::vector<uint32_t> cells_in(const Partition& partition, const Box& box);
uint32_t aspect_of_cell(const Partition& partition, uint32_t cell);
uint64_t first_mip_of_cell(const Partition& partition, uint32_t cell);
// `mips 1..3 layer 0`, `bytes 256..512`; empty for the whole resource.
std::string cell_text(const Partition& partition, uint32_t cell);

}  // namespace rg::verify
