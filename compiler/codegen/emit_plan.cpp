#include "compiler/codegen/emit_plan.h"

#include <algorithm>

#include "compiler/codegen/plan_emitter.h"

namespace rg::compiler {

// ---- pieces of rows

Row& index(Row& row, std::string_view name, Index value) { return value == kNone ? row : row.number(name, value, kNone); }

Row& slice(Row& row, const std::string& first, Index at, const std::string& count, uint32_t size) {
  return size == 0 ? row : row.number(first, at).number(count, size);
}

std::string enum_text(const char* type, size_t value, std::initializer_list<const char*> names) {
  return std::string(type) + "::" + *(names.begin() + value);
}

Row& enumerator(Row& row, const char* field, const char* type, size_t value, std::initializer_list<const char*> names) {
  return value == 0 ? row : row.field(field, enum_text(type, value, names));
}

std::string capability_text(Capability capability) {
  switch (capability) {
#define RG_CAPABILITY(name, meaning) \
  case Capability::name:             \
    return "Capability::" #name;
#include "dsl/capability.def"
#undef RG_CAPABILITY
    case Capability::none:
      break;
  }
  return "Capability::none";
}

std::string dimension_text(Dimension dimension) { return enum_text("Dimension", static_cast<size_t>(dimension), {"d1", "d2", "d3", "cube"}); }
std::string format_text(Format format) { return "Format{" + std::to_string(static_cast<uint32_t>(format)) + "}"; }

Row clear_value(const ClearValue& value) {
  Row row;
  if (std::all_of(value.word, value.word + 4, [](uint32_t word) { return word == 0; })) return row;
  std::string words = "{";
  for (int i = 0; i < 4; ++i) words += (i > 0 ? ", " : "") + std::to_string(value.word[i]) + (value.word[i] > INT32_MAX ? "u" : "");
  return row.field("word", words + "}");
}

std::string owner(const Plan& plan, size_t at, Index Pass::*first, uint32_t Pass::*count) {
  for (const Pass& pass : plan.passes)
    if (at >= pass.*first && at < pass.*first + pass.*count) return std::string(pass.name);
  return "";
}

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
  for (const Index i : indices) texts.push_back(i == kNone ? "kNone" : std::to_string(i));
  return texts;
}

Row PlanEmitter::ref(const Ref& ref) const {
  Row row;
  if (ref.resource != kNone) row.field("resource", resource(ref.resource));
  return row.number("age", ref.age);
}

Row PlanEmitter::range(const Range& range) const {
  Row row;
  if (range.aspects != 0) row.field("aspects", aspects_text(range.aspects));
  row.number("mip", range.mip);
  if (range.mips != kRemaining) row.number("mips", range.mips, kRemaining);
  row.number("layer", range.layer);
  if (range.layers != kRemaining) row.number("layers", range.layers, kRemaining);
  return row;
}

Row PlanEmitter::bytes(const Bytes& bytes) const {
  Row row;
  index(row, "offset", bytes.offset);
  return index(row, "size", bytes.size);
}

Row PlanEmitter::scopes(Row row, Stages src_stages, Accesses src_accesses, Stages dst_stages, Accesses dst_accesses, BarrierTag tag) const {
  if (src_stages != 0) row.field("src_stages", stages_text(src_stages));
  if (src_accesses != 0) row.field("src_accesses", accesses_text(src_accesses));
  if (dst_stages != 0) row.field("dst_stages", stages_text(dst_stages));
  if (dst_accesses != 0) row.field("dst_accesses", accesses_text(dst_accesses));
  enumerator(row, "tag", "BarrierTag", static_cast<size_t>(tag),
             {"hazard", "valid_usage", "workaround", "merged_batch", "boundary_join", "alias_pair"});
  return row;
}

Row& PlanEmitter::declared(Row& row, dsl::Span span) const {
  const std::string place = origin(text_.files, span);
  const size_t colon = place.rfind(':');
  return place.empty() ? row : row.field("line", place.substr(colon + 1)).string("file", place.substr(0, colon));
}

// ---- tables

void PlanEmitter::values() {
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
    const auto triple = [](const int64_t(&v)[3]) {
      return "{" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + "}";
    };
    Row row;
    row.string("name", e.name).number("axes", e.axes, 2).field("initial", triple(e.initial)).field("maximum", triple(e.maximum));
    if (e.minimum[0] != 1 || e.minimum[1] != 1 || e.minimum[2] != 1) row.field("minimum", triple(e.minimum));
    return row;
  });
}

