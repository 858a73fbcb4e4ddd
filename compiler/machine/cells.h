// Where versions live. A resource is cut into pieces so that every range of program and plan is a set of whole pieces; the physical cells of a
// resource are its pieces once a copy.
//
//   resources   those of the program by their id; pieces are shared by program and plan
//   copies      history n: n + 1, age k in frame f is copy (f - k) mod (n + 1); read-back buffers and surfaces: one a frame; others one
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/machine/machine.h"

namespace rg::machine {

// Half-open in x and y. Images: mips and layers of one aspect; buffers: bytes and [0, 1) of aspect 1.
struct Piece {
  uint32_t aspect = 1;
  uint64_t x0 = 0, x1 = 0, y0 = 0, y1 = 1;
};
using Region = std::vector<Piece>;  // one for each aspect; empty where the range lies beyond the resource
using Pieces = std::vector<uint32_t>;

struct ResourceCells {
  bool image = false;
  bool exists = false;  // has a plan resource
  uint32_t plan_resource = kNone;
  Piece whole;  // aspect holds all bits
  uint32_t copies = 1;
  uint32_t first_cell = 0;  // physical
  std::vector<Piece> pieces;
};

struct Cells {
  std::vector<int64_t> extents;
  std::vector<ResourceCells> resources;       // by program resource
  std::vector<uint32_t> resource_of;          // by physical cell
  std::vector<uint32_t> aspect_of;            // by physical cell: 1 for buffers
  std::vector<std::vector<uint32_t>> rivals;  // by physical cell: cells of other resources in the same memory
  uint32_t count = 0;
};

Cells make_cells(const dsl::Program& program, const dsl::Graph& graph, const Plan& plan, const std::vector<uint32_t>& program_resource,
                 const MachineOptions& options);

Region region_of(const dsl::Program& program, const dsl::Graph& graph, const Cells& cells, const dsl::Access& access);
Region region_of(const ResourceCells& resource, const Range& range);
Region region_of(const Plan& plan, const Cells& cells, const ResourceCells& resource, const Bytes& bytes);
Region region_of(const Plan& plan, const Cells& cells, const ResourceCells& resource, const Boundary& boundary);

// Pieces inside the region, ascending.
Pieces pieces_in(const ResourceCells& resource, const Region& region);
uint32_t physical_cell(const ResourceCells& resource, uint32_t piece, uint32_t age, uint32_t frame);

// Mips the image has at the extents: its declared maximum or the full chain.
uint32_t mips_at(const dsl::Program& program, const dsl::Resource& image, const std::vector<int64_t>& extents);

}  // namespace rg::machine
