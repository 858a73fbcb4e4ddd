#include "compiler/commands/plan_json.h"

#include <fmt/format.h>

#include "compiler/codegen/plan_values.h"
#include "compiler/commands/facts.h"

namespace rg::commands {
namespace {

using Json = nlohmann::ordered_json;

template <class Row, class Convert>
Json slice(const std::vector<Row>& rows, Index first, Index count, Convert convert) {
  Json json = Json::array();
  for (Index i = first; i < first + count; ++i) json.push_back(convert(rows[i]));
  return json;
}

template <class Row, class Convert>
Json all(const std::vector<Row>& rows, Convert convert) {
  return slice(rows, 0, static_cast<Index>(rows.size()), convert);
}

Json optional_index(Index index) { return index == kNone ? Json(nullptr) : Json(index); }
Json count_or_all(uint32_t count) { return count == kRemaining ? Json("all") : Json(count); }

template <size_t n, class Enum>
const char* word(const char* const (&words)[n], Enum value) {
  return static_cast<size_t>(value) < n ? words[static_cast<size_t>(value)] : "?";
}

constexpr const char* kLifetimes[] = {"transient", "history", "persistent", "imported", "readback"};
constexpr const char* kDimensions[] = {"1d", "2d", "3d", "cube"};
constexpr const char* kPassKinds[] = {"raster", "compute", "transfer", "host"};
constexpr const char* kQueueKinds[] = {"graphics", "compute", "transfer"};
constexpr const char* kLoadOps[] = {"load", "clear", "dont_care", "none"};
constexpr const char* kStoreOps[] = {"store", "dont_care", "none"};
constexpr const char* kWorkKinds[] = {"none",
                                      "host",
                                      "draw",
                                      "draw_indirect",
                                      "draw_indexed_indirect",
                                      "draw_indirect_count",
                                      "draw_indexed_indirect_count",
                                      "dispatch",
                                      "dispatch_indirect",
                                      "transfers",
                                      "draw_indexed"};
constexpr const char* kTransferKinds[] = {"copy_image", "copy_buffer", "copy_buffer_to_image", "copy_image_to_buffer",
                                          "blit",       "clear_color", "clear_depth_stencil",  "fill",
                                          "update",     "resolve"};

struct PlanJson {
  const PlanData& plan;

  Json ref(Ref ref) const {
    if (ref.resource == kNone) return nullptr;
    Json json = {{"resource", plan.resources[ref.resource].name}};
    if (ref.age) json["age"] = ref.age;
    return json;
  }
  Json range(const Range& range) const {
    return {{"aspects", range.aspects},
            {"mip", range.mip},
            {"mips", count_or_all(range.mips)},
            {"layer", range.layer},
            {"layers", count_or_all(range.layers)}};
  }
  Json bytes(const Bytes& bytes) const {
    return {{"offset", bytes.offset == kNone ? "0" : expression_text(plan, bytes.offset)},
            {"size", bytes.size == kNone ? "all" : expression_text(plan, bytes.size)}};
  }
  template <class Barrier>
  Json scopes(const Barrier& barrier) const {
    return {{"src_stages", stage_names(barrier.src_stages)},
            {"src_accesses", access_names(barrier.src_accesses)},
            {"dst_stages", stage_names(barrier.dst_stages)},
            {"dst_accesses", access_names(barrier.dst_accesses)},
            {"tag", tag_name(barrier.tag)}};
  }

  Json extent(const Extent& row) const {
    Json initial = Json::array(), minimum = Json::array(), maximum = Json::array();
    for (uint32_t axis = 0; axis < row.axes; ++axis)
      initial.push_back(row.initial[axis]), minimum.push_back(row.minimum[axis]), maximum.push_back(row.maximum[axis]);
    return {{"name", row.name}, {"initial", initial}, {"minimum", minimum}, {"maximum", maximum}};
  }

