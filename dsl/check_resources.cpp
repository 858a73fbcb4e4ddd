// Images, buffers, the members of interfaces, surfaces: rows of Graph::resources.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "dsl/check_state.h"
#include "dsl/layout.h"

namespace rg::dsl {
namespace {

constexpr int64_t kMaxLayers = 2048;
constexpr int64_t kMaxHistory = 15;

struct RoleWord {
  std::string_view word;
  Role role;
};
constexpr RoleWord kRoles[] = {
    {"sampled", Role::sampled},
    {"storage", Role::storage},
    {"uniform", Role::uniform},
    {"vertex", Role::vertex},
    {"index", Role::index},
    {"indirect", Role::indirect},
    {"color", Role::color},
    {"depth", Role::depth},
    {"stencil", Role::stencil},
    {"input", Role::input},
    {"resolve_src", Role::resolve_src},
    {"resolve_dst", Role::resolve_dst},
    {"copy_src", Role::copy_src},
    {"copy_dst", Role::copy_dst},
    {"blit_src", Role::blit_src},
    {"blit_dst", Role::blit_dst},
    {"clear_dst", Role::clear_dst},
    {"fill_dst", Role::fill_dst},
    {"update_dst", Role::update_dst},
    {"host", Role::host_read},
    {"host_read", Role::host_read},
    {"host_write", Role::host_write},
    {"present", Role::present},
    {"undefined", Role::undefined},
    {"depth_readonly", Role::depth_readonly},
};

struct StageWord {
  std::string_view word;
  Stage stage;
};
constexpr StageWord kStages[] = {
    {"vertex", stage_vertex},     {"tess_control", stage_tess_control}, {"tess_eval", stage_tess_eval}, {"geometry", stage_geometry},
    {"fragment", stage_fragment}, {"compute", stage_compute},           {"transfer", stage_transfer},   {"host", stage_host}};

struct Builder {
  Checker& checker;
  GraphScope& scope;
  const ast::ResourceDeclaration& node;
  Resource resource;
  bool ok = true;
};

void fail(Builder& at, DiagnosticKind kind, Span span, std::vector<std::string> arguments = {}) {
  at.checker.report(kind, span, std::move(arguments));
  at.ok = false;
}

std::optional<int64_t> setting_value(Builder& at, const ast::Setting& setting, int64_t least, int64_t greatest) {
  if (setting.values.empty()) return at.ok = false, std::nullopt;
  const auto value = evaluate_integer(at.checker, &at.scope, at.scope.module, setting.values[0], least, greatest);
  at.ok = at.ok && value.has_value();
  return value;
}

void set_count(Builder& at, const ast::Setting& setting, int64_t greatest, uint32_t& out) {
  const auto value = setting_value(at, setting, 1, greatest);
  if (value) out = static_cast<uint32_t>(*value);
}

void set_lifetime(Builder& at, const ast::Setting& setting, Lifetime lifetime) {
  if (at.resource.lifetime != Lifetime::transient) return fail(at, DiagnosticKind::LifetimesConflict, setting.span, {at.resource.name});
  at.resource.lifetime = lifetime;
}

void read_image_setting(Builder& at, const ast::Setting& setting) {
  const std::string_view word = setting.word.text;
  Resource& resource = at.resource;
  if (word == "mips") set_count(at, setting, 16, resource.mips);
  if (word == "layers") set_count(at, setting, kMaxLayers, resource.layers);
  if (word == "samples") set_count(at, setting, 64, resource.samples);
  if (word == "samples" && (resource.samples & (resource.samples - 1)) != 0)
    fail(at, DiagnosticKind::SamplesNotPowerOfTwo, setting.span, {std::to_string(resource.samples)});
  if (word == "cube") resource.dimension = Dimension::cube;
  if (word == "layout") resource.layout_general = true;
  if (word == "1d") resource.dimension = Dimension::d1;
  if (word == "3d") resource.dimension = Dimension::d3;
}

void read_setting(Builder& at, const ast::Setting& setting) {
  const std::string_view word = setting.word.text;
  constexpr std::string_view kOfImages[] = {"mips", "layers", "samples", "cube", "1d", "2d", "3d", "layout"};
  const bool of_images = std::find(std::begin(kOfImages), std::end(kOfImages), word) != std::end(kOfImages);
  if (of_images && at.node.is_buffer) return fail(at, DiagnosticKind::SettingOfImages, setting.span, {std::string(word)});
  if (of_images) return read_image_setting(at, setting);
  if (word == "history") {
    set_lifetime(at, setting, Lifetime::history);
    const auto depth = setting_value(at, setting, 1, kMaxHistory);
    if (depth) at.resource.history = static_cast<uint32_t>(*depth);
  }
  if (word == "persistent") set_lifetime(at, setting, Lifetime::persistent);
  if (word == "readback" && !at.node.is_buffer) return fail(at, DiagnosticKind::ReadbackOfImage, setting.span, {at.resource.name});
  if (word == "readback") set_lifetime(at, setting, Lifetime::readback);
  if (word == "output" || word == "readback") at.resource.is_output = true;
  if (word == "no") at.resource.no_alias = true;
}

void read_settings(Builder& at) {
  for (size_t i = 0; i < at.node.settings.size(); ++i) {
    for (size_t j = 0; j < i; ++j)
      if (at.node.settings[i].word.text == at.node.settings[j].word.text) {
        at.checker.report(DiagnosticKind::RepeatedSetting, at.node.settings[i].span, {std::string(at.node.settings[i].word.text)})
            .note(DiagnosticKind::FirstIsHere, at.node.settings[j].span);
        at.ok = false;
      }
    read_setting(at, at.node.settings[i]);
  }
}

void read_format(Builder& at) {
  const ast::Name& name = at.node.format;
  at.resource.format = find_format(name.text);
  if (at.resource.format != Format::none || name.empty()) return;
  Diagnostic diagnostic(DiagnosticKind::UnknownFormat, name.span, {std::string(name.text)});
  const Guess guess = closest_type(name.text, format_names());
  suggest(diagnostic, name.span, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  at.ok = false;
}

// What a size comes to: known now, or at the initial, the greatest and the least extents; the first that is out of bounds, if one is. Where the least
// extents leave nothing, as a half of 1 does, there is one element.
struct Beyond {
  int64_t value = 0;
  bool at_least = false;
};
std::optional<Beyond> beyond(Checker& checker, const Scalar64& size, int64_t most) {
  const auto fits = [&](int64_t value) { return value >= 1 && value <= most; };
  if (size.known()) return fits(size.value) ? std::nullopt : std::optional(Beyond{size.value, false});
  for (const auto& extents : {initial_extents(checker.program), maximum_extents(checker.program)}) {
    const int64_t value = evaluate(checker.program, size.expr, extents);
    if (!fits(value)) return Beyond{value, false};
  }
  const int64_t least = evaluate(checker.program, size.expr, minimum_extents(checker.program));
  return least < 0 || least > most ? std::optional(Beyond{least, true}) : std::nullopt;
}

void fail_beyond(Builder& at, DiagnosticKind kind, Span span, const Beyond& wrong) {
  Diagnostic& diagnostic = at.checker.report(kind, span, {at.resource.name, std::to_string(wrong.value)});
  if (wrong.at_least) diagnostic.note(DiagnosticKind::AtLeastExtents, span);
  at.ok = false;
}

bool check_axis(Builder& at, const Scalar64& axis) {
  const auto wrong = beyond(at.checker, axis, 65536);
  if (wrong) fail_beyond(at, DiagnosticKind::ImageSize, at.node.size->span, *wrong);
  return !wrong;
}

void set_dimension(Builder& at, uint8_t axes) {
  Dimension& dimension = at.resource.dimension;
  if (dimension == Dimension::d2 && axes == 3) dimension = Dimension::d3;
  if (dimension == Dimension::d2 && axes == 1) dimension = Dimension::d1;
  const uint8_t wanted = dimension == Dimension::d1 ? 1 : dimension == Dimension::d3 ? 3 : 2;
  if (wanted != axes) fail(at, DiagnosticKind::DimensionAxes, at.node.size->span, {at.resource.name, std::to_string(wanted), std::to_string(axes)});
}

// `64*64`, which is a number and so one axis: said aloud by `1d`, else likely a slip of `64x64`.
void check_product(Builder& at) {
  const ast::Expr& size = *at.node.size;
  const bool product =
      size.kind == ast::ExprKind::mul && size.operands[0].kind == ast::ExprKind::integer && size.operands[1].kind == ast::ExprKind::integer;
  const bool said = std::any_of(at.node.settings.begin(), at.node.settings.end(), [](const ast::Setting& each) { return each.word.text == "1d"; });
  if (!product || said) return;
  const std::string two = std::string(size.operands[0].text) + "x" + std::string(size.operands[1].text);
  const std::string texels = std::to_string(size.operands[0].integer * size.operands[1].integer);
  at.checker.diagnostics.report(Diagnostic(DiagnosticKind::OneAxis, size.span, {at.resource.name, texels, two}));
}

void read_size(Builder& at) {
  if (!at.node.size) return;
  const Value size = evaluate_expr(at.checker, &at.scope, at.scope.module, *at.node.size);
  if (!size.ok()) return void(at.ok = false);
  if (size.kind != Value::Kind::integer) return fail(at, DiagnosticKind::NotASize, at.node.size->span);
  ExprId* out[3] = {&at.resource.width, &at.resource.height, &at.resource.depth};
  for (uint8_t axis = 0; axis < size.axes; ++axis) {
    if (!check_axis(at, size.at[axis])) return;
    *out[axis] = to_expr(at.checker, size.at[axis]);
  }
  set_dimension(at, size.axes);
  check_product(at);
}

int64_t longest_side(Builder& at, const std::vector<int64_t>& extents) {
  int64_t longest = 1;
  for (const ExprId axis : {at.resource.width, at.resource.height, at.resource.depth})
    if (axis.valid()) longest = std::max(longest, evaluate(at.checker.program, axis, extents));
  return longest;
}

void check_mips(Builder& at) {
  if (at.resource.mips == 1 || !at.ok) return;
  const int64_t longest = longest_side(at, maximum_extents(at.checker.program));
  uint32_t chain = 0;
  for (int64_t side = longest; side > 0; side /= 2) ++chain;
  if (at.resource.mips > chain)
    fail(at, DiagnosticKind::TooManyMips, at.node.size->span,
         {at.resource.name, std::to_string(at.resource.mips), std::to_string(longest), std::to_string(chain)});
}

// Equal formulas are equal at all extents.
bool is_square(Builder& at) { return (at.checker.formulas.of(at.resource.width) - at.checker.formulas.of(at.resource.height)).terms().empty(); }

void check_image_shape(Builder& at) {
  const Resource& image = at.resource;
  const FormatInfo& format = info(image.format);
  const Span span = at.node.format.span;
  if (image.samples > 1 && (image.mips > 1 || image.dimension != Dimension::d2)) fail(at, DiagnosticKind::SamplesOfShape, span, {image.name});
  if (image.dimension == Dimension::d3 && image.layers > 1) fail(at, DiagnosticKind::LayersOfVolume, span, {image.name});
  if (image.dimension == Dimension::d3 && !format.is_color()) fail(at, DiagnosticKind::DepthVolume, span, {image.name, format.name});
  if (image.dimension == Dimension::cube && !is_square(at)) fail(at, DiagnosticKind::CubeNotSquare, at.node.size->span, {image.name});
  if (image.samples > 1 && format.is_block()) fail(at, DiagnosticKind::BlockFormatUse, span, {image.name, format.name, "have several samples"});
}

void read_image(Builder& at) {
  read_format(at);
  read_size(at);
  if (!at.ok) return;
  check_mips(at);
  check_image_shape(at);
  if (at.resource.dimension == Dimension::cube) at.resource.layers *= 6;
}

void read_count(Builder& at) {
  const ast::TypeName& type = at.node.element;
  if (!type.count) {
    if (!type.unsized)
      fail(at, DiagnosticKind::BufferNeedsCount, type.span, {at.resource.name});
    else if (at.resource.lifetime != Lifetime::imported)
      fail(at, DiagnosticKind::UnsizedBuffer, type.span, {at.resource.name});
    return;
  }
  const Value count = evaluate_expr(at.checker, &at.scope, at.scope.module, *type.count);
  if (!count.ok()) return void(at.ok = false);
  if (count.kind != Value::Kind::integer || count.axes != 1) return fail(at, DiagnosticKind::NotAnInteger, type.count->span);
  if (const auto wrong = beyond(at.checker, count.at[0], UINT32_MAX)) return fail_beyond(at, DiagnosticKind::BufferSize, type.count->span, *wrong);
  at.resource.count = to_expr(at.checker, count.at[0]);
}

// What a texel buffer, `rgba8[256]`, cannot be.
const char* texel_fault(const Builder& at, const FormatInfo& format) {
  if (!format.is_color()) return "depth and stencil need an image";
  if (format.is_block()) return "blocks need an image";
  if (format.numeric == Numeric::srgb) return "buffers have no sRGB conversion";
  return at.resource.lifetime == Lifetime::readback ? "the host reads plain elements; copy it to a buffer that is read back" : nullptr;
}

// True if the element is a format: shaders convert texels as they do those of images.
bool read_texels(Builder& at) {
  const Format format = find_format(at.node.element.name.text);
  if (at.node.element.name.kind != ast::ExprKind::name || format == Format::none) return false;
  const FormatInfo& row = info(format);
  if (const char* fault = texel_fault(at, row)) fail(at, DiagnosticKind::TexelFormat, at.node.element.span, {at.resource.name, row.name, fault});
  at.resource.kind = ResourceKind::buffer;
  at.resource.format = format;
  at.resource.element.scalar = row.numeric == Numeric::uint ? Scalar::u32 : row.numeric == Numeric::sint ? Scalar::i32 : Scalar::f32;
  at.resource.stride = row.block_bytes;
  read_count(at);
  return true;
}

void read_buffer(Builder& at) {
  if (read_texels(at)) return;
  const auto element = element_type(at.checker, at.scope.module, at.node.element);
  if (!element) return void(at.ok = false);
  at.resource.kind = ResourceKind::buffer;
  at.resource.element = *element;
  at.resource.stride = static_cast<uint32_t>(layout_of(at.checker.program.structs, *element, BlockLayout::std430).stride);
  read_count(at);
}

std::optional<Role> boundary_role(Builder& at, const ast::Usage& usage) {
  if (usage.role.empty()) return at.ok = false, std::nullopt;
  const auto role = find_role(usage.role.text);
  if (!role) fail(at, DiagnosticKind::UnknownRole, usage.role.span, {std::string(usage.role.text)});
  return role;
}

void read_boundary(Builder& at, const ast::Usage& usage, BoundaryState& out) {
  const auto role = boundary_role(at, usage);
  if (!role) return;
  out.role = *role;
  out.stages = find_stages(at.checker, usage.stages);
}

// Interfaces and surfaces come in a state; nothing else has one.
void read_boundaries(Builder& at) {
  if (at.resource.lifetime != Lifetime::imported) {
    const auto& usage = at.node.ready ? at.node.ready : at.node.after;
    if (usage) fail(at, DiagnosticKind::BoundaryOfOwn, usage->span, {at.resource.name});
    return;
  }
  if (at.node.ready) read_boundary(at, *at.node.ready, at.resource.before);
  at.resource.before.wrote = at.node.wrote;
  if (at.node.after) return read_boundary(at, *at.node.after, at.resource.after);
  at.resource.after = at.resource.before;
  at.resource.after.wrote = false;
}

void check_boundaries(Builder& at) {
  if (at.resource.lifetime != Lifetime::imported || !at.ok) return;
  if (at.node.ready) at.ok = check_boundary(at.checker, at.resource, at.resource.before, at.node.ready->span);
  if (at.node.after && at.ok) at.ok = check_boundary(at.checker, at.resource, at.resource.after, at.node.after->span);
}

void read_init(Builder& at) {
  if (!at.node.has_init || !at.node.clear) {
    const bool needs = at.ok && at.resource.lifetime == Lifetime::history;
    if (needs) fail(at, DiagnosticKind::HistoryNeedsInit, at.node.name.span, {at.resource.name});
    return;
  }
  const bool keeps = at.resource.lifetime == Lifetime::history || at.resource.lifetime == Lifetime::persistent;
  if (!keeps) return fail(at, DiagnosticKind::InitOfTransient, at.node.clear->span, {at.resource.name});
  if (at.ok && info(at.resource.format).is_block())
    return fail(at, DiagnosticKind::BlockFormatUse, at.node.clear->span, {at.resource.name, name(at.resource.format), "be cleared"});
  at.resource.init = InitKind::clear;
  if (at.ok) at.resource.init_value = clear_value(at.checker, at.scope, *at.node.clear, at.resource, 0);
}

bool claim_name(Builder& at) {
  const auto existing = at.scope.resources.find(at.resource.name);
  if (existing == at.scope.resources.end()) return true;
  report_duplicate(at.checker, at.node.name, at.scope.graph.resources[existing->second].span);
  return false;
}

void add_resource(Builder& at) {
  if (!at.ok) {
    at.scope.failed[at.resource.name] = true;
    at.scope.incomplete = true;
    return;
  }
  if (!claim_name(at)) return;
  const ResourceId id = at.scope.graph.resources.add(at.resource);
  at.scope.resources.emplace(at.resource.name, id);
  at.scope.resource_used.push_back(false);
}

void build(Builder& at) {
  at.resource.module = at.checker.modules[at.scope.module].name;
  at.resource.span = at.node.name.span;
  at.resource.guard = at.scope.guard;
  if (at.node.has_error) at.ok = false;
  if (!at.ok) return;
  read_settings(at);
  if (at.node.is_buffer)
    read_buffer(at);
  else
    read_image(at);
  read_boundaries(at);
  check_boundaries(at);
  read_init(at);
}

// `Scene` as parameter `scene` brings `scene.lights`, in the order of the interface.
void declare_interface(Checker& checker, GraphScope& scope, const ast::Parameter& parameter) {
  const auto symbol = find_symbol(checker, scope.module, parameter.type, SymbolKind::interface);
  const std::string name(parameter.name.text);
  if (!symbol) {
    scope.failed[name] = true;
    scope.incomplete = true;
    return;
  }
  scope.interfaces[name] = *symbol;
  const uint32_t outer = scope.module;
  scope.module = checker.symbols[*symbol].module;
  for (const ast::ResourceDeclaration& member : std::get<ast::InterfaceDeclaration>(*checker.symbols[*symbol].declaration).members) {
    Builder at{checker, scope, member, {}, true};
    at.resource.name = name + "." + std::string(member.name.text);
    at.resource.lifetime = Lifetime::imported;
    at.resource.is_output = true;
    build(at);
    add_resource(at);
  }
  scope.module = outer;
}

void declare_surface(Checker& checker, GraphScope& scope, const ast::Parameter& parameter) {
  Builder at{checker, scope, parameter.surface, {}, true};
  at.resource.name = std::string(parameter.name.text);
  at.resource.lifetime = Lifetime::imported;
  at.resource.is_surface = at.resource.is_output = true;
  build(at);
  if (!parameter.surface.after) at.resource.after.role = Role::present;
  add_resource(at);
}

void declare_params(Checker& checker, GraphScope& scope, const ast::Parameter& parameter) {
  const std::string name(parameter.name.text);
  const StructId type = find_struct(checker, scope.module, parameter.type);
  if (!type.valid() || !check_not_packed(checker, type, parameter.type.span)) {
    scope.failed[name] = true;
    return;
  }
  scope.params.emplace(name, scope.graph.params.add({name, type, {}, parameter.name.span}));
}

}  // namespace

std::optional<Role> find_role(std::string_view word) {
  for (const RoleWord& row : kRoles)
    if (row.word == word) return row.role;
  return std::nullopt;
}

uint32_t find_stages(Checker& checker, const std::vector<ast::Name>& words) {
  uint32_t stages = 0;
  std::vector<std::string_view> candidates;
  for (const StageWord& row : kStages) candidates.push_back(row.word);
  for (const ast::Name& word : words) {
    const auto* row = std::find_if(std::begin(kStages), std::end(kStages), [&](const StageWord& each) { return each.word == word.text; });
    if (row != std::end(kStages)) {
      stages |= row->stage;
      continue;
    }
    if (word.empty()) continue;
    Diagnostic diagnostic(DiagnosticKind::UnknownStage, word.span, {std::string(word.text)});
    const Guess guess = closest(word.text, candidates);
    suggest(diagnostic, word.span, guess);
    checker.diagnostics.report(std::move(diagnostic));
  }
  return stages;
}

std::optional<std::string> indexed_name(Checker& checker, GraphScope& scope, const ast::Name& name, const std::vector<ast::Expr>& indices) {
  std::string full = scope.prefix + std::string(name.text);
  for (const ast::Expr& index : indices) {
    const auto value = evaluate_integer(checker, &scope, scope.module, index, 0, UINT32_MAX);
    if (!value) return std::nullopt;
    full += "[" + std::to_string(*value) + "]";
  }
  return full;
}

void declare_resource(Checker& checker, GraphScope& scope, const ast::ResourceDeclaration& declaration) {
  if (declaration.name.empty()) return void(scope.incomplete = true);
  Builder at{checker, scope, declaration, {}, true};
  if (!declaration.index.empty()) scope.families[scope.prefix + std::string(declaration.name.text)] = true;
  const auto name = indexed_name(checker, scope, declaration.name, declaration.index);
  if (!name) return void(scope.incomplete = true);
  at.resource.name = *name;
  build(at);
  add_resource(at);
}

void declare_parameters(Checker& checker, GraphScope& scope, const ast::GraphDeclaration& graph) {
  std::unordered_map<std::string_view, Span> seen;
  for (const ast::Parameter& parameter : graph.parameters) {
    if (parameter.name.empty()) continue;
    const auto [at, fresh] = seen.emplace(parameter.name.text, parameter.name.span);
    if (!fresh) {
      report_duplicate(checker, parameter.name, at->second);
      continue;
    }
    if (parameter.kind == ast::Parameter::Kind::params)
      declare_params(checker, scope, parameter);
    else if (parameter.kind == ast::Parameter::Kind::surface)
      declare_surface(checker, scope, parameter);
    else if (parameter.kind == ast::Parameter::Kind::interface)
      declare_interface(checker, scope, parameter);
    else
      checker.report(DiagnosticKind::ParameterOfTechnique, parameter.span, {std::string(parameter.name.text)});
  }
}

}  // namespace rg::dsl