void PlanEmitter::resources() {
  table("Resource", "kResources", plan_.resources, [&](const Resource& r, size_t i) {
    Row row;
    row.string("name", r.name);
    enumerator(row, "kind", "ResourceKind", static_cast<size_t>(r.kind), {"image", "buffer"});
    enumerator(row, "lifetime", "Lifetime", static_cast<size_t>(r.lifetime), {"transient", "history", "persistent", "imported", "readback"});
    if (r.kind == ResourceKind::image && r.dimension != Dimension::d2) row.field("dimension", dimension_text(r.dimension));
    if (r.format != Format::undefined) row.field("format", format_text(r.format));
    index(row, "width", r.width);
    index(row, "height", r.height);
    index(row, "depth", r.depth);
    row.number("mips", r.mips, 1).number("layers", r.layers, 1).number("samples", r.samples, 1);
    if (r.aspects != 0) row.field("aspects", aspects_text(r.aspects));
    row.number("usage", r.usage).flag("mutable_format", r.mutable_format);
    index(row, "bytes", r.bytes);
    row.number("stride", r.stride).number("layout", r.layout).number("copies", r.copies, 1);
    enumerator(row, "init", "InitKind", static_cast<size_t>(r.init), {"none", "clear"});
    row.nested("init_value", clear_value(r.init_value))
        .flag("is_surface", r.is_surface)
        .flag("no_alias", r.no_alias)
        .flag("concurrent", r.concurrent)
        .flag("lazy", r.lazy);
    index(row, "import_slot", r.import_slot);
    row.number("estimated_bytes", r.estimated_bytes)
        .number("estimated_alignment", r.estimated_alignment, 1)
        .number("estimated_offset", r.estimated_offset);
    return declared(row, text_.resources[i]);
  });
}

namespace {

Row work_row(const Work& work, const Row& arguments, const Row& counts, const Row& indices) {
  Row row;
  enumerator(row, "kind", "WorkKind", static_cast<size_t>(work.kind),
             {"none", "host", "draw", "draw_indirect", "draw_indexed_indirect", "draw_indirect_count", "draw_indexed_indirect_count", "dispatch",
              "dispatch_indirect", "transfers", "draw_indexed"});
  index(row, "x", work.x);
  index(row, "y", work.y);
  index(row, "z", work.z);
  row.nested("arguments", arguments);
  index(row, "arguments_offset", work.arguments_offset);
  row.nested("counts", counts).number("max_draws", work.max_draws, 1).number("stride", work.stride, 16);
  slice(row, "first_transfer", work.first_transfer, "transfer_count", work.transfer_count);
  index(row, "first", work.first);
  index(row, "vertex_offset", work.vertex_offset);
  slice(row, "first_vertex_buffer", work.first_vertex_buffer, "vertex_buffer_count", work.vertex_buffer_count);
  row.nested("indices", indices);
  return index(row, "indices_offset", work.indices_offset).number("index_bytes", work.index_bytes, 4);
}

}  // namespace

void PlanEmitter::passes() {
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
    row.number("push_bytes", p.push_bytes).number("push_stages", p.push_stages).number("push_layout", p.push_layout);
    index(row, "engine_set", p.engine_set);
    slice(row, "first_choice", p.first_choice, "choice_count", p.choice_count);
    slice(row, "first_feature", p.first_feature, "feature_count", p.feature_count);
    row.nested("work", work_row(p.work, ref(p.work.arguments), ref(p.work.counts), ref(p.work.indices)));
    index(row, "host_slot", p.host_slot);
    slice(row, "first_mip_limit", p.first_mip_limit, "mip_limit_count", p.mip_limit_count);
    return declared(row, text_.passes[i]);
  });
  table("VertexBuffer", "kVertexBuffers", plan_.vertex_buffers, [&](const VertexBuffer& b, size_t) {
    Row row;
    row.nested("ref", ref(b.ref));
    return index(row, "offset", b.offset);
  });
  table("MipLimit", "kMipLimits", plan_.mip_limits,
        [&](const MipLimit& m, size_t) { return Row().field("image", resource(m.image)).number("mip", m.mip); });
}

void PlanEmitter::frame() {
  table("Queue", "kQueues", plan_.queues, [](const Queue& q, size_t) {
    return Row().field("kind", enum_text("QueueKind", static_cast<size_t>(q.kind), {"graphics", "compute", "transfer"}));
  });
  table("Step", "kSteps", plan_.steps, [&](const Step& s, size_t) {
    const bool is_pass = s.kind == StepKind::pass;
    return Row()
        .field("kind", enum_text("StepKind", static_cast<size_t>(s.kind), {"barriers", "pass", "set"}))
        .field("index", is_pass ? pass(s.index) : std::to_string(s.index));
  });
  table("Wait", "kWaits", plan_.waits, [](const Wait& w, size_t) {
    return Row().number("queue", w.queue, kNone).number("value", w.value).field("stages", stages_text(w.stages)).number("frames_ago", w.frames_ago);
  });
  table("Signal", "kSignals", plan_.signals,
        [](const Signal& s, size_t) { return Row().number("value", s.value).field("stages", stages_text(s.stages)); });
  table("Batch", "kBatches", plan_.batches, [](const Batch& b, size_t) {
    Row row;
    row.number("queue", b.queue);
    slice(row, "first_step", b.first_step, "step_count", b.step_count);
    slice(row, "first_wait", b.first_wait, "wait_count", b.wait_count);
    return slice(row, "first_signal", b.first_signal, "signal_count", b.signal_count);
  });
}

