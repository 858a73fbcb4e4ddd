#include "runtime/plan_check.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <vector>

#include "runtime/plan_check_parts.h"
#include "runtime/plan_fields.h"

namespace rg {

namespace {

using plan_check::Checker;

// Every reference of every row, needed or not, is to a resource there is or to none; every enumerator is one that its type can hold.
class ReferenceCheck {
 public:
  ReferenceCheck(const Plan& plan, Checker& checker) : plan_(plan), checker_(checker) {}

  template <plan_file::PlanRow Row>
  void check(const Row& row) {
    plan_file::each_field(row, [&](const auto&... fields) { (check(fields), ...); });
  }
  template <class Row>
  void check(std::span<const Row> rows) {
    if constexpr (plan_file::PlanRow<Row>)
      for (row_ = 0; row_ < rows.size() && checker_.ok(); ++row_) check(rows[row_]);
  }
  void check(const Ref& ref) { checker_.optional(ref.resource, plan_.resources.size(), "a table's row", row_, "resource"); }
  // Those of four bytes are numbers of Vulkan, whose enumerations end there.
  template <class Enumerator>
  requires std::is_enum_v<Enumerator>
  void check(const Enumerator& value) {
    checker_.that(sizeof(Enumerator) < 4 || static_cast<uint64_t>(value) <= INT32_MAX, "a table's row", row_, "enumerator");
  }
  template <class Other>
  void check(const Other&) {}

