// Programs as text.
#include "dsl/print.h"

#include <fmt/format.h>

#include "dsl/format_table.h"
#include "dsl/layout.h"
#include "dsl/source.h"

namespace rg::dsl {
namespace {

constexpr const char* kRoles[] = {"sampled",        "storage",   "uniform",  "vertex",      "index",       "indirect",   "color",    "depth",
                                  "depth_readonly", "stencil",   "input",    "resolve_src", "resolve_dst", "copy_src",   "copy_dst", "blit_src",
                                  "blit_dst",       "clear_dst", "fill_dst", "update_dst",  "host_read",   "host_write", "present",  "undefined"};
constexpr const char* kModes[] = {"read", "write", "update", "atomic"};
constexpr const char* kLifetimes[] = {"transient", "history", "persistent", "imported", "readback"};
constexpr const char* kDimensions[] = {"1d", "2d", "3d", "cube"};
constexpr const char* kPassKinds[] = {"raster", "compute", "transfer", "host"};
constexpr const char* kQueues[] = {"graphics", "compute", "transfer"};
constexpr const char* kDraws[] = {"none", "fullscreen", "direct", "indirect", "indirect_count", "host"};
constexpr const char* kDispatches[] = {"none", "over", "groups", "indirect", "host"};
constexpr const char* kTransfers[] = {"copy", "blit", "clear", "fill", "update", "resolve", "host"};
constexpr const char* kCompares[] = {"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"};
constexpr const char* kFilters[] = {"nearest", "linear"};
constexpr const char* kAddresses[] = {"repeat", "mirror", "clamp", "border"};
constexpr const char* kCulls[] = {"none", "front", "back"};
constexpr const char* kStencilOps[] = {"keep", "zero", "replace", "increment", "decrement", "invert", "increment_wrap", "decrement_wrap"};
constexpr const char* kTopologies[] = {"points", "lines", "triangles", "triangle_strip"};
constexpr const char* kBlendOps[] = {"add", "subtract", "reverse_subtract", "min", "max"};
constexpr const char* kFactors[] = {"zero",      "one",
                                    "src_alpha", "one_minus_src_alpha",
                                    "dst_alpha", "one_minus_dst_alpha",
                                    "src_color", "one_minus_src_color",
                                    "dst_color", "one_minus_dst_color"};

template <class Enum, size_t Count>
const char* word(const char* const (&words)[Count], Enum value) {
  return words[static_cast<size_t>(value)];
}

std::string stages_text(uint32_t stages) {
  constexpr const char* kNames[] = {"vertex", "tess_control", "tess_eval", "geometry", "fragment", "compute", "transfer", "host"};
  std::string text;
  for (size_t bit = 0; bit < std::size(kNames); ++bit)
    if (stages & (1u << bit)) text += (text.empty() ? "" : "|") + std::string(kNames[bit]);
  return text;
}

std::string clear_text(const ClearValue& value) {
  if (value.integer) return fmt::format("u({}, {}, {}, {})", value.u[0], value.u[1], value.u[2], value.u[3]);
  std::string text = fmt::format("f({}, {}, {}, {})", value.f[0], value.f[1], value.f[2], value.f[3]);
  return value.u[1] == 0 ? text : text + fmt::format(" stencil {}", value.u[1]);
}

std::string guard_text(const Program& program, const Guard& guard) {
  std::string text;
  for (const Guard::Term& term : guard.terms) {
    const Feature& feature = program.features[term.feature];
    text += fmt::format(" when {} {} {}", feature.name, term.negated ? "!=" : "==", feature.values[term.value]);
  }
  return text;
}

struct Printer {
  const Program& program;
  std::string out;

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> pattern, Arguments&&... arguments) {
    out += fmt::format(pattern, std::forward<Arguments>(arguments)...) + "\n";
  }
};

void print_extent(Printer& at, const Extent& extent) {
  const auto size = [](const int64_t(&axes)[3]) { return fmt::format("{}x{}x{}", axes[0], axes[1], axes[2]); };
  const std::string minimum = size(extent.minimum);
  at.line("extent {} axes {} initial {}{} max {}", extent.name, extent.axes, size(extent.initial), minimum == "1x1x1" ? "" : " min " + minimum,
          size(extent.maximum));
}

void print_struct(Printer& at, const Struct& record) {
  at.line("struct {}{} std140 {}/{} std430 {}/{}", record.name, is_scalar(record) ? " scalar" : "", record.size140, record.align140, record.size430,
          record.align430);
  for (const Field& field : record.fields)
    at.line("  {}: {} @{} @{}", field.name, print_type(at.program, field.type), field.offset140, field.offset430);
}

void print_sampler(Printer& at, const Sampler& sampler) {
  at.line("sampler {} filter {} mip {} address {}{}{}", sampler.name, word(kFilters, sampler.filter), word(kFilters, sampler.mip_filter),
          word(kAddresses, sampler.address), sampler.compare ? fmt::format(" compare {}", word(kCompares, *sampler.compare)) : "",
          sampler.max_anisotropy > 0 ? fmt::format(" anisotropy {}", sampler.max_anisotropy) : "");
}

std::string stencil_text(const StencilFace& face) {
  return fmt::format("test {} fail {} depth_fail {} pass {} masks {} {} reference {}", word(kCompares, face.compare), word(kStencilOps, face.fail),
                     word(kStencilOps, face.depth_fail), word(kStencilOps, face.pass), face.read_mask, face.write_mask, face.reference);
}

std::string device_text(const State& state) {
  std::string text = state.conservative ? " conservative" : "";
  if (state.depth_bounds) text += fmt::format(" bounds {} {}", state.depth_min, state.depth_max);
  for (const SampleLocation& at : state.sample_locations) text += fmt::format(" sample {} {}", at.x, at.y);
  return text;
}

void print_state(Printer& at, const State& state) {
  at.line("state {} cull {} front {} depth test {} write {} bias {} {} topology {}{}", state.name, word(kCulls, state.cull),
          state.front_clockwise ? "clockwise" : "counter_clockwise", state.depth_test ? word(kCompares, state.depth_compare) : "off",
          state.depth_write ? "on" : "off", state.depth_bias_constant, state.depth_bias_slope, word(kTopologies, state.topology),
          (state.alpha_to_coverage ? " alpha_to_coverage" : "") + device_text(state));
  if (!state.stencil_test) return;
  at.line("  stencil front {}", stencil_text(state.stencil_front));
  at.line("  stencil back {}", stencil_text(state.stencil_back));
}

std::string shape_text(const Program& program, const Resource& resource) {
  if (resource.kind == ResourceKind::buffer)
    return fmt::format("{}[{}] stride {}", resource.format == Format::none ? print_type(program, resource.element) : name(resource.format),
                       resource.count.valid() ? print_expr(program, resource.count) : "", resource.stride);
  std::string text = fmt::format("{} {} [{}", name(resource.format), word(kDimensions, resource.dimension), print_expr(program, resource.width));
  if (resource.height.valid()) text += ", " + print_expr(program, resource.height);
  if (resource.depth.valid()) text += ", " + print_expr(program, resource.depth);
  text += "]";
  if (resource.mips > 1) text += fmt::format(" mips {}", resource.mips);
  if (resource.layers > 1) text += fmt::format(" layers {}", resource.layers);
  if (resource.samples > 1) text += fmt::format(" samples {}", resource.samples);
  return text;
}

std::string boundary_text(const char* title, const BoundaryState& state) {
  return fmt::format(" {} {}{}{}", title, word(kRoles, state.role), state.stages ? " in " + stages_text(state.stages) : "",
                     state.wrote ? " written" : "");
}

void print_resource(Printer& at, size_t id, const Resource& resource) {
  std::string text = fmt::format("  r{} {} {}: {} {}", id, resource.kind == ResourceKind::image ? "image" : "buffer", resource.name,
                                 shape_text(at.program, resource), word(kLifetimes, resource.lifetime));
  if (resource.history > 0) text += fmt::format(" {}", resource.history);
  if (resource.init == InitKind::clear) text += " init " + clear_text(resource.init_value);
  if (resource.lifetime == Lifetime::imported) text += boundary_text("before", resource.before) + boundary_text("after", resource.after);
  if (resource.is_surface) text += " surface";
  if (resource.is_output) text += " output";
  if (resource.no_alias) text += " no alias";
  if (resource.layout_general) text += " layout general";
  at.line("{}{} ({})", text, guard_text(at.program, resource.guard), resource.module);
}

std::string span_text(uint32_t first, uint32_t count) {
  return count == kAll ? fmt::format("{}..", first) : fmt::format("{}..{}", first, uint64_t{first} + count);
}

std::string range_text(const Program& program, const Resource& resource, const Range& range) {
  std::string text;
  if (resource.kind == ResourceKind::buffer)
    return range.offset.valid() ? fmt::format(" bytes {} + {}", print_expr(program, range.offset), print_expr(program, range.size)) : "";
  if (range.mip != 0 || range.mips != kAll) text += " mips " + span_text(range.mip, range.mips);
  if (range.layer != 0 || range.layers != kAll) text += " layers " + span_text(range.layer, range.layers);
  const uint32_t all = info(resource.format).aspects;
  if (range.aspects != all)
    text += range.aspects == aspect_depth ? " depth" : range.aspects == aspect_stencil ? " stencil" : fmt::format(" aspects {}", range.aspects);
  return text;
}

std::string blend_text(const Blend& blend) {
  return fmt::format(" blend {}({}, {}, {}, {})", word(kBlendOps, blend.op), word(kFactors, blend.src), word(kFactors, blend.dst),
                     word(kFactors, blend.src_alpha), word(kFactors, blend.dst_alpha));
}

void print_access(Printer& at, const Graph& graph, size_t index, const Access& access) {
  const Resource& resource = graph.resources[access.resource];
  std::string text =
      fmt::format("    a{} {} {}{}", index, word(kModes, access.mode), resource.name, access.age ? fmt::format(".prev({})", access.age) : "");
  text += range_text(at.program, resource, access.range);
  if (is_slice(access)) text += " slices " + span_text(access.range.slice, access.range.slices);
  if (access.view != Format::none) text += fmt::format(" view {}", name(access.view));
  text += fmt::format(" as {}", word(kRoles, access.role));
  if (access.sampler.valid()) text += fmt::format("({})", at.program.samplers[access.sampler].name);
  if (access.stages) text += " in " + stages_text(access.stages);
  if (access.clear) text += " clear " + clear_text(*access.clear);
  if (access.blend.enabled) text += blend_text(access.blend);
  if (access.element) text += " element";
  if (access.covers) text += " covers";
  if (access.disjoint) text += " disjoint";
  at.line("{} called {}", text, access.name);
}

std::string index_text(uint32_t index) { return index == kAll ? "-" : fmt::format("a{}", index); }

void print_draw(Printer& at, const Draw& draw) {
  std::string text = fmt::format("    draw {}", word(kDraws, draw.kind));
  if (draw.kind == DrawKind::direct)
    text += fmt::format(" {} instances {}", print_expr(at.program, draw.vertices), print_expr(at.program, draw.instances));
  if (draw.first.valid()) text += " first " + print_expr(at.program, draw.first);
  if (draw.offset.valid()) text += " offset " + print_expr(at.program, draw.offset);
  if (draw.indices != kAll) text += " indices " + index_text(draw.indices);
  if (draw.arguments != kAll)
    text += fmt::format(" {} max {} stride {}{}", index_text(draw.arguments), draw.max_draws, draw.stride, draw.indexed ? " indexed" : "");
  if (draw.counts != kAll) text += " count " + index_text(draw.counts);
  if (draw.per_draw.valid()) text += " per_draw " + at.program.structs[draw.per_draw].name;
  for (const VertexInput& vertex : draw.vertex) {
    text += (vertex.per_instance ? " instance " : " vertex ") + at.program.structs[vertex.type].name;
    if (vertex.buffer != kAll) text += " from " + index_text(vertex.buffer);
  }
  at.line("{}", text);
}

void print_dispatch(Printer& at, const Dispatch& dispatch) {
  std::string text = fmt::format("    dispatch {}", word(kDispatches, dispatch.kind));
  if (dispatch.size[0].valid())
    text += fmt::format(" [{}, {}, {}]", print_expr(at.program, dispatch.size[0]), print_expr(at.program, dispatch.size[1]),
                        print_expr(at.program, dispatch.size[2]));
  if (dispatch.arguments != kAll) text += " " + index_text(dispatch.arguments);
  at.line("{} group {} {} {}", text, dispatch.group[0], dispatch.group[1], dispatch.group[2]);
}

void print_transfer(Printer& at, const Transfer& transfer) {
  std::string text = fmt::format("    {} {} -> {}", word(kTransfers, transfer.kind), index_text(transfer.src), index_text(transfer.dst));
  if (transfer.kind == TransferKind::blit) text += fmt::format(" {}", word(kFilters, transfer.filter));
  if (transfer.kind == TransferKind::clear || transfer.kind == TransferKind::fill) text += " " + clear_text(transfer.value);
  if (!transfer.data.empty()) text += " from " + transfer.data;
  at.line("{}", text);
}

std::string heading(const Program& program, const Graph& graph, const Pass& pass) {
  std::string text = fmt::format("{} queue {}{}", word(kPassKinds, pass.kind), word(kQueues, pass.queue), pass.queue_may ? " may" : "");
  for (const ParamsUse& use : pass.params)
    text += " params " + (use.name == graph.params[use.id].name ? "" : use.name + " = ") + graph.params[use.id].name;
  if (pass.state.valid()) text += " state " + program.states[pass.state].name;
  if (!pass.bind.empty()) text += " bind " + pass.bind;
  for (const PassId other : pass.after) text += " after " + graph.passes[other].name;
  if (pass.keep) text += " keep";
  if (pass.multiview) text += " multiview";
  for (const ConditionId condition : pass.conditions) text += " if host " + program.conditions[condition].name;
  for (const MipLimit& limit : pass.mip_limits) text += fmt::format(" needs {}.mip({})", graph.resources[limit.image].name, limit.mip);
  return text + guard_text(program, pass.guard);
}

std::string block_text(const Program& program, const Block& block) {
  std::string text = fmt::format("    block over {} {}", block.axes, block.axes == 1 ? "axis" : "axes");
  if (block.scan != kAll)
    text += fmt::format(" scan {} {}{}", "xyz"[block.scan], print_type(program, block.carry), block.associative ? " associative" : "");
  return text;
}

void print_pass(Printer& at, const Graph& graph, size_t id, const Pass& pass) {
  at.line("  p{} {}: {} ({})", id, pass.name, heading(at.program, graph, pass), pass.module);
  for (const Shader& shader : pass.shaders) at.line("    shader {} {}", stages_text(shader.stage), shader.path);
  if (pass.block) at.line("{}", block_text(at.program, *pass.block));
  if (pass.fusion.valid()) at.line("    fuse {}", graph.fusions[pass.fusion].name);
  for (const ShaderFeature& feature : pass.features)
    at.line("    feature {}{}", feature.name, feature.feature.valid() ? "" : fmt::format(" = {}", feature.value));
  if (pass.spectrum.valid())
    at.line("    spectrum {} by {}{}", at.program.spectra[pass.spectrum].name, graph.resources[pass.accesses[pass.masks].resource].name,
            pass.kernels == kAll ? "" : " into " + graph.resources[pass.accesses[pass.kernels].resource].name);
  for (size_t i = 0; i < pass.accesses.size(); ++i) print_access(at, graph, i, pass.accesses[i]);
  if (pass.draw.kind != DrawKind::none) print_draw(at, pass.draw);
  if (pass.dispatch.kind != DispatchKind::none) print_dispatch(at, pass.dispatch);
  for (const Transfer& transfer : pass.transfers) print_transfer(at, transfer);
}

void print_graph(Printer& at, const Graph& graph) {
  at.line("graph {}", graph.name);
  for (const Params& params : graph.params)
    at.line("  params {}: {}{}", params.name, at.program.structs[params.type].name,
            params.pass.valid() ? " of " + graph.passes[params.pass].name : "");
  for (size_t i = 0; i < graph.resources.size(); ++i) print_resource(at, i, graph.resources.rows[i]);
  for (const Fusion& fusion : graph.fusions)
    at.line("  fuse {}{}{}{}", fusion.name, fusion.may ? " may" : "", fusion.unrounded ? " unrounded" : "",
            fusion.when ? guard_text(at.program, {{*fusion.when}}) : "");
  for (size_t i = 0; i < graph.passes.size(); ++i) print_pass(at, graph, i, graph.passes.rows[i]);
  for (const Assertion& assertion : graph.assertions)
    at.line("  {} {} {} {}", assertion.is_error ? "assert" : "warn", assertion.fact, assertion.comparison,
            assertion.comparison.empty() ? "" : fmt::format("{}", assertion.value));
}

void print_feature(Printer& at, const Feature& feature) {
  at.line("feature {}: {}{}", feature.name, fmt::join(feature.values, ", "), feature.capability == Capability::none ? "" : " by device");
  for (const Feature::Rule& rule : feature.rules) {
    const Feature& other = at.program.features[rule.needs.feature];
    at.line("  {} needs {} {} {}", feature.values[rule.value], other.name, rule.needs.negated ? "!=" : "==", other.values[rule.needs.value]);
  }
}

}  // namespace

