#include <algorithm>

#include "compiler/byte_cuts.h"
#include "compiler/expressions.h"
#include "compiler/format_table.h"
#include "compiler/frame.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

bool holds(const dsl::Guard& guard, const Configuration& configuration) {
  for (const dsl::Guard::Term& term : guard.terms) {
    const uint32_t value = term.feature.value < configuration.size() ? configuration[term.feature.value] : 0;
    if ((value == term.value) == term.negated) return false;
  }
  return true;
}

struct ByteInterval {
  uint64_t begin = 0, end = UINT64_MAX;
};
// Size of a buffer, if it does not depend on extents.
std::optional<uint64_t> constant_size(const dsl::Program& program, const dsl::Resource& resource) {
  const auto count = constant_value(program, resource.count);
  if (!count) return std::nullopt;
  return static_cast<uint64_t>(*count) * resource.stride;
}

// Of an access to a buffer, everything from its size on being UINT64_MAX; nullopt where parts of it depend on extents.
std::optional<ByteInterval> constant_bytes(const dsl::Program& program, const dsl::Resource& resource, const dsl::Range& range) {
  if (!range.offset.valid() && !range.size.valid()) return ByteInterval{};
  const auto total = constant_size(program, resource);
  const auto offset = range.offset.valid() ? constant_value(program, range.offset) : 0;
  const auto size = range.size.valid() ? constant_value(program, range.size) : INT64_MAX;
  if (!total || !offset || !size) return std::nullopt;
  ByteInterval bytes{static_cast<uint64_t>(*offset), static_cast<uint64_t>(*offset) + static_cast<uint64_t>(*size)};
  if (bytes.end >= *total) bytes.end = UINT64_MAX;
  return bytes;
}

uint32_t format_aspects(const dsl::Resource& resource) { return format_row(resource.format).aspects; }

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class Visit>
void for_each_access(const Frame& frame, Visit visit) {
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass)
    for (const dsl::Access& access : frame.pass(pass).accesses) visit(frame.pass(pass), access);
}

// Of an access to a buffer, as numbers of its grid; everything where that is not cut by what extents decide.
ByteInterval piece_of(const Frame& frame, const dsl::Access& access) {
  const Grid& grid = frame.grids[access.resource.value];
  const auto place = grid.places.find({access.range.offset.value, access.range.size.value});
  if (place != grid.places.end()) return {place->second.first, place->second.second};
  if (!grid.cuts.empty()) return {};
  return constant_bytes(*frame.program, (*frame.graph).resources[access.resource], access.range).value_or(ByteInterval{});
}

// Passes whose range is not known, though some are: they touch some of the one cell.
bool is_partial(const Frame& frame, const dsl::Access& access) {
  const dsl::Resource& resource = (*frame.graph).resources[access.resource];
  return resource.kind == dsl::ResourceKind::buffer && frame.grids[access.resource.value].cuts.empty() &&
         !constant_bytes(*frame.program, resource, access.range);
}

void cut_grids(Frame& frame) {
  const auto& resources = frame.graph->resources.rows;
  frame.grids.resize(resources.size());
  std::vector<bool> symbolic(resources.size());
  std::vector<std::vector<dsl::Range>> ranges(resources.size());  // of buffers, those that are not the whole
  dsl::Formulas formulas(*frame.program);
  for_each_access(frame, [&](const dsl::Pass&, const dsl::Access& access) {
    const dsl::Resource& resource = resources[access.resource.value];
    Grid& grid = frame.grids[access.resource.value];
    grid.ages = std::max({grid.ages, access.age + 1, resource.lifetime == dsl::Lifetime::history ? resource.history + 1 : 1});
    if (resource.kind == dsl::ResourceKind::buffer) {
      const auto bytes = constant_bytes(*frame.program, resource, access.range);
      if (!bytes) symbolic[access.resource.value] = true;
      if (access.range.offset.valid()) ranges[access.resource.value].push_back(access.range);
      if (bytes) grid.bytes.insert(grid.bytes.end(), {bytes->begin, bytes->end});
      return;
    }
    const Range range = resolved_range(resource, access);
    if (range.mip > 0 || range.mips < resource.mips) grid.mips.insert(grid.mips.end(), {range.mip, range.mip + range.mips});
    if (range.layer > 0 || range.layers < resource.layers) grid.layers.insert(grid.layers.end(), {range.layer, range.layer + range.layers});
  });
  for (uint32_t r = 0; r < resources.size(); ++r) {
    Grid& grid = frame.grids[r];
    if (symbolic[r]) grid.bytes.clear();
    if (symbolic[r] && cut_bytes(formulas, resources[r], ranges[r], grid)) continue;
    grid.bytes.insert(grid.bytes.end(), {0, UINT64_MAX});
    grid.mips.insert(grid.mips.end(), {0, resources[r].mips});
    grid.layers.insert(grid.layers.end(), {0, resources[r].layers});
    for (uint32_t bit = 1; bit <= aspect_stencil; bit <<= 1)
      if (resources[r].kind == dsl::ResourceKind::image && (format_aspects(resources[r]) & bit)) grid.aspects.push_back(bit);
    sort_unique(grid.bytes);
    sort_unique(grid.mips);
    sort_unique(grid.layers);
  }
}

