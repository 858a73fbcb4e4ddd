#include "compiler/machine/hardware.h"

namespace rg::machine {
namespace {

using dsl::Mode;
using dsl::Role;

constexpr Stages kGraphics[] = {
    // in logical order
    stage::draw_indirect,       stage::index_input,         stage::vertex_attribute_input,  stage::vertex_shader,
    stage::tess_control_shader, stage::tess_eval_shader,    stage::geometry_shader,         stage::early_fragment_tests,
    stage::fragment_shader,     stage::late_fragment_tests, stage::color_attachment_output,
};
constexpr Stages kComputePipe[] = {stage::draw_indirect, stage::compute_shader};
constexpr Stages kTransfers = stage::copy | stage::resolve | stage::blit | stage::clear;

constexpr Stages all_of(const Stages (&pipe)[11]) {
  Stages all = 0;
  for (const Stages each : pipe) all |= each;
  return all;
}
constexpr Stages kAllGraphics = all_of(kGraphics);
constexpr Stages kAllCommands = kAllGraphics | stage::compute_shader | kTransfers;

constexpr Accesses kReads = access::indirect_command_read | access::index_read | access::vertex_attribute_read | access::uniform_read |
                            access::input_attachment_read | access::color_attachment_read | access::depth_stencil_attachment_read |
                            access::transfer_read | access::host_read | access::shader_sampled_read | access::shader_storage_read;
constexpr Accesses kWrites = access::color_attachment_write | access::depth_stencil_attachment_write | access::transfer_write | access::host_write |
                             access::shader_storage_write;

template <size_t N>
Stages earlier_in(const Stages (&pipe)[N], Stages stages) {
  Stages result = 0, so_far = 0;
  for (const Stages each : pipe) {
    so_far |= each;
    if (stages & each) result |= so_far;
  }
  return result;
}
template <size_t N>
Stages later_in(const Stages (&pipe)[N], Stages stages) {
  Stages result = 0;
  for (const Stages each : pipe)
    if ((stages & each) || result) result |= each;
  return result;
}

std::vector<Stages> shader_stages(uint32_t bits) {
  constexpr std::pair<uint32_t, Stages> kNames[] = {{dsl::stage_vertex, stage::vertex_shader},
                                                    {dsl::stage_tess_control, stage::tess_control_shader},
                                                    {dsl::stage_tess_eval, stage::tess_eval_shader},
                                                    {dsl::stage_geometry, stage::geometry_shader},
                                                    {dsl::stage_fragment, stage::fragment_shader},
                                                    {dsl::stage_compute, stage::compute_shader},
                                                    {dsl::stage_host, stage::host}};
  std::vector<Stages> stages;
  for (const auto& [bit, stage] : kNames)
    if (bits & bit) stages.push_back(stage);
  if (bits & dsl::stage_transfer)
    for (const Stages each : {stage::copy, stage::resolve, stage::blit, stage::clear}) stages.push_back(each);
  return stages;
}

// Early tests may already write what late tests complete; a cleared or covered attachment is not read.
std::vector<Touch> depth_touches(bool reads, bool writes) {
  std::vector<Touch> touches;
  if (reads) touches.push_back({stage::early_fragment_tests, access::depth_stencil_attachment_read, false, false});
  if (reads && !writes) touches.push_back({stage::late_fragment_tests, access::depth_stencil_attachment_read, false, false});
  if (writes) touches.push_back({stage::early_fragment_tests, access::depth_stencil_attachment_write, true, true});
  if (writes) touches.push_back({stage::late_fragment_tests, access::depth_stencil_attachment_write, true, false});
  return touches;
}

std::vector<Touch> simple(Stages stage, Accesses read, Accesses write) {
  std::vector<Touch> touches;
  if (read) touches.push_back({stage, read, false, false});
  if (write) touches.push_back({stage, write, true, false});
  return touches;
}

std::vector<Touch> shader_touches(uint32_t stages, Accesses read, Accesses write) {
  std::vector<Touch> touches;
  for (const Stages stage : shader_stages(stages))
    if (read) touches.push_back({stage, read, false, false});
  for (const Stages stage : shader_stages(stages))
    if (write) touches.push_back({stage, write, true, false});
  return touches;
}

std::vector<Touch> touches_as(Role role, bool reads, bool writes, uint32_t stages, bool command) {
  switch (role) {
    case Role::sampled:
      return shader_touches(stages, access::shader_sampled_read, 0);
    case Role::uniform:
      return shader_touches(stages, access::uniform_read, 0);
    case Role::storage:
      return shader_touches(stages, reads ? access::shader_storage_read : 0, writes ? access::shader_storage_write : 0);
    case Role::input:
      return simple(stage::fragment_shader, access::shader_sampled_read, 0);
    case Role::vertex:
      return simple(stage::vertex_attribute_input, access::vertex_attribute_read, 0);
    case Role::index:
      return simple(stage::index_input, access::index_read, 0);
    case Role::indirect:
      return simple(stage::draw_indirect, access::indirect_command_read, 0);
    case Role::color:
      return simple(stage::color_attachment_output, reads ? access::color_attachment_read : 0, writes ? access::color_attachment_write : 0);
    case Role::depth:
    case Role::stencil:
      return depth_touches(reads, writes);
    case Role::depth_readonly:
      return depth_touches(true, false);
    case Role::resolve_src:
      return command ? simple(stage::resolve, access::transfer_read, 0) : simple(stage::color_attachment_output, access::color_attachment_read, 0);
    case Role::resolve_dst:
      return command ? simple(stage::resolve, 0, access::transfer_write) : simple(stage::color_attachment_output, 0, access::color_attachment_write);
    case Role::copy_src:
      return simple(stage::copy, access::transfer_read, 0);
    case Role::copy_dst:
    case Role::update_dst:
      return simple(stage::copy, 0, access::transfer_write);
    case Role::blit_src:
      return simple(stage::blit, access::transfer_read, 0);
    case Role::blit_dst:
      return simple(stage::blit, 0, access::transfer_write);
    case Role::clear_dst:
    case Role::fill_dst:
      return simple(stage::clear, 0, access::transfer_write);
    case Role::host_read:
      return simple(stage::host, access::host_read, 0);
    case Role::host_write:
      return simple(stage::host, 0, access::host_write);
    case Role::present:
    case Role::undefined:
      break;
  }
  return {};
}

}  // namespace

Stages expand_stages(Stages stages) {
  Stages result = stages & (kAllCommands | stage::host);
  if (stages & stage::all_transfer) result |= kTransfers;
  if (stages & stage::all_graphics) result |= kAllGraphics;
  if (stages & stage::all_commands) result |= kAllCommands;
  return result;
}

Accesses expand_accesses(Accesses accesses) {
  Accesses result = accesses & (kReads | kWrites);
  if (accesses & access::shader_read) result |= access::shader_sampled_read | access::shader_storage_read;
  if (accesses & access::shader_write) result |= access::shader_storage_write;
  if (accesses & access::memory_read) result |= kReads;
  if (accesses & access::memory_write) result |= kWrites;
  return result;
}

Stages with_earlier(Stages stages) { return stages | earlier_in(kGraphics, stages) | earlier_in(kComputePipe, stages); }
Stages with_later(Stages stages) { return stages | later_in(kGraphics, stages) | later_in(kComputePipe, stages); }

bool is_attachment(Role role) { return role == Role::color || role == Role::depth || role == Role::depth_readonly || role == Role::stencil; }

bool loads(const dsl::Pass& pass, const dsl::Access& access) {
  const bool fullscreen = pass.draw.kind == dsl::DrawKind::fullscreen && access.role == Role::color && access.mode == Mode::write;
  const bool covered = (access.covers || fullscreen) && !access.blend.enabled;
  return !access.clear && !covered;
}

bool needs_contents(const dsl::Pass& pass, const dsl::Access& access) {
  if (access.mode == Mode::read || access.mode == Mode::atomic) return true;
  if (!is_attachment(access.role)) return access.mode == Mode::update;
  return is_slice(access) || loads(pass, access);
}

bool commutes(const dsl::Access& access) { return access.mode == Mode::atomic || (access.disjoint && access.mode != Mode::read); }

std::vector<Touch> touches_of(const dsl::Pass& pass, const dsl::Access& access) {
  const uint32_t standard = pass.kind == dsl::PassKind::raster ? dsl::stage_fragment : dsl::stage_compute;
  const bool reads = needs_contents(pass, access), writes = access.mode != Mode::read;
  std::vector<Touch> touches = touches_as(access.role, reads, writes, access.stages ? access.stages : standard, pass.kind == dsl::PassKind::transfer);
  // Nothing is read of slices that are drawn anew, but the mip's other slices have to stay: the write finds them in its own cache.
  const bool anew = access.role == Role::color && is_slice(access) && access.mode != Mode::read && !loads(pass, access);
  for (Touch& touch : touches)
    if (anew && !touch.writes) touch.access = access::color_attachment_write;
  return touches;
}

std::vector<Touch> touches_of(const dsl::BoundaryState& state) {
  return touches_as(state.role, !state.wrote, state.wrote, state.stages ? state.stages : uint32_t{dsl::stage_fragment}, true);
}

Layout layout_of_aspect(Layout layout, uint32_t aspect) {
  const auto of = [&](Layout depth, Layout stencil) { return aspect == aspect_depth ? depth : aspect == aspect_stencil ? stencil : layout; };
  switch (layout) {
    case Layout::depth_stencil_attachment:
      return of(Layout::depth_attachment, Layout::stencil_attachment);
    case Layout::depth_stencil_read_only:
      return of(Layout::depth_read_only, Layout::stencil_read_only);
    case Layout::depth_read_only_stencil_attachment:
      return of(Layout::depth_read_only, Layout::stencil_attachment);
    case Layout::depth_attachment_stencil_read_only:
      return of(Layout::depth_attachment, Layout::stencil_read_only);
    default:
      return layout;
  }
}

Layout layout_of_both(Layout first, Layout second) {
  for (const Layout both : {Layout::depth_stencil_attachment, Layout::depth_stencil_read_only, Layout::depth_read_only_stencil_attachment,
                            Layout::depth_attachment_stencil_read_only}) {
    const Layout depth = layout_of_aspect(both, aspect_depth), stencil = layout_of_aspect(both, aspect_stencil);
    if ((depth == first && stencil == second) || (depth == second && stencil == first)) return both;
  }
  return first;
}

bool permits(Layout layout, Role role, bool writes) {
  const bool read_only = layout == Layout::shader_read_only || layout == Layout::depth_stencil_read_only || layout == Layout::depth_read_only ||
                         layout == Layout::stencil_read_only || layout == Layout::depth_read_only_stencil_attachment ||
                         layout == Layout::depth_attachment_stencil_read_only;
  const bool tests = layout == Layout::depth_stencil_attachment || layout == Layout::depth_attachment || layout == Layout::stencil_attachment ||
                     layout == Layout::depth_read_only_stencil_attachment || layout == Layout::depth_attachment_stencil_read_only;
  if (role == Role::present) return layout == Layout::present_src;
  if (layout == Layout::general) return true;
  switch (role) {
    case Role::sampled:
    case Role::input:
      return read_only;
    case Role::color:
      return layout == Layout::color_attachment;
    case Role::depth:
    case Role::stencil:
      return tests || (!writes && read_only && layout != Layout::shader_read_only);
    case Role::depth_readonly:
      return tests || (read_only && layout != Layout::shader_read_only);
    case Role::resolve_src:
      return layout == Layout::transfer_src || layout == Layout::color_attachment || tests;
    case Role::resolve_dst:
      return layout == Layout::transfer_dst || layout == Layout::color_attachment || tests;
    case Role::copy_src:
    case Role::blit_src:
      return layout == Layout::transfer_src;
    case Role::copy_dst:
    case Role::blit_dst:
    case Role::clear_dst:
    case Role::fill_dst:
    case Role::update_dst:
      return layout == Layout::transfer_dst;
    default:
      return false;
  }
}

}  // namespace rg::machine