  Json resource(const Resource& row) const {
    Json json = {{"name", row.name}, {"kind", row.kind == ResourceKind::image ? "image" : "buffer"}, {"lifetime", word(kLifetimes, row.lifetime)}};
    if (row.kind == ResourceKind::image) {
      json["dimension"] = word(kDimensions, row.dimension);
      json["format"] = static_cast<uint32_t>(row.format);
      json["size"] = {expression_text(plan, row.width), expression_text(plan, row.height), expression_text(plan, row.depth)};
      json["mips"] = row.mips, json["layers"] = row.layers, json["samples"] = row.samples;
    } else {
      json["bytes"] = expression_text(plan, row.bytes);
      json["stride"] = row.stride;
    }
    json["usage"] = row.usage, json["copies"] = row.copies;
    json["estimate"] = {{"offset", row.estimated_offset}, {"bytes", row.estimated_bytes}, {"alignment", row.estimated_alignment}};
    json["file"] = row.file, json["line"] = row.line;
    return json;
  }

  Json access(const Access& row) const {
    Json json = {{"ref", ref(row.ref)}, {"stages", stage_names(row.stages)}, {"accesses", access_names(row.accesses)}, {"writes", row.writes}};
    if (plan.resources[row.ref.resource].kind == ResourceKind::image)
      json["layout"] = layout_name(row.layout), json["range"] = range(row.range);
    else
      json["bytes"] = bytes(row.bytes);
    return json;
  }

  Json attachment(const Attachment& row) const {
    Json json = {{"ref", ref(row.ref)},
                 {"range", range(row.range)},
                 {"layout", layout_name(row.layout)},
                 {"load", word(kLoadOps, row.load)},
                 {"store", word(kStoreOps, row.store)}};
    if (row.resolve.resource != kNone) json["resolve"] = ref(row.resolve);
    return json;
  }

  Json rendering(Index index) const {
    if (index == kNone) return nullptr;
    const Rendering& row = plan.renderings[index];
    return {{"size", {expression_text(plan, row.width), expression_text(plan, row.height)}},
            {"layers", row.layers},
            {"samples", row.samples},
            {"color", slice(plan.attachments, row.first_color, row.color_count, [&](const Attachment& a) { return attachment(a); })},
            {"depth", row.depth == kNone ? Json(nullptr) : attachment(plan.attachments[row.depth])},
            {"stencil", row.stencil == kNone ? Json(nullptr) : attachment(plan.attachments[row.stencil])}};
  }

  Json binding(const Binding& row) const {
    return {{"binding", row.binding},
            {"type", static_cast<uint32_t>(row.type)},
            {"stages", row.stages},
            {"ref", ref(row.ref)},
            {"sampler", row.sampler == kNone ? Json(nullptr) : Json(plan.samplers[row.sampler].name)},
            {"params", row.params == kNone ? Json(nullptr) : Json(plan.params[row.params].name)}};
  }

  Json transfer(const Transfer& row) const { return {{"kind", word(kTransferKinds, row.kind)}, {"src", ref(row.src)}, {"dst", ref(row.dst)}}; }

  Json work(const Work& row) const {
    Json json = {{"kind", word(kWorkKinds, row.kind)}};
    if (row.x != kNone) json["count"] = {expression_text(plan, row.x), expression_text(plan, row.y), expression_text(plan, row.z)};
    if (row.arguments.resource != kNone) json["arguments"] = ref(row.arguments);
    if (row.first != kNone) json["first"] = expression_text(plan, row.first);
    if (row.vertex_offset != kNone) json["vertex_offset"] = expression_text(plan, row.vertex_offset);
    if (row.indices.resource != kNone) json["indices"] = ref(row.indices);
    if (row.vertex_buffer_count)
      json["vertex_buffers"] =
          slice(plan.vertex_buffers, row.first_vertex_buffer, row.vertex_buffer_count, [&](const VertexBuffer& b) { return ref(b.ref); });
    if (row.transfer_count)
      json["transfers"] = slice(plan.transfers, row.first_transfer, row.transfer_count, [&](const Transfer& t) { return transfer(t); });
    return json;
  }

