#include "compiler/verify/roles.h"

#include <algorithm>

namespace rg::verify {
namespace {

using dsl::Mode;
using dsl::Role;

StageSet declared_stages(const dsl::Access& access) {
  struct Row {
    uint32_t declared;
    uint32_t stage;
  };
  constexpr Row kRows[] = {{dsl::stage_vertex, kVertexShader},      {dsl::stage_tess_control, kTessControlShader},
                           {dsl::stage_tess_eval, kTessEvalShader}, {dsl::stage_geometry, kGeometryShader},
                           {dsl::stage_fragment, kFragmentShader},  {dsl::stage_compute, kComputeShader}};
  StageSet set = 0;
  for (const Row& row : kRows)
    if (access.stages & row.declared) set |= stage_bit(row.stage);
  return set;
}

// Where the host records, an access without stages means the one that is usual for the pass.
StageSet shader_stages(const dsl::Pass& pass, const dsl::Access& access) {
  if (access.stages == 0) return stage_bit(pass.kind == dsl::PassKind::raster ? kFragmentShader : kComputeShader);
  return declared_stages(access);
}

AccessSet storage_accesses(Mode mode) {
  const AccessSet read = access_bit(kStorageRead), write = access_bit(kStorageWrite);
  if (mode == Mode::read) return read;
  return mode == Mode::write ? write : read | write;
}

Touch transfer(uint32_t stage, bool writes) { return {stage_bit(stage), access_bit(writes ? kTransferWrite : kTransferRead)}; }

constexpr StageSet kTests = stage_bit(kEarlyTests) | stage_bit(kLateTests);

bool is_depth_role(Role role) { return role == Role::depth || role == Role::depth_readonly || role == Role::stencil; }

bool reads_only(const dsl::Access& access) { return access.role == Role::depth_readonly || access.mode == Mode::read; }

std::vector<Touch> depth_touches(const dsl::Access& access, LoadOp load, StoreOp store) {
  const AccessSet read = access_bit(kDepthStencilRead), write = access_bit(kDepthStencilWrite);
  std::vector<Touch> touches;
  if (load == LoadOp::load) touches.push_back({kTests, read});
  if (load == LoadOp::clear || load == LoadOp::dont_care) touches.push_back({stage_bit(kEarlyTests), write});
  // A test after a clear reads what the rendering itself wrote.
  if (load != LoadOp::load) touches.push_back({kTests, read, false});
  if (!reads_only(access)) touches.push_back({kTests, write});
  if (store != StoreOp::none) touches.push_back({stage_bit(kLateTests), write});
  return touches;
}

std::vector<Touch> color_touches(const dsl::Access& access, LoadOp load, StoreOp store) {
  const StageSet output = stage_bit(kColorOutput);
  std::vector<Touch> touches;
  const bool reads = load == LoadOp::load || access.role == Role::resolve_src;
  touches.push_back({output, access_bit(kColorRead), reads});
  if (!reads_only(access) || store != StoreOp::none || load == LoadOp::clear || load == LoadOp::dont_care)
    touches.push_back({output, access_bit(kColorWrite)});
  return touches;
}

bool is_sampled_layout(uint32_t aspect, Layout layout) {
  if (layout == Layout::general || layout == Layout::shader_read_only) return true;
  if (aspect == aspect_depth) return layout == Layout::depth_read_only;
  return aspect == aspect_stencil && layout == Layout::stencil_read_only;
}

bool is_attachment_layout(const dsl::Access& access, uint32_t aspect, Layout layout) {
  if (layout == Layout::general) return true;
  const bool read_only = reads_only(access);
  if (aspect == aspect_depth) return layout == Layout::depth_attachment || (read_only && layout == Layout::depth_read_only);
  if (aspect == aspect_stencil) return layout == Layout::stencil_attachment || (read_only && layout == Layout::stencil_read_only);
  return layout == Layout::color_attachment;
}

}  // namespace

bool is_selected(const dsl::Guard& guard, const std::vector<uint32_t>& configuration) {
  return std::all_of(guard.terms.begin(), guard.terms.end(), [&](const dsl::Guard::Term& term) {
    const uint32_t value = term.feature.value < configuration.size() ? configuration[term.feature.value] : 0;
    return (value == term.value) != term.negated;
  });
}

bool is_attachment(Role role) { return role == Role::color || is_depth_role(role); }

bool is_rendered(const dsl::Pass& pass, Role role) {
  if (pass.kind != dsl::PassKind::raster) return false;
  return is_attachment(role) || role == Role::resolve_src || role == Role::resolve_dst;
}

uint32_t default_aspects(Role role, uint32_t format_aspects) {
  const uint32_t both = aspect_depth | aspect_stencil;
  if (role == Role::depth || role == Role::depth_readonly) return format_aspects & aspect_depth;
  if (role == Role::stencil) return format_aspects & aspect_stencil;
  const bool view = role == Role::sampled || role == Role::input || role == Role::storage;
  if (view && (format_aspects & both) == both) return aspect_depth;
  return format_aspects;
}

dsl::Range effective_range(const dsl::Access& access, uint32_t format_aspects) {
  dsl::Range range = access.range;
  if (range.aspects == 0) range.aspects = default_aspects(access.role, format_aspects);
  if (is_attachment(access.role)) range.mips = 1;
  return range;
}

std::vector<Touch> touches_of(const dsl::Pass& pass, const dsl::Access& access, StageSet planned) {
  switch (access.role) {
    case Role::sampled:
      return {{shader_stages(pass, access), access_bit(kSampledRead)}};
    case Role::storage:
      return {{shader_stages(pass, access), storage_accesses(access.mode)}};
    case Role::uniform:
      return {{shader_stages(pass, access), access_bit(kUniformRead)}};
    case Role::vertex:
      return {{stage_bit(kVertexAttributeInput), access_bit(kVertexAttributeRead)}};
    case Role::index:
      return {{stage_bit(kIndexInput), access_bit(kIndexRead)}};
    case Role::indirect:
      return {{stage_bit(kDrawIndirect), access_bit(kIndirectRead)}};
    case Role::input:
      return {{stage_bit(kFragmentShader), access_bit(kSampledRead)}};  // fetched: a rendering of one pass has no subpass to take it from
    case Role::copy_src:
      return {transfer(kCopy, false)};
    case Role::copy_dst:
      return {transfer(kCopy, true)};
    case Role::blit_src:
      return {transfer(kBlit, false)};
    case Role::blit_dst:
      return {transfer(kBlit, true)};
    case Role::clear_dst:
    case Role::fill_dst:
      return {transfer(kClear, true)};
    case Role::update_dst:
      return {transfer(planned & stage_bit(kCopy) ? kCopy : kClear, true)};
    case Role::resolve_src:
      // In a rendering the source is an attachment that the rendering itself has written.
      return {pass.kind == dsl::PassKind::raster ? Touch{stage_bit(kColorOutput), access_bit(kColorRead), false} : transfer(kResolve, false)};
    case Role::resolve_dst:
      return {pass.kind == dsl::PassKind::raster ? Touch{stage_bit(kColorOutput), access_bit(kColorWrite)} : transfer(kResolve, true)};
    case Role::host_read:
      return {{stage_bit(kHost), access_bit(kHostRead)}};
    case Role::host_write:
      return {{stage_bit(kHost), access_bit(kHostWrite)}};
    case Role::color:
    case Role::depth:
    case Role::depth_readonly:
    case Role::stencil:
    case Role::present:
    case Role::undefined:
      return {};
  }
  return {};
}

std::vector<Touch> touches_of_attachment(const dsl::Access& access, LoadOp load, StoreOp store) {
  return is_depth_role(access.role) ? depth_touches(access, load, store) : color_touches(access, load, store);
}

bool is_legal_layout(const dsl::Pass& pass, const dsl::Access& access, uint32_t aspect, Layout layout) {
  const bool raster = pass.kind == dsl::PassKind::raster;
  switch (access.role) {
    case Role::sampled:
    case Role::input:
      return is_sampled_layout(aspect, layout);
    case Role::storage:
      return layout == Layout::general;
    case Role::color:
    case Role::depth:
    case Role::depth_readonly:
    case Role::stencil:
      return is_attachment_layout(access, aspect, layout);
    case Role::resolve_src:
      return raster ? is_attachment_layout(access, aspect, layout) : layout == Layout::transfer_src || layout == Layout::general;
    case Role::resolve_dst:
      return raster ? is_attachment_layout(access, aspect, layout) : layout == Layout::transfer_dst || layout == Layout::general;
    case Role::copy_src:
    case Role::blit_src:
      return layout == Layout::transfer_src || layout == Layout::general;
    case Role::copy_dst:
    case Role::blit_dst:
    case Role::clear_dst:
    case Role::update_dst:
      return layout == Layout::transfer_dst || layout == Layout::general;
    case Role::host_read:
    case Role::host_write:
      return layout == Layout::general;
    case Role::present:
      return layout == Layout::present_src;
    default:
      return true;
  }
}

bool uses_contents(const dsl::Pass& pass, const dsl::Access& access) {
  if (access.clear && is_rendered(pass, access.role)) return is_slice(access);
  if (access.mode == Mode::read || access.mode == Mode::update || access.mode == Mode::atomic) {
    return true;
  }
  const bool covers = access.covers || pass.draw.kind == dsl::DrawKind::fullscreen;
  if (access.role == Role::color) return !covers || access.blend.enabled;
  if (is_depth_role(access.role)) return !access.covers;
  return access.disjoint;
}

bool writes_contents(const dsl::Access& access) { return access.mode != Mode::read && access.role != Role::depth_readonly; }

bool commutes(const dsl::Access& access) { return access.mode == Mode::atomic || (access.disjoint && access.mode != Mode::read); }

}  // namespace rg::verify
