#include "compiler/access_table.h"

#include <array>
#include <bit>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

using dsl::Mode;
using dsl::Role;

struct Row {
  Role role;
  Stages stages;
  Accesses reads, writes;
  Layout layout;
  uint32_t image_usage, buffer_usage;
};

constexpr Row kRows[] = {
#define RG_ROLE(role, stages, reads, writes, layout, image_usage, buffer_usage) \
  {Role::role, stage::stages, access::reads, access::writes, Layout::layout, image_usage, buffer_usage},
#include "compiler/access.def"
#undef RG_ROLE
};
// A resolve in a transfer pass is a command of its own.
constexpr Row kResolveCommandSource = {Role::resolve_src, stage::resolve, access::transfer_read, 0, Layout::transfer_src, 0x1, 0};
constexpr Row kResolveCommandTarget = {Role::resolve_dst, stage::resolve, 0, access::transfer_write, Layout::transfer_dst, 0x2, 0};

const Row& row_of(Role role) {
  for (const Row& row : kRows)
    if (row.role == role) return row;
  RG_CHECK(false, "every role has a row in access.def");
  return kRows[0];
}
const Row& row_of(const dsl::Pass& pass, Role role) {
  if (pass.kind == dsl::PassKind::transfer && role == Role::resolve_src) return kResolveCommandSource;
  if (pass.kind == dsl::PassKind::transfer && role == Role::resolve_dst) return kResolveCommandTarget;
  return row_of(role);
}

Stages vulkan_stages(uint32_t bits) {
  constexpr std::pair<uint32_t, Stages> kStages[] = {
      {dsl::stage_vertex, stage::vertex_shader},       {dsl::stage_tess_control, stage::tess_control_shader},
      {dsl::stage_tess_eval, stage::tess_eval_shader}, {dsl::stage_geometry, stage::geometry_shader},
      {dsl::stage_fragment, stage::fragment_shader},   {dsl::stage_compute, stage::compute_shader},
      {dsl::stage_transfer, stage::all_transfer},      {dsl::stage_host, stage::host},
  };
  Stages stages = 0;
  for (const auto& [bit, stage] : kStages)
    if (bits & bit) stages |= stage;
  return stages;
}

// Depth and stencil have their own names; sampling uses the read-only attachment layout, so that testing and sampling at once needs no transition.
Layout layout_for_aspect(Layout layout, uint32_t aspect) {
  const bool depth = aspect == aspect_depth, stencil = aspect == aspect_stencil;
  if (aspect == 0) return Layout::undefined;
  if (!depth && !stencil) return layout;
  if (layout == Layout::shader_read_only || layout == Layout::depth_stencil_read_only)
    return depth ? Layout::depth_read_only : Layout::stencil_read_only;
  if (layout == Layout::depth_stencil_attachment || layout == Layout::color_attachment)
    return depth ? Layout::depth_attachment : Layout::stencil_attachment;
  return layout;
}

bool loads(const dsl::Access& access) { return access.role == Role::color && (access.blend.enabled || !access.clear); }

bool covers(const dsl::Pass& pass, const dsl::Access& access) {
  const bool fills = pass.draw.kind == dsl::DrawKind::fullscreen && access.mode == Mode::write;  // tests may leave holes
  return access.covers || (fills && access.role == Role::color && !access.blend.enabled);
}

Effect pick(const Row& row, Stages stages, bool reads, bool writes, uint32_t aspect) {
  Effect effect;
  effect.layout = layout_for_aspect(row.layout, aspect);
  if (reads && row.reads) effect.reads = row.reads, effect.read_stages = stages;
  if (writes && row.writes) effect.writes = row.writes, effect.write_stages = stages;
  return effect;
}

}  // namespace

uint32_t default_stages(const dsl::Pass& pass) { return pass.kind == dsl::PassKind::raster ? dsl::stage_fragment : dsl::stage_compute; }

Effect effect_of(const dsl::Pass& pass, const dsl::Access& access, uint32_t aspect) {
  const Row& row = row_of(pass, access.role);
  const Stages stages = row.stages ? row.stages : vulkan_stages(access.stages ? access.stages : default_stages(pass));
  switch (access.role) {
    case Role::color:
      if (access.mode == Mode::read) return pick(row, stages, true, false, aspect);
      return pick(row, stages, loads(access) && !(covers(pass, access) && !access.blend.enabled), true, aspect);
    case Role::depth:
    case Role::stencil: {
      if (access.mode == Mode::read) {
        Effect effect = pick(row_of(Role::depth_readonly), stages, true, false, aspect);
        return effect;
      }
      return pick(row, stages, true, true, aspect);
    }
    case Role::resolve_src:
    case Role::copy_src:
    case Role::blit_src:
    case Role::depth_readonly:
    case Role::host_read:
      return pick(row, stages, true, false, aspect);
    case Role::resolve_dst:
    case Role::copy_dst:
    case Role::blit_dst:
    case Role::clear_dst:
    case Role::fill_dst:
    case Role::update_dst:
    case Role::host_write:
      return pick(row, stages, false, true, aspect);
    default:
      return pick(row, stages, access.mode != Mode::write, access.mode != Mode::read, aspect);
  }
}

