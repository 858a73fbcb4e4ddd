#include "runtime/pipeline_reuse.h"

#include <algorithm>

#include "runtime/plan_fields.h"

namespace rg {

namespace {

template <class Row>
bool equal(const Row& a, const Row& b) {
  if constexpr (std::is_array_v<Row>) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), [](const auto& x, const auto& y) { return equal(x, y); });
  } else if constexpr (plan_file::PlanNumber<Row> || std::is_same_v<Row, std::string_view>) {
    return a == b;
  } else {
    return plan_file::each_field(
        a, [&](const auto&... left) { return plan_file::each_field(b, [&](const auto&... right) { return (true && ... && equal(left, right)); }); });
  }
}
template <class Row>
bool equal(std::span<const Row> a, std::span<const Row> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Row& x, const Row& y) { return equal<Row>(x, y); });
}

bool same_code(const Plan& a, const Pipeline& x, const Plan& b, const Pipeline& y) {
  const auto rows = [](const Plan& plan, const Pipeline& pipeline) {
    return plan.pipeline_shaders.subspan(pipeline.first_shader, pipeline.shader_count);
  };
  return std::ranges::equal(rows(a, x), rows(b, y), [&](Index left, Index right) {
    const ShaderModule &m = a.shaders[left], &n = b.shaders[right];
    return m.stage == n.stage && std::ranges::equal(m.words, n.words);
  });
}

bool same_state(const Plan& a, const Pipeline& x, const Plan& b, const Pipeline& y) {
  RasterState raster = y.raster;  // where its sample locations stand says nothing of them
  raster.first_sample_location = x.raster.first_sample_location;
  return equal(x.raster, raster) &&
         equal(a.sample_locations.subspan(x.raster.first_sample_location, x.raster.sample_location_count),
               b.sample_locations.subspan(y.raster.first_sample_location, y.raster.sample_location_count)) &&
         equal(a.blends.subspan(x.first_blend, x.blend_count), b.blends.subspan(y.first_blend, y.blend_count)) &&
         equal(a.vertex_bindings.subspan(x.first_vertex_binding, x.vertex_binding_count),
               b.vertex_bindings.subspan(y.first_vertex_binding, y.vertex_binding_count)) &&
         equal(a.vertex_attributes.subspan(x.first_vertex_attribute, x.vertex_attribute_count),
               b.vertex_attributes.subspan(y.first_vertex_attribute, y.vertex_attribute_count));
}

Format format_of(const Plan& plan, Index attachment) {
  return attachment == kNone ? Format::undefined : plan.resources[plan.attachments[attachment].ref.resource].format;
}
bool same_attachments(const Plan& a, const Pass& x, const PassObjects& made, const Plan& b, const Pass& y, const PassObjects& before) {
  if (x.rendering == kNone || y.rendering == kNone) return x.rendering == y.rendering;
  const Rendering &r = a.renderings[x.rendering], &s = b.renderings[y.rendering];
  return made.color_formats == before.color_formats && format_of(a, r.depth) == format_of(b, s.depth) &&
         format_of(a, r.stencil) == format_of(b, s.stencil) && r.samples == s.samples && r.view_mask == s.view_mask && r.color_count == s.color_count;
}

// Layouts that are defined alike are compatible: a pipeline made with the one is bound with sets of the other.
bool same_layout(const Context& a, const Pass& x, const Context& b, const Pass& y) {
  const auto bindings = [](const Context& context, const Pass& pass) {
    return context.plan.bindings.subspan(pass.first_binding, pass.binding_count);
  };
  const bool same_set = std::ranges::equal(bindings(a, x), bindings(b, y), [](const Binding& m, const Binding& n) {
    return m.binding == n.binding && m.type == n.type && m.stages == n.stages;
  });
  if (!same_set || x.push_bytes != y.push_bytes || x.push_stages != y.push_stages) return false;
  if (x.engine_set == kNone || y.engine_set == kNone) return x.engine_set == y.engine_set;
  return a.plan.engine_sets[x.engine_set].role == b.plan.engine_sets[y.engine_set].role &&
         a.engine_set_layouts[x.engine_set] == b.engine_set_layouts[y.engine_set];
}

}  // namespace

PipelineReuse::PipelineReuse(const Context& context, const Predecessor* before) : context_(context), before_(before) {
  if (before == nullptr) return;
  const std::span<const Pass> passes = before->context.plan.passes;
  for (Index p = 0; p < passes.size(); ++p) passes_.emplace(passes[p].name, p);
}

SharedPipeline PipelineReuse::find(const Pass& pass, Index index, const PassObjects& made) const {
  const auto named = passes_.find(pass.name);
  if (named == passes_.end() || made.render_pass) return nullptr;  // classic render passes are made for one instance
  const Plan& plan = before_->context.plan;
  const Pass& other = plan.passes[named->second];
  const PassObjects& objects = before_->objects.passes[named->second];
  if (!same_attachments(context_.plan, pass, made, plan, other, objects) || !same_layout(context_, pass, before_->context, other)) return nullptr;
  const Pipeline& wanted = context_.plan.pipelines[index];
  for (const MadePipeline& there : objects.pipelines) {
    const Pipeline& row = plan.pipelines[there.row];
    if (same_code(context_.plan, wanted, plan, row) && same_state(context_.plan, wanted, plan, row)) return there.pipeline;
  }
  return nullptr;
}

}  // namespace rg