void PlanEmitter::transfers() {
  table("Transfer", "kTransfers", plan_.transfers, [&](const Transfer& t, size_t) {
    Row row;
    row.field("kind", enum_text("TransferKind", static_cast<size_t>(t.kind),
                                {"copy_image", "copy_buffer", "copy_buffer_to_image", "copy_image_to_buffer", "blit", "clear_color",
                                 "clear_depth_stencil", "fill", "update", "resolve"}));
    row.nested("src", ref(t.src)).nested("dst", ref(t.dst)).nested("src_range", range(t.src_range)).nested("dst_range", range(t.dst_range));
    row.nested("src_bytes", bytes(t.src_bytes))
        .nested("dst_bytes", bytes(t.dst_bytes))
        .flag("linear", t.linear)
        .nested("value", clear_value(t.value));
    return index(row, "update_slot", t.update_slot);
  });
  table("Culled", "kCulled", plan_.culled, [](const Culled& c, size_t) { return Row().string("pass", c.pass).string("reason", c.reason); });
}

void PlanEmitter::plan() {
  Row row;
  row.string("name", plan_.name)
      .number("variant", plan_.variant)
      .number("variant_count", plan_.variant_count, 1)
      .string("variant_name", plan_.variant_name);
  const auto add = [&](const char* member, const char* table, size_t size) {
    if (size > 0) row.field(member, table);
  };
#define RG_TABLE(member, table) add(#member, #table, plan_.member.size())
  RG_TABLE(exprs, kExprs);
  RG_TABLE(extents, kExtents);
  RG_TABLE(resources, kResources);
  RG_TABLE(queues, kQueues);
  RG_TABLE(batches, kBatches);
  RG_TABLE(steps, kSteps);
  RG_TABLE(waits, kWaits);
  RG_TABLE(signals, kSignals);
  RG_TABLE(groups, kGroups);
  RG_TABLE(memory_barriers, kMemoryBarriers);
  RG_TABLE(image_barriers, kImageBarriers);
  RG_TABLE(buffer_barriers, kBufferBarriers);
  RG_TABLE(entry, kEntry);
  RG_TABLE(exit, kExit);
  RG_TABLE(acquires, kAcquires);
  RG_TABLE(releases, kReleases);
  RG_TABLE(alias_clocks, kAliasClocks);
  RG_TABLE(passes, kPasses);
  RG_TABLE(accesses, kAccesses);
  RG_TABLE(renderings, kRenderings);
  RG_TABLE(attachments, kAttachments);
  RG_TABLE(shaders, kShaders);
  RG_TABLE(pipelines, kPipelines);
  RG_TABLE(pipeline_shaders, kPipelineShaders);
  RG_TABLE(blends, kBlends);
  RG_TABLE(sample_locations, kSampleLocations);
  RG_TABLE(vertex_buffers, kVertexBuffers);
  RG_TABLE(vertex_bindings, kVertexBindings);
  RG_TABLE(vertex_attributes, kVertexAttributes);
  RG_TABLE(bindings, kBindings);
  RG_TABLE(samplers, kSamplers);
  RG_TABLE(params, kParams);
  RG_TABLE(pass_params, kPassParams);
  RG_TABLE(features, kFeatures);
  RG_TABLE(pass_features, kPassFeatures);
  RG_TABLE(pipeline_choices, kPipelineChoices);
  RG_TABLE(transfers, kTransfers);
  RG_TABLE(mip_limits, kMipLimits);
  RG_TABLE(engine_sets, kEngineSets);
  RG_TABLE(conditions, kConditions);
  RG_TABLE(feature_conditions, kFeatureConditions);
  RG_TABLE(needs, kNeeds);
  RG_TABLE(culled, kCulled);
#undef RG_TABLE
  row.number("estimated_heap_bytes", plan_.estimated_heap_bytes);
  std::string text = "constexpr Plan kPlan =\n" + row.lines(4);
  text.erase(text.rfind(','), 1);
  text.insert(text.rfind('\n'), ";");
  out_.line(text.substr(0, text.size() - 1));
}

std::string PlanEmitter::run() {
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
  table("Feature", "kFeatures", plan_.features, [](const Feature& f, size_t) {
    Row row = Row().string("name", f.name).number("values", f.values, 2).number("initial", f.initial);
    if (f.capability != Capability::none) row.field("capability", capability_text(f.capability));
    return row.number("layout", f.layout);
  });
  table("FeatureCondition", "kFeatureConditions", plan_.feature_conditions, [](const FeatureCondition& f, size_t) {
    return Row().number("condition", f.condition).number("feature", f.feature).number("values", f.values);
  });
  std::vector<std::string> needs;
  for (const Capability capability : plan_.needs) needs.push_back(capability_text(capability));
  list(out_, "Capability", "kNeeds", needs);
  list(out_, "Index", "kPassFeatures", numbers(plan_.pass_features));
  list(out_, "Index", "kPipelineChoices", numbers(plan_.pipeline_choices));
  list(out_, "std::string_view", "kConditions", conditions);
  transfers();
  plan();
  return out_.text();
}

std::string emit_plan(const Plan& plan, const PlanText& text) { return PlanEmitter(plan, text).run(); }

}  // namespace rg::compiler
