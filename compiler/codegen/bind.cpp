#include "compiler/codegen/bind.h"

#include <algorithm>
#include <map>

#include "compiler/codegen/layout_number.h"
#include "compiler/expressions.h"
#include "compiler/format_table.h"
#include "compiler/shaders/interface.h"
#include "dsl/check_macro.h"
#include "dsl/features.h"
#include "dsl/format_table.h"
#include "dsl/layout.h"

namespace rg::compiler {
namespace {

// ---- fixed-function state, the program's words to Vulkan's numbers

BlendFactor convert(dsl::BlendFactor factor) {
  switch (factor) {
    case dsl::BlendFactor::zero:
      return BlendFactor::zero;
    case dsl::BlendFactor::one:
      return BlendFactor::one;
    case dsl::BlendFactor::src_alpha:
      return BlendFactor::src_alpha;
    case dsl::BlendFactor::one_minus_src_alpha:
      return BlendFactor::one_minus_src_alpha;
    case dsl::BlendFactor::dst_alpha:
      return BlendFactor::dst_alpha;
    case dsl::BlendFactor::one_minus_dst_alpha:
      return BlendFactor::one_minus_dst_alpha;
    case dsl::BlendFactor::src_color:
      return BlendFactor::src_color;
    case dsl::BlendFactor::one_minus_src_color:
      return BlendFactor::one_minus_src_color;
    case dsl::BlendFactor::dst_color:
      return BlendFactor::dst_color;
    case dsl::BlendFactor::one_minus_dst_color:
      return BlendFactor::one_minus_dst_color;
  }
  return BlendFactor::zero;
}

ColorBlend convert(const dsl::Blend& blend) {
  const auto op = static_cast<BlendOp>(blend.op);
  return {blend.enabled, convert(blend.src), convert(blend.dst), op, convert(blend.src_alpha), convert(blend.dst_alpha), op};
}

uint8_t convert(dsl::Topology topology) {
  switch (topology) {
    case dsl::Topology::points:
      return 0;
    case dsl::Topology::lines:
      return 1;
    case dsl::Topology::triangles:
      return 3;
    case dsl::Topology::triangle_strip:
      return 4;
  }
  return 3;
}

bool may_write(const dsl::Pass& pass, dsl::Role role) {
  return std::any_of(pass.accesses.begin(), pass.accesses.end(),
                     [&](const dsl::Access& access) { return access.role == role && access.mode != dsl::Mode::read; });
}

StencilFace convert(const dsl::StencilFace& face, bool writes) {
  const auto op = [](dsl::StencilOp each) { return static_cast<StencilOp>(each); };  // in one order
  return {op(face.fail), op(face.pass), op(face.depth_fail), static_cast<Compare>(face.compare), face.read_mask, writes ? face.write_mask : 0u,
          face.reference};
}

// Bits of the capabilities that the state of the pass uses where its features have these values.
uint32_t device_state(const dsl::Program& program, const dsl::Pass& pass, const std::vector<uint32_t>& values) {
  uint32_t bits = 0;
  for (size_t i = 0; i < pass.features.size(); ++i) {
    const dsl::FeatureId feature = pass.features[i].feature;
    if (!feature.valid() || !pass.state.valid() || values[i] != 1) continue;
    const dsl::Capability capability = program.features[feature].capability;
    if (dsl::asks(program.states[pass.state], capability)) bits |= 1u << static_cast<uint32_t>(capability);
  }
  return bits;
}

// What only some devices can, in a variant of the pass for those.
void add_device_state(PlanData& plan, const dsl::State& state, uint32_t capabilities, RasterState& raster) {
  const auto can = [&](dsl::Capability capability) { return (capabilities >> static_cast<uint32_t>(capability) & 1) != 0; };
  raster.depth_bounds = can(dsl::Capability::depth_bounds);
  if (raster.depth_bounds) raster.depth_min = state.depth_min, raster.depth_max = state.depth_max;
  raster.conservative = can(dsl::Capability::conservative_rasterization);
  if (!can(dsl::Capability::sample_locations)) return;
  raster.first_sample_location = static_cast<Index>(plan.sample_locations.size());
  raster.sample_location_count = static_cast<uint32_t>(state.sample_locations.size());
  for (const dsl::SampleLocation& at : state.sample_locations) plan.sample_locations.push_back({at.x, at.y});
}

RasterState raster_state(PlanData& plan, const dsl::Program& program, const dsl::Pass& pass, uint32_t capabilities) {
  const dsl::State state = pass.state.valid() ? program.states[pass.state] : dsl::State{};
  RasterState raster;
  // The generated triangle has one side.
  raster.cull = is_fullscreen(pass) ? 0 : static_cast<uint8_t>(state.cull);
  raster.front_clockwise = state.front_clockwise;
  raster.depth_test = state.depth_test;
  raster.depth_write = state.depth_write && state.depth_test && may_write(pass, dsl::Role::depth);
  raster.depth_compare = static_cast<Compare>(state.depth_compare);
  raster.depth_bias_constant = state.depth_bias_constant;
  raster.depth_bias_slope = state.depth_bias_slope;
  raster.topology = is_fullscreen(pass) ? convert(dsl::Topology::triangles) : convert(state.topology);
  raster.alpha_to_coverage = state.alpha_to_coverage;
  raster.stencil_test = state.stencil_test;
  add_device_state(plan, state, capabilities, raster);
  if (!state.stencil_test) return raster;
  raster.stencil_front = convert(state.stencil_front, may_write(pass, dsl::Role::stencil));
  raster.stencil_back = convert(state.stencil_back, may_write(pass, dsl::Role::stencil));
  return raster;
}

Sampler convert(const dsl::Sampler& sampler) {
  Sampler row;
  row.name = intern(sampler.name);
  row.linear = sampler.filter == dsl::Filter::linear;
  row.mip_linear = sampler.mip_filter == dsl::Filter::linear;
  row.address = static_cast<uint8_t>(sampler.address);  // both count repeat, mirror, clamp, border
  row.compare_enabled = sampler.compare.has_value();
  row.compare = sampler.compare ? static_cast<Compare>(*sampler.compare) : Compare::never;
  row.max_anisotropy = sampler.max_anisotropy;
  return row;
}

// ---- vertex input

Format vertex_format(const dsl::Type& type) {
  if (type.packed != dsl::Format::none) return format_row(type.packed).vulkan;
  constexpr uint32_t kUint[] = {98, 101, 104, 107}, kInt[] = {99, 102, 105, 108}, kFloat[] = {100, 103, 106, 109};
  const size_t last = type.rows - 1;
  if (type.scalar == dsl::Scalar::f32) return static_cast<Format>(kFloat[last]);
  return static_cast<Format>(type.scalar == dsl::Scalar::i32 ? kInt[last] : kUint[last]);
}

uint32_t column_bytes(const dsl::Type& type) { return type.columns == 1 ? 4u * type.rows : type.rows == 2 ? 8u : 16u; }

// From one column, or element of an array, to the next.
uint32_t attribute_stride(const dsl::Type& type, bool scalar) {
  if (type.packed != dsl::Format::none) return dsl::info(type.packed).block_bytes;
  if (scalar) return 4u * type.rows;
  return type.count > 0 && type.columns == 1 && type.rows == 3 ? 16 : column_bytes(type);
}

// One location a column of each array element, as GLSL counts them.
void add_attributes(PlanData& plan, const dsl::Field& field, bool scalar, uint32_t binding, uint32_t& location) {
  const uint32_t columns = field.type.columns * std::max(field.type.count, 1u), stride = attribute_stride(field.type, scalar);
  for (uint32_t i = 0; i < columns; ++i)
    plan.vertex_attributes.push_back({location++, binding, field.offset430 + i * stride, vertex_format(field.type)});
}

void add_vertex_input(PlanData& plan, Pipeline& pipeline, const dsl::Program& program, const dsl::Pass& pass) {
  pipeline.first_vertex_binding = static_cast<Index>(plan.vertex_bindings.size());
  pipeline.first_vertex_attribute = static_cast<Index>(plan.vertex_attributes.size());
  uint32_t location = 0;
  for (uint32_t binding = 0; binding < pass.draw.vertex.size(); ++binding) {
    const dsl::Struct& record = program.structs[pass.draw.vertex[binding].type];
    plan.vertex_bindings.push_back({record.size430, pass.draw.vertex[binding].per_instance});
    for (const dsl::Field& field : record.fields) add_attributes(plan, field, dsl::is_scalar(record), binding, location);
  }
  pipeline.vertex_binding_count = static_cast<uint32_t>(plan.vertex_bindings.size()) - pipeline.first_vertex_binding;
  pipeline.vertex_attribute_count = static_cast<uint32_t>(plan.vertex_attributes.size()) - pipeline.first_vertex_attribute;
}

// ---- one pass

struct Binder {
  PlanData& plan;
  const dsl::Program& program;
  const dsl::Graph& graph;
  const ShaderBundle& bundle;
  size_t configuration;
  std::map<uint32_t, Index> plan_resource;  // by program resource
  std::map<size_t, Index> plan_shader;      // by bundle shader
};

// The layout the planner gave this image in this pass.
Layout layout_of(const Binder& b, const Pass& pass, const Binding& binding) {
  Layout layout = Layout::undefined;
  const auto end_of = [](uint32_t first, uint32_t count) { return count == kRemaining ? UINT32_MAX : first + count; };
  const auto overlaps = [&](uint32_t a, uint32_t na, uint32_t b0, uint32_t nb) { return a < end_of(b0, nb) && b0 < end_of(a, na); };
  for (Index i = pass.first_access; i < pass.first_access + pass.access_count; ++i) {
    const Access& access = b.plan.accesses[i];
    const bool same = access.ref == binding.ref && (access.range.aspects & binding.range.aspects) != 0 &&
                      overlaps(access.range.mip, access.range.mips, binding.range.mip, binding.range.mips) &&
                      overlaps(access.range.layer, access.range.layers, binding.range.layer, binding.range.layers);
    if (same && access.layout != Layout::undefined) layout = access.layout;
  }
  RG_CHECK(layout != Layout::undefined, "an image bound to a shader has no layout in its pass");
  return layout;
}

DescriptorType descriptor_type(BindingKind kind) {
  switch (kind) {
    case BindingKind::combined_sampler:
      return DescriptorType::combined_image_sampler;
    case BindingKind::texture:
      return DescriptorType::sampled_image;
    case BindingKind::storage_image:
      return DescriptorType::storage_image;
    case BindingKind::storage_buffer:
      return DescriptorType::storage_buffer;
    case BindingKind::uniform_buffer:
      return DescriptorType::uniform_buffer;
    case BindingKind::params:
      return DescriptorType::uniform_buffer_dynamic;
    case BindingKind::texel_buffer:
      return DescriptorType::uniform_texel_buffer;
    case BindingKind::storage_texel_buffer:
      return DescriptorType::storage_texel_buffer;
  }
  return DescriptorType::sampled_image;
}

void bind_resource(const Binder& b, const Pass& pass, const dsl::Access& access, Binding& binding) {
  const dsl::Resource& resource = b.graph.resources[access.resource];
  binding.ref = {b.plan_resource.at(access.resource.value), access.age};
  if (resource.kind == dsl::ResourceKind::buffer) {
    binding.bytes = {index_of(access.range.offset), index_of(access.range.size)};
    if (resource.format != dsl::Format::none) binding.view_format = format_row(resource.format).vulkan;
    return;
  }
  const ViewShape view = view_shape(resource, access);
  if (access.view != dsl::Format::none) binding.view_format = format_row(access.view).vulkan;
  binding.range = {view.aspects, access.range.mip, access.range.mips, access.range.layer, access.range.layers};
  binding.view = static_cast<Dimension>(view.dimension);
  binding.arrayed = view.arrayed;
  binding.layout = layout_of(b, pass, binding);
  if (access.sampler.valid()) binding.sampler = access.sampler.value;
}

void add_bindings(Binder& b, Pass& pass, const dsl::Pass& source, const PassShaders& shaders) {
  pass.first_binding = static_cast<Index>(b.plan.bindings.size());
  pass.first_params = static_cast<Index>(b.plan.pass_params.size());
  for (const InterfaceBinding& interface : pass_bindings(b.program, b.graph, source)) {
    Binding binding;
    binding.binding = interface.binding;
    binding.type = descriptor_type(interface.kind);
    if (interface.kind == BindingKind::params) {
      binding.stages = shaders.params_stages[interface.params];
      binding.params = source.params[interface.params].id.value;
      b.plan.pass_params.push_back(binding.params);
    } else {
      binding.stages = shaders.access_stages[interface.access];
      bind_resource(b, pass, source.accesses[interface.access], binding);
    }
    b.plan.bindings.push_back(binding);
  }
  pass.binding_count = static_cast<uint32_t>(b.plan.bindings.size()) - pass.first_binding;
  pass.params_count = static_cast<uint32_t>(b.plan.pass_params.size()) - pass.first_params;
}

Index add_shader(Binder& b, size_t shader) {
  const auto [at, is_new] = b.plan_shader.try_emplace(shader, static_cast<Index>(b.plan.shaders.size()));
  if (is_new) {
    const CompiledShader& compiled = b.bundle.shaders[shader];
    b.plan.shaders.push_back({intern(compiled.name), static_cast<ShaderStage>(compiled.stage), compiled.words});
  }
  return at->second;
}

Index add_pipeline(Binder& b, Index pass_index, const dsl::Pass& source, const std::vector<size_t>& shaders, uint32_t capabilities) {
  Pipeline pipeline;
  pipeline.name = b.plan.passes[pass_index].name;
  pipeline.pass = pass_index;
  pipeline.first_shader = static_cast<Index>(b.plan.pipeline_shaders.size());
  for (const size_t shader : shaders) b.plan.pipeline_shaders.push_back(add_shader(b, shader));
  pipeline.shader_count = static_cast<uint32_t>(shaders.size());
  if (source.kind == dsl::PassKind::raster) {
    pipeline.raster = raster_state(b.plan, b.program, source, capabilities);
    pipeline.first_blend = static_cast<Index>(b.plan.blends.size());
    for (const dsl::Access& access : source.accesses)
      if (access.role == dsl::Role::color) b.plan.blends.push_back(convert(access.blend));
    pipeline.blend_count = static_cast<uint32_t>(b.plan.blends.size()) - pipeline.first_blend;
    add_vertex_input(b.plan, pipeline, b.program, source);
  }
  b.plan.pipelines.push_back(pipeline);
  return static_cast<Index>(b.plan.pipelines.size() - 1);
}

// The feature's row in Plan::features.
Index add_feature(Binder& b, const dsl::Feature& feature) {
  const auto same = [&](const Feature& row) { return row.name == feature.name; };
  const auto found = std::find_if(b.plan.features.begin(), b.plan.features.end(), same);
  if (found != b.plan.features.end()) return static_cast<Index>(found - b.plan.features.begin());
  const Capability capability = plan_capability(feature.capability);
  b.plan.features.push_back(
      {intern(feature.name), static_cast<uint32_t>(feature.values.size()), feature.initial, capability, layout_of_values(feature)});
  return static_cast<Index>(b.plan.features.size() - 1);
}

// A pipeline for every combination of the features that shaders are selected by; equal ones once.
void add_pipelines(Binder& b, Index pass_index, const dsl::Pass& source, const PassShaders& shaders) {
  if (b.configuration >= shaders.variants.size() || shaders.variants[b.configuration].empty()) return;
  const auto& selected = shaders.variants[b.configuration];
  std::map<std::pair<std::vector<size_t>, uint32_t>, Index> known;
  std::vector<Index> choices;
  for (size_t s = 0; s < selected.size(); ++s) {
    if (selected[s].empty()) {
      choices.push_back(kNone);
      continue;
    }
    const uint32_t capabilities = device_state(b.program, source, shaders.values[b.configuration][s]);
    const auto [at, is_new] = known.try_emplace({selected[s], capabilities}, kNone);
    if (is_new) at->second = add_pipeline(b, pass_index, source, selected[s], capabilities);
    choices.push_back(at->second);
  }
  Pass& pass = b.plan.passes[pass_index];
  const auto first = std::find_if(choices.begin(), choices.end(), [](Index choice) { return choice != kNone; });
  pass.pipeline = first == choices.end() ? kNone : *first;
  if (choices.size() == 1) return;
  pass.first_choice = static_cast<Index>(b.plan.pipeline_choices.size());
  pass.choice_count = static_cast<uint32_t>(choices.size());
  pass.first_feature = static_cast<Index>(b.plan.pass_features.size());
  for (const size_t feature : shaders.selecting[b.configuration])
    b.plan.pass_features.push_back(add_feature(b, b.program.features[source.features[feature].feature]));
  pass.feature_count = static_cast<uint32_t>(b.plan.pass_features.size()) - pass.first_feature;
  uint32_t initial = 0;
  for (const Index row : std::span(b.plan.pass_features).subspan(pass.first_feature))
    initial = initial * b.plan.features[row].values + b.plan.features[row].initial;
  if (choices[initial] != kNone) pass.pipeline = choices[initial];
  b.plan.pipeline_choices.insert(b.plan.pipeline_choices.end(), choices.begin(), choices.end());
}

Index engine_set_index(const dsl::Program& program, const dsl::Pass& pass) {
  const dsl::EngineSet* set = engine_set_of(program, pass);
  return set == nullptr ? kNone : static_cast<Index>(set - program.engine_sets.rows.data());
}

void bind_pass(Binder& b, Index index) {
  Pass& pass = b.plan.passes[index];
  pass.pipeline = pass.engine_set = kNone;
  pass.first_binding = pass.binding_count = pass.first_params = pass.params_count = pass.push_bytes = pass.push_stages = pass.push_layout = 0;
  pass.first_choice = pass.choice_count = pass.first_feature = pass.feature_count = 0;
  const uint32_t program_pass = b.plan.program_pass[index];
  // A clear in front of a pass may name that pass as its origin, but runs none of its shaders.
  if (program_pass == kNone || pass.kind == PassKind::transfer || pass.kind == PassKind::host) return;
  const dsl::Pass& source = b.graph.passes.rows[program_pass];
  const PassShaders& shaders = b.bundle.passes[program_pass];
  add_bindings(b, pass, source, shaders);
  add_pipelines(b, index, source, shaders);
  pass.engine_set = engine_set_index(b.program, source);
  if (!source.draw.per_draw.valid()) return;
  pass.push_bytes = b.program.structs[source.draw.per_draw].size430;
  pass.push_layout = layout_of_struct(b.program, source.draw.per_draw);
  pass.push_stages = shaders.push_stages;
}

// Conditions that follow from features, of passes that the plan has.
void add_feature_conditions(Binder& b) {
  uint64_t used = 0;
  for (const Pass& pass : b.plan.passes) used |= pass.guard;
  for (size_t c = 0; c < b.program.conditions.size(); ++c) {
    const dsl::Condition& condition = b.program.conditions.rows[c];
    if (!condition.feature.valid() || (used >> c & 1) == 0) continue;
    FeatureCondition row{static_cast<Index>(c), add_feature(b, b.program.features[condition.feature]), 0};
    for (const uint32_t value : condition.values) row.values |= uint64_t{1} << value;
    b.plan.feature_conditions.push_back(row);
  }
}

void clear_tables(PlanData& plan) {
  plan.shaders.clear();
  plan.pipelines.clear();
  plan.pipeline_shaders.clear();
  plan.blends.clear();
  plan.sample_locations.clear();
  plan.vertex_bindings.clear();
  plan.vertex_attributes.clear();
  plan.bindings.clear();
  plan.samplers.clear();
  plan.params.clear();
  plan.pass_params.clear();
  plan.features.clear();
  plan.pass_features.clear();
  plan.pipeline_choices.clear();
  plan.feature_conditions.clear();
  plan.engine_sets.clear();
}

SetRole set_role(uint32_t set) {
  RG_CHECK(set != 1 && set <= 3, "an engine set has a number that is not the engine's");
  return static_cast<SetRole>(set);
}

}  // namespace

Capability plan_capability(dsl::Capability capability) {
  switch (capability) {
#define RG_CAPABILITY(name, meaning) \
  case dsl::Capability::name:        \
    return Capability::name;
#include "dsl/capability.def"
#undef RG_CAPABILITY
    case dsl::Capability::none:
      break;
  }
  return Capability::none;
}

void attach_shaders(PlanData& plan, const dsl::Program& program, dsl::GraphId graph_id, const ShaderBundle& bundle, size_t configuration) {
  const dsl::Graph& graph = program.graphs[graph_id];
  RG_CHECK(plan.program_pass.size() == plan.passes.size(), "the plan does not say which pass of the program each pass is");
  clear_tables(plan);
  Binder b{plan, program, graph, bundle, configuration, {}, {}};
  for (uint32_t i = 0; i < plan.program_resource.size(); ++i) b.plan_resource.emplace(plan.program_resource[i], i);
  for (size_t i = 0; i < plan.resources.size(); ++i)
    plan.resources[i].layout = layout_of_elements(program, graph.resources.rows[plan.program_resource[i]]);
  for (const dsl::Sampler& sampler : program.samplers) plan.samplers.push_back(convert(sampler));
  for (const dsl::EngineSet& set : program.engine_sets) plan.engine_sets.push_back({intern(set.name), set_role(set.set)});
  for (const dsl::Params& params : graph.params)
    plan.params.push_back({intern(params.name), program.structs[params.type].size140, kNone, layout_of_struct(program, params.type)});
  for (Index i = 0; i < plan.passes.size(); ++i) bind_pass(b, i);
  add_feature_conditions(b);
  for (Index i = 0; i < plan.passes.size(); ++i)
    for (size_t p = 0; p < graph.params.size(); ++p)
      if (plan.program_pass[i] != kNone && graph.params.rows[p].pass == dsl::PassId{plan.program_pass[i]} && plan.passes[i].params_count > 0)
        plan.params[p].pass = i;
}

}  // namespace rg::compiler
