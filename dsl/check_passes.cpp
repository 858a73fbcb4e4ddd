// Passes: their statements become shaders, accesses, draws, dispatches, transfers; clears of storage become passes of their own.
#include <algorithm>

#include "dsl/check_state.h"
#include "dsl/paths.h"

namespace rg::dsl {
namespace {

struct Builder {
  Checker& checker;
  GraphScope& scope;
  const ast::PassDeclaration& node;
  PassScope out;
  bool has_draw = false, has_dispatch = false, fullscreen = false;
  Span shader_span, draw_span, dispatch_span;
  std::vector<const ast::BundleDeclaration*> open = {};  // bundles that are being read
  size_t bundled = 0;                                    // statements that came from bundles
};

void fail(Builder& at, DiagnosticKind kind, Span span, std::vector<std::string> arguments = {}) {
  at.checker.report(kind, span, std::move(arguments));
  at.out.dropped = at.scope.incomplete = true;
}

struct StageSuffix {
  std::string_view suffix;
  Stage stage;
};
constexpr StageSuffix kSuffixes[] = {{".vert", stage_vertex},   {".tesc", stage_tess_control}, {".tese", stage_tess_eval},
                                     {".geom", stage_geometry}, {".frag", stage_fragment},     {".comp", stage_compute}};

std::optional<Stage> stage_of(std::string_view path) {
  for (const StageSuffix& row : kSuffixes)
    if (path.size() > row.suffix.size() && path.substr(path.size() - row.suffix.size()) == row.suffix) return row.stage;
  return std::nullopt;
}

bool stage_fits(PassKind kind, Stage stage) {
  return (kind == PassKind::compute) == (stage == stage_compute) && (kind == PassKind::compute || kind == PassKind::raster);
}

void add_shader(Builder& at, const ast::ShaderStatement::Path& path) {
  const std::string shown(path.text);
  const auto stage = stage_of(path.text);
  if (!stage) return fail(at, DiagnosticKind::ShaderSuffix, path.span, {shown});
  if (!stage_fits(at.out.pass.kind, *stage)) return fail(at, DiagnosticKind::ShaderStage, path.span, {shown, std::string(at.node.kind.text)});
  for (const Shader& other : at.out.pass.shaders) {
    if (other.stage != *stage) continue;
    at.checker.report(DiagnosticKind::RepeatedStage, path.span, {shown}).note(DiagnosticKind::FirstIsHere, other.span);
    at.out.dropped = at.scope.incomplete = true;
    return;
  }
  const auto resolved = join_inside(at.checker.modules[at.scope.module].folder, path.text);
  if (!resolved) return fail(at, DiagnosticKind::ShaderEscapes, path.span, {shown});
  at.out.pass.shaders.push_back({*stage, *resolved, path.span});
}

void read_group(Builder& at, const ast::ShaderStatement& node) {
  int64_t product = 1;
  for (size_t axis = 0; axis < node.group.size(); ++axis) {
    const auto size = evaluate_integer(at.checker, &at.scope, at.scope.module, node.group[axis], 1, 1024);
    if (!size) return void(at.out.dropped = true);
    at.out.pass.dispatch.group[axis] = static_cast<uint32_t>(*size);
    product *= *size;
  }
  constexpr int64_t kMaxInvocations = 1024;
  if (!node.group.empty() && at.out.pass.kind != PassKind::compute) fail(at, DiagnosticKind::GroupOfRaster, node.group[0].span);
  if (product > kMaxInvocations) fail(at, DiagnosticKind::GroupTooLarge, node.span, {std::to_string(product), std::to_string(kMaxInvocations)});
}

void visit(Builder& at, const ast::ShaderStatement& node) {
  at.shader_span = node.span;
  if (node.block) {
    at.out.dropped |= !read_block(at.checker, at.scope, at.out.pass, node);
    return read_group(at, node);
  }
  for (const auto& path : node.paths) add_shader(at, path);
  read_group(at, node);
  const bool unsized = !at.out.dropped && at.out.pass.kind == PassKind::compute && node.group.empty() && !node.paths.empty();
  if (unsized) fail(at, DiagnosticKind::GroupMissing, node.paths.back().span, {std::string(node.paths.back().text)});
  if (!node.fullscreen) return;
  at.fullscreen = at.has_draw = true;
  at.draw_span = node.span;
  at.out.pass.draw.kind = DrawKind::fullscreen;
  const auto& shaders = at.out.pass.shaders;
  if (!at.out.dropped && (shaders.size() != 1 || shaders[0].stage != stage_fragment)) fail(at, DiagnosticKind::FullscreenShader, node.span);
}

void visit(Builder& at, const ast::AccessStatement& node) { add_access(at.checker, at.scope, at.out, node); }
void visit(Builder& at, const ast::TransferStatement& node) { add_transfer(at.checker, at.scope, at.out, node); }
void visit(Builder& at, const ast::HostTransfer& node) { add_host_transfer(at.checker, at.scope, at.out, node); }

void read_dispatch_size(Builder& at, const ast::Expr& expr) {
  const Value size = evaluate_expr(at.checker, &at.scope, at.scope.module, expr);
  if (!size.ok()) return void(at.out.dropped = at.scope.incomplete = true);
  if (size.kind != Value::Kind::integer) return fail(at, DiagnosticKind::NotASize, expr.span);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const ExprId count = to_expr(at.checker, axis < size.axes ? size.at[axis] : Scalar64{1, {}});
    if (const auto few = too_few(at.checker, count, 1)) return fail(at, DiagnosticKind::EmptyDispatch, expr.span, {std::to_string(*few)});
    at.out.pass.dispatch.size[axis] = count;
  }
}

std::optional<uint32_t> add_indirect(Builder& at, const ast::Expr& expr, uint32_t bytes) {
  const Place place = find_place(at.checker, at.scope, expr);
  if (!place.ok()) return at.out.dropped = true, std::nullopt;
  const Resource& buffer = at.scope.graph.resources[place.resource];
  if (buffer.kind != ResourceKind::buffer)
    return fail(at, DiagnosticKind::RoleOfKind, expr.span, {buffer.name, "an image", "indirect"}), std::nullopt;
  const bool simple = !buffer.element.record.valid();
  if (!simple && buffer.stride < bytes)
    return fail(at, DiagnosticKind::IndirectTooSmall, expr.span, {buffer.name, std::to_string(buffer.stride), std::to_string(bytes)}), std::nullopt;
  return add_plain_access(at.scope, at.out, place, Mode::read, Role::indirect);
}

void visit(Builder& at, const ast::DispatchStatement& node) {
  if (at.out.pass.kind != PassKind::compute) return fail(at, DiagnosticKind::DispatchOutsideCompute, node.span);
  if (at.has_dispatch) return fail(at, DiagnosticKind::RepeatedWork, node.span, {"dispatch"});
  at.has_dispatch = true;
  at.dispatch_span = node.span;
  constexpr uint32_t kDispatchBytes = 12;  // VkDispatchIndirectCommand
  Dispatch& dispatch = at.out.pass.dispatch;
  const std::string_view how = node.how.text;
  dispatch.kind = how == "over"       ? DispatchKind::over
                  : how == "groups"   ? DispatchKind::groups
                  : how == "indirect" ? DispatchKind::indirect
                                      : DispatchKind::host;
  if (!node.size) return;
  if (dispatch.kind != DispatchKind::indirect) return read_dispatch_size(at, *node.size);
  dispatch.arguments = add_indirect(at, *node.size, kDispatchBytes).value_or(kAll);
}

ExprId count_expr(Builder& at, const ast::Boxed<ast::Expr>& expr) {
  if (!expr) return to_expr(at.checker, {1, {}});
  const Value value = evaluate_expr(at.checker, &at.scope, at.scope.module, *expr);
  if (!value.ok()) return at.out.dropped = at.scope.incomplete = true, ExprId{};
  if (value.kind != Value::Kind::integer || value.axes != 1) return fail(at, DiagnosticKind::NotAnInteger, expr->span), ExprId{};
  return to_expr(at.checker, value.at[0]);
}

void read_indirect_draw(Builder& at, const ast::DrawStatement& node) {
  Draw& draw = at.out.pass.draw;
  draw.kind = node.counts ? DrawKind::indirect_count : DrawKind::indirect;
  draw.indexed = node.indexed;
  draw.stride = node.indexed ? 20 : 16;  // VkDrawIndexedIndirectCommand, VkDrawIndirectCommand
  if (node.max_draws) {
    const auto most = evaluate_integer(at.checker, &at.scope, at.scope.module, *node.max_draws, 1, UINT32_MAX);
    if (most)
      draw.max_draws = static_cast<uint32_t>(*most);
    else
      at.out.dropped = true;
  }
  const auto arguments = add_indirect(at, *node.arguments, draw.stride);
  if (!arguments) return;
  draw.arguments = *arguments;
  const Resource& buffer = at.scope.graph.resources[at.out.pass.accesses[*arguments].resource];
  if (buffer.element.record.valid()) draw.stride = buffer.stride;
  if (node.counts) draw.counts = add_indirect(at, *node.counts, 4).value_or(kAll);
}

void read_per_draw(Builder& at, const ast::PerDraw& node) {
  constexpr uint32_t kMaxPushBytes = 128;  // what every Vulkan device has
  const StructId type =
      node.declaration ? struct_in_place(at.checker, at.scope.module, *node.declaration) : find_struct(at.checker, at.scope.module, *node.type);
  const Span span = node.type ? node.type->span : node.name.span;
  if (!type.valid() || !check_not_packed(at.checker, type, span)) return void(at.out.dropped = true);
  const Struct& record = at.checker.program.structs[type];
  if (record.size430 > kMaxPushBytes)
    return fail(at, DiagnosticKind::PushConstantsTooLarge, span, {record.name, std::to_string(record.size430), std::to_string(kMaxPushBytes)});
  at.out.pass.draw.per_draw = type;
}

void visit(Builder& at, const ast::DrawStatement& node) {
  if (at.out.pass.kind != PassKind::raster) return fail(at, DiagnosticKind::DrawOutsideRaster, node.span);
  if (at.has_draw) return fail(at, DiagnosticKind::RepeatedWork, node.span, {"draw"});
  at.has_draw = true;
  at.draw_span = node.span;
  Draw& draw = at.out.pass.draw;
  if (node.host)
    draw.kind = DrawKind::host;
  else if (node.indirect && node.arguments)
    read_indirect_draw(at, node);
  else if (node.vertices) {
    draw.kind = DrawKind::direct;
    draw.indexed = node.indexed;
    draw.vertices = count_expr(at, node.vertices);
    draw.instances = count_expr(at, node.instances);
    if (node.first) draw.first = count_expr(at, node.first);
    if (node.offset) draw.offset = count_expr(at, node.offset);
  }
  if (node.per_draw) read_per_draw(at, *node.per_draw);
  for (const ast::VertexStatement& vertex : node.vertex) {
    const StructId type = find_struct(at.checker, at.scope.module, vertex.type);
    if (!type.valid())
      at.out.dropped = true;
    else
      draw.vertex.push_back({type, vertex.per_instance, kAll});
  }
}

void visit(Builder& at, const ast::ParamsStatement& node) {
  if (node.name.empty()) return;
  const std::string name(node.name.text);
  if (node.type) {
    const StructId type = find_struct(at.checker, at.scope.module, *node.type);
    if (!type.valid() || !check_not_packed(at.checker, type, node.type->span)) return void(at.out.dropped = true);
    const ParamsId own = at.scope.graph.params.add({name, type, PassId{at.scope.graph.passes.size()}, node.span});
    return at.out.pass.params.push_back({name, own, node.span});
  }
  const auto bound =
      std::find_if(at.scope.bindings.rbegin(), at.scope.bindings.rend(), [&](const Binding& binding) { return binding.name == node.name.text; });
  if (bound != at.scope.bindings.rend() && bound->kind == Binding::Kind::params)
    return at.out.pass.params.push_back({name, bound->params, node.span});
  const auto found = at.scope.params.find(name);
  if (found != at.scope.params.end()) return at.out.pass.params.push_back({name, found->second, node.span});
  if (at.scope.failed.count(name) || at.checker.lost_names) return void(at.out.dropped = true);
  std::vector<std::string_view> candidates;
  for (const Params& params : at.scope.graph.params)
    if (!params.pass.valid()) candidates.push_back(params.name);
  Diagnostic diagnostic(DiagnosticKind::UnknownName, node.name.span, {"parameter block", name});
  const Guess guess = closest(name, candidates);
  suggest(diagnostic, node.name.span, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  at.out.dropped = true;
}

void read_after(Builder& at, const ast::Expr& value) {
  const auto evaluated = evaluated_name(at.checker, at.scope, value);
  if (!evaluated) return void(at.out.dropped = true);
  const std::string name = at.scope.prefix + *evaluated;
  const auto found = at.scope.passes.find(name);
  if (found != at.scope.passes.end()) return at.out.pass.after.push_back(found->second);
  if (at.checker.lost_names || at.scope.failed.count("pass " + name)) return void(at.out.dropped = true);
  std::vector<std::string_view> candidates;
  for (const Pass& pass : at.scope.graph.passes)
    if (pass.name.starts_with(at.scope.prefix)) candidates.push_back(std::string_view(pass.name).substr(at.scope.prefix.size()));  // as called here
  Diagnostic diagnostic(DiagnosticKind::UnknownEarlierPass, value.span, {name, at.out.pass.name});
  Guess guess = closest(*evaluated, candidates);
  guess.certain = guess.certain && spelled(value) == *evaluated && guess.words[0].find('[') == std::string::npos;  // an index may be a variable
  suggest(diagnostic, value.span, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  at.out.dropped = true;
}

void read_state(Builder& at, const ast::WordStatement& node) {
  const auto symbol = find_symbol(at.checker, at.scope.module, *node.value, SymbolKind::state);
  if (!symbol) return void(at.out.dropped = true);
  if (at.out.pass.kind != PassKind::raster) return fail(at, DiagnosticKind::StateOutsideRaster, node.span);
  if (at.out.pass.state.valid()) return fail(at, DiagnosticKind::RepeatedWork, node.span, {"state"});
  at.out.pass.state = state_of(at.checker, *symbol);
}

void read_multiview(Builder& at, const ast::WordStatement& node) {
  if (at.out.pass.kind != PassKind::raster) return fail(at, DiagnosticKind::MultiviewOfPass, node.span, {at.out.pass.name, "it is no raster pass"});
  if (at.out.pass.multiview) return fail(at, DiagnosticKind::RepeatedWork, node.span, {"multiview"});
  at.out.pass.multiview = true;
}

// A plan has one set of the engine for each pass. Bundles may each say the same.
void bind_set(Builder& at, const std::string& name, Span span) {
  std::string& bound = at.out.pass.bind;
  if (!bound.empty() && bound != name) return fail(at, DiagnosticKind::SecondBind, span, {at.out.pass.name, bound, name});
  bound = name;
}

void visit_all(Builder& at, const std::vector<ast::Statement>& statements);

// `with world`: the statements of the bundle, as if they stood here.
void read_bundle(Builder& at, const ast::Expr& value) {
  constexpr size_t kMaxDepth = 100, kMaxStatements = 4096;  // both of one pass
  const std::string name = spelled(value);
  const auto found = at.scope.bundles.find(at.scope.prefix + name);
  if (found == at.scope.bundles.end()) {
    at.out.dropped = at.scope.incomplete = true;
    if (at.checker.lost_names) return;
    std::vector<std::string_view> candidates;
    for (const auto& [known, bundle] : at.scope.bundles) candidates.push_back(bundle->name.text);
    std::sort(candidates.begin(), candidates.end());
    Diagnostic diagnostic(DiagnosticKind::UnknownName, value.span, {"bundle", name});
    const Guess guess = closest(name, candidates);
    suggest(diagnostic, value.span, guess);
    at.checker.diagnostics.report(std::move(diagnostic));
    return;
  }
  const ast::BundleDeclaration* bundle = found->second;
  if (std::find(at.open.begin(), at.open.end(), bundle) != at.open.end()) return fail(at, DiagnosticKind::NeedsItself, value.span, {name});
  if (at.open.size() >= kMaxDepth) return fail(at, DiagnosticKind::NestingTooDeep, value.span, {std::to_string(kMaxDepth)});
  if (at.bundled > kMaxStatements) return void(at.out.dropped = true);  // reported
  at.bundled += std::max<size_t>(bundle->statements.size(), 1);
  if (at.bundled > kMaxStatements)
    return fail(at, DiagnosticKind::BundlesTooLong, at.node.name.span, {at.out.pass.name, std::to_string(kMaxStatements)});
  at.out.dropped |= bundle->has_error;
  at.open.push_back(bundle);
  const size_t told = at.checker.diagnostics.rows().size();
  visit_all(at, bundle->statements);
  note_since(at.checker, told, value.span, name);
  at.open.pop_back();
}

void visit(Builder& at, const ast::WordStatement& node) {
  if (node.word.text == "keep") return void(at.out.pass.keep = true);
  if (node.word.text == "multiview") return read_multiview(at, node);
  if (!node.value || node.value->kind == ast::ExprKind::error) return void(at.out.dropped = true);
  if (node.word.text == "after") return read_after(at, *node.value);
  if (node.word.text == "state") return read_state(at, node);
  if (node.word.text == "with") return read_bundle(at, *node.value);
  const auto symbol = find_symbol(at.checker, at.scope.module, *node.value, SymbolKind::set);
  if (!symbol) return void(at.out.dropped = true);
  bind_set(at, std::string(at.checker.symbols[*symbol].name.text), node.span);
}

void visit(Builder& at, const ast::FeaturesStatement& node) {
  if (!add_features(at.checker, at.scope, at.out.pass, node)) at.out.dropped = at.scope.incomplete = true;
}

void visit(Builder& at, const ast::SpectrumStatement& node) {
  if (!add_spectrum(at.checker, at.scope, at.out, node)) at.out.dropped = at.scope.incomplete = true;
}

void visit_all(Builder& at, const std::vector<ast::Statement>& statements) {
  for (const ast::Statement& statement : statements) std::visit([&](const auto& node) { visit(at, node); }, statement);
}

void read_heading(Builder& at) {
  const std::string_view kind = at.node.kind.text, queue = at.node.queue.text;
  Pass& pass = at.out.pass;
  pass.kind = kind == "raster" ? PassKind::raster : kind == "compute" ? PassKind::compute : kind == "transfer" ? PassKind::transfer : PassKind::host;
  pass.queue = queue == "compute" ? QueueKind::compute : queue == "transfer" ? QueueKind::transfer : QueueKind::graphics;
  pass.queue_may = at.node.queue_may;
  const bool fits = pass.queue == QueueKind::graphics || (pass.queue == QueueKind::compute && pass.kind != PassKind::raster) ||
                    (pass.queue == QueueKind::transfer && pass.kind == PassKind::transfer);
  if (!fits) fail(at, DiagnosticKind::QueueOfKind, at.node.queue.span, {std::string(kind), std::string(queue), pass.name});
  pass.module = at.checker.modules[at.scope.module].name;
  pass.span = at.node.span;
  pass.guard = at.scope.guard;
  pass.conditions = at.scope.conditions;
  pass.fusion = at.scope.fusion;
}

bool has_stage(const Pass& pass, Stage stage) {
  return std::any_of(pass.shaders.begin(), pass.shaders.end(), [&](const Shader& shader) { return shader.stage == stage; });
}

// Shaders need work, work needs shaders, unless the host records.
void check_work(Builder& at) {
  Pass& pass = at.out.pass;
  if (at.out.dropped) return;
  const bool shaders = !pass.shaders.empty();
  if (pass.kind == PassKind::compute && shaders && !at.has_dispatch) fail(at, DiagnosticKind::ShaderWithoutDispatch, at.shader_span, {pass.name});
  if (pass.kind == PassKind::compute && !shaders && at.has_dispatch && pass.dispatch.kind != DispatchKind::host)
    fail(at, DiagnosticKind::DispatchWithoutShader, pass.span, {pass.name});
  if (pass.kind == PassKind::raster && shaders && !at.has_draw) fail(at, DiagnosticKind::ShaderWithoutDraw, at.shader_span, {pass.name});
  const bool host_draws = pass.draw.kind == DrawKind::host || pass.draw.kind == DrawKind::none;
  if (pass.kind == PassKind::raster && !shaders && !host_draws) fail(at, DiagnosticKind::DrawWithoutShader, at.draw_span, {pass.name});
  const bool no_vertex = pass.kind == PassKind::raster && shaders && !at.fullscreen && !has_stage(pass, stage_vertex);
  if (no_vertex) fail(at, DiagnosticKind::NoVertexShader, at.shader_span, {pass.name});
  if (pass.kind == PassKind::raster && pass.draw.kind == DrawKind::none) pass.draw.kind = DrawKind::host;
  if (pass.kind == PassKind::compute && pass.dispatch.kind == DispatchKind::none) pass.dispatch.kind = DispatchKind::host;
}

// Where the work may touch less than the range, `write` promises nothing and old contents count.
bool may_leave(const Builder& at, const Access& access) {
  if (access.covers || !is_shader_role(access.role)) return false;
  const Pass& pass = at.out.pass;
  return (pass.kind == PassKind::raster && !at.fullscreen) || pass.dispatch.kind == DispatchKind::indirect;
}

// Tests that fragments may fail.
bool may_reject(const Builder& at) {
  const Pass& pass = at.out.pass;
  if (!pass.state.valid()) return false;
  const State& state = at.checker.program.states[pass.state];
  const auto has = [&](uint32_t aspect) {
    return std::any_of(pass.accesses.begin(), pass.accesses.end(),
                       [&](const Access& access) { return is_attachment(access.role) && (access.range.aspects & aspect) != 0; });
  };
  const bool stencil = state.stencil_front.compare != Compare::always || state.stencil_back.compare != Compare::always;
  return (state.depth_test && state.depth_compare != Compare::always && has(aspect_depth)) || (state.stencil_test && stencil && has(aspect_stencil));
}

void settle_modes(Builder& at) {
  const bool fills = at.fullscreen && !may_reject(at);
  for (Access& access : at.out.pass.accesses) {
    const bool covered = fills && access.role == Role::color && !access.blend.enabled && access.mode == Mode::update && !access.clear;
    if (covered) access.mode = is_slice(access) ? Mode::update : Mode::write, access.covers = true;
    if (access.mode == Mode::write && !access.clear && may_leave(at, access)) access.mode = Mode::update;
  }
}

uint32_t default_stages(const Pass& pass, Role role) {
  if (!pass.shaders.empty() || !is_shader_role(role)) return 0;
  if (pass.kind == PassKind::compute) return stage_compute;
  return pass.kind == PassKind::raster ? stage_fragment : 0u;
}

void settle_stages(Pass& pass) {
  for (Access& access : pass.accesses)
    if (access.stages == 0) access.stages = default_stages(pass, access.role);
}

PassId add_pass(Builder& at, Pass pass) {
  const std::string name = pass.name;
  const PassId id = at.scope.graph.passes.add(std::move(pass));
  at.scope.passes.emplace(name, id);
  return id;
}

void own_params(Graph& graph, const Pass& pass, PassId id) {
  for (const ParamsUse& use : pass.params)
    if (graph.params[use.id].pass.valid()) graph.params[use.id].pass = id;
}

void add_passes(Builder& at) {
  Pass pass = std::move(at.out.pass);
  Pass clear = clear_pass(at.scope.graph, pass);
  for (const Access& access : clear.accesses)
    if (access.range.mip > 0) clear.mip_limits = pass.mip_limits;
  if (!clear.transfers.empty()) {
    name_hidden_accesses(clear);
    clear.after = pass.after;
    add_pass(at, std::move(clear));
  }
  own_params(at.scope.graph, pass, PassId{at.scope.graph.passes.size()});
  add_pass(at, std::move(pass));
}

void note_told(Builder& at, size_t first) {
  for (const auto& rows = at.checker.diagnostics.rows(); first < rows.size(); ++first)
    for (const Access& access : at.out.pass.accesses)
      if (access.span == rows[first].span) at.scope.told.insert(static_cast<uint32_t>(access.resource.value));
}

bool claim_name(Builder& at) {
  const auto existing = at.scope.passes.find(at.out.pass.name);
  if (existing == at.scope.passes.end()) return true;
  report_duplicate(at.checker, at.node.name, at.scope.graph.passes[existing->second].span);
  at.scope.incomplete = true;
  return false;
}

void drop_pass(Builder& at) {
  at.scope.incomplete = true;
  at.scope.failed["pass " + at.out.pass.name] = true;
  for (Binding& binding : at.scope.bindings) binding.written |= binding.is_out;  // which may be what was wrong
}

}  // namespace

void declare_pass(Checker& checker, GraphScope& scope, const ast::PassDeclaration& declaration) {
  Builder at{checker, scope, declaration, {}, false, false, false, {}, {}, {}};
  const auto name = declaration.name.empty() ? std::nullopt : indexed_name(checker, scope, declaration.name, declaration.index);
  if (!name) return void(scope.incomplete = true);
  at.out.pass.name = *name;
  if (!claim_name(at)) return;
  if (declaration.kind.empty()) return drop_pass(at);
  read_heading(at);
  visit_all(at, declaration.statements);
  at.out.dropped |= declaration.has_error;
  check_work(at);
  if (at.out.dropped) return drop_pass(at);
  merge_reads_and_writes(at.out.pass);
  if (!bind_buffers(checker, scope.graph, at.out.pass, at.draw_span)) return drop_pass(at);
  if (!check_amounts(checker, scope.graph, at.out.pass, at.has_dispatch ? at.dispatch_span : at.draw_span)) return drop_pass(at);
  settle_modes(at);
  settle_stages(at.out.pass);
  name_hidden_accesses(at.out.pass);
  const size_t told = checker.diagnostics.rows().size();
  check_pass_rules(checker, scope.graph, at.out.pass);
  note_told(at, told);
  if (!check_spectrum_pass(checker, scope.graph, at.out.pass)) return drop_pass(at);
  if (!check_block(checker, scope, at.out.pass, at.dispatch_span)) return drop_pass(at);
  add_passes(at);
}

}  // namespace rg::dsl
