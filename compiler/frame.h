// One configuration of a graph, in the planner's terms: passes that exist, cells of resources, who uses which cell how.
//
// A cell is the smallest piece of a resource that any access tells apart: one rectangle of mips and layers of one aspect of one history age, or
// one byte interval. Everything later thinks in cells and merges them back into ranges when it prints.
//
//   image bloom mips 3, read whole by one pass, mip by mip by others          cells: mip 0 | mip 1 | mip 2
//   image shadow layers 4, written layer by layer                            cells: 4 layers
//   image albedo, always used whole                                         one cell
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "compiler/access_table.h"
#include "compiler/plan_frame.h"
#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::compiler {

struct Cell {
  uint32_t resource = 0;  // program index
  uint32_t age = 0;
  Range range;                           // images: exact counts, never kRemaining
  uint64_t begin = 0, end = UINT64_MAX;  // buffers: bytes, the last cell ends at UINT64_MAX
  friend bool operator==(const Cell&, const Cell&) = default;
};

// Passes that need no order among themselves on a cell, although they write it.
enum class Share : uint8_t { none, atomic, disjoint };

// Everything one pass does to one cell.
struct Use {
  uint32_t pass = 0, cell = 0;
  Effect effect;
  bool needs = false;    // depends on earlier contents, be it only because the pass may be skipped
  bool defines = false;  // leaves every element defined, whatever the conditions
  Share share = Share::none;
  bool writes() const { return effect.writes != 0; }
};

struct ByteCut {  // at offset + size, an invalid one being 0
  dsl::ExprId offset, size;
};

// How a resource is cut into cells; cells of one resource are contiguous: by age, aspect, mip piece, layer piece or byte piece.
struct Grid {
  uint32_t first_cell = 0, ages = 1;
  std::vector<uint32_t> aspects, mips, layers;  // images; cuts of mips and layers, first 0, last the count
  std::vector<uint64_t> bytes;                  // buffers; cuts, first 0, last UINT64_MAX
  // Buffers that are cut by extents: `bytes` counts these, and so do the cells; where ranges, by offset and size, begin and end.
  std::vector<ByteCut> cuts;
  std::map<std::pair<uint32_t, uint32_t>, std::pair<uint64_t, uint64_t>> places;
  uint32_t cells_per_age() const;
};

struct Frame {
  const dsl::Program* program = nullptr;
  const dsl::Graph* graph = nullptr;
  std::vector<uint32_t> passes;  // program indices of passes whose guard holds, in program order; "pass" below is an index into this
  std::vector<Grid> grids;       // by program resource
  std::vector<Cell> cells;
  std::vector<Use> uses;            // by pass, then cell
  std::vector<uint32_t> first_use;  // by pass, one more at the end
  std::vector<uint64_t> bytes;      // estimated size by program resource, one copy
  const dsl::Pass& pass(uint32_t index) const { return graph->passes.rows[passes[index]]; }
  const dsl::Resource& resource_of(uint32_t cell) const { return graph->resources.rows[cells[cell].resource]; }
  std::span<const Use> uses_of(uint32_t pass) const { return {uses.data() + first_use[pass], first_use[pass + 1] - first_use[pass]}; }
};

// Keeps what the configuration's features select. O(accesses * cells they touch).
Frame expand(const dsl::Program& program, dsl::GraphId graph, const Configuration& configuration, const PlanOptions& options);

// True if contents of the resource that nobody needs may be lost.
inline bool may_discard(const PlanOptions& options, const dsl::Resource& resource) {
  return options.discard && (options.no_discard.empty() || !options.no_discard.contains(resource.name));
}
// Attachments that may not be discarded are loaded, whether their contents are needed or not. After culling, which is not to see that.
void keep_contents(Frame& frame, const PlanOptions& options);

// Cells that `access` touches, ascending.
std::vector<uint32_t> cells_of(const Frame& frame, const dsl::Access& access);

// Aspects of the access, mips and layers within the image, defaults filled in.
Range resolved_range(const dsl::Resource& resource, const dsl::Access& access);

// Of one copy, packed tightly, with mips, layers and samples. Buffers of unknown length count as one element.
uint64_t bytes_of(const dsl::Resource& resource, std::span<const Expr> exprs, std::span<const int64_t> extents);

// True if the pass may be skipped in a frame while the cell exists.
bool may_skip(const Frame& frame, uint32_t pass, const Cell& cell);

}  // namespace rg::compiler
