#include "compiler/emit_plan.h"
#include "compiler/format_table.h"
#include "compiler/slots.h"

namespace rg::compiler {
namespace {

constexpr uint32_t kTransferTarget = 0x2;  // of images and of buffers

// Storage of a buffer of texels goes through a view, not through a block.
uint32_t use_bits(const dsl::Pass& pass, const dsl::Access& access, const dsl::Resource& resource) {
  constexpr uint32_t kStorageTexels = 0x8;
  const bool texels = resource.kind == dsl::ResourceKind::buffer && resource.format != dsl::Format::none;
  if (texels && access.role == dsl::Role::storage) return kStorageTexels;
  return usage_of(pass, access.role, resource.kind, format_row(resource.format).aspects);
}

// What live passes do with each resource, as usage flags.
std::vector<uint32_t> find_usage(const PlanParts& parts) {
  const Frame& frame = parts.frame;
  std::vector<uint32_t> usage(frame.graph->resources.size());
  for (const uint32_t pass : parts.schedule.order)
    for (const dsl::Access& access : frame.pass(pass).accesses) {
      const dsl::Resource& resource = frame.graph->resources[access.resource];
      usage[access.resource.value] |= use_bits(frame.pass(pass), access, resource);
    }
  for (uint32_t r = 0; r < usage.size(); ++r)
    if (frame.graph->resources.rows[r].init == dsl::InitKind::clear) usage[r] |= kTransferTarget;
  return usage;
}

void set_image(const dsl::Resource& from, Resource& row) {
  row.dimension = static_cast<Dimension>(from.dimension);
  row.format = format_row(from.format).vulkan;
  row.aspects = format_row(from.format).aspects;
  row.width = index_of(from.width), row.height = index_of(from.height), row.depth = index_of(from.depth);
  row.mips = from.mips, row.layers = from.layers, row.samples = from.samples;
}

Resource make_row(const PlanParts& parts, uint32_t program_index, Expressions& exprs) {
  const dsl::Resource& from = parts.frame.graph->resources.rows[program_index];
  Resource row;
  row.name = intern(from.name);
  row.kind = static_cast<ResourceKind>(from.kind);
  row.lifetime = static_cast<rg::Lifetime>(from.lifetime);
  if (from.kind == dsl::ResourceKind::image) set_image(from, row);
  if (from.kind == dsl::ResourceKind::buffer)
    row.bytes = exprs.binary(ExprOp::mul, index_of(from.count), exprs.constant(from.stride)), row.stride = from.stride;
  row.copies = parts.frame.grids[program_index].ages;
  row.init = static_cast<InitKind>(from.init);
  row.init_value = plan_clear(from.init_value, row.aspects);
  row.is_surface = from.is_surface;
  // What is observable at the end of the frame gives its bytes to nobody.
  row.no_alias = from.no_alias || (from.lifetime == dsl::Lifetime::transient && (from.is_output || !parts.options.aliasing));
  row.estimated_bytes = parts.frame.bytes[program_index];
  if (from.lifetime == dsl::Lifetime::transient)
    row.estimated_alignment = from.kind == dsl::ResourceKind::image ? parts.options.image_alignment : parts.options.buffer_alignment;
  return row;
}

// Images that some live pass sees in another format.
std::vector<bool> find_reinterpreted(const PlanParts& parts) {
  std::vector<bool> found(parts.frame.graph->resources.size());
  for (uint32_t pass = 0; pass < parts.frame.passes.size(); ++pass)
    for (const dsl::Access& access : parts.frame.pass(pass).accesses)
      if (access.view != dsl::Format::none) found[access.resource.value] = true;
  return found;
}

}  // namespace

void emit_resources(const PlanParts& parts, const PlanIndices& indices, Expressions& exprs, PlanData& plan) {
  const std::vector<uint32_t> usage = find_usage(parts);
  const std::vector<bool> reinterpreted = find_reinterpreted(parts);
  const std::vector<Index> slots = import_slots(*parts.frame.graph);
  for (uint32_t r = 0; r < indices.resource.size(); ++r) {
    if (indices.resource[r] == kNone) continue;
    Resource row = make_row(parts, r, exprs);
    row.usage = usage[r];
    row.mutable_format = reinterpreted[r];
    row.import_slot = slots[r];
    row.concurrent = parts.sync.concurrent[r];
    if (row.lifetime == rg::Lifetime::transient)
      row.no_alias = row.no_alias || parts.sync.scattered[r] || parts.options.no_aliasing.contains(std::string(row.name));
    plan.resources.push_back(row);
  }
}

}  // namespace rg::compiler