 private:
  const Plan& plan_;
  Checker& checker_;
  size_t row_ = 0;
};

bool has_operands(ExprOp op) { return op != ExprOp::constant && op != ExprOp::extent; }

void check_exprs(const Plan& plan, Checker& c) {
  for (size_t i = 0; i < plan.exprs.size(); ++i) {
    const Expr& e = plan.exprs[i];
    c.that(e.op <= ExprOp::mip, "expression", i, "operation");
    if (e.op == ExprOp::extent) c.that(e.value >= 0 && static_cast<uint64_t>(e.value) < plan.extents.size() * 3, "expression", i, "extent");
    if (!has_operands(e.op)) continue;
    c.that(e.a == kNone || e.a < i, "expression", i, "first operand");
    c.that(e.b == kNone || e.b < i, "expression", i, "second operand");
  }
}

void check_extents(const Plan& plan, Checker& c) {
  constexpr int64_t kMost = int64_t{1} << 31;
  for (size_t i = 0; i < plan.extents.size(); ++i) {
    const Extent& extent = plan.extents[i];
    c.that(extent.axes >= 1 && extent.axes <= 3, "extent", i, "axes");
    for (int axis = 0; axis < 3; ++axis)
      c.that(extent.minimum[axis] >= 0 && extent.minimum[axis] <= extent.initial[axis] && extent.initial[axis] <= extent.maximum[axis] &&
                 extent.maximum[axis] <= kMost,
             "extent", i, "initial, smallest and largest value");
  }
}

void check_resource(const Resource& resource, size_t i, Checker& c) {
  c.that(resource.kind <= ResourceKind::buffer && resource.lifetime <= Lifetime::readback && resource.dimension <= Dimension::cube, "resource", i,
         "kind");
  for (const Index expr : {resource.width, resource.height, resource.depth, resource.bytes}) c.expr(expr, "resource", i, "size");
  c.that(resource.lifetime != Lifetime::imported || resource.import_slot < 4096, "resource", i, "import slot");
  c.that(resource.lifetime != Lifetime::readback || resource.kind == ResourceKind::buffer, "resource", i, "only buffers are read back");
  c.that(resource.copies >= 1 && resource.copies <= 64, "resource", i, "copies");
  constexpr uint32_t kAttachments = 0x10 | 0x20;  // colour; depth and stencil
  const bool attachment = resource.kind == ResourceKind::image && resource.usage != 0 && (resource.usage & ~kAttachments) == 0;
  c.that(!resource.lazy || (attachment && resource.lifetime == Lifetime::transient), "resource", i,
         "lazy, and no transient that is only an attachment");
  if (resource.kind != ResourceKind::image) return;
  c.that(resource.mips >= 1 && resource.mips <= 16 && resource.layers >= 1 && resource.layers <= 65536, "resource", i, "mips or layers");
  c.that(resource.samples >= 1 && resource.samples <= 64 && (resource.samples & (resource.samples - 1)) == 0, "resource", i, "samples");
  c.that(resource.format != Format::undefined && resource.aspects >= 1 && resource.aspects <= 7, "resource", i, "format");
}

void check_barriers(const Plan& plan, Checker& c) {
  for (size_t i = 0; i < plan.groups.size(); ++i) {
    const BarrierGroup& group = plan.groups[i];
    c.range(group.first_memory, group.memory_count, plan.memory_barriers.size(), "group", i, "memory barriers");
    c.range(group.first_image, group.image_count, plan.image_barriers.size(), "group", i, "image barriers");
    c.range(group.first_buffer, group.buffer_count, plan.buffer_barriers.size(), "group", i, "buffer barriers");
  }
  for (size_t i = 0; i < plan.image_barriers.size(); ++i) c.ref(plan.image_barriers[i].image, ResourceKind::image, "image barrier", i, "image");
  for (size_t i = 0; i < plan.buffer_barriers.size(); ++i) {
    c.ref(plan.buffer_barriers[i].buffer, ResourceKind::buffer, "buffer barrier", i, "buffer");
    c.bytes(plan.buffer_barriers[i].bytes, "buffer barrier", i);
  }
  for (size_t i = 0; i < plan.entry.size(); ++i) c.any_ref(plan.entry[i].ref, "entry", i);
  for (size_t i = 0; i < plan.exit.size(); ++i) c.any_ref(plan.exit[i].ref, "exit", i);
}

// Whoever takes memory must say when it lets go.
void check_released(const Plan& plan, Checker& c) {
  std::vector<bool> released(plan.resources.size());
  for (const Release& release : plan.releases)
    if (release.resource < released.size()) released[release.resource] = true;
  for (size_t i = 0; i < plan.acquires.size(); ++i)
    c.that(plan.acquires[i].resource < released.size() && released[plan.acquires[i].resource], "acquire", i, "no release");
}

void check_aliases(const Plan& plan, Checker& c) {
  check_released(plan, c);
  for (size_t i = 0; i < plan.acquires.size(); ++i) {
    const Acquire& acquire = plan.acquires[i];
    c.index(acquire.resource, plan.resources.size(), "acquire", i, "resource");
    c.index(acquire.group, plan.groups.size(), "acquire", i, "group");
    if (acquire.image_barrier != kNone)
      c.range(acquire.image_barrier, acquire.image_barriers, plan.image_barriers.size(), "acquire", i, "image barriers");
    c.index(acquire.queue, plan.queues.size(), "acquire", i, "queue");
    if (acquire.first_clock != kNone)
      c.range(acquire.first_clock, static_cast<uint32_t>(2 * plan.queues.size()), plan.alias_clocks.size(), "acquire", i, "clocks");
  }
  for (size_t i = 0; i < plan.releases.size(); ++i) {
    c.index(plan.releases[i].resource, plan.resources.size(), "release", i, "resource");
    c.index(plan.releases[i].queue, plan.queues.size(), "release", i, "queue");
  }
}

void check_attachment(const Plan& plan, Index i, Checker& c) {
  if (!c.ok()) return;
  const Attachment& attachment = plan.attachments[i];
  if (attachment.ref.resource != kNone) c.ref(attachment.ref, ResourceKind::image, "attachment", i, "image");
  if (attachment.resolve.resource != kNone) c.ref(attachment.resolve, ResourceKind::image, "attachment", i, "resolve");
  if (!c.ok() || attachment.ref.resource == kNone) return;
  const bool volume = plan.resources[attachment.ref.resource].dimension == Dimension::d3;
  c.that((attachment.slices != 0) == volume && attachment.slices <= 65536 && attachment.slice <= 65536, "attachment", i, "slices");
}

void check_renderings(const Plan& plan, Checker& c) {
  for (size_t i = 0; i < plan.renderings.size(); ++i) {
    const Rendering& rendering = plan.renderings[i];
    c.range(rendering.first_color, rendering.color_count, plan.attachments.size(), "rendering", i, "colours");
    c.that(rendering.color_count <= 8, "rendering", i, "more than 8 colours");
    for (const Index depth : {rendering.depth, rendering.stencil}) {
      c.optional(depth, plan.attachments.size(), "rendering", i, "depth or stencil");
      if (c.ok() && depth != kNone) c.that(plan.attachments[depth].ref.resource != kNone, "rendering", i, "depth or stencil without an image");
    }
    c.expr(rendering.width, "rendering", i, "width");
    c.expr(rendering.height, "rendering", i, "height");
    c.that(rendering.view_mask == 0 || std::bit_width(rendering.view_mask) <= rendering.layers, "rendering", i, "more views than layers");
    c.that(rendering.layers >= 1 && rendering.samples >= 1, "rendering", i, "layers or samples");
  }
  for (Index i = 0; i < plan.attachments.size(); ++i) check_attachment(plan, i, c);
}

void check_pipelines(const Plan& plan, Checker& c) {
  for (size_t i = 0; i < plan.pipeline_shaders.size(); ++i) c.index(plan.pipeline_shaders[i], plan.shaders.size(), "pipeline shader", i, "shader");
  for (size_t i = 0; i < plan.shaders.size(); ++i) c.that(!plan.shaders[i].words.empty(), "shader", i, "no code");
  for (size_t i = 0; i < plan.pipelines.size(); ++i) {
    const Pipeline& pipeline = plan.pipelines[i];
    c.index(pipeline.pass, plan.passes.size(), "pipeline", i, "pass");
    c.that(pipeline.shader_count >= 1, "pipeline", i, "no shader");
    c.range(pipeline.first_shader, pipeline.shader_count, plan.pipeline_shaders.size(), "pipeline", i, "shaders");
    c.range(pipeline.first_blend, pipeline.blend_count, plan.blends.size(), "pipeline", i, "blends");
    c.range(pipeline.raster.first_sample_location, pipeline.raster.sample_location_count, plan.sample_locations.size(), "pipeline", i,
            "sample locations");
    c.range(pipeline.first_vertex_binding, pipeline.vertex_binding_count, plan.vertex_bindings.size(), "pipeline", i, "vertex bindings");
    c.range(pipeline.first_vertex_attribute, pipeline.vertex_attribute_count, plan.vertex_attributes.size(), "pipeline", i, "vertex attributes");
  }
}

bool is_image_type(DescriptorType type) {
  return type == DescriptorType::combined_image_sampler || type == DescriptorType::sampled_image || type == DescriptorType::storage_image ||
         type == DescriptorType::input_attachment;
}

void check_binding(const Plan& plan, size_t i, Checker& c) {
  const Binding& binding = plan.bindings[i];
  c.optional(binding.sampler, plan.samplers.size(), "binding", i, "sampler");
  c.bytes(binding.bytes, "binding", i);
  if (is_image_type(binding.type)) return c.ref(binding.ref, ResourceKind::image, "binding", i, "image");
  const bool block = binding.type == DescriptorType::uniform_buffer_dynamic;
  if (binding.type == DescriptorType::sampler || block) c.that(binding.ref.resource == kNone, "binding", i, "a resource that it does not show");
  if (binding.type == DescriptorType::sampler) return c.that(binding.sampler != kNone, "binding", i, "no sampler");
  if (block) return c.index(binding.params, plan.params.size(), "binding", i, "parameter block");
  c.that(binding.params == kNone, "binding", i, "a parameter block that is not dynamic");
  const bool texels = binding.type == DescriptorType::uniform_texel_buffer || binding.type == DescriptorType::storage_texel_buffer;
  c.that(texels || binding.type == DescriptorType::uniform_buffer || binding.type == DescriptorType::storage_buffer, "binding", i, "type");
  if (texels) c.that(binding.view_format != Format::undefined, "binding", i, "no format of its texels");
  c.ref(binding.ref, ResourceKind::buffer, "binding", i, "buffer");
  if (c.ok() && texels) c.that(plan.resources[binding.ref.resource].lifetime != Lifetime::imported, "binding", i, "texels of an imported buffer");
}

void check_transfer(const Plan& plan, size_t i, Checker& c) {
  const Transfer& t = plan.transfers[i];
  c.bytes(t.src_bytes, "transfer", i);
  c.bytes(t.dst_bytes, "transfer", i);
  const bool from_image = t.kind == TransferKind::copy_image || t.kind == TransferKind::blit || t.kind == TransferKind::resolve ||
                          t.kind == TransferKind::copy_image_to_buffer;
  const bool from_buffer = t.kind == TransferKind::copy_buffer || t.kind == TransferKind::copy_buffer_to_image;
  if (from_image) c.ref(t.src, ResourceKind::image, "transfer", i, "source");
  if (from_buffer) c.ref(t.src, ResourceKind::buffer, "transfer", i, "source");
  if (t.kind == TransferKind::update) c.that(t.update_slot < 4096, "transfer", i, "update slot");
  c.that(t.kind <= TransferKind::resolve, "transfer", i, "kind");
  const bool to_buffer = t.kind == TransferKind::copy_buffer || t.kind == TransferKind::copy_image_to_buffer || t.kind == TransferKind::fill;
  if (t.kind == TransferKind::update) return c.any_ref(t.dst, "transfer", i);
  c.ref(t.dst, to_buffer ? ResourceKind::buffer : ResourceKind::image, "transfer", i, "target");
}

bool indirect_work(WorkKind kind) {
  return kind == WorkKind::draw_indirect || kind == WorkKind::draw_indexed_indirect || kind == WorkKind::draw_indirect_count ||
         kind == WorkKind::draw_indexed_indirect_count || kind == WorkKind::dispatch_indirect;
}

void check_draw_buffers(const Plan& plan, const Work& work, size_t i, Checker& c) {
  for (const Index expr : {work.first, work.vertex_offset, work.indices_offset}) c.expr(expr, "pass", i, "draw");
  c.range(work.first_vertex_buffer, work.vertex_buffer_count, plan.vertex_buffers.size(), "pass", i, "vertex buffers");
  if (work.indices.resource != kNone) c.ref(work.indices, ResourceKind::buffer, "pass", i, "indices");
  c.that(work.index_bytes == 2 || work.index_bytes == 4, "pass", i, "bytes of an index");
  c.that(work.kind != WorkKind::draw_indexed || work.indices.resource != kNone, "pass", i, "an indexed draw without indices");
}

void check_work(const Plan& plan, const Pass& pass, size_t i, Checker& c) {
  const Work& work = pass.work;
  c.that(work.kind <= WorkKind::draw_indexed, "pass", i, "work");
  for (const Index expr : {work.x, work.y, work.z, work.arguments_offset}) c.expr(expr, "pass", i, "work size");
  if (indirect_work(work.kind)) c.ref(work.arguments, ResourceKind::buffer, "pass", i, "indirect arguments");
  if (work.kind == WorkKind::draw_indirect_count || work.kind == WorkKind::draw_indexed_indirect_count)
    c.ref(work.counts, ResourceKind::buffer, "pass", i, "draw count");
  c.range(work.first_transfer, work.transfer_count, plan.transfers.size(), "pass", i, "transfers");
  if (work.kind == WorkKind::host) c.that(pass.host_slot < 65536, "pass", i, "host slot");
  c.that(work.max_draws <= 1u << 22, "pass", i, "most draws");
  c.that(pass.kind <= PassKind::host, "pass", i, "kind");
  check_draw_buffers(plan, work, i, c);
  const bool direct = work.kind == WorkKind::draw || work.kind == WorkKind::draw_indexed;
  const bool draws = indirect_work(work.kind) ? work.kind != WorkKind::dispatch_indirect : direct;
  const bool dispatches = work.kind == WorkKind::dispatch || work.kind == WorkKind::dispatch_indirect;
  c.that(!draws || pass.kind == PassKind::raster, "pass", i, "draws outside a raster pass");
  c.that(!dispatches || pass.kind == PassKind::compute, "pass", i, "a dispatch outside a compute pass");
  c.that(work.kind != WorkKind::transfers || pass.kind == PassKind::transfer, "pass", i, "transfers outside a transfer pass");
}

uint32_t dynamic_bindings(const Plan& plan, const Pass& pass) {
  uint32_t count = 0;
  for (const Binding& binding : plan.bindings.subspan(pass.first_binding, pass.binding_count))
    count += binding.type == DescriptorType::uniform_buffer_dynamic ? 1 : 0;
  return count;
}

// Of the values of the features of a pass; 0 without features. Saturates well above what a table holds.
uint64_t combinations(const Plan& plan, const Pass& pass) {
  uint64_t product = pass.feature_count == 0 ? 0 : 1;
  for (const Index feature : plan.pass_features.subspan(pass.first_feature, pass.feature_count))
    product = std::min<uint64_t>(product * plan.features[feature].values, uint64_t{1} << 32);
  return product;
}

// Tables exist once for every combination of copies that a group or a pass can see: histories of many different lengths would multiply.
constexpr uint64_t kLongestPeriod = 4096;

class Period {
 public:
  explicit Period(const Plan& plan) : plan_(plan) {}
  void add(Ref ref) {
    if (ref.resource == kNone || plan_.resources[ref.resource].lifetime != Lifetime::history) return;
    frames_ = std::min(std::lcm(frames_, uint64_t{plan_.resources[ref.resource].copies}), kLongestPeriod + 1);
  }
  bool bearable() const { return frames_ <= kLongestPeriod; }