  Json pass(const Pass& row) const {
    return {{"name", row.name},
            {"module", row.module},
            {"kind", word(kPassKinds, row.kind)},
            {"queue", row.queue},
            {"guard", row.guard},
            {"accesses", slice(plan.accesses, row.first_access, row.access_count, [&](const Access& a) { return access(a); })},
            {"rendering", rendering(row.rendering)},
            {"pipeline", row.pipeline == kNone ? Json(nullptr) : Json(plan.pipelines[row.pipeline].name)},
            {"bindings", slice(plan.bindings, row.first_binding, row.binding_count, [&](const Binding& b) { return binding(b); })},
            {"push_bytes", row.push_bytes},
            {"work", work(row.work)},
            {"host_slot", optional_index(row.host_slot)},
            {"file", row.file},
            {"line", row.line}};
  }

  template <class Barrier>
  static Json transfer_of_ownership(const Barrier& barrier) {
    if (barrier.src_queue == barrier.dst_queue) return Json::object();
    return {{"src_queue", barrier.src_queue}, {"dst_queue", barrier.dst_queue}};
  }

  Json group(Index index) const {
    const BarrierGroup& row = plan.groups[index];
    const auto image = [&](const ImageBarrier& barrier) {
      Json json = {{"ref", ref(barrier.image)},
                   {"range", range(barrier.range)},
                   {"old_layout", layout_name(barrier.old_layout)},
                   {"new_layout", layout_name(barrier.new_layout)}};
      json.update(scopes(barrier));
      json.update(transfer_of_ownership(barrier));
      return json;
    };
    const auto buffer = [&](const BufferBarrier& barrier) {
      Json json = {{"ref", ref(barrier.buffer)}, {"bytes", bytes(barrier.bytes)}};
      json.update(scopes(barrier));
      json.update(transfer_of_ownership(barrier));
      return json;
    };
    Json json = {
        {"number", index},
        {"memory", slice(plan.memory_barriers, row.first_memory, row.memory_count, [&](const MemoryBarrier& barrier) { return scopes(barrier); })},
        {"images", slice(plan.image_barriers, row.first_image, row.image_count, image)},
        {"buffers", slice(plan.buffer_barriers, row.first_buffer, row.buffer_count, buffer)}};
    if (row.event != kNone) json["event"] = row.event;
    return json;
  }

  Json step(const Step& row) const {
    if (row.kind == StepKind::pass) return {{"pass", plan.passes[row.index].name}};
    if (row.kind == StepKind::set) return {{"set", plan.groups[row.index].event}};
    return {{"barriers", group(row.index)}};
  }

  Json batch(const Batch& row) const {
    const auto wait = [](const Wait& w) {
      return Json{{"queue", w.queue}, {"value", w.value}, {"stages", stage_names(w.stages)}, {"frames_ago", w.frames_ago}};
    };
    const auto signal = [](const Signal& s) { return Json{{"value", s.value}, {"stages", stage_names(s.stages)}}; };
    return {{"queue", row.queue},
            {"waits", slice(plan.waits, row.first_wait, row.wait_count, wait)},
            {"steps", slice(plan.steps, row.first_step, row.step_count, [&](const Step& s) { return step(s); })},
            {"signals", slice(plan.signals, row.first_signal, row.signal_count, signal)}};
  }

  Json boundary(const Boundary& row) const {
    return {{"ref", ref(row.ref)},
            {"range", range(row.range)},
            {"stages", stage_names(row.stages)},
            {"accesses", access_names(row.accesses)},
            {"layout", layout_name(row.layout)},
            {"queue", optional_index(row.queue)},
            {"discard", row.discard}};
  }

  Json acquire(const Acquire& row) const {
    const auto clocks = [&](size_t first) {
      Json points = Json::array();
      for (size_t q = 0; row.first_clock != kNone && q < plan.queues.size(); ++q) points.push_back(optional_index(plan.alias_clocks[first + q]));
      return points;
    };
    return {{"resource", plan.resources[row.resource].name},
            {"queue", row.queue},
            {"point", row.point},
            {"stages", stage_names(row.stages)},
            {"accesses", access_names(row.accesses)},
            {"after", clocks(row.first_clock)},
            {"after_in_frame_before", clocks(row.first_clock + plan.queues.size())}};
  }

