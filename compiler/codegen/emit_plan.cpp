#include "compiler/codegen/emit_plan.h"

#include <algorithm>
#include <cstring>

namespace rg::compiler {
namespace {

std::string index_text(Index index) { return index == kNone ? "kNone" : std::to_string(index); }

// Adds an index unless it is kNone.
Row& index(Row& row, std::string_view name, Index value) { return value == kNone ? row : row.number(name, value, kNone); }
// Adds a slice of another table unless it is empty.
Row& slice(Row& row, const std::string& first, Index at, const std::string& count, uint32_t size) {
  return size == 0 ? row : row.number(first, at).number(count, size);
}

std::string enum_text(const char* type, size_t value, std::initializer_list<const char*> names) {
  return std::string(type) + "::" + *(names.begin() + value);
}
#define RG_ENUM(row, member, type, ...) \
  if (member != decltype(member){}) row.field(#member, enum_text(type, static_cast<size_t>(member), {__VA_ARGS__}))

// Index and string tables are no rows of fields; sixteen numbers a line.
void list(CppWriter& out, const std::string& type, const std::string& name, const std::vector<std::string>& items) {
  if (items.empty()) return;
  out.line("constexpr " + type + " " + name + "[] = {");
  for (size_t i = 0; i < items.size(); i += 16) {
    std::string text = "   ";
    for (size_t j = i; j < std::min(i + 16, items.size()); ++j) text += " " + items[j] + ",";
    out.line(text);
  }
  out.line("};").line();
}

std::vector<std::string> numbers(std::span<const Index> indices) {
  std::vector<std::string> texts;
  for (const Index i : indices) texts.push_back(std::to_string(i));
  return texts;
}

class Emitter {
 public:
  Emitter(const Plan& plan, const PlanText& text) : plan_(plan), text_(text) {}
  std::string run();

 private:
  std::string resource(Index i) const { return i == kNone ? "kNone" : "resource::" + text_.names.resources[i]; }
  std::string pass(Index i) const { return i == kNone ? "kNone" : "pass::" + text_.names.passes[i]; }
  Row& declared(Row& row, dsl::Span span) const;

  Row ref(const Ref& ref) const;
  Row range(const Range& range) const;
  Row bytes(const Bytes& bytes) const;
  Row scopes(Row row, Stages src_stages, Accesses src_accesses, Stages dst_stages, Accesses dst_accesses, BarrierTag tag) const;
  std::string flow(const Ref& ref, size_t step) const;

  void values();
  void resources();
  void barriers();
  void boundaries();
  void frame();
  void passes();
  void rendering();
  void pipelines();
  void bindings();
  void transfers();
  void plan();

  template <class T, class F>
  void table(const char* type, const char* name, std::span<const T> rows, F row) {
    std::vector<Row> texts;
    for (size_t i = 0; i < rows.size(); ++i) texts.push_back(row(rows[i], i));
    out_.table(type, name, texts);
  }
  size_t step_of_group(Index group) const;
  std::string group_comment(Index group) const;

  const Plan& plan_;
  const PlanText& text_;
  CppWriter out_;
};

// ---- small pieces

Row Emitter::ref(const Ref& ref) const {
  Row row;
  if (ref.resource != kNone) row.field("resource", resource(ref.resource));
  return row.number("age", ref.age);
}

Row Emitter::range(const Range& range) const {
  Row row;
  if (range.aspects != 0) row.field("aspects", aspects_text(range.aspects));
  row.number("mip", range.mip);
  if (range.mips != kRemaining) row.number("mips", range.mips, kRemaining);
  row.number("layer", range.layer);
  if (range.layers != kRemaining) row.number("layers", range.layers, kRemaining);
  return row;
}

Row Emitter::bytes(const Bytes& bytes) const {
  Row row;
  index(row, "offset", bytes.offset);
  return index(row, "size", bytes.size);
}

Row Emitter::scopes(Row row, Stages src_stages, Accesses src_accesses, Stages dst_stages, Accesses dst_accesses, BarrierTag tag) const {
  if (src_stages != 0) row.field("src_stages", stages_text(src_stages));
  if (src_accesses != 0) row.field("src_accesses", accesses_text(src_accesses));
  if (dst_stages != 0) row.field("dst_stages", stages_text(dst_stages));
  if (dst_accesses != 0) row.field("dst_accesses", accesses_text(dst_accesses));
  RG_ENUM(row, tag, "BarrierTag", "hazard", "valid_usage", "workaround", "merged_batch", "boundary_join", "alias_pair");
  return row;
}

Row clear_value(const ClearValue& value) {
  Row row;
  if (std::all_of(value.word, value.word + 4, [](uint32_t word) { return word == 0; })) return row;
  std::string words = "{";
  for (int i = 0; i < 4; ++i) words += (i > 0 ? ", " : "") + std::to_string(value.word[i]) + (value.word[i] > INT32_MAX ? "u" : "");
  return row.field("word", words + "}");
}

Row& Emitter::declared(Row& row, dsl::Span span) const {
  const std::string place = origin(text_.files, span);
  const size_t colon = place.rfind(':');
  return place.empty() ? row : row.field("line", place.substr(colon + 1)).string("file", place.substr(0, colon));
}

// The pass that owns row `at` of a table that passes slice.
std::string owner(const Plan& plan, size_t at, Index Pass::*first, uint32_t Pass::*count) {
  for (const Pass& pass : plan.passes)
    if (at >= pass.*first && at < pass.*first + pass.*count) return std::string(pass.name);
  return "";
}

// ---- who a barrier is between

size_t Emitter::step_of_group(Index group) const {
  for (size_t i = 0; i < plan_.steps.size(); ++i)
    if (plan_.steps[i].kind == StepKind::barriers && plan_.steps[i].index == group) return i;
  return plan_.steps.size();
}

bool touches(const Plan& plan, Index pass, const Ref& ref) {
  const Pass& row = plan.passes[pass];
  const auto accesses = plan.accesses.subspan(row.first_access, row.access_count);
  return std::any_of(accesses.begin(), accesses.end(), [&](const Access& access) { return access.ref == ref; });
}

// "gbuffer -> deferred_light": the last pass before the barrier and the first one after it that touch the resource.
std::string Emitter::flow(const Ref& ref, size_t step) const {
  std::string from = "frame start", to = "frame end";
  for (size_t i = step; i-- > 0;) {
    if (plan_.steps[i].kind != StepKind::pass || !touches(plan_, plan_.steps[i].index, ref)) continue;
    from = plan_.passes[plan_.steps[i].index].name;
    break;
  }
  for (size_t i = step; i < plan_.steps.size(); ++i) {
    if (plan_.steps[i].kind != StepKind::pass || !touches(plan_, plan_.steps[i].index, ref)) continue;
    to = plan_.passes[plan_.steps[i].index].name;
    break;
  }
  return from + " -> " + to;
}

std::string Emitter::group_comment(Index group) const {
  for (size_t i = step_of_group(group); i < plan_.steps.size(); ++i)
    if (plan_.steps[i].kind == StepKind::pass) {
      const std::string place = origin(text_.files, text_.passes[plan_.steps[i].index]);
      return "before " + std::string(plan_.passes[plan_.steps[i].index].name) + (place.empty() ? "" : "  " + place);
    }
  return "at the end of the frame";
}

// ---- tables

void Emitter::values() {
  table("Expr", "kExprs", plan_.exprs, [](const Expr& e, size_t i) {
    Row row;
    static constexpr const char* kOps[] = {"constant", "extent", "add", "sub", "mul", "floor_div", "ceil_div", "min", "max", "mip"};
    row.field("op", std::string("ExprOp::") + kOps[static_cast<size_t>(e.op)]);
    index(row, "a", e.a);
    index(row, "b", e.b);
    if (e.value != 0) row.field("value", std::to_string(e.value));
    return row.comment(std::to_string(i));
  });
  table("Extent", "kExtents", plan_.extents, [](const Extent& e, size_t) {
    const auto triple = [](const int64_t (&v)[3]) { return "{" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + "}"; };
    return Row().string("name", e.name).number("axes", e.axes, 2).field("initial", triple(e.initial)).field("maximum", triple(e.maximum));
  });
}

void Emitter::resources() {
  table("Resource", "kResources", plan_.resources, [&](const Resource& r, size_t i) {
    Row row;
    row.string("name", r.name);
    const auto &kind = r.kind; const auto &lifetime = r.lifetime; const auto &dimension = r.dimension; const auto &init = r.init;
    RG_ENUM(row, kind, "ResourceKind", "image", "buffer");
    RG_ENUM(row, lifetime, "Lifetime", "transient", "history", "persistent", "imported", "readback");
    if (r.kind == ResourceKind::image && r.dimension != Dimension::d2) row.field("dimension", enum_text("Dimension", static_cast<size_t>(dimension), {"d1", "d2", "d3", "cube"}));
    if (r.format != Format::undefined) row.field("format", "Format{" + std::to_string(static_cast<uint32_t>(r.format)) + "}");
    index(row, "width", r.width);
    index(row, "height", r.height);
    index(row, "depth", r.depth);
    row.number("mips", r.mips, 1).number("layers", r.layers, 1).number("samples", r.samples, 1);
    if (r.aspects != 0) row.field("aspects", aspects_text(r.aspects));
    row.number("usage", r.usage).flag("mutable_format", r.mutable_format);
    index(row, "bytes", r.bytes);
    row.number("stride", r.stride).number("copies", r.copies, 1);
    RG_ENUM(row, init, "InitKind", "none", "clear");
    row.nested("init_value", clear_value(r.init_value)).flag("is_surface", r.is_surface).flag("no_alias", r.no_alias);
    index(row, "import_slot", r.import_slot);
    row.number("estimated_bytes", r.estimated_bytes).number("estimated_alignment", r.estimated_alignment, 1).number("estimated_offset", r.estimated_offset);
    return declared(row, text_.resources[i]);
  });
}

void Emitter::barriers() {
  std::vector<std::string> image_flow(plan_.image_barriers.size()), buffer_flow(plan_.buffer_barriers.size());
  for (Index g = 0; g < plan_.groups.size(); ++g) {
    const BarrierGroup& group = plan_.groups[g];
    const size_t step = step_of_group(g);
    for (Index i = group.first_image; i < group.first_image + group.image_count; ++i) image_flow[i] = flow(plan_.image_barriers[i].image, step);
    for (Index i = group.first_buffer; i < group.first_buffer + group.buffer_count; ++i) buffer_flow[i] = flow(plan_.buffer_barriers[i].buffer, step);
  }
  table("MemoryBarrier", "kMemoryBarriers", plan_.memory_barriers,
        [&](const MemoryBarrier& b, size_t) { return scopes({}, b.src_stages, b.src_accesses, b.dst_stages, b.dst_accesses, b.tag); });
  table("ImageBarrier", "kImageBarriers", plan_.image_barriers, [&](const ImageBarrier& b, size_t i) {
    Row row;
    row.nested("image", ref(b.image)).nested("range", range(b.range)).field("src_stages", stages_text(b.src_stages));
    if (b.src_accesses != 0) row.field("src_accesses", accesses_text(b.src_accesses));
    row.field("dst_stages", stages_text(b.dst_stages));
    if (b.dst_accesses != 0) row.field("dst_accesses", accesses_text(b.dst_accesses));
    row.field("old_layout", layout_text(b.old_layout)).field("new_layout", layout_text(b.new_layout));
    index(row, "src_queue", b.src_queue);
    index(row, "dst_queue", b.dst_queue);
    const BarrierTag& tag = b.tag;
    return scopes(std::move(row), 0, 0, 0, 0, tag).comment(image_flow[i]);
  });
  table("BufferBarrier", "kBufferBarriers", plan_.buffer_barriers, [&](const BufferBarrier& b, size_t i) {
    Row row;
    row.nested("buffer", ref(b.buffer)).nested("bytes", bytes(b.bytes));
    row = scopes(std::move(row), b.src_stages, b.src_accesses, b.dst_stages, b.dst_accesses, BarrierTag::hazard);
    index(row, "src_queue", b.src_queue);
    index(row, "dst_queue", b.dst_queue);
    return scopes(std::move(row), 0, 0, 0, 0, b.tag).comment(buffer_flow[i]);
  });
  table("BarrierGroup", "kGroups", plan_.groups, [&](const BarrierGroup& g, size_t i) {
    Row row;
    slice(row, "first_memory", g.first_memory, "memory_count", g.memory_count);
    slice(row, "first_image", g.first_image, "image_count", g.image_count);
    slice(row, "first_buffer", g.first_buffer, "buffer_count", g.buffer_count);
    return row.comment(group_comment(static_cast<Index>(i)));
  });
}

void Emitter::boundaries() {
  const auto boundary = [&](const Boundary& b, size_t) {
    Row row;
    row.nested("ref", ref(b.ref)).nested("range", range(b.range)).nested("bytes", bytes(b.bytes));
    if (b.stages != 0) row.field("stages", stages_text(b.stages));
    if (b.accesses != 0) row.field("accesses", accesses_text(b.accesses));
    if (b.layout != Layout::undefined) row.field("layout", layout_text(b.layout));
    index(row, "queue", b.queue);
    return row.flag("discard", b.discard);
  };
  table("Boundary", "kEntry", plan_.entry, boundary);
  table("Boundary", "kExit", plan_.exit, boundary);
  table("Acquire", "kAcquires", plan_.acquires, [&](const Acquire& a, size_t) {
    Row row;
    row.field("resource", resource(a.resource));
    index(row, "group", a.group);
    index(row, "image_barrier", a.image_barrier);
    row.number("image_barriers", a.image_barriers);
    if (a.stages != 0) row.field("stages", stages_text(a.stages));
    return a.accesses != 0 ? row.field("accesses", accesses_text(a.accesses)) : row;
  });
  table("Release", "kReleases", plan_.releases, [&](const Release& r, size_t) {
    Row row;
    row.field("resource", resource(r.resource));
    if (r.stages != 0) row.field("stages", stages_text(r.stages));
    return r.accesses != 0 ? row.field("accesses", accesses_text(r.accesses)) : row;
  });
  table("AliasPair", "kAliasPairs", plan_.alias_pairs, [&](const AliasPair& p, size_t) {
    return Row().field("before", resource(p.before)).field("after", resource(p.after)).flag("wraps", p.wraps);
  });
}

void Emitter::frame() {
  table("Queue", "kQueues", plan_.queues, [](const Queue& q, size_t) {
    return Row().field("kind", enum_text("QueueKind", static_cast<size_t>(q.kind), {"graphics", "compute", "transfer"}));
  });
  table("Step", "kSteps", plan_.steps, [&](const Step& s, size_t) {
    const bool is_pass = s.kind == StepKind::pass;
    return Row().field("kind", is_pass ? "StepKind::pass" : "StepKind::barriers").field("index", is_pass ? pass(s.index) : index_text(s.index));
  });
  table("Wait", "kWaits", plan_.waits, [](const Wait& w, size_t) {
    return Row().number("queue", w.queue, kNone).number("value", w.value).field("stages", stages_text(w.stages));
  });
  table("Signal", "kSignals", plan_.signals, [](const Signal& s, size_t) { return Row().number("value", s.value).field("stages", stages_text(s.stages)); });
  table("Batch", "kBatches", plan_.batches, [](const Batch& b, size_t) {
    Row row;
    row.number("queue", b.queue);
    slice(row, "first_step", b.first_step, "step_count", b.step_count);
    slice(row, "first_wait", b.first_wait, "wait_count", b.wait_count);
    return slice(row, "first_signal", b.first_signal, "signal_count", b.signal_count);
  });
}

Row work_row(const Work& work, const Row& arguments, const Row& counts) {
  Row row;
  const auto& kind = work.kind;
  RG_ENUM(row, kind, "WorkKind", "none", "host", "draw", "draw_indirect", "draw_indexed_indirect", "draw_indirect_count", "draw_indexed_indirect_count",
          "dispatch", "dispatch_indirect", "transfers");
  index(row, "x", work.x);
  index(row, "y", work.y);
  index(row, "z", work.z);
  row.nested("arguments", arguments);
  index(row, "arguments_offset", work.arguments_offset);
  row.nested("counts", counts).number("max_draws", work.max_draws, 1).number("stride", work.stride, 16);
  return slice(row, "first_transfer", work.first_transfer, "transfer_count", work.transfer_count);
}

void Emitter::passes() {
  table("Access", "kAccesses", plan_.accesses, [&](const Access& a, size_t i) {
    Row row;
    row.nested("ref", ref(a.ref)).nested("range", range(a.range)).nested("bytes", bytes(a.bytes));
    if (a.stages != 0) row.field("stages", stages_text(a.stages));
    if (a.accesses != 0) row.field("accesses", accesses_text(a.accesses));
    if (a.layout != Layout::undefined) row.field("layout", layout_text(a.layout));
    return row.flag("writes", a.writes).comment(owner(plan_, i, &Pass::first_access, &Pass::access_count));
  });
  table("Pass", "kPasses", plan_.passes, [&](const Pass& p, size_t i) {
    Row row;
    row.string("name", p.name).string("module", p.module);
    row.field("kind", enum_text("PassKind", static_cast<size_t>(p.kind), {"raster", "compute", "transfer", "host"}));
    row.number("queue", p.queue).number("guard", p.guard);
    slice(row, "first_access", p.first_access, "access_count", p.access_count);
    index(row, "rendering", p.rendering);
    index(row, "pipeline", p.pipeline);
    slice(row, "first_binding", p.first_binding, "binding_count", p.binding_count);
    slice(row, "first_params", p.first_params, "params_count", p.params_count);
    row.number("push_bytes", p.push_bytes).number("push_stages", p.push_stages);
    index(row, "engine_set", p.engine_set);
    row.nested("work", work_row(p.work, ref(p.work.arguments), ref(p.work.counts)));
    index(row, "host_slot", p.host_slot);
    slice(row, "first_mip_limit", p.first_mip_limit, "mip_limit_count", p.mip_limit_count);
    return declared(row, text_.passes[i]);
  });
  table("MipLimit", "kMipLimits", plan_.mip_limits,
        [&](const MipLimit& m, size_t) { return Row().field("image", resource(m.image)).number("mip", m.mip); });
}

void Emitter::rendering() {
  table("Attachment", "kAttachments", plan_.attachments, [&](const Attachment& a, size_t) {
    Row row;
    row.nested("ref", ref(a.ref)).nested("range", range(a.range)).field("layout", layout_text(a.layout));
    row.field("load", enum_text("LoadOp", static_cast<size_t>(a.load), {"load", "clear", "dont_care", "none"}));
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

std::string compare_text(Compare compare) {
  return enum_text("Compare", static_cast<size_t>(compare), {"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"});
}

Row raster_row(const RasterState& state) {
  Row row;
  row.number("cull", state.cull).flag("front_clockwise", state.front_clockwise).flag("depth_test", state.depth_test).flag("depth_write", state.depth_write);
  if (state.depth_compare != Compare::greater_equal) row.field("depth_compare", compare_text(state.depth_compare));
  if (state.depth_bias_constant != 0) row.field("depth_bias_constant", cpp_float(state.depth_bias_constant));
  if (state.depth_bias_slope != 0) row.field("depth_bias_slope", cpp_float(state.depth_bias_slope));
  return row.number("topology", state.topology, 3).flag("alpha_to_coverage", state.alpha_to_coverage);
}

Row blend_row(const ColorBlend& blend) {
  if (!blend.enabled) return {};
  const auto factor = [](BlendFactor f) {
    return enum_text("BlendFactor", static_cast<size_t>(f), {"zero", "one", "src_color", "one_minus_src_color", "dst_color", "one_minus_dst_color",
                                                              "src_alpha", "one_minus_src_alpha", "dst_alpha", "one_minus_dst_alpha"});
  };
  const auto op = [](BlendOp o) { return enum_text("BlendOp", static_cast<size_t>(o), {"add", "subtract", "reverse_subtract", "min", "max"}); };
  return Row().flag("enabled", true).field("src", factor(blend.src)).field("dst", factor(blend.dst)).field("op", op(blend.op))
      .field("src_alpha", factor(blend.src_alpha)).field("dst_alpha", factor(blend.dst_alpha)).field("op_alpha", op(blend.op_alpha));
}

void Emitter::pipelines() {
  table("ShaderModule", "kShaders", plan_.shaders, [&](const ShaderModule& m, size_t i) {
    static constexpr std::pair<ShaderStage, const char*> kStages[] = {{ShaderStage::vertex, "vertex"}, {ShaderStage::tess_control, "tess_control"},
        {ShaderStage::tess_eval, "tess_eval"}, {ShaderStage::geometry, "geometry"}, {ShaderStage::fragment, "fragment"}, {ShaderStage::compute, "compute"}};
    Row row;
    row.string("name", m.name);
    for (const auto& [stage, name] : kStages)
      if (stage == m.stage) row.field("stage", std::string("ShaderStage::") + name);
    return row.field("words", text_.shader_symbols[i]);
  });
  list(out_, "Index", "kPipelineShaders", numbers(plan_.pipeline_shaders));
  table("ColorBlend", "kBlends", plan_.blends, [](const ColorBlend& b, size_t) { return blend_row(b); });
  table("VertexBinding", "kVertexBindings", plan_.vertex_bindings,
        [](const VertexBinding& b, size_t) { return Row().number("stride", b.stride).flag("per_instance", b.per_instance); });
  table("VertexAttribute", "kVertexAttributes", plan_.vertex_attributes, [](const VertexAttribute& a, size_t) {
    return Row().number("location", a.location).number("binding", a.binding).number("offset", a.offset)
        .field("format", "Format{" + std::to_string(static_cast<uint32_t>(a.format)) + "}");
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

std::string descriptor_text(DescriptorType type) {
  switch (type) {
    case DescriptorType::sampler: return "DescriptorType::sampler";
    case DescriptorType::combined_image_sampler: return "DescriptorType::combined_image_sampler";
    case DescriptorType::sampled_image: return "DescriptorType::sampled_image";
    case DescriptorType::storage_image: return "DescriptorType::storage_image";
    case DescriptorType::uniform_buffer: return "DescriptorType::uniform_buffer";
    case DescriptorType::storage_buffer: return "DescriptorType::storage_buffer";
    case DescriptorType::uniform_buffer_dynamic: return "DescriptorType::uniform_buffer_dynamic";
    case DescriptorType::input_attachment: return "DescriptorType::input_attachment";
  }
  return "";
}

void Emitter::bindings() {
  table("Binding", "kBindings", plan_.bindings, [&](const Binding& b, size_t i) {
    Row row;
    row.number("binding", b.binding).field("type", descriptor_text(b.type)).number("stages", b.stages);
    row.nested("ref", ref(b.ref)).nested("range", range(b.range)).nested("bytes", bytes(b.bytes));
    if (b.view != Dimension::d2) row.field("view", enum_text("Dimension", static_cast<size_t>(b.view), {"d1", "d2", "d3", "cube"}));
    row.flag("arrayed", b.arrayed);
    if (b.view_format != Format::undefined) row.field("view_format", "Format{" + std::to_string(static_cast<uint32_t>(b.view_format)) + "}");
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
    return p.pass != kNone ? row.field("pass", pass(p.pass)) : row;
  });
  table("EngineSet", "kEngineSets", plan_.engine_sets, [](const EngineSet& s, size_t) {
    return Row().string("name", s.name).field("role", enum_text("SetRole", static_cast<size_t>(s.role), {"engine", "pass", "material", "draw"}));
  });
}

void Emitter::transfers() {
  table("Transfer", "kTransfers", plan_.transfers, [&](const Transfer& t, size_t) {
    Row row;
    row.field("kind", enum_text("TransferKind", static_cast<size_t>(t.kind), {"copy_image", "copy_buffer", "copy_buffer_to_image", "copy_image_to_buffer",
                                                                               "blit", "clear_color", "clear_depth_stencil", "fill", "update", "resolve"}));
    row.nested("src", ref(t.src)).nested("dst", ref(t.dst)).nested("src_range", range(t.src_range)).nested("dst_range", range(t.dst_range));
    row.nested("src_bytes", bytes(t.src_bytes)).nested("dst_bytes", bytes(t.dst_bytes)).flag("linear", t.linear).nested("value", clear_value(t.value));
    return index(row, "update_slot", t.update_slot);
  });
  table("Culled", "kCulled", plan_.culled, [](const Culled& c, size_t) { return Row().string("pass", c.pass).string("reason", c.reason); });
}

void Emitter::plan() {
  Row row;
  row.string("name", plan_.name).number("variant", plan_.variant).number("variant_count", plan_.variant_count, 1).string("variant_name", plan_.variant_name);
  const auto add = [&](const char* member, const char* table, size_t size) {
    if (size > 0) row.field(member, table);
  };
#define RG_TABLE(member, table) add(#member, #table, plan_.member.size())
  RG_TABLE(exprs, kExprs); RG_TABLE(extents, kExtents); RG_TABLE(resources, kResources); RG_TABLE(queues, kQueues); RG_TABLE(batches, kBatches);
  RG_TABLE(steps, kSteps); RG_TABLE(waits, kWaits); RG_TABLE(signals, kSignals); RG_TABLE(groups, kGroups);
  RG_TABLE(memory_barriers, kMemoryBarriers); RG_TABLE(image_barriers, kImageBarriers); RG_TABLE(buffer_barriers, kBufferBarriers);
  RG_TABLE(entry, kEntry); RG_TABLE(exit, kExit); RG_TABLE(acquires, kAcquires); RG_TABLE(releases, kReleases); RG_TABLE(alias_pairs, kAliasPairs);
  RG_TABLE(passes, kPasses); RG_TABLE(accesses, kAccesses); RG_TABLE(renderings, kRenderings); RG_TABLE(attachments, kAttachments);
  RG_TABLE(shaders, kShaders); RG_TABLE(pipelines, kPipelines); RG_TABLE(pipeline_shaders, kPipelineShaders); RG_TABLE(blends, kBlends);
  RG_TABLE(vertex_bindings, kVertexBindings); RG_TABLE(vertex_attributes, kVertexAttributes); RG_TABLE(bindings, kBindings);
  RG_TABLE(samplers, kSamplers); RG_TABLE(params, kParams); RG_TABLE(pass_params, kPassParams); RG_TABLE(transfers, kTransfers);
  RG_TABLE(mip_limits, kMipLimits); RG_TABLE(engine_sets, kEngineSets); RG_TABLE(conditions, kConditions); RG_TABLE(culled, kCulled);
#undef RG_TABLE
  row.number("estimated_heap_bytes", plan_.estimated_heap_bytes);
  std::string text = "constexpr Plan kPlan =\n" + row.lines(4);
  text.erase(text.rfind(','), 1);
  text.insert(text.rfind('\n'), ";");
  out_.line(text.substr(0, text.size() - 1));
}

std::string Emitter::run() {
  values();
  resources();
  passes();
  barriers();
  boundaries();
  frame();
  rendering();
  pipelines();
  std::vector<std::string> conditions;
  for (const std::string_view condition : plan_.conditions) conditions.push_back(cpp_string(condition));
  bindings();
  list(out_, "Index", "kPassParams", numbers(plan_.pass_params));
  list(out_, "std::string_view", "kConditions", conditions);
  transfers();
  plan();
  return out_.text();
}

}  // namespace

std::string emit_plan(const Plan& plan, const PlanText& text) { return Emitter(plan, text).run(); }

}  // namespace rg::compiler
