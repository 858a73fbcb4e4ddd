#include "compiler/shaders/interface.h"

#include <algorithm>
#include <limits>
#include <set>

#include "compiler/shaders/glsl_types.h"
#include "dsl/format_table.h"
#include "dsl/layout.h"

namespace rg::compiler {
namespace {

constexpr const char* kHeader[] = {
    "#version 460",
    "#extension GL_GOOGLE_include_directive : require",
    "#extension GL_EXT_samplerless_texture_functions : require",
    "#extension GL_EXT_nonuniform_qualifier : enable",
};

// ---- constants and structs

void add_constants(const dsl::Program& program, Prelude& prelude) {
  std::set<std::string> seen;
  for (const auto& constant : program.constants) {
    const std::string name = last_part(constant.name);
    const bool fits = constant.value >= std::numeric_limits<int32_t>::min() && constant.value <= std::numeric_limits<uint32_t>::max();
    if (!fits || !seen.insert(name).second) continue;
    const bool is_signed = constant.value <= std::numeric_limits<int32_t>::max();
    const std::string value = std::to_string(constant.value) + (is_signed ? "" : "u");
    prelude.push_back({std::string("const ") + (is_signed ? "int " : "uint ") + name + " = " + value + ";", {}});
  }
}

void add_struct(const dsl::Program& program, dsl::StructId id, std::vector<bool>& done, Prelude& prelude) {
  if (done[id.value]) return;
  done[id.value] = true;
  const dsl::Struct& record = program.structs[id];
  for (const dsl::Field& field : record.fields)
    if (field.type.record.valid()) add_struct(program, field.type.record, done, prelude);
  prelude.push_back({"struct " + record.name + " {", record.span});
  for (const dsl::Field& field : record.fields) prelude.push_back({"  " + glsl_variable(program, field.type, field.name) + ";", field.span});
  prelude.push_back({"};", record.span});
}

// Vertices come in field by field: no block holds those that are packed.
bool is_packed(const dsl::Struct& record) {
  return std::any_of(record.fields.begin(), record.fields.end(), [](const dsl::Field& field) { return field.type.packed != dsl::Format::none; });
}

void add_structs(const dsl::Program& program, Prelude& prelude) {
  std::vector<bool> done(program.structs.size(), false);
  for (size_t i = 0; i < program.structs.size(); ++i) done[i] = is_packed(program.structs.rows[i]);
  for (size_t i = 0; i < program.structs.size(); ++i) add_struct(program, dsl::StructId{i}, done, prelude);
}

// ---- features

// layout(constant_id = 1000) const bool fog = true;
void add_feature(const dsl::ShaderFeature& feature, size_t index, std::optional<uint32_t> fixed, Prelude& prelude) {
  const bool is_bool = feature.values.empty();
  const uint32_t value = fixed.value_or(is_bool ? 1 : 0);
  const std::string name = last_part(feature.name);
  const std::string text = is_bool ? (value != 0 ? "true" : "false") : std::to_string(value) + "u";
  const std::string layout = fixed ? "" : "layout(constant_id = " + std::to_string(kFirstFeatureConstant + index) + ") ";
  for (size_t i = 0; i < feature.values.size(); ++i)
    prelude.push_back({"const uint " + name + "_" + feature.values[i] + " = " + std::to_string(i) + "u;", feature.span});
  if (fixed) prelude.push_back({"#define " + feature_macro(feature) + " " + std::to_string(value), feature.span});
  prelude.push_back({layout + "const " + (is_bool ? "bool " : "uint ") + name + " = " + text + ";", feature.span});
}

void add_features(const dsl::Pass& pass, const FixedFeatures& fixed, Prelude& prelude) {
  for (size_t i = 0; i < pass.features.size(); ++i) add_feature(pass.features[i], i, i < fixed.size() ? fixed[i] : std::nullopt, prelude);
}

// ---- bindings of set 1

std::string view_suffix(const ViewShape& view, bool multisampled) {
  const char* array = view.arrayed ? "Array" : "";
  switch (view.dimension) {
    case dsl::Dimension::d1:
      return std::string("1D") + array;
    case dsl::Dimension::d2:
      return std::string(multisampled ? "2DMS" : "2D") + array;
    case dsl::Dimension::d3:
      return "3D";
    case dsl::Dimension::cube:
      return std::string("Cube") + array;
  }
  return "2D";
}

std::string texel_prefix(dsl::Format format, const ViewShape& view) {
  const char kind = texel_kind(format, view.aspects);
  return kind == 'f' ? "" : std::string(1, kind);
}

const char* memory_qualifier(dsl::Mode mode) {
  if (mode == dsl::Mode::read) return "readonly ";
  return mode == dsl::Mode::write ? "writeonly " : "";
}

std::string opaque_type(const dsl::Program& program, const dsl::Resource& image, const dsl::Access& access, BindingKind kind) {
  const ViewShape view = view_shape(image, access);
  const std::string suffix = view_suffix(view, image.samples > 1);
  const std::string prefix = texel_prefix(dsl::seen_format(image, access), view);
  if (kind == BindingKind::storage_image) return prefix + "image" + suffix;
  if (kind == BindingKind::texture) return prefix + "texture" + suffix;
  const bool compares = program.samplers[access.sampler].compare.has_value();
  return prefix + "sampler" + suffix + (compares ? "Shadow" : "");
}

std::string texel_buffer_type(const dsl::Resource& buffer, BindingKind kind) {
  const char texel = texel_kind(buffer.format, 1);
  return (texel == 'f' ? "" : std::string(1, texel)) + (kind == BindingKind::texel_buffer ? "textureBuffer" : "imageBuffer");
}

const char* block_layout(const dsl::Program& program, const dsl::Type& type, const char* otherwise) {
  return type.record.valid() && dsl::is_scalar(program.structs[type.record]) ? "scalar" : otherwise;
}

std::string binding_text(const dsl::Program& program, const dsl::Graph& graph, const dsl::Pass& pass, const InterfaceBinding& binding) {
  const std::string place = "set = 1, binding = " + std::to_string(binding.binding);
  const std::string block = "rg_block_" + binding.name;
  if (binding.kind == BindingKind::params) {
    const dsl::Type type{.record = graph.params[pass.params[binding.params].id].type};
    return "layout(" + place + ", " + block_layout(program, type, "std140") + ") uniform " + block + " { " +
           glsl_variable(program, type, binding.name) + "; };";
  }
  const dsl::Access& access = pass.accesses[binding.access];
  const dsl::Resource& resource = graph.resources[access.resource];
  if (binding.kind == BindingKind::storage_buffer)
    return "layout(" + place + ", " + block_layout(program, resource.element, "std430") + ") " + memory_qualifier(access.mode) + "buffer " + block +
           " { " + glsl_type(program, resource.element) + " " + binding.name + "[]; };";
  if (binding.kind == BindingKind::uniform_buffer)
    return "layout(" + place + ", " + block_layout(program, resource.element, "std140") + ") uniform " + block + " { " +
           glsl_variable(program, resource.element, binding.name) + "; };";
  const bool texels = resource.kind == dsl::ResourceKind::buffer;
  const std::string type = texels ? texel_buffer_type(resource, binding.kind) : opaque_type(program, resource, access, binding.kind);
  if (binding.kind != BindingKind::storage_image && binding.kind != BindingKind::storage_texel_buffer)
    return "layout(" + place + ") uniform " + type + " " + binding.name + ";";
  const std::string format = glsl_image_format(dsl::seen_format(resource, access));
  return "layout(" + place + (format.empty() ? "" : ", " + format) + ") " + memory_qualifier(access.mode) + "uniform " + type + " " + binding.name +
         ";";
}

bool is_input(const dsl::Pass& pass, const InterfaceBinding& binding) {
  return binding.access != dsl::kAll && pass.accesses[binding.access].role == dsl::Role::input;
}

// An input attachment is a value: its texel at the fragment's own pixel, and sample where it has several.
std::string input_text(const dsl::Graph& graph, const dsl::Pass& pass, const InterfaceBinding& binding) {
  const dsl::Access& access = pass.accesses[binding.access];
  const dsl::Resource& image = graph.resources[access.resource];
  const std::string layer = !view_shape(image, access).arrayed ? "ivec2(gl_FragCoord.xy)"
                            : pass.multiview                   ? "ivec3(gl_FragCoord.xy, gl_ViewIndex)"
                                                               : "ivec3(gl_FragCoord.xy, gl_Layer)";
  const std::string sample = image.samples > 1 ? "gl_SampleID" : "0";
  return "#define " + access.name + " texelFetch(" + binding.name + ", " + layer + ", " + sample + ")";
}

// ---- what else a stage sees

void add_outputs(const dsl::Graph& graph, const dsl::Pass& pass, Prelude& prelude) {
  uint32_t location = 0;
  for (const dsl::Access& access : pass.accesses) {
    if (access.role != dsl::Role::color) continue;
    const char kind = texel_kind(dsl::seen_format(graph.resources[access.resource], access), 1);
    const std::string type = (kind == 'f' ? "" : std::string(1, kind)) + "vec4 ";
    prelude.push_back({"layout(location = " + std::to_string(location++) + ") out " + type + access.name + ";", access.span});
  }
}

uint32_t locations_of(const dsl::Type& type) { return type.columns * std::max(type.count, 1u); }

void add_vertex_inputs(const dsl::Program& program, const dsl::Pass& pass, Prelude& prelude) {
  uint32_t location = 0;
  for (const dsl::VertexInput& input : pass.draw.vertex) {
    for (const dsl::Field& field : program.structs[input.type].fields) {
      prelude.push_back(
          {"layout(location = " + std::to_string(location) + ") in " + glsl_variable(program, field.type, field.name) + ";", field.span});
      location += locations_of(field.type);
    }
  }
}

void add_stage_interface(const dsl::Program& program, const dsl::Graph& graph, const dsl::Pass& pass, dsl::Stage stage, Prelude& prelude) {
  if (pass.draw.per_draw.valid()) {
    const std::string type = program.structs[pass.draw.per_draw].name;
    const dsl::Type record{.record = pass.draw.per_draw};
    prelude.push_back(
        {std::string("layout(push_constant, ") + block_layout(program, record, "std430") + ") uniform rg_block_per_draw { " + type + " per_draw; };",
         pass.span});
  }
  if (stage == dsl::stage_vertex) add_vertex_inputs(program, pass, prelude);
  if (stage == dsl::stage_fragment) {
    if (is_fullscreen(pass)) prelude.push_back({"layout(location = 0) in vec2 uv;", pass.span});
    add_outputs(graph, pass, prelude);
  }
  if (stage == dsl::stage_compute) {
    const uint32_t* group = pass.dispatch.group;
    prelude.push_back({"layout(local_size_x = " + std::to_string(group[0]) + ", local_size_y = " + std::to_string(group[1]) +
                           ", local_size_z = " + std::to_string(group[2]) + ") in;",
                       pass.span});
  }
}

bool is_image(const dsl::Graph& graph, const dsl::Access& access) { return graph.resources[access.resource].kind == dsl::ResourceKind::image; }

// False where the access is made by fixed function, transfers or the host.
bool binding_kind(const dsl::Graph& graph, const dsl::Access& access, BindingKind& kind) {
  const bool image = is_image(graph, access), texels = !image && graph.resources[access.resource].format != dsl::Format::none;
  switch (access.role) {
    case dsl::Role::sampled:
      kind = texels ? BindingKind::texel_buffer : access.sampler.valid() ? BindingKind::combined_sampler : BindingKind::texture;
      return image || texels;
    case dsl::Role::storage:
      kind = image ? BindingKind::storage_image : texels ? BindingKind::storage_texel_buffer : BindingKind::storage_buffer;
      return true;
    case dsl::Role::uniform:
      kind = BindingKind::uniform_buffer;
      return !image;
    case dsl::Role::input:
      kind = BindingKind::texture;
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string last_part(const std::string& name) {
  const size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

const char* const kFullscreenVertexShader =
    "#version 460\n"
    "layout(location = 0) out vec2 uv;\n"
    "void main() {\n"
    "  uv = vec2(gl_VertexIndex & 2, (gl_VertexIndex << 1) & 2);\n"
    "  gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);\n"
    "}\n";

bool is_fullscreen(const dsl::Pass& pass) {
  const auto is_vertex = [](const dsl::Shader& shader) { return shader.stage == dsl::stage_vertex; };
  return pass.draw.kind == dsl::DrawKind::fullscreen && std::none_of(pass.shaders.begin(), pass.shaders.end(), is_vertex);
}

ViewShape view_shape(const dsl::Resource& image, const dsl::Access& access) {
  ViewShape shape{image.dimension, false, dsl::info(image.format).aspects};
  if (access.range.aspects != 0) shape.aspects = access.range.aspects;
  if ((shape.aspects & 6) == 6) shape.aspects = 2;
  const uint32_t layers = access.range.layers == dsl::kAll ? image.layers - std::min(access.range.layer, image.layers) : access.range.layers;
  const bool is_cube_view = image.dimension == dsl::Dimension::cube && access.role == dsl::Role::sampled && layers % 6 == 0;
  if (image.dimension == dsl::Dimension::cube && !is_cube_view) shape.dimension = dsl::Dimension::d2;
  shape.arrayed = layers > (is_cube_view ? 6u : 1u) && image.dimension != dsl::Dimension::d3;
  return shape;
}

std::string binding_name(const dsl::Access& access) {
  if (access.role == dsl::Role::input) return "rg_input_" + access.name;
  return access.element ? "rg_own_" + access.name : access.name;
}

std::vector<InterfaceBinding> pass_bindings(const dsl::Program&, const dsl::Graph& graph, const dsl::Pass& pass) {
  std::vector<InterfaceBinding> bindings;
  if (pass.kind != dsl::PassKind::raster && pass.kind != dsl::PassKind::compute) return bindings;
  for (uint32_t i = 0; i < pass.accesses.size(); ++i) {
    const dsl::Access& access = pass.accesses[i];
    InterfaceBinding binding{.binding = static_cast<uint32_t>(bindings.size()), .access = i, .name = binding_name(access), .span = access.span};
    if (binding_kind(graph, access, binding.kind)) bindings.push_back(std::move(binding));
  }
  for (uint32_t i = 0; i < pass.params.size(); ++i) {
    const dsl::ParamsUse& use = pass.params[i];
    bindings.push_back({BindingKind::params, static_cast<uint32_t>(bindings.size()), dsl::kAll, i, use.name, use.span});
  }
  return bindings;
}

const dsl::EngineSet* engine_set_of(const dsl::Program& program, const dsl::Pass& pass) {
  if (pass.bind.empty()) return nullptr;
  for (const dsl::EngineSet& set : program.engine_sets)
    if (set.name == pass.bind || last_part(set.name) == last_part(pass.bind)) return &set;
  return nullptr;
}

std::vector<std::string> engine_set_declarations(const dsl::EngineSet& set) {
  std::vector<std::string> declarations;
  std::string current;
  int depth = 0;
  for (const char c : set.glsl) {
    if (current.empty() && (c == ' ' || c == '\n' || c == '\t' || c == '\r')) continue;
    current += c == '\n' || c == '\r' ? ' ' : c;
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (c != ';' || depth > 0) continue;
    const std::string place = "layout(set = " + std::to_string(set.set) + ", binding = " + std::to_string(declarations.size()) + ") ";
    declarations.push_back(place + current);
    current.clear();
  }
  if (!current.empty()) declarations.push_back(current);  // glslang says what is wrong with it, at the set's declaration
  return declarations;
}

std::string feature_macro(const dsl::ShaderFeature& feature) { return "FEATURE_" + last_part(feature.name); }

Prelude make_prelude(const dsl::Program& program, const dsl::Graph& graph, const dsl::Pass& pass, dsl::Stage stage, const FixedFeatures& fixed) {
  Prelude prelude;
  for (const char* line : kHeader) prelude.push_back({line, {}});
  const bool scalar = std::any_of(program.structs.begin(), program.structs.end(), dsl::is_scalar);
  if (scalar) prelude.push_back({"#extension GL_EXT_scalar_block_layout : require", {}});
  if (pass.multiview) prelude.push_back({"#extension GL_EXT_multiview : require", pass.span});
  add_constants(program, prelude);
  add_structs(program, prelude);
  add_features(pass, fixed, prelude);
  if (const dsl::EngineSet* set = engine_set_of(program, pass))
    for (std::string& declaration : engine_set_declarations(*set)) prelude.push_back({std::move(declaration), set->span});
  for (const InterfaceBinding& binding : pass_bindings(program, graph, pass)) {
    if (is_input(pass, binding) && stage != dsl::stage_fragment) continue;
    const bool block = binding.kind == BindingKind::params;  // named by who declares it, not by who takes it
    prelude.push_back({binding_text(program, graph, pass, binding), block ? graph.params[pass.params[binding.params].id].span : binding.span});
    if (is_input(pass, binding)) prelude.push_back({input_text(graph, pass, binding), binding.span});
  }
  add_stage_interface(program, graph, pass, stage, prelude);
  for (const std::string& line : pass.interface_lines) prelude.push_back({line, pass.span});
  return prelude;
}

std::string text(const Prelude& prelude) {
  std::string joined;
  for (const PreludeLine& line : prelude) joined += line.text + "\n";
  return joined;
}

}  // namespace rg::compiler