Effect effect_of(const dsl::BoundaryState& state, uint32_t aspect) {
  const Row& row = row_of(state.role);
  Stages stages = row.stages;
  if (!stages && (row.reads || row.writes)) stages = vulkan_stages(state.stages ? state.stages : uint32_t{dsl::stage_fragment});
  const bool writes = state.wrote || !row.reads;
  return pick(row, stages, !writes, writes, aspect);
}

uint32_t usage_of(const dsl::Pass& pass, Role role, dsl::ResourceKind kind, uint32_t aspects) {
  const Row& row = row_of(pass, role);
  if (kind == dsl::ResourceKind::buffer) return row.buffer_usage;
  if ((role == Role::resolve_src || role == Role::resolve_dst) && (aspects & aspect_color) == 0 && row.image_usage == 0x10) return 0x20;
  return row.image_usage;
}

uint32_t default_aspects(Role role, uint32_t format_aspects) {
  switch (role) {
    case Role::depth:
    case Role::depth_readonly:
      return format_aspects & aspect_depth;
    case Role::stencil:
      return format_aspects & aspect_stencil;
    case Role::sampled:
    case Role::storage:
    case Role::input:
      return format_aspects & aspect_depth ? uint32_t{aspect_depth} : format_aspects;
    default:
      return format_aspects;
  }
}

bool defines_range(const dsl::Pass& pass, const dsl::Access& access) {
  if (access.clear) return !is_slice(access);
  if (is_attachment(access.role)) return access.mode != Mode::read && covers(pass, access) && !is_slice(access);
  return access.mode == Mode::write && !access.disjoint;
}

bool needs_contents(const dsl::Pass& pass, const dsl::Access& access) {
  if (access.mode == Mode::read || access.mode == Mode::atomic) return true;
  if (access.clear) return is_slice(access);
  return access.mode == Mode::update || access.disjoint || (is_attachment(access.role) && (access.blend.enabled || !covers(pass, access)));
}

Accesses supported_accesses(Stages stage) {
  constexpr Stages kTests = stage::early_fragment_tests | stage::late_fragment_tests;
  constexpr Stages kTransfers = stage::copy | stage::resolve | stage::blit | stage::clear | stage::all_transfer;
  if (stage == stage::draw_indirect) return access::indirect_command_read;
  if (stage == stage::index_input) return access::index_read;
  if (stage == stage::vertex_attribute_input) return access::vertex_attribute_read;
  if (stage & kTests) return access::depth_stencil_attachment_read | access::depth_stencil_attachment_write;
  if (stage == stage::color_attachment_output) return access::color_attachment_read | access::color_attachment_write;
  if (stage & kTransfers) return access::transfer_read | access::transfer_write;
  if (stage == stage::host) return access::host_read | access::host_write;
  const Accesses shader = access::uniform_read | access::shader_sampled_read | access::shader_storage_read | access::shader_storage_write;
  return stage == stage::fragment_shader ? shader | access::input_attachment_read : shader;
}

// The graphics pipeline in its logical order; compute has only the indirect stage before it; all other stages stand alone.
namespace {
constexpr std::array<Stages, 11> kGraphics = {
    stage::draw_indirect,       stage::index_input,         stage::vertex_attribute_input,  stage::vertex_shader,
    stage::tess_control_shader, stage::tess_eval_shader,    stage::geometry_shader,         stage::early_fragment_tests,
    stage::fragment_shader,     stage::late_fragment_tests, stage::color_attachment_output,
};

// What is logically earlier and later than each single stage, by bit.
struct LogicalOrder {
  std::array<Stages, 64> earlier{}, later{};
  constexpr LogicalOrder() {
    for (uint32_t bit = 0; bit < 64; ++bit) earlier[bit] = later[bit] = Stages{1} << bit;
    const auto add = [&](Stages before, Stages after) {
      earlier[static_cast<size_t>(std::countr_zero(after))] |= before, later[static_cast<size_t>(std::countr_zero(before))] |= after;
    };
    add(stage::draw_indirect, stage::compute_shader);
    for (size_t i = 0; i < kGraphics.size(); ++i)
      for (size_t j = i + 1; j < kGraphics.size(); ++j) add(kGraphics[i], kGraphics[j]);
  }
};
constexpr LogicalOrder kOrder;

Stages closure(Stages stages, const std::array<Stages, 64>& of_bit) {
  Stages result = stages;
  for (Stages rest = stages; rest; rest &= rest - 1) result |= of_bit[static_cast<size_t>(std::countr_zero(rest))];
  return result;
}

}  // namespace

Stages with_earlier(Stages stages) { return closure(stages, kOrder.earlier); }
Stages with_later(Stages stages) { return closure(stages, kOrder.later); }

Stages latest_stages(Stages stages) {
  Stages result = stages;
  for (Stages rest = stages; rest; rest &= rest - 1) {
    const Stages one = rest & ~(rest - 1);
    if (with_earlier(stages & ~one) & one) result &= ~one;
  }
  return result;
}

Stages earliest_stages(Stages stages) {
  Stages result = stages;
  for (Stages rest = stages; rest; rest &= rest - 1) {
    const Stages one = rest & ~(rest - 1);
    if (with_later(stages & ~one) & one) result &= ~one;
  }
  return result;
}

}  // namespace rg::compiler
