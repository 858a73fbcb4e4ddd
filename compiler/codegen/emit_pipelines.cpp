// Rendering, pipelines and bindings.
#include <utility>

#include "compiler/codegen/plan_emitter.h"

namespace rg::compiler {
namespace {

std::string compare_text(Compare compare) {
  return enum_text("Compare", static_cast<size_t>(compare),
                   {"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"});
}

Row stencil_row(const StencilFace& face) {
  Row row;
  const auto op = [&](const char* member, StencilOp each) {
    if (each != StencilOp::keep)
      row.field(member, enum_text("StencilOp", static_cast<size_t>(each),
                                  {"keep", "zero", "replace", "increment", "decrement", "invert", "increment_wrap", "decrement_wrap"}));
  };
  op("fail", face.fail), op("pass", face.pass), op("depth_fail", face.depth_fail);
  if (face.compare != Compare::always) row.field("compare", compare_text(face.compare));
  return row.number("read_mask", face.read_mask).number("write_mask", face.write_mask).number("reference", face.reference);
}

Row raster_row(const RasterState& state) {
  Row row;
  row.number("cull", state.cull)
      .flag("front_clockwise", state.front_clockwise)
      .flag("depth_test", state.depth_test)
      .flag("depth_write", state.depth_write);
  if (state.depth_compare != Compare::greater_equal) row.field("depth_compare", compare_text(state.depth_compare));
  if (state.depth_bias_constant != 0) row.field("depth_bias_constant", cpp_float(state.depth_bias_constant));
  if (state.depth_bias_slope != 0) row.field("depth_bias_slope", cpp_float(state.depth_bias_slope));
  row.number("topology", state.topology, 3).flag("alpha_to_coverage", state.alpha_to_coverage);
  row.flag("depth_bounds", state.depth_bounds);
  if (state.depth_bounds) row.field("depth_min", cpp_float(state.depth_min)).field("depth_max", cpp_float(state.depth_max));
  row.flag("conservative", state.conservative);
  slice(row, "first_sample_location", state.first_sample_location, "sample_location_count", state.sample_location_count);
  if (!state.stencil_test) return row;
  return row.flag("stencil_test", true)
      .nested("stencil_front", stencil_row(state.stencil_front))
      .nested("stencil_back", stencil_row(state.stencil_back));
}

Row blend_row(const ColorBlend& blend) {
  if (!blend.enabled) return {};
  const auto factor = [](BlendFactor f) {
    return enum_text("BlendFactor", static_cast<size_t>(f),
                     {"zero", "one", "src_color", "one_minus_src_color", "dst_color", "one_minus_dst_color", "src_alpha", "one_minus_src_alpha",
                      "dst_alpha", "one_minus_dst_alpha"});
  };
  const auto op = [](BlendOp o) { return enum_text("BlendOp", static_cast<size_t>(o), {"add", "subtract", "reverse_subtract", "min", "max"}); };
  return Row()
      .flag("enabled", true)
      .field("src", factor(blend.src))
      .field("dst", factor(blend.dst))
      .field("op", op(blend.op))
      .field("src_alpha", factor(blend.src_alpha))
      .field("dst_alpha", factor(blend.dst_alpha))
      .field("op_alpha", op(blend.op_alpha));
}

std::string descriptor_text(DescriptorType type) {
  switch (type) {
    case DescriptorType::sampler:
      return "DescriptorType::sampler";
    case DescriptorType::combined_image_sampler:
      return "DescriptorType::combined_image_sampler";
    case DescriptorType::sampled_image:
      return "DescriptorType::sampled_image";
    case DescriptorType::storage_image:
      return "DescriptorType::storage_image";
    case DescriptorType::uniform_texel_buffer:
      return "DescriptorType::uniform_texel_buffer";
    case DescriptorType::storage_texel_buffer:
      return "DescriptorType::storage_texel_buffer";
    case DescriptorType::uniform_buffer:
      return "DescriptorType::uniform_buffer";
    case DescriptorType::storage_buffer:
      return "DescriptorType::storage_buffer";
    case DescriptorType::uniform_buffer_dynamic:
      return "DescriptorType::uniform_buffer_dynamic";
    case DescriptorType::input_attachment:
      return "DescriptorType::input_attachment";
  }
  return "";
}

}  // namespace

void PlanEmitter::rendering() {
  table("Attachment", "kAttachments", plan_.attachments, [&](const Attachment& a, size_t) {
    Row row;
    row.nested("ref", ref(a.ref)).nested("range", range(a.range)).number("slice", a.slice).number("slices", a.slices);
    if (a.view_format != Format::undefined) row.field("view_format", format_text(a.view_format));
    row.field("layout", layout_text(a.layout))
        .field("load", enum_text("LoadOp", static_cast<size_t>(a.load), {"load", "clear", "dont_care", "none"}));
    row.field("store", enum_text("StoreOp", static_cast<size_t>(a.store), {"store", "dont_care", "none"})).nested("clear", clear_value(a.clear));
    if (a.resolve.resource == kNone) return row;
    row.nested("resolve", ref(a.resolve)).nested("resolve_range", range(a.resolve_range)).field("resolve_layout", layout_text(a.resolve_layout));
    return row.number("resolve_mode", a.resolve_mode);
  });
  table("Rendering", "kRenderings", plan_.renderings, [&](const Rendering& r, size_t) {
    Row row;
    slice(row, "first_color", r.first_color, "color_count", r.color_count);
    index(row, "depth", r.depth);
    index(row, "stencil", r.stencil);
    index(row, "width", r.width);
    index(row, "height", r.height);
    return row.number("layers", r.layers, 1).number("view_mask", r.view_mask).number("samples", r.samples, 1);
  });
}

void PlanEmitter::pipelines() {
  table("ShaderModule", "kShaders", plan_.shaders, [&](const ShaderModule& m, size_t i) {
    static constexpr std::pair<ShaderStage, const char*> kStages[] = {
        {ShaderStage::vertex, "vertex"},     {ShaderStage::tess_control, "tess_control"}, {ShaderStage::tess_eval, "tess_eval"},
        {ShaderStage::geometry, "geometry"}, {ShaderStage::fragment, "fragment"},         {ShaderStage::compute, "compute"}};
    Row row;
    row.string("name", m.name);
    for (const auto& [stage, name] : kStages)
      if (stage == m.stage) row.field("stage", std::string("ShaderStage::") + name);
    return row.field("words", text_.shader_symbols[i]);
  });
  list(out_, "Index", "kPipelineShaders", numbers(plan_.pipeline_shaders));
  table("ColorBlend", "kBlends", plan_.blends, [](const ColorBlend& b, size_t) { return blend_row(b); });
  table("SampleLocation", "kSampleLocations", plan_.sample_locations,
        [](const SampleLocation& s, size_t) { return Row().field("x", cpp_float(s.x)).field("y", cpp_float(s.y)); });
  table("VertexBinding", "kVertexBindings", plan_.vertex_bindings,
        [](const VertexBinding& b, size_t) { return Row().number("stride", b.stride).flag("per_instance", b.per_instance); });
  table("VertexAttribute", "kVertexAttributes", plan_.vertex_attributes, [](const VertexAttribute& a, size_t) {
    return Row().number("location", a.location).number("binding", a.binding).number("offset", a.offset).field("format", format_text(a.format));
  });
  table("Pipeline", "kPipelines", plan_.pipelines, [&](const Pipeline& p, size_t) {
    Row row;
    row.string("name", p.name).field("pass", pass(p.pass));
    slice(row, "first_shader", p.first_shader, "shader_count", p.shader_count);
    row.nested("raster", raster_row(p.raster));
    slice(row, "first_blend", p.first_blend, "blend_count", p.blend_count);
    slice(row, "first_vertex_binding", p.first_vertex_binding, "vertex_binding_count", p.vertex_binding_count);
    return slice(row, "first_vertex_attribute", p.first_vertex_attribute, "vertex_attribute_count", p.vertex_attribute_count);
  });
}

void PlanEmitter::bindings() {
  table("Binding", "kBindings", plan_.bindings, [&](const Binding& b, size_t i) {
    Row row;
    row.number("binding", b.binding).field("type", descriptor_text(b.type)).number("stages", b.stages);
    row.nested("ref", ref(b.ref)).nested("range", range(b.range)).nested("bytes", bytes(b.bytes));
    if (b.view != Dimension::d2) row.field("view", dimension_text(b.view));
    row.flag("arrayed", b.arrayed);
    if (b.view_format != Format::undefined) row.field("view_format", format_text(b.view_format));
    if (b.layout != Layout::undefined) row.field("layout", layout_text(b.layout));
    index(row, "sampler", b.sampler);
    return index(row, "params", b.params).comment(owner(plan_, i, &Pass::first_binding, &Pass::binding_count));
  });
  table("Sampler", "kSamplers", plan_.samplers, [](const Sampler& s, size_t) {
    Row row;
    row.string("name", s.name).flag("linear", s.linear).flag("mip_linear", s.mip_linear).number("address", s.address, 2);
    row.flag("compare_enabled", s.compare_enabled);
    if (s.compare_enabled) row.field("compare", compare_text(s.compare));
    return s.max_anisotropy != 0 ? row.field("max_anisotropy", cpp_float(s.max_anisotropy)) : row;
  });
  table("Params", "kParams", plan_.params, [&](const Params& p, size_t) {
    Row row;
    row.string("name", p.name).number("bytes", p.bytes);
    if (p.pass != kNone) row.field("pass", pass(p.pass));
    return row.number("layout", p.layout);
  });
  table("EngineSet", "kEngineSets", plan_.engine_sets, [](const EngineSet& s, size_t) {
    return Row().string("name", s.name).field("role", enum_text("SetRole", static_cast<size_t>(s.role), {"engine", "pass", "material", "draw"}));
  });
}

}  // namespace rg::compiler