 private:
  const Plan& plan_;
  uint64_t frames_ = 1;
};

void check_periods(const Plan& plan, Checker& c) {
  if (!c.ok()) return;
  for (size_t i = 0; i < plan.groups.size(); ++i) {
    Period period(plan);
    for (const ImageBarrier& barrier : plan.image_barriers.subspan(plan.groups[i].first_image, plan.groups[i].image_count)) period.add(barrier.image);
    for (const BufferBarrier& barrier : plan.buffer_barriers.subspan(plan.groups[i].first_buffer, plan.groups[i].buffer_count))
      period.add(barrier.buffer);
    c.that(period.bearable(), "group", i, "histories of too many different lengths");
  }
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    Period period(plan);
    for (const Binding& binding : plan.bindings.subspan(plan.passes[i].first_binding, plan.passes[i].binding_count)) period.add(binding.ref);
    c.that(period.bearable(), "pass", i, "histories of too many different lengths");
  }
}

void check_features(const Plan& plan, Checker& c) {
  for (size_t i = 0; i < plan.features.size(); ++i)
    c.that(plan.features[i].values >= 1 && plan.features[i].initial < plan.features[i].values, "feature", i, "initial value");
  for (size_t i = 0; i < plan.features.size(); ++i)
    c.that(plan.features[i].capability == Capability::none || plan.features[i].values == 2, "feature", i, "the device says yes or no");
  for (size_t i = 0; i < plan.pass_features.size(); ++i) c.index(plan.pass_features[i], plan.features.size(), "pass feature", i, "feature");
  for (size_t i = 0; i < plan.pipeline_choices.size(); ++i) c.optional(plan.pipeline_choices[i], plan.pipelines.size(), "choice", i, "pipeline");
}

void check_pass(const Plan& plan, size_t i, Checker& c) {
  const Pass& pass = plan.passes[i];
  c.range(pass.first_access, pass.access_count, plan.accesses.size(), "pass", i, "accesses");
  c.optional(pass.rendering, plan.renderings.size(), "pass", i, "rendering");
  c.optional(pass.pipeline, plan.pipelines.size(), "pass", i, "pipeline");
  c.range(pass.first_choice, pass.choice_count, plan.pipeline_choices.size(), "pass", i, "pipeline choices");
  c.range(pass.first_feature, pass.feature_count, plan.pass_features.size(), "pass", i, "features");
  if (c.ok()) c.that(pass.choice_count == combinations(plan, pass), "pass", i, "pipeline choices are not the combinations of its features");
  c.range(pass.first_binding, pass.binding_count, plan.bindings.size(), "pass", i, "bindings");
  c.range(pass.first_params, pass.params_count, plan.pass_params.size(), "pass", i, "parameter blocks");
  c.optional(pass.engine_set, plan.engine_sets.size(), "pass", i, "engine set");
  c.range(pass.first_mip_limit, pass.mip_limit_count, plan.mip_limits.size(), "pass", i, "mip limits");
  c.that(pass.rendering == kNone || pass.kind == PassKind::raster, "pass", i, "attachments outside a raster pass");
  if (c.ok()) c.that(dynamic_bindings(plan, pass) == pass.params_count, "pass", i, "parameter blocks and bindings differ in number");
  check_work(plan, pass, i, c);
}

void check_small_tables(const Plan& plan, Checker& c) {
  for (size_t i = 0; i < plan.accesses.size(); ++i) c.any_ref(plan.accesses[i].ref, "access", i);
  for (size_t i = 0; i < plan.vertex_buffers.size(); ++i) {
    c.ref(plan.vertex_buffers[i].ref, ResourceKind::buffer, "vertex buffer", i, "buffer");
    c.expr(plan.vertex_buffers[i].offset, "vertex buffer", i, "offset");
  }
  for (size_t i = 0; i < plan.bindings.size(); ++i) check_binding(plan, i, c);
  for (size_t i = 0; i < plan.transfers.size(); ++i) check_transfer(plan, i, c);
  for (size_t i = 0; i < plan.pass_params.size(); ++i) c.index(plan.pass_params[i], plan.params.size(), "pass parameter", i, "block");
  for (size_t i = 0; i < plan.mip_limits.size(); ++i) {
    c.ref({plan.mip_limits[i].image, 0}, ResourceKind::image, "mip limit", i, "image");
  }
  for (size_t i = 0; i < plan.engine_sets.size(); ++i)
    c.that(plan.engine_sets[i].role <= SetRole::draw && plan.engine_sets[i].role != SetRole::pass, "engine set", i, "role");
  c.that(plan.conditions.size() <= 64, "plan", 0, "more than 64 conditions");
  for (size_t i = 0; i < plan.params.size(); ++i) {
    c.that(plan.params[i].bytes <= 1u << 20, "parameter block", i, "more than 1 MiB");
    c.optional(plan.params[i].pass, plan.passes.size(), "parameter block", i, "pass");
  }
  for (size_t i = 0; i < plan.feature_conditions.size(); ++i) {
    const FeatureCondition& row = plan.feature_conditions[i];
    c.index(row.condition, plan.conditions.size(), "feature condition", i, "condition");
    c.index(row.feature, plan.features.size(), "feature condition", i, "feature");
    if (c.ok()) c.that(plan.features[row.feature].values <= 64, "feature condition", i, "more than 64 values");
  }
}

}  // namespace

Status check_plan(const Plan& plan) {
  if (plan.version != kPlanVersion)
    return Error{ErrorCode::invalid_plan, "plan `" + std::string(plan.name) + "` has version " + std::to_string(plan.version) +
                                              "; this runtime runs version " + std::to_string(kPlanVersion)};
  Checker checker(plan);
  check_exprs(plan, checker);
  check_extents(plan, checker);
  for (size_t i = 0; i < plan.resources.size(); ++i) check_resource(plan.resources[i], i, checker);
  check_barriers(plan, checker);
  check_aliases(plan, checker);
  check_renderings(plan, checker);
  check_pipelines(plan, checker);
  check_features(plan, checker);
  check_small_tables(plan, checker);
  for (size_t i = 0; i < plan.passes.size(); ++i) check_pass(plan, i, checker);
  ReferenceCheck(plan, checker).check(plan);
  check_periods(plan, checker);
  plan_check::check_schedule(plan, checker);
  return checker.status();
}

}  // namespace rg