void add_cells(Frame& frame, uint32_t resource, bool is_buffer) {
  Grid& grid = frame.grids[resource];
  grid.first_cell = static_cast<uint32_t>(frame.cells.size());
  for (uint32_t age = 0; age < grid.ages; ++age) {
    if (is_buffer) {
      for (size_t i = 0; i + 1 < grid.bytes.size(); ++i) frame.cells.push_back({resource, age, {0, 0, 0, 0, 0}, grid.bytes[i], grid.bytes[i + 1]});
      continue;
    }
    for (const uint32_t aspect : grid.aspects)
      for (size_t m = 0; m + 1 < grid.mips.size(); ++m)
        for (size_t l = 0; l + 1 < grid.layers.size(); ++l)
          frame.cells.push_back(
              {resource, age, {aspect, grid.mips[m], grid.mips[m + 1] - grid.mips[m], grid.layers[l], grid.layers[l + 1] - grid.layers[l]}, 0, 0});
  }
}

// A pass that names a resource twice, to sample the depth it tests, say: one use with both effects.
void merge_use(Use& use, const Use& other) {
  Effect& a = use.effect;
  const Effect& b = other.effect;
  a.read_stages |= b.read_stages, a.write_stages |= b.write_stages;
  a.reads |= b.reads, a.writes |= b.writes;
  if (a.layout != b.layout) a.layout = Layout::general;
  use.defines = use.defines || other.defines;
  use.needs = use.needs || other.needs;
  if (use.share != other.share) use.share = Share::none;
}

Use make_use(const Frame& frame, uint32_t pass_index, const dsl::Access& access, uint32_t cell_index, bool partial) {
  const dsl::Pass& pass = frame.pass(pass_index);
  const Cell& cell = frame.cells[cell_index];
  Use use{pass_index, cell_index, effect_of(pass, access, cell.range.aspects), needs_contents(pass, access), defines_range(pass, access),
          Share::none};
  if (frame.resource_of(cell_index).layout_general && access.role != dsl::Role::present) use.effect.layout = Layout::general;
  if (use.writes() && (partial || may_skip(frame, pass_index, cell))) use.needs = true, use.defines = false;
  if (access.mode == dsl::Mode::atomic) use.share = Share::atomic;
  if (access.disjoint) use.share = Share::disjoint;
  return use;
}

void add_uses(Frame& frame, uint32_t pass) {
  const size_t first = frame.uses.size();
  frame.first_use.push_back(static_cast<uint32_t>(first));
  for (const dsl::Access& access : frame.pass(pass).accesses) {
    const bool partial = is_partial(frame, access);
    for (const uint32_t cell : cells_of(frame, access)) frame.uses.push_back(make_use(frame, pass, access, cell, partial));
  }
  const auto begin = frame.uses.begin() + static_cast<ptrdiff_t>(first);
  std::stable_sort(begin, frame.uses.end(), [](const Use& a, const Use& b) { return a.cell < b.cell; });
  size_t kept = first;
  for (size_t i = first; i < frame.uses.size(); ++i) {
    if (kept > first && frame.uses[kept - 1].cell == frame.uses[i].cell)
      merge_use(frame.uses[kept - 1], frame.uses[i]);
    else
      frame.uses[kept++] = frame.uses[i];
  }
  frame.uses.resize(kept);
}

uint64_t image_bytes(const dsl::Resource& resource, std::span<const Expr> exprs, std::span<const int64_t> extents) {
  const FormatRow& format = format_row(resource.format);
  const auto size = [&](dsl::ExprId id) { return std::max<int64_t>(1, evaluate(exprs, index_of(id), extents)); };
  int64_t w = size(resource.width), h = size(resource.height), d = size(resource.depth);
  uint64_t texels = 0;
  for (uint32_t mip = 0; mip < resource.mips; ++mip) {
    const uint64_t blocks_x = (static_cast<uint64_t>(w) + format.block_width - 1) / format.block_width;
    const uint64_t blocks_y = (static_cast<uint64_t>(h) + format.block_height - 1) / format.block_height;
    texels += blocks_x * blocks_y * static_cast<uint64_t>(d);
    if (w == 1 && h == 1 && d == 1) break;
    w = std::max<int64_t>(1, w / 2), h = std::max<int64_t>(1, h / 2), d = std::max<int64_t>(1, d / 2);
  }
  return texels * format.block_bytes * resource.layers * resource.samples;
}

uint64_t align_up(uint64_t value, uint64_t alignment) { return (value + alignment - 1) / alignment * alignment; }

