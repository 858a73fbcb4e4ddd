#include "compiler/machine/cells.h"

#include <algorithm>
#include <set>

#include "compiler/machine/hardware.h"

namespace rg::machine {
namespace {

// Aspect bits by the format's name: d16, d32f, s8, d24_s8, ...
uint32_t aspects_of(dsl::Format format) {
  const std::string name = dsl::name(format);
  const bool depth = name[0] == 'd', stencil = name[0] == 's' || name.find("_s8") != std::string::npos;
  if (!depth && !stencil) return aspect_color;
  return (depth ? 2u : 0u) | (stencil ? 4u : 0u);
}

int64_t length(const dsl::Program& program, dsl::ExprId id, const std::vector<int64_t>& extents) {
  return id.valid() ? dsl::evaluate(program, id, extents) : 1;
}

Piece whole_of(const dsl::Program& program, const dsl::Resource& resource, const std::vector<int64_t>& extents) {
  if (resource.kind == dsl::ResourceKind::buffer)
    return {1, 0, static_cast<uint64_t>(length(program, resource.count, extents)) * std::max(resource.stride, 1u), 0, 1};
  return {aspects_of(resource.format), 0, mips_at(program, resource, extents), 0, resource.layers};
}

// Shader roles and attachments see one aspect where none is named.
uint32_t aspects_seen(dsl::Role role, uint32_t aspects) {
  if ((aspects & aspect_depth) == 0) return aspects;
  switch (role) {
    case dsl::Role::depth:
    case dsl::Role::depth_readonly:
    case dsl::Role::sampled:
    case dsl::Role::storage:
    case dsl::Role::input:
      return aspect_depth;
    case dsl::Role::stencil:
      return aspects & aspect_stencil;
    default:
      return aspects;
  }
}

uint64_t end_of(uint64_t begin, uint32_t count, uint64_t limit) { return count == UINT32_MAX ? limit : std::min<uint64_t>(begin + count, limit); }

Region by_aspect(uint32_t aspects, uint64_t x0, uint64_t x1, uint64_t y0, uint64_t y1) {
  Region region;
  for (const uint32_t aspect : {1u, 2u, 4u})
    if ((aspects & aspect) && x0 < x1 && y0 < y1) region.push_back({aspect, x0, x1, y0, y1});
  return region;
}

Region subresources(const Piece& whole, uint32_t aspects, uint32_t mip, uint32_t mips, uint32_t layer, uint32_t layers) {
  return by_aspect(whole.aspect & aspects, mip, end_of(mip, mips, whole.x1), layer, end_of(layer, layers, whole.y1));
}

// Cuts every aspect along all begins and ends of its regions.
std::vector<Piece> cut(const Piece& whole, const std::vector<Region>& regions) {
  std::vector<Piece> pieces;
  for (const Piece& aspect : by_aspect(whole.aspect, whole.x0, whole.x1, whole.y0, whole.y1)) {
    std::set<uint64_t> xs{whole.x0, whole.x1}, ys{whole.y0, whole.y1};
    for (const Region& region : regions)
      for (const Piece& each : region)
        if (each.aspect == aspect.aspect) xs.insert({each.x0, each.x1}), ys.insert({each.y0, each.y1});
    for (auto x = xs.begin(); std::next(x) != xs.end(); ++x)
      for (auto y = ys.begin(); std::next(y) != ys.end(); ++y) pieces.push_back({aspect.aspect, *x, *std::next(x), *y, *std::next(y)});
  }
  return pieces;
}

// All regions that occur, by program resource.
std::vector<std::vector<Region>> all_regions(const dsl::Program& program, const dsl::Graph& graph, const Plan& plan,
                                             const std::vector<uint32_t>& program_resource, const Cells& cells) {
  std::vector<std::vector<Region>> regions(graph.resources.size());
  for (const dsl::Pass& pass : graph.passes)
    for (const dsl::Access& access : pass.accesses) regions[access.resource.value].push_back(region_of(program, graph, cells, access));
  const auto image = [&](const Ref& ref, const Range& range) {
    const uint32_t resource = program_resource[ref.resource];
    if (graph.resources.rows[resource].kind == dsl::ResourceKind::image) regions[resource].push_back(region_of(cells.resources[resource], range));
  };
  for (const ImageBarrier& barrier : plan.image_barriers) image(barrier.image, barrier.range);
  for (const Attachment& attachment : plan.attachments) image(attachment.ref, attachment.range);
  for (const auto& boundaries : {plan.entry, plan.exit})
    for (const Boundary& boundary : boundaries) {
      const uint32_t resource = program_resource[boundary.ref.resource];
      regions[resource].push_back(region_of(plan, cells, cells.resources[resource], boundary));
    }
  for (const Access& access : plan.accesses) image(access.ref, access.range);
  for (const BufferBarrier& barrier : plan.buffer_barriers) {
    const uint32_t resource = program_resource[barrier.buffer.resource];
    regions[resource].push_back(region_of(plan, cells, cells.resources[resource], barrier.bytes));
  }
  return regions;
}

uint32_t copies_of(const dsl::Resource& resource, uint32_t frames) {
  if (resource.lifetime == dsl::Lifetime::history) return resource.history + 1;
  return resource.lifetime == dsl::Lifetime::readback || resource.is_surface ? frames : 1;
}

void add_rivals(Cells& cells, const std::vector<Placement>& placement) {
  cells.rivals.resize(cells.count);
  const auto place_of = [&](uint32_t cell) {
    const Index resource = cells.resources[cells.resource_of[cell]].plan_resource;
    return resource < placement.size() ? placement[resource] : Placement{};
  };
  for (uint32_t a = 0; a < cells.count; ++a)
    for (uint32_t b = 0; b < cells.count; ++b) {
      const Placement one = place_of(a), other = place_of(b);
      if (cells.resource_of[a] == cells.resource_of[b] || one.bytes == 0 || other.bytes == 0) continue;
      if (one.offset < other.offset + other.bytes && other.offset < one.offset + one.bytes) cells.rivals[a].push_back(b);
    }
}

}  // namespace

uint32_t mips_at(const dsl::Program& program, const dsl::Resource& image, const std::vector<int64_t>& extents) {
  int64_t longest = std::max(length(program, image.width, extents), length(program, image.height, extents));
  if (image.dimension == dsl::Dimension::d3) longest = std::max(longest, length(program, image.depth, extents));
  uint32_t chain = 1;
  for (; longest > 1; longest /= 2) ++chain;
  return std::min(image.mips, chain);
}

Region region_of(const dsl::Program& program, const dsl::Graph& graph, const Cells& cells, const dsl::Access& access) {
  const Piece& whole = cells.resources[access.resource.value].whole;
  const dsl::Range& range = access.range;
  if (graph.resources[access.resource].kind == dsl::ResourceKind::image)
    return subresources(whole, range.aspects ? range.aspects : aspects_seen(access.role, whole.aspect), range.mip,
                        is_attachment(access.role) ? 1 : range.mips, range.layer, range.layers);
  const uint64_t begin = range.offset.valid() ? static_cast<uint64_t>(length(program, range.offset, cells.extents)) : 0;
  const uint64_t end = range.size.valid() ? begin + static_cast<uint64_t>(length(program, range.size, cells.extents)) : whole.x1;
  return by_aspect(1, begin, std::min(end, whole.x1), 0, 1);
}

Region region_of(const ResourceCells& resource, const Range& range) {
  return subresources(resource.whole, range.aspects ? range.aspects : resource.whole.aspect, range.mip, range.mips, range.layer, range.layers);
}

Region region_of(const Plan& plan, const Cells& cells, const ResourceCells& resource, const Bytes& bytes) {
  const uint64_t begin = bytes.offset == kNone ? 0 : static_cast<uint64_t>(evaluate(plan.exprs, bytes.offset, cells.extents));
  const uint64_t end = bytes.size == kNone ? resource.whole.x1 : begin + static_cast<uint64_t>(evaluate(plan.exprs, bytes.size, cells.extents));
  return by_aspect(1, begin, std::min(end, resource.whole.x1), 0, 1);
}

Region region_of(const Plan& plan, const Cells& cells, const ResourceCells& resource, const Boundary& boundary) {
  return resource.image ? region_of(resource, boundary.range) : region_of(plan, cells, resource, boundary.bytes);
}

Pieces pieces_in(const ResourceCells& resource, const Region& region) {
  Pieces result;
  for (uint32_t i = 0; i < resource.pieces.size(); ++i) {
    const Piece& piece = resource.pieces[i];
    for (const Piece& part : region)
      if (piece.aspect == part.aspect && piece.x0 >= part.x0 && piece.x1 <= part.x1 && piece.y0 >= part.y0 && piece.y1 <= part.y1)
        result.push_back(i);
  }
  return result;
}

uint32_t physical_cell(const ResourceCells& resource, uint32_t piece, uint32_t age, uint32_t frame) {
  const uint32_t copy = (frame + resource.copies - age % resource.copies) % resource.copies;
  return resource.first_cell + copy * static_cast<uint32_t>(resource.pieces.size()) + piece;
}

Cells make_cells(const dsl::Program& program, const dsl::Graph& graph, const Plan& plan, const std::vector<uint32_t>& program_resource,
                 const MachineOptions& options) {
  Cells cells;
  cells.extents = options.extents.empty() ? dsl::initial_extents(program) : options.extents;
  cells.resources.resize(graph.resources.size());
  for (uint32_t i = 0; i < cells.resources.size(); ++i) {
    cells.resources[i].whole = whole_of(program, graph.resources.rows[i], cells.extents);
    cells.resources[i].image = graph.resources.rows[i].kind == dsl::ResourceKind::image;
  }
  for (Index i = 0; i < program_resource.size(); ++i) {
    cells.resources[program_resource[i]].exists = true;
    cells.resources[program_resource[i]].plan_resource = i;
  }
  const auto regions = all_regions(program, graph, plan, program_resource, cells);
  for (uint32_t i = 0; i < cells.resources.size(); ++i) {
    ResourceCells& resource = cells.resources[i];
    resource.pieces = cut(resource.whole, regions[i]);
    resource.copies = copies_of(graph.resources.rows[i], options.frames);
    resource.first_cell = cells.count;
    cells.count += resource.copies * static_cast<uint32_t>(resource.pieces.size());
    cells.resource_of.resize(cells.count, i);
    for (uint32_t copy = 0; copy < resource.copies; ++copy)
      for (const Piece& piece : resource.pieces) cells.aspect_of.push_back(piece.aspect);
  }
  add_rivals(cells, options.placement);
  return cells;
}

}  // namespace rg::machine