std::string print_expr(const Program& program, ExprId id) {
  const Expr& expr = program.exprs[id];
  constexpr const char* kAxes[] = {"x", "y", "z"};
  const auto operand = [&](ExprId each) { return print_expr(program, each); };
  switch (expr.op) {
    case ExprOp::constant:
      return std::to_string(expr.value);
    case ExprOp::extent:
      return program.extents.rows[static_cast<size_t>(expr.value / 3)].name + "." + kAxes[expr.value % 3];
    case ExprOp::add:
      return fmt::format("({} + {})", operand(expr.a), operand(expr.b));
    case ExprOp::sub:
      return fmt::format("({} - {})", operand(expr.a), operand(expr.b));
    case ExprOp::mul:
      return fmt::format("({} * {})", operand(expr.a), operand(expr.b));
    case ExprOp::floor_div:
      return fmt::format("floor({} / {})", operand(expr.a), operand(expr.b));
    case ExprOp::ceil_div:
      return fmt::format("ceil({} / {})", operand(expr.a), operand(expr.b));
    case ExprOp::min:
      return fmt::format("min({}, {})", operand(expr.a), operand(expr.b));
    case ExprOp::max:
      return fmt::format("max({}, {})", operand(expr.a), operand(expr.b));
    case ExprOp::mip:
      return fmt::format("mip({}, {})", operand(expr.a), operand(expr.b));
  }
  return {};
}