void estimate_sizes(Frame& frame, const PlanOptions& options) {
  const std::vector<Expr> exprs = convert_expressions(*frame.program);
  const std::vector<int64_t> extents = initial_values(*frame.program);
  for (const dsl::Resource& resource : frame.graph->resources) {
    const uint64_t alignment = resource.kind == dsl::ResourceKind::image ? options.image_alignment : options.buffer_alignment;
    frame.bytes.push_back(align_up(bytes_of(resource, exprs, extents), alignment));
  }
}

}  // namespace

uint64_t bytes_of(const dsl::Resource& resource, std::span<const Expr> exprs, std::span<const int64_t> extents) {
  if (resource.kind == dsl::ResourceKind::image) return image_bytes(resource, exprs, extents);
  return static_cast<uint64_t>(std::max<int64_t>(1, evaluate(exprs, index_of(resource.count), extents))) * resource.stride;
}

uint32_t Grid::cells_per_age() const {
  const size_t image = aspects.size() * (mips.size() - 1) * (layers.size() - 1);
  return static_cast<uint32_t>(aspects.empty() ? bytes.size() - 1 : image);
}

Range resolved_range(const dsl::Resource& resource, const dsl::Access& access) {
  Range range{access.range.aspects, access.range.mip, access.range.mips, access.range.layer, access.range.layers};
  if (resource.kind == dsl::ResourceKind::buffer) return range;
  if (range.aspects == 0) range.aspects = default_aspects(access.role, format_aspects(resource));
  RG_CHECK(range.mip < resource.mips && range.layer < resource.layers, "the front end keeps mips and layers within their image");
  // Attachments are one mip: the whole image means its first.
  range.mips = is_attachment(access.role) ? 1 : std::min(range.mips, resource.mips - range.mip);
  range.layers = std::min(range.layers, resource.layers - range.layer);
  return range;
}

std::vector<uint32_t> cells_of(const Frame& frame, const dsl::Access& access) {
  const dsl::Resource& resource = (*frame.graph).resources[access.resource];
  const Grid& grid = frame.grids[access.resource.value];
  const uint32_t first = grid.first_cell + access.age * grid.cells_per_age();
  std::vector<uint32_t> cells;
  if (resource.kind == dsl::ResourceKind::buffer) {
    const ByteInterval bytes = piece_of(frame, access);
    for (uint32_t i = 0; i + 1 < grid.bytes.size(); ++i)
      if (grid.bytes[i] >= bytes.begin && grid.bytes[i] < bytes.end) cells.push_back(first + i);
    if (grid.bytes.size() == 2) cells = {first};
    return cells;
  }
  const Range range = resolved_range(resource, access);
  uint32_t cell = first;
  for (const uint32_t aspect : grid.aspects)
    for (size_t m = 0; m + 1 < grid.mips.size(); ++m)
      for (size_t l = 0; l + 1 < grid.layers.size(); ++l, ++cell)
        if ((range.aspects & aspect) && grid.mips[m] >= range.mip && grid.mips[m] < range.mip + range.mips && grid.layers[l] >= range.layer &&
            grid.layers[l] < range.layer + range.layers)
          cells.push_back(cell);
  return cells;
}

void keep_contents(Frame& frame, const PlanOptions& options) {
  if (options.discard && options.no_discard.empty()) return;
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass)
    for (const dsl::Access& access : frame.pass(pass).accesses) {
      if (!is_attachment(access.role) || access.clear || may_discard(options, (*frame.graph).resources[access.resource])) continue;
      const std::vector<uint32_t> cells = cells_of(frame, access);
      for (uint32_t u = frame.first_use[pass]; u < frame.first_use[pass + 1]; ++u) {
        Use& use = frame.uses[u];
        if (!std::binary_search(cells.begin(), cells.end(), use.cell)) continue;
        use.needs = true;
        if (access.role == dsl::Role::color) use.effect.reads |= access::color_attachment_read, use.effect.read_stages |= use.effect.write_stages;
      }
    }
}

bool may_skip(const Frame& frame, uint32_t pass_index, const Cell& cell) {
  const dsl::Pass& pass = frame.pass(pass_index);
  if (!pass.conditions.empty()) return true;
  for (const dsl::MipLimit& limit : pass.mip_limits)
    if (limit.image.value != cell.resource || cell.range.mip < limit.mip) return true;
  return false;
}

Frame expand(const dsl::Program& program, dsl::GraphId graph, const Configuration& configuration, const PlanOptions& options) {
  Frame frame;
  frame.program = &program;
  frame.graph = &program.graphs[graph];
  for (uint32_t i = 0; i < frame.graph->passes.size(); ++i)
    if (holds(frame.graph->passes.rows[i].guard, configuration)) frame.passes.push_back(i);
  cut_grids(frame);
  for (uint32_t r = 0; r < frame.graph->resources.size(); ++r) add_cells(frame, r, frame.graph->resources.rows[r].kind == dsl::ResourceKind::buffer);
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass) add_uses(frame, pass);
  frame.first_use.push_back(static_cast<uint32_t>(frame.uses.size()));
  estimate_sizes(frame, options);
  return frame;
}

}  // namespace rg::compiler