  Json release(const Release& row) const {
    return {{"resource", plan.resources[row.resource].name},
            {"queue", row.queue},
            {"point", row.point},
            {"stages", stage_names(row.stages)},
            {"accesses", access_names(row.accesses)}};
  }
};

std::string binary(const PlanData& plan, const Expr& e, const char* format) {
  return fmt::format(fmt::runtime(format), expression_text(plan, e.a), expression_text(plan, e.b));
}

}  // namespace

std::string expression_text(const PlanData& plan, Index expr) {
  if (expr == kNone) return "1";
  const Expr& e = plan.exprs[expr];
  switch (e.op) {
    case ExprOp::constant:
      return std::to_string(e.value);
    case ExprOp::extent:
      return fmt::format("{}.{}", plan.extents[static_cast<size_t>(e.value / 3)].name, "xyz"[e.value % 3]);
    case ExprOp::add:
      return binary(plan, e, "({} + {})");
    case ExprOp::sub:
      return binary(plan, e, "({} - {})");
    case ExprOp::mul:
      return binary(plan, e, "({} * {})");
    case ExprOp::floor_div:
      return binary(plan, e, "({} / {})");
    case ExprOp::ceil_div:
      return binary(plan, e, "ceil({} / {})");
    case ExprOp::min:
      return binary(plan, e, "min({}, {})");
    case ExprOp::max:
      return binary(plan, e, "max({}, {})");
    case ExprOp::mip:
      return binary(plan, e, "mip({}, {})");
  }
  return "?";
}

Json plan_json(const PlanData& plan) {
  const PlanJson json{plan};
  return {{"schema", "rgc-plan-1"},
          {"graph", plan.name},
          {"variant", plan.variant_name},
          {"conditions", plan.conditions},
          {"extents", all(plan.extents, [&](const Extent& row) { return json.extent(row); })},
          {"resources", all(plan.resources, [&](const Resource& row) { return json.resource(row); })},
          {"queues", all(plan.queues, [&](const Queue& row) { return Json(word(kQueueKinds, row.kind)); })},
          {"passes", all(plan.passes, [&](const Pass& row) { return json.pass(row); })},
          {"batches", all(plan.batches, [&](const Batch& row) { return json.batch(row); })},
          {"entry", all(plan.entry, [&](const Boundary& row) { return json.boundary(row); })},
          {"exit", all(plan.exit, [&](const Boundary& row) { return json.boundary(row); })},
          {"acquires", all(plan.acquires, [&](const Acquire& row) { return json.acquire(row); })},
          {"releases", all(plan.releases, [&](const Release& row) { return json.release(row); })},
          {"culled", all(plan.culled,
                         [](const Culled& row) {
                           return Json{{"pass", row.pass}, {"reason", row.reason}};
                         })},
          {"heap_bytes", plan.estimated_heap_bytes}};
}

Json plan_json(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan) {
  const dsl::Graph& declared = result.program.graphs[graph.graph];
  PlanData placed = plan.plan;
  const auto place = [&](auto& row, dsl::Span span) {
    const std::string text = compiler::origin(result.sources, span);
    const size_t colon = text.rfind(':');
    if (colon == std::string::npos) return;
    row.file = intern(text.substr(0, colon));
    row.line = static_cast<uint32_t>(std::stoul(text.substr(colon + 1)));
  };
  for (size_t p = 0; p < placed.passes.size(); ++p) place(placed.passes[p], declared.passes.rows[placed.program_pass[p]].span);
  for (size_t r = 0; r < placed.resources.size(); ++r) place(placed.resources[r], declared.resources.rows[placed.program_resource[r]].span);
  return plan_json(placed);
}

}  // namespace rg::commands