std::string print_type(const Program& program, const Type& type) {
  constexpr const char* kScalars[] = {"f32", "i32", "u32", "bool"};
  constexpr const char* kPrefixes[] = {"", "i", "u", "b"};
  std::string text;
  if (type.record.valid())
    text = program.structs[type.record].name;
  else if (type.packed != Format::none)
    text = name(type.packed);
  else if (type.columns > 1)
    text = type.rows == type.columns ? fmt::format("mat{}", type.rows) : fmt::format("mat{}x{}", type.columns, type.rows);
  else if (type.rows > 1)
    text = fmt::format("{}vec{}", word(kPrefixes, type.scalar), type.rows);
  else
    text = word(kScalars, type.scalar);
  return type.count ? fmt::format("{}[{}]", text, type.count) : text;
}

std::string print_program(const Program& program) {
  Printer at{program, {}};
  at.line("module {}", program.module);
  if (program.split_barriers) at.line("target with split_barriers");
  for (const Profile& profile : program.profiles) at.line("target profile {}", profile.name);
  for (const Program::Constant& constant : program.constants) at.line("const {} = {}", constant.name, constant.value);
  for (const Extent& extent : program.extents) print_extent(at, extent);
  for (const Struct& record : program.structs) print_struct(at, record);
  for (const Sampler& sampler : program.samplers) print_sampler(at, sampler);
  for (const State& state : program.states) print_state(at, state);
  for (const Feature& feature : program.features) print_feature(at, feature);
  for (const Condition& condition : program.conditions) at.line("condition {}", condition.name);
  for (const EngineSet& set : program.engine_sets) at.line("set {} {}", set.name, set.set);
  for (const Graph& graph : program.graphs) print_graph(at, graph);
  return at.out;
}

std::string print_tokens(std::string_view text, const Tokens& tokens) {
  const SourceFile source({}, std::string(text));
  std::string out;
  for (const Token& token : tokens) {
    const Position at = source.position(token.begin);
    out += fmt::format("{}:{} {}{}{}\n", at.line, at.column, name(token.kind), token.begin == token.end ? "" : " ", text_of(token, text));
  }
  return out;
}

const char* print_role(Role role) { return kRoles[static_cast<size_t>(role)]; }

}  // namespace rg::dsl
