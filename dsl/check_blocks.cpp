// Blocks, shaders written for one element, and `fuse`, which makes one kernel of several.
#include <algorithm>

#include "dsl/check_state.h"
#include "dsl/format_table.h"
#include "dsl/paths.h"
#include "dsl/print.h"

namespace rg::dsl {
namespace {

constexpr std::string_view kSuffix = ".glsl";
constexpr uint32_t kMaxCarryBytes = 256;

bool read_scan(Checker& checker, GraphScope& scope, Block& block, const ast::ShaderStatement& node) {
  if (node.scan.empty()) return true;
  if (!node.carry) return false;
  block.scan = static_cast<uint32_t>(node.scan.text[0] - 'x');
  block.associative = node.associative;
  const auto type = element_type(checker, scope.module, *node.carry);
  if (!type || !check_not_packed(checker, type->record, node.carry->span)) return false;
  block.carry = *type;
  const uint32_t bytes = type->record.valid() ? checker.program.structs[type->record].size430 : 0;
  if (!node.carry->count && !node.carry->unsized && bytes <= kMaxCarryBytes) return true;
  checker.report(DiagnosticKind::ScanType, node.carry->span, {print_type(checker.program, *type), std::to_string(kMaxCarryBytes)});
  return false;
}

bool is_one(const Program& program, ExprId id) { return !id.valid() || program.exprs[id] == Expr{ExprOp::constant, {}, {}, 1}; }

// Axes up to the last one that is not 1 for certain.
uint32_t domain_axes(const Program& program, const Dispatch& dispatch) {
  return !is_one(program, dispatch.size[2]) ? 3 : !is_one(program, dispatch.size[1]) ? 2 : 1;
}

// A block without `group` leaves the shape to the compiler: rows, tiles or clusters; one element along the axis it walks.
void default_group(Pass& pass) {
  constexpr uint32_t kShapes[4][3] = {{1, 1, 1}, {64, 1, 1}, {8, 8, 1}, {4, 4, 4}};
  const Block& block = *pass.block;
  if (block.sized) return;
  const bool walks = block.scan != kAll && !block.associative;
  const uint32_t* shape = kShapes[walks ? block.axes - 1 : block.axes];
  for (uint32_t axis = 0; axis < 3; ++axis) pass.dispatch.group[axis] = walks && axis == block.scan ? 1 : *shape++;
}

struct Rules {
  Checker& checker;
  GraphScope& scope;
  const Pass& pass;
};

Scalar64 scalar(const Program& program, ExprId id) {
  const Expr& expr = program.exprs[id];
  return expr.op == ExprOp::constant ? Scalar64{expr.value, {}} : Scalar64{0, id};
}

// The size that an image or a buffer with one element for each of the block's has.
bool fits_domain(const Rules& at, const Access& access, const Value& size) {
  const ExprId(&domain)[3] = at.pass.dispatch.size;
  Checker& checker = at.checker;
  if (at.scope.graph.resources[access.resource].kind == ResourceKind::image) {
    for (uint32_t axis = 0; axis < 3; ++axis)
      if (to_expr(checker, axis < size.axes ? size.at[axis] : Scalar64{1, {}}) != domain[axis]) return false;
    return true;
  }
  Scalar64 count = scalar(checker.program, domain[0]);
  for (uint32_t axis = 1; axis < at.pass.block->axes; ++axis)
    count = combine(checker, ExprOp::mul, count, scalar(checker.program, domain[axis]), access.span);
  return to_expr(checker, size.at[0]) == to_expr(checker, count);
}

std::string size_text(Checker& checker, const Value& size) {
  std::string text;
  for (uint32_t axis = 0; axis < size.axes; ++axis) text += (axis == 0 ? "" : ", ") + print_expr(checker.program, to_expr(checker, size.at[axis]));
  return size.axes == 1 ? text : "[" + text + "]";
}

std::string domain_text(const Program& program, const Pass& pass) {
  std::string text;
  for (uint32_t axis = 0; axis < pass.block->axes; ++axis) text += (axis == 0 ? "" : ", ") + print_expr(program, pass.dispatch.size[axis]);
  return pass.block->axes == 1 ? text : "[" + text + "]";
}

bool refuse(const Rules& at, const Access& access, std::string why) {
  at.checker.report(DiagnosticKind::ElementShape, access.span, {at.scope.graph.resources[access.resource].name, at.pass.name, std::move(why)});
  return false;
}

bool check_element(const Rules& at, const Access& access) {
  const Resource& resource = at.scope.graph.resources[access.resource];
  if (resource.kind == ResourceKind::image) {
    if (resource.samples > 1) return refuse(at, access, "it has several samples a texel");
    if (resource.dimension == Dimension::cube || layer_count(resource, access.range) > 1) return refuse(at, access, "it has layers; name one");
    if (resource.dimension == Dimension::d1 && at.pass.block->axes > 1) return refuse(at, access, "it has one axis");
  } else if (access.range.offset.valid()) {
    return refuse(at, access, "of a buffer it takes the whole");
  }
  Place place;
  place.resource = access.resource, place.range = access.range, place.age = access.age, place.span = access.span;
  const Value size = size_of(at.checker, at.scope, place);
  if (!size.ok()) return false;
  if (fits_domain(at, access, size)) return true;
  return refuse(at, access, "its size is " + size_text(at.checker, size) + ", that of the pass " + domain_text(at.checker.program, at.pass));
}

bool check_elements(const Rules& at) {
  bool good = true;
  for (const Access& access : at.pass.accesses) {
    if (!access.element) continue;
    if (!at.pass.block) {
      at.checker.report(DiagnosticKind::ElementWithoutBlock, access.span, {at.scope.graph.resources[access.resource].name, at.pass.name});
      good = false;
    } else {
      good = check_element(at, access) && good;
    }
  }
  return good;
}

// The kernel has to know where its domain ends: from an image of that size, or because the size is constant.
bool knows_domain(const Rules& at) {
  const auto constant = [&](ExprId id) { return at.checker.program.exprs[id].op == ExprOp::constant; };
  const auto image = [&](const Access& access) { return access.element && at.scope.graph.resources[access.resource].kind == ResourceKind::image; };
  const auto& accesses = at.pass.accesses;
  return std::all_of(at.pass.dispatch.size, at.pass.dispatch.size + 3, constant) || std::any_of(accesses.begin(), accesses.end(), image);
}

bool refuse_block(const Rules& at, Span span, std::string why) {
  at.checker.report(DiagnosticKind::BlockOfPass, span, {at.pass.name, std::move(why)});
  return false;
}

bool check_shape(const Rules& at, Span dispatch) {
  const Block& block = *at.pass.block;
  const Span shader = at.pass.shaders.front().span;
  if (at.pass.spectrum.valid()) return refuse_block(at, shader, "a spectrum runs whole shaders");
  if (at.pass.dispatch.kind != DispatchKind::over) return refuse_block(at, dispatch, "its elements are those of `dispatch over`");
  if (block.scan != kAll && block.scan >= block.axes)
    return refuse_block(at, shader, std::string("it walks along ") + "xyz"[block.scan] + ", an axis that its size does not have");
  const bool across = block.scan != kAll && !block.associative && at.pass.dispatch.group[block.scan] != 1;
  if (across)
    return refuse_block(at, shader, std::string("a group walks one element at a time along ") + "xyz"[block.scan] + " unless `associative`");
  if (!knows_domain(at))
    return refuse_block(at, dispatch, "where its elements end is known from an image `as element`, or because the size is constant");
  return true;
}

}  // namespace

bool read_block(Checker& checker, GraphScope& scope, Pass& pass, const ast::ShaderStatement& node) {
  if (node.paths.empty()) return false;
  const ast::ShaderStatement::Path& path = node.paths.front();
  const auto fail = [&](DiagnosticKind kind, Span span, std::vector<std::string> arguments) {
    checker.report(kind, span, std::move(arguments));
    scope.incomplete = true;
    return false;
  };
  if (pass.kind != PassKind::compute) return fail(DiagnosticKind::BlockOfPass, node.span, {pass.name, "it is no compute pass"});
  if (node.paths.size() > 1) return fail(DiagnosticKind::BlockOfPass, node.paths[1].span, {pass.name, "one file holds it"});
  if (!path.text.ends_with(kSuffix)) return fail(DiagnosticKind::BlockSuffix, path.span, {std::string(path.text)});
  if (!pass.shaders.empty()) return fail(DiagnosticKind::RepeatedWork, node.span, {"block"});
  const auto resolved = join_inside(checker.modules[scope.module].folder, path.text);
  if (!resolved) return fail(DiagnosticKind::ShaderEscapes, path.span, {std::string(path.text)});
  Block block;
  block.sized = !node.group.empty();
  if (!read_scan(checker, scope, block, node)) return scope.incomplete = true, false;
  pass.shaders.push_back({stage_compute, *resolved, path.span});
  pass.block = block;
  return true;
}

bool check_block(Checker& checker, GraphScope& scope, Pass& pass, Span dispatch) {
  if (pass.block && pass.dispatch.kind == DispatchKind::over) {
    pass.block->axes = domain_axes(checker.program, pass.dispatch);
    default_group(pass);
  }
  const Rules rules{checker, scope, pass};
  if (pass.block && !check_shape(rules, dispatch)) return false;
  return check_elements(rules);
}

FusionId declare_fusion(Checker& checker, GraphScope& scope, const ast::Fuse& node) {
  if (node.name.empty()) return {};
  if (scope.fusion.valid()) {
    checker.report(DiagnosticKind::FuseInFuse, node.span, {std::string(node.name.text)})
        .note(DiagnosticKind::FirstIsHere, scope.graph.fusions[scope.fusion].span);
    return {};
  }
  Fusion fusion;
  fusion.name = scope.prefix + std::string(node.name.text);
  fusion.may = node.may;
  fusion.unrounded = node.unrounded;
  fusion.span = node.span;
  if (node.term) {
    fusion.when = feature_term(checker, scope.module, *node.term);
    if (!fusion.when) return {};
  }
  if (const auto taken = scope.passes.find(fusion.name); taken != scope.passes.end()) {
    report_duplicate(checker, node.name, scope.graph.passes[taken->second].span);
    return {};
  }
  for (const Fusion& other : scope.graph.fusions)
    if (other.name == fusion.name) return report_duplicate(checker, node.name, other.span), FusionId{};
  return scope.graph.fusions.add(std::move(fusion));
}

void finish_fusion(Checker& checker, const GraphScope& scope, FusionId id) {
  const Fusion& fusion = scope.graph.fusions[id];
  size_t blocks = 0;
  for (const Pass& pass : scope.graph.passes) {
    if (pass.fusion != id) continue;
    blocks += pass.block ? 1 : 0;
    if (!pass.block && !fusion.may) checker.report(DiagnosticKind::FuseNoBlock, pass.span, {fusion.name, pass.name});
  }
  if (blocks < 2 && !scope.incomplete) checker.report(DiagnosticKind::FuseTooFew, fusion.span, {fusion.name, std::to_string(blocks)});
}

}  // namespace rg::dsl
