// What one pass may do with what it names: kinds, formats, stages, names, conflicts.
#include <algorithm>
#include <unordered_map>

#include "dsl/check_state.h"
#include "dsl/features.h"
#include "dsl/reserved.h"

namespace rg::dsl {
namespace {

struct Rules {
  Checker& checker;
  const Graph& graph;
  const Pass& pass;
  const Resource& resource(const Access& access) const { return graph.resources[access.resource]; }
};

const char* word_of(PassKind kind) {
  constexpr const char* kWords[] = {"raster", "compute", "transfer", "host"};
  return kWords[static_cast<size_t>(kind)];
}

bool of_pass(Role role, PassKind kind) {
  switch (role) {
    case Role::sampled:
    case Role::storage:
    case Role::uniform:
      return kind == PassKind::raster || kind == PassKind::compute;
    case Role::indirect:
      return kind == PassKind::raster || kind == PassKind::compute;
    case Role::vertex:
    case Role::index:
    case Role::input:
    case Role::color:
    case Role::depth:
    case Role::depth_readonly:
    case Role::stencil:
      return kind == PassKind::raster;
    case Role::resolve_dst:
      return kind == PassKind::raster || kind == PassKind::transfer;
    case Role::host_read:
    case Role::host_write:
      return false;
    default:
      return kind == PassKind::transfer;
  }
}

std::optional<int64_t> known(const Rules& rules, ExprId id) {
  if (!id.valid() || rules.checker.program.exprs[id].op != ExprOp::constant) return std::nullopt;
  return rules.checker.program.exprs[id].value;
}

bool check_role(const Rules& rules, const Access& access) {
  const Resource& resource = rules.resource(access);
  const bool image = resource.kind == ResourceKind::image;
  const bool texels = !image && resource.format != Format::none;
  if (!suits_kind(resource, access.role)) {
    rules.checker
        .report(DiagnosticKind::RoleOfKind, access.span,
                {resource.name,
                 image    ? "an image"
                 : texels ? "a buffer of texels"
                          : "a buffer",
                 word_of(access.role)})
        .note(DiagnosticKind::DeclaredHere, resource.span, {resource.name});
    return false;
  }
  if (rules.pass.kind == PassKind::host) {
    const bool reads = access.mode == Mode::read;
    rules.checker.report(DiagnosticKind::HostPassAccess, access.span,
                         {rules.pass.name, reads ? "read" : "write", resource.name,
                          reads ? "a `readback` buffer is read after the frame" : "`update` in a transfer pass takes the engine's bytes"});
    return false;
  }
  if (of_pass(access.role, rules.pass.kind)) return true;
  rules.checker.report(DiagnosticKind::RoleOfPass, access.span, {word_of(rules.pass.kind), resource.name, word_of(access.role)});
  return false;
}

void report_format(const Rules& rules, DiagnosticKind kind, const Access& access, std::vector<std::string> more = {}) {
  const Resource& image = rules.resource(access);
  std::vector<std::string> arguments = {image.name, name(seen_format(image, access))};
  arguments.insert(arguments.end(), more.begin(), more.end());
  rules.checker.report(kind, access.span, std::move(arguments)).note(DiagnosticKind::DeclaredHere, image.span, {image.name});
}

void check_attachment_format(const Rules& rules, const Access& access, const FormatInfo& format) {
  if (format.is_block()) return report_format(rules, DiagnosticKind::BlockFormatUse, access, {"be an attachment"});
  if (access.role == Role::color && !format.is_color()) return report_format(rules, DiagnosticKind::ColorOfDepth, access);
  if (access.role == Role::color && access.blend.enabled && format.is_integer()) return report_format(rules, DiagnosticKind::BlendsIntegers, access);
  const bool depth = access.role == Role::depth || access.role == Role::depth_readonly;
  if (depth && (format.aspects & aspect_depth) == 0) report_format(rules, DiagnosticKind::DepthOfColor, access, {"depth"});
  if (access.role == Role::stencil && (format.aspects & aspect_stencil) == 0) report_format(rules, DiagnosticKind::DepthOfColor, access, {"stencil"});
}

void check_storage_format(const Rules& rules, const Access& access, const FormatInfo& format) {
  if (format.is_block()) return report_format(rules, DiagnosticKind::BlockFormatUse, access, {"be used as storage"});
  if (!is_storage_format(seen_format(rules.resource(access), access))) report_format(rules, DiagnosticKind::StorageFormat, access);
}

void check_sampler(const Rules& rules, const Access& access, const FormatInfo& format) {
  if (!access.sampler.valid()) return;
  const Sampler& sampler = rules.checker.program.samplers[access.sampler];
  const Resource& image = rules.resource(access);
  if (sampler.compare && access.range.aspects != aspect_depth) {
    rules.checker.report(DiagnosticKind::ComparesColor, access.span, {sampler.name, image.name, format.name})
        .note(DiagnosticKind::DeclaredHere, sampler.span, {sampler.name});
    return;
  }
  const bool integers = format.is_integer() || access.range.aspects == aspect_stencil;
  if (integers && (sampler.filter == Filter::linear || sampler.mip_filter == Filter::linear))
    rules.checker.report(DiagnosticKind::FiltersIntegers, access.span, {sampler.name, image.name, format.name})
        .note(DiagnosticKind::DeclaredHere, sampler.span, {sampler.name});
}

void check_mips(const Rules& rules, const Access& access) {
  const Resource& image = rules.resource(access);
  const bool one_level = is_attachment(access.role) || access.role == Role::storage || access.role == Role::input || access.role == Role::blit_src ||
                         access.role == Role::blit_dst || access.role == Role::resolve_src || access.role == Role::resolve_dst;
  const uint32_t mips = mip_count(image, access.range);
  if (!one_level || mips == 1) return;
  rules.checker.report(DiagnosticKind::OneMipNeeded, access.span, {image.name, std::to_string(mips), word_of(access.role)})
      .note(DiagnosticKind::DeclaredHere, image.span, {image.name});
}

void check_slices(const Rules& rules, const Access& access) {
  const Resource& image = rules.resource(access);
  if (is_slice(access) && !is_attachment(access.role))
    return void(rules.checker.report(DiagnosticKind::OptionDoesNotFit, access.span, {"slice", word_of(access.role)}));
  const uint32_t depth = is_slice(access) ? least_depth(rules.checker, image, access.range.mip) : kAll;
  if (is_slice(access) && access.range.slice + access.range.slices > depth)  // `.slice(3).mip(1)`
    rules.checker.report(DiagnosticKind::NoSuchSubresource, access.span,
                         {image.name, std::to_string(depth), "slices", std::to_string(access.range.slice + access.range.slices - 1)});
  if (!is_attachment(access.role) || image.dimension != Dimension::d3 || is_slice(access) || known(rules, image.depth)) return;
  rules.checker.report(DiagnosticKind::SlicesNeeded, access.span, {image.name}).note(DiagnosticKind::DeclaredHere, image.span, {image.name});
}

void check_image_use(const Rules& rules, const Access& access) {
  const FormatInfo& format = info(seen_format(rules.resource(access), access));
  const bool in_shader = access.role == Role::sampled || access.role == Role::storage;
  const bool viewed = in_shader || access.role == Role::color;
  if (access.view != Format::none && !viewed) rules.checker.report(DiagnosticKind::OptionDoesNotFit, access.span, {"view", word_of(access.role)});
  if (is_attachment(access.role)) check_attachment_format(rules, access, format);
  if (access.role == Role::storage) check_storage_format(rules, access, format);
  if (access.role == Role::sampled) check_sampler(rules, access, format);
  check_mips(rules, access);
  check_slices(rules, access);
}

// Shaders see texels through a view of the buffer, and the engine may bring another every frame.
void check_imported_texels(const Rules& rules, const Access& access) {
  const Resource& buffer = rules.resource(access);
  if (buffer.kind != ResourceKind::buffer || buffer.format == Format::none || buffer.lifetime != Lifetime::imported) return;
  rules.checker
      .report(DiagnosticKind::TexelFormat, access.span, {buffer.name, name(buffer.format), "shaders see what the engine brings through a copy"})
      .note(DiagnosticKind::DeclaredHere, buffer.span, {buffer.name});
}

void check_stages(const Rules& rules, const Access& access) {
  constexpr uint32_t kRaster = stage_vertex | stage_tess_control | stage_tess_eval | stage_geometry | stage_fragment;
  const uint32_t allowed = rules.pass.kind == PassKind::raster     ? kRaster
                           : rules.pass.kind == PassKind::compute  ? uint32_t{stage_compute}
                           : rules.pass.kind == PassKind::transfer ? uint32_t{stage_transfer}
                                                                   : uint32_t{stage_host};
  if ((access.stages & ~allowed) != 0) rules.checker.report(DiagnosticKind::StageOfPass, access.span, {word_of(rules.pass.kind)});
}

// ---- attachments of one pass go together ------------------------------------------------------------------------

int64_t side(const Rules& rules, ExprId axis, uint32_t mip, const std::vector<int64_t>& extents) {
  return axis.valid() ? std::max<int64_t>(evaluate(rules.checker.program, axis, extents) >> mip, 1) : 1;
}

std::string size_text(const Rules& rules, const Access& access, const std::vector<int64_t>& extents) {
  const Resource& image = rules.resource(access);
  return std::to_string(side(rules, image.width, access.range.mip, extents)) + "x" +
         std::to_string(side(rules, image.height, access.range.mip, extents));
}

// Layers of the target: those of the image, or slices of a volume.
uint32_t target_layers(const Rules& rules, const Access& access) {
  const Resource& image = rules.resource(access);
  if (image.dimension != Dimension::d3) return layer_count(image, access.range);
  return is_slice(access) ? access.range.slices
                          : static_cast<uint32_t>(side(rules, image.depth, access.range.mip, initial_extents(rules.checker.program)));
}

void compare_attachments(const Rules& rules, const Access& first, const Access& other) {
  const Resource &a = rules.resource(first), &b = rules.resource(other);
  const auto report = [&](DiagnosticKind kind, std::string one, std::string two) {
    rules.checker.report(kind, other.span, {b.name, std::move(one), std::move(two)}).note(DiagnosticKind::OtherAttachment, first.span);
  };
  const bool same_formula = a.width == b.width && a.height == b.height && first.range.mip == other.range.mip;
  for (const auto& extents : telling_extents(rules.checker.program, {a.width, a.height, b.width, b.height})) {
    if (same_formula) break;
    const std::string one = size_text(rules, first, extents), two = size_text(rules, other, extents);
    if (one != two) return report(DiagnosticKind::AttachmentSizes, two, one);
  }
  if (other.role == Role::input) return;
  if (a.samples != b.samples && other.role != Role::resolve_dst)
    return report(DiagnosticKind::AttachmentSamples, std::to_string(b.samples), std::to_string(a.samples));
  const uint32_t one = target_layers(rules, first), two = target_layers(rules, other);
  if (one != two) report(DiagnosticKind::AttachmentLayers, std::to_string(two), std::to_string(one));
}

// Vulkan 1.3 promises six views; views of volumes are no arrays; other stages would need features of their own.
const char* multiview_fault(const Rules& rules) {
  constexpr uint32_t kMostViews = 6;
  const auto first =
      std::find_if(rules.pass.accesses.begin(), rules.pass.accesses.end(), [](const Access& access) { return is_attachment(access.role); });
  if (first == rules.pass.accesses.end()) return "views are layers of attachments, and it has none";
  if (rules.resource(*first).dimension == Dimension::d3) return "slices of volumes are no views";
  if (layer_count(rules.resource(*first), first->range) > kMostViews) return "not every device has more than six";
  const bool plain = std::all_of(rules.pass.shaders.begin(), rules.pass.shaders.end(),
                                 [](const Shader& shader) { return shader.stage == stage_vertex || shader.stage == stage_fragment; });
  return plain ? nullptr : "views take vertex and fragment shaders";
}

void check_multiview(const Rules& rules) {
  if (!rules.pass.multiview) return;
  if (const char* fault = multiview_fault(rules)) rules.checker.report(DiagnosticKind::MultiviewOfPass, rules.pass.span, {rules.pass.name, fault});
}

// ---- work stays within what every device takes ------------------------------------------------------------------

int64_t greatest(const Rules& rules, ExprId expr) {
  return expr.valid() ? evaluate(rules.checker.program, expr, maximum_extents(rules.checker.program)) : 0;
}

void check_amount(const Rules& rules) {
  constexpr int64_t kMostGroups = 65535, kMostVertices = UINT32_MAX;  // maxComputeWorkGroupCount; what a draw command holds
  const auto report = [&](std::string what, int64_t most) {
    rules.checker.report(DiagnosticKind::WorkTooLarge, rules.pass.span, {rules.pass.name, std::move(what), std::to_string(most)});
  };
  const Dispatch& dispatch = rules.pass.dispatch;
  const bool sized = !rules.pass.block && (dispatch.kind == DispatchKind::over || dispatch.kind == DispatchKind::groups);  // of blocks later
  for (size_t axis = 0; sized && axis < 3; ++axis) {
    const int64_t size = greatest(rules, dispatch.size[axis]), group = dispatch.kind == DispatchKind::over ? dispatch.group[axis] : 1;
    const int64_t groups = size / group + (size % group != 0);
    if (groups > kMostGroups) return report("dispatches " + std::to_string(groups) + " groups along an axis", kMostGroups);
  }
  const Draw& draw = rules.pass.draw;
  const char* vertices = draw.indexed ? " indices" : " vertices";
  for (const auto& [count, what] :
       {std::pair(draw.vertices, vertices), {draw.instances, " instances"}, {draw.first, vertices}, {draw.offset, vertices}})
    if (greatest(rules, count) > kMostVertices) return report("draws " + std::to_string(greatest(rules, count)) + what, kMostVertices);
}

bool has_feature_of(const Rules& rules, Capability capability) {
  return std::any_of(rules.pass.features.begin(), rules.pass.features.end(), [&](const ShaderFeature& feature) {
    return feature.feature.valid() && rules.checker.program.features[feature.feature].capability == capability;
  });
}

// What not every device has holds where a feature of the pass says that the device does: one has to.
void check_capabilities(const Rules& rules, const State& state) {
  static constexpr std::pair<Capability, const char*> kNames[] = {
#define RG_CAPABILITY(name, meaning) {Capability::name, #name},
#include "dsl/capability.def"
#undef RG_CAPABILITY
  };
  for (const auto& [capability, name] : kNames) {
    if (!asks(state, capability) || has_feature_of(rules, capability)) continue;
    const std::string way_out = std::string("declare `feature NAME : device ") + name +
                                "` and name it in `features` of the pass: where a device has none, the pass draws without";
    rules.checker.report(DiagnosticKind::BeyondProfile, rules.pass.span, {"state `" + state.name + "`", name, "vulkan 1.3", way_out})
        .note(DiagnosticKind::DeclaredHere, state.span, {state.name});
  }
}

// Why such a state cannot be used by this pass; empty: it can.
std::string unfit(const Rules& rules, const State& state) {
  const auto attachment_of = [&](Role role) {
    return std::find_if(rules.pass.accesses.begin(), rules.pass.accesses.end(), [&](const Access& access) { return access.role == role; });
  };
  const auto none = rules.pass.accesses.end();
  const bool depth = attachment_of(Role::depth) != none || attachment_of(Role::depth_readonly) != none;
  if (state.depth_bounds && !depth) return "its bounds are of a depth attachment, which the pass has not";
  if (state.conservative && state.topology != Topology::triangles && state.topology != Topology::triangle_strip)
    return "only triangles are rasterised conservatively";
  if (state.sample_locations.empty()) return {};
  if (depth) return "it places samples, and depth is kept for the device's own";
  const auto color = attachment_of(Role::color);
  const size_t samples = color == none ? 1 : rules.resource(*color).samples;
  if (samples == state.sample_locations.size()) return {};
  return "it places " + std::to_string(state.sample_locations.size()) + " samples, and its attachments have " + std::to_string(samples);
}

void check_state(const Rules& rules) {
  if (!rules.pass.state.valid()) return;
  const State& state = rules.checker.program.states[rules.pass.state];
  check_capabilities(rules, state);
  if (const std::string why = unfit(rules, state); !why.empty())
    rules.checker.report(DiagnosticKind::StateUnfit, rules.pass.span, {state.name, rules.pass.name, why})
        .note(DiagnosticKind::DeclaredHere, state.span, {state.name});
  const bool has =
      std::any_of(rules.pass.accesses.begin(), rules.pass.accesses.end(), [](const Access& access) { return access.role == Role::stencil; });
  if (state.stencil_test && !has)
    rules.checker.report(DiagnosticKind::StencilMissing, rules.pass.span, {rules.pass.name, state.name})
        .note(DiagnosticKind::DeclaredHere, state.span, {state.name});
}

void check_attachments(const Rules& rules) {
  const auto& accesses = rules.pass.accesses;
  const auto first = std::find_if(accesses.begin(), accesses.end(), [](const Access& access) { return is_attachment(access.role); });
  size_t colors = 0;
  for (const Access& access : accesses) {
    colors += access.role == Role::color;
    const bool beside = access.role == Role::input || (access.role == Role::resolve_dst && rules.pass.kind == PassKind::raster);
    if (first != accesses.end() && &access != &*first && (is_attachment(access.role) || beside)) compare_attachments(rules, *first, access);
  }
  if (colors > 8) rules.checker.report(DiagnosticKind::TooManyColors, rules.pass.span, {rules.pass.name, std::to_string(colors)});
}

// ---- accesses of one pass do not contradict each other ----------------------------------------------------------

bool overlap(uint32_t a, uint32_t a_count, uint32_t b, uint32_t b_count) {
  const uint64_t a_end = a_count == kAll ? UINT64_MAX : uint64_t{a} + a_count, b_end = b_count == kAll ? UINT64_MAX : uint64_t{b} + b_count;
  return a < b_end && b < a_end;
}

// Byte ranges that are not known now may overlap.
bool bytes_overlap(const Rules& rules, const Range& a, const Range& b) {
  const auto a0 = known(rules, a.offset), a1 = known(rules, a.size), b0 = known(rules, b.offset), b1 = known(rules, b.size);
  if (!a0 || !a1 || !b0 || !b1) return true;
  return *a0 < *b0 + *b1 && *b0 < *a0 + *a1;
}

bool overlap(const Rules& rules, const Access& a, const Access& b) {
  if (a.resource != b.resource || a.age != b.age) return false;
  if (rules.resource(a).kind == ResourceKind::buffer) return bytes_overlap(rules, a.range, b.range);
  return (a.range.aspects & b.range.aspects) != 0 && overlap(a.range.mip, a.range.mips, b.range.mip, b.range.mips) &&
         overlap(a.range.layer, a.range.layers, b.range.layer, b.range.layers);
}

bool may_stand_together(const Access& a, const Access& b) {
  if (a.mode == Mode::read && b.mode == Mode::read) return true;
  return a.mode == Mode::atomic && b.mode == Mode::atomic && a.role == b.role;
}

bool conflict(const Rules& rules, const Access& a, const Access& b) { return overlap(rules, a, b) && !may_stand_together(a, b); }

// Two ways to use one thing, by their roles, or where those are one by what they do.
std::pair<std::string, std::string> told_apart(const Access& a, const Access& b) {
  constexpr const char* kModes[] = {"read ", "write ", "update ", "atomic "};
  const bool same = a.role == b.role && a.mode != b.mode;
  const auto words = [&](const Access& access) { return (same ? kModes[static_cast<size_t>(access.mode)] : "") + std::string(word_of(access.role)); };
  return {words(a), words(b)};
}

// What is wrong by itself contradicts nothing.
void check_conflicts(const Rules& rules, const std::vector<bool>& wrong) {
  std::unordered_map<uint32_t, std::vector<const Access*>> seen;  // by resource
  for (const Access& access : rules.pass.accesses) {
    if (wrong[static_cast<size_t>(&access - rules.pass.accesses.data())]) continue;
    auto& others = seen[access.resource.value];
    for (const Access* other : others) {
      if (!conflict(rules, *other, access)) continue;
      const auto [one, two] = told_apart(*other, access);
      rules.checker.report(DiagnosticKind::AccessesConflict, access.span, {rules.pass.name, rules.resource(access).name, one, two})
          .note(DiagnosticKind::OtherAccess, other->span);
      break;
    }
    others.push_back(&access);
  }
}

// How shaders come to see another name.
std::string way_out(const Access* access) {
  if (!access) return "call the parameter block otherwise";
  constexpr const char* kVerbs[] = {"read", "write", "update", "atomic"};
  const char* verb = access->role == Role::color ? "color" : kVerbs[static_cast<size_t>(access->mode)];
  return "rename it for the shaders: `" + std::string(verb) + " other = ...`";
}

void check_names(const Rules& rules) {
  const bool has_shaders = !rules.pass.shaders.empty();
  struct Taken {
    Span span;
    const Access* access = nullptr;
  };
  std::unordered_map<std::string, Taken> seen;
  const auto claim = [&](const std::string& name, Taken by) {
    const auto [at, fresh] = seen.emplace(name, by);
    const Access* first = at->second.access;
    if (fresh && has_shaders && reserved_in_glsl(name)) rules.checker.report(DiagnosticKind::ReservedName, by.span, {name, way_out(by.access)});
    if (fresh || (first && by.access && conflict(rules, *first, *by.access))) return;  // no name would mend a conflict
    rules.checker.report(DiagnosticKind::AccessNameTaken, by.span, {name}).note(DiagnosticKind::OtherAccess, at->second.span);
  };
  for (const Access& access : rules.pass.accesses)
    if (is_shader_role(access.role) || access.role == Role::color) claim(access.name, {access.span, &access});
  for (const ParamsUse& use : rules.pass.params) claim(use.name, {use.span});
}

}  // namespace

void check_pass_rules(Checker& checker, const Graph& graph, const Pass& pass) {
  const Rules rules{checker, graph, pass};
  bool roles_fit = true;
  std::vector<bool> wrong;  // by access
  for (const Access& access : pass.accesses) {
    const size_t told = checker.diagnostics.rows().size();
    check_stages(rules, access);
    const bool fits = check_role(rules, access);
    roles_fit = roles_fit && fits;
    if (fits && rules.resource(access).kind == ResourceKind::image) check_image_use(rules, access);
    const bool in_block = fits && (access.role == Role::storage || access.role == Role::uniform);
    if (in_block) check_not_packed(checker, rules.resource(access).element.record, access.span);
    if (fits && is_shader_role(access.role)) check_imported_texels(rules, access);
    const bool sampled_texels = rules.resource(access).kind == ResourceKind::buffer && access.sampler.valid();
    if (sampled_texels) checker.report(DiagnosticKind::SamplerOfRole, access.span, {word_of(access.role)});
    if (fits && access.role == Role::storage && rules.resource(access).format != Format::none && rules.resource(access).kind == ResourceKind::buffer)
      check_storage_format(rules, access, info(rules.resource(access).format));
    wrong.push_back(checker.diagnostics.rows().size() > told);
  }
  if (!roles_fit) return;
  check_attachments(rules);
  check_state(rules);
  check_amount(rules);
  check_multiview(rules);
  check_conflicts(rules, wrong);
  check_names(rules);
}

}  // namespace rg::dsl
