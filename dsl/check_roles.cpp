// What a role suits: kinds of resources, formats, stages. Rules that accesses and the states of imported resources share.
#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

bool of_images(Role role) {
  switch (role) {
    case Role::uniform:
    case Role::vertex:
    case Role::index:
    case Role::indirect:
    case Role::fill_dst:
    case Role::update_dst:
      return false;
    default:
      return true;
  }
}

bool of_buffers(Role role) {
  switch (role) {
    case Role::storage:
    case Role::copy_src:
    case Role::copy_dst:
    case Role::host_read:
    case Role::host_write:
      return true;
    default:
      return !of_images(role);
  }
}

bool of_texels(Role role) {
  return role == Role::sampled || role == Role::index ||
         (of_buffers(role) && role != Role::uniform && role != Role::vertex && role != Role::indirect);
}

// Stages in which a role can happen where somebody names one.
uint32_t stages_of(Role role) {
  constexpr uint32_t kShaders = stage_vertex | stage_tess_control | stage_tess_eval | stage_geometry | stage_fragment | stage_compute;
  switch (role) {
    case Role::sampled:
    case Role::storage:
    case Role::uniform:
      return kShaders;
    case Role::vertex:
    case Role::index:
      return stage_vertex;
    case Role::indirect:
      return stage_vertex | stage_compute;
    case Role::color:
    case Role::depth:
    case Role::depth_readonly:
    case Role::stencil:
    case Role::input:
      return stage_fragment;
    case Role::host_read:
    case Role::host_write:
      return stage_host;
    case Role::present:
    case Role::undefined:
      return stage_none;
    default:
      return stage_transfer;
  }
}

// Empty, or why an image of the format has no such state.
std::string format_fault(const Resource& image, Role role) {
  const FormatInfo& format = info(image.format);
  const auto fault = [&](const char* what) { return "`" + std::string(format.name) + "` " + what; };
  const bool depth = role == Role::depth || role == Role::depth_readonly, attachment = depth || role == Role::color || role == Role::stencil;
  if (attachment && format.is_block()) return fault("is block-compressed: nobody draws to it");
  if (role == Role::color && !format.is_color()) return fault("is no format of colours; say `depth`");
  if (depth && (format.aspects & aspect_depth) == 0) return fault("holds no depths; say `color`");
  if (role == Role::stencil && (format.aspects & aspect_stencil) == 0) return fault("has no stencil aspect");
  if (role == Role::storage && !is_storage_format(image.format)) return fault("is none that images used as `storage` can have; say `sampled`");
  return {};
}

std::string kind_fault(const Resource& resource) {
  if (resource.kind == ResourceKind::image) return "it is an image; those are `sampled`, `storage`, drawn to or copied";
  if (resource.format != Format::none) return "it is a buffer of texels; those are `sampled`, `storage` or copied";
  return "it is a buffer; those are `storage`, `uniform`, `vertex`, `index`, `indirect` or copied";
}

std::string state_fault(const Resource& resource, const BoundaryState& state) {
  if (state.role == Role::undefined && state.wrote)
    return "what was written was written somehow; leave the state out if the contents are worth nothing";
  if (!suits_kind(resource, state.role)) return kind_fault(resource);
  if (resource.kind == ResourceKind::image)
    if (std::string fault = format_fault(resource, state.role); !fault.empty()) return fault;
  if (state.wrote && reads_only(state.role)) return "that only reads; say `ready`, or how it was written";
  if ((state.stages & ~stages_of(state.role)) != 0) return "that does not happen in the stages after `in`";
  return {};
}

}  // namespace

const char* word_of(Role role) {
  constexpr const char* kWords[] = {"sampled",        "storage",   "uniform",  "vertex",      "index",       "indirect",   "color",    "depth",
                                    "depth readonly", "stencil",   "input",    "resolve_src", "resolve_dst", "copy_src",   "copy_dst", "blit_src",
                                    "blit_dst",       "clear_dst", "fill_dst", "update_dst",  "host_read",   "host_write", "present",  "undefined"};
  return kWords[static_cast<size_t>(role)];
}

bool reads_only(Role role) {
  switch (role) {
    case Role::sampled:
    case Role::uniform:
    case Role::vertex:
    case Role::index:
    case Role::indirect:
    case Role::input:
    case Role::depth_readonly:
    case Role::copy_src:
    case Role::blit_src:
    case Role::resolve_src:
    case Role::host_read:
      return true;
    default:
      return false;
  }
}

bool is_storage_format(Format format) {
  const FormatInfo& row = info(format);
  return row.is_color() && !row.is_block() && row.numeric != Numeric::srgb && format != Format::rgb9e5 && format != Format::bgra8;
}

bool suits_kind(const Resource& resource, Role role) {
  if (resource.kind == ResourceKind::image) return of_images(role);
  return resource.format != Format::none ? of_texels(role) : of_buffers(role);
}

bool check_boundary(Checker& checker, const Resource& resource, const BoundaryState& state, Span span) {
  const std::string fault = state_fault(resource, state);
  if (!fault.empty()) checker.report(DiagnosticKind::StateImpossible, span, {resource.name, word_of(state.role), fault});
  return fault.empty();
}

}  // namespace rg::dsl
