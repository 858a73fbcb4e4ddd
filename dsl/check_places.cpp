// RES: `name`, `name[i]`, `parameter.member`, then `.mip(i)`, `.mips(a, n)`, `.layer(i)`, `.layers(a, n)`, `.depth`, `.stencil`, `.bytes(o, n)`,
// `.prev(k)`.
#include <algorithm>

#include "dsl/check_state.h"

namespace rg::dsl {

using ast::ExprKind;

namespace {

using ast::Expr;

struct Walk {
  Checker& checker;
  GraphScope& scope;
};

const Expr& root_of(const Expr& expr) {
  const Expr* at = &expr;
  while (at->kind == ExprKind::member || at->kind == ExprKind::index || at->kind == ExprKind::call) at = &at->operands[0];
  return *at;
}

const Binding* find_binding(const GraphScope& scope, std::string_view name, Binding::Kind kind) {
  const auto at = std::find_if(scope.bindings.rbegin(), scope.bindings.rend(), [&](const Binding& binding) { return binding.name == name; });
  return at != scope.bindings.rend() && at->kind == kind ? &*at : nullptr;
}

Place whole(const GraphScope& scope, ResourceId id, Span span) {
  Place place;
  place.resource = id;
  place.span = span;
  std::string name = scope.graph.resources[id].name;
  const size_t dot = name.rfind('.');
  if (dot != std::string::npos) name.erase(0, dot + 1);
  name.resize(std::min(name.size(), name.find('[')));
  place.default_name = name;
  return place;
}

std::optional<ResourceId> lookup(const GraphScope& scope, const std::string& name) {
  const auto at = scope.resources.find(name);
  if (at == scope.resources.end()) return std::nullopt;
  return at->second;
}

// `scene.lights`, if exactly one interface has a member `lights`.
std::string member_called(const GraphScope& scope, const std::string& name) {
  std::string found;
  for (const auto& [parameter, symbol] : scope.interfaces) {
    const std::string full = parameter + "." + name;
    if (!scope.resources.count(full)) continue;
    if (!found.empty()) return {};
    found = full;
  }
  return found;
}

void report_unknown(Walk walk, const Expr& expr, const std::string& name) {
  walk.scope.incomplete = true;
  if (walk.checker.lost_names || !walk.scope.failed.emplace(walk.scope.prefix + name, true).second)
    return;  // one mistake, however often it is repeated
  const std::string_view prefix = walk.scope.prefix;
  std::vector<std::string_view> candidates;  // as they are called here
  for (const Resource& known : walk.scope.graph.resources)
    if (known.name.starts_with(prefix)) candidates.push_back(std::string_view(known.name).substr(prefix.size()));
  for (const Binding& binding : walk.scope.bindings)
    if (binding.kind == Binding::Kind::place) candidates.push_back(binding.name);
  Diagnostic diagnostic(DiagnosticKind::UnknownName, expr.span, {"resource", name});
  const std::string member = member_called(walk.scope, name);
  const std::string_view here = name.starts_with(prefix) ? std::string_view(name).substr(prefix.size()) : std::string_view(name);
  Guess guess = member.empty() ? closest(here, candidates) : Guess{{member}, true};
  guess.certain = guess.certain && spelled(expr) == here && guess.words[0].find('[') == std::string::npos;  // an index may be a variable
  suggest(diagnostic, expr.span, guess);
  walk.checker.diagnostics.report(std::move(diagnostic));
}

Place find_root(Walk walk, const Expr& expr) {
  if (const Binding* binding = find_binding(walk.scope, expr.text, Binding::Kind::place)) {
    Place place = binding->place;
    place.span = expr.span;
    place.default_name = std::string(binding->name);
    if (!binding->writable) place.read_only = binding;
    if (binding->is_out) place.port = const_cast<Binding*>(binding);
    return place;
  }
  const std::string name = walk.scope.prefix + std::string(expr.text);
  if (const auto id = lookup(walk.scope, name)) return whole(walk.scope, *id, expr.span);
  if (walk.scope.families.count(name)) {
    walk.scope.incomplete = true;
    walk.checker.report(DiagnosticKind::NeedsIndex, expr.span, {std::string(expr.text)});
    return {};
  }
  if (const auto symbol = peek_symbol(walk.checker, walk.scope.module, expr)) {
    walk.scope.incomplete = true;
    const Symbol& found = walk.checker.symbols[*symbol];
    walk.checker.report(DiagnosticKind::WrongKindOfName, expr.span, {std::string(expr.text), with_article(describe(found.kind)), "a resource"})
        .note(DiagnosticKind::DeclaredHere, found.name.span, {std::string(expr.text)});
    return {};
  }
  report_unknown(walk, expr, std::string(expr.text));
  return {};
}

Place fail(Walk walk, DiagnosticKind kind, Span span, std::vector<std::string> arguments) {
  walk.scope.incomplete = true;
  walk.checker.report(kind, span, std::move(arguments));
  return {};
}

const Expr& family_of(const Expr& expr) { return expr.kind == ExprKind::index ? family_of(expr.operands[0]) : expr; }

// `[2][0]`
std::optional<std::string> index_text(Checker& checker, GraphScope& scope, const Expr& expr) {
  if (expr.kind != ExprKind::index) return std::string();
  const auto outer = index_text(checker, scope, expr.operands[0]);
  const auto index = outer ? evaluate_integer(checker, &scope, scope.module, expr.operands[1], 0, UINT32_MAX) : std::nullopt;
  if (!index) return std::nullopt;
  return *outer + "[" + std::to_string(*index) + "]";
}

// `2` for `[2]`; several stay as they are.
std::string shown_index(const std::string& indices) {
  const bool one = indices.find('[', 1) == std::string::npos;
  return one ? indices.substr(1, indices.size() - 2) : indices;
}

Place find_indexed(Walk walk, const Expr& expr) {
  const Expr& base = family_of(expr);
  if (base.kind != ExprKind::name) return fail(walk, DiagnosticKind::NotAPlace, expr.span, {});
  const std::string family = walk.scope.prefix + std::string(base.text);
  if (!walk.scope.families.count(family)) {
    const Place plain = find_root(walk, base);
    if (plain.ok()) return fail(walk, DiagnosticKind::NotIndexed, expr.span, {std::string(base.text)});
    return {};
  }
  const auto indices = index_text(walk.checker, walk.scope, expr);
  if (!indices) return walk.scope.incomplete = true, Place{};
  const std::string name = family + *indices;
  if (const auto id = lookup(walk.scope, name)) return whole(walk.scope, *id, expr.span);
  if (walk.scope.failed.count(name)) return walk.scope.incomplete = true, Place{};
  return fail(walk, DiagnosticKind::IndexNotDeclared, expr.span, {std::string(base.text), shown_index(*indices)});
}

bool is_format_aspect(const Resource& resource, uint32_t aspect) { return (info(resource.format).aspects & aspect) != 0; }

Place take_aspect(Walk walk, const Expr& expr, Place place, uint32_t aspect) {
  const Resource& resource = walk.scope.graph.resources[place.resource];
  if (resource.kind == ResourceKind::buffer || !is_format_aspect(resource, aspect))
    return fail(walk, DiagnosticKind::NoSuchAspect, expr.span, {resource.name, std::string(expr.text)});
  place.range.aspects = aspect;
  if (aspect == aspect_stencil) place.default_name += "_stencil";
  return place;
}

Place member_place(Walk walk, const Expr& expr) {
  const Expr& owner = expr.operands[0];
  const bool instance = owner.kind == ExprKind::index && walk.scope.instances.count(walk.scope.prefix + std::string(family_of(owner).text));
  if (owner.kind == ExprKind::name || instance) {
    const auto indices = index_text(walk.checker, walk.scope, owner);
    if (!indices) return walk.scope.incomplete = true, Place{};
    const std::string name = walk.scope.prefix + std::string(family_of(owner).text) + *indices;
    const std::string full = name + "." + std::string(expr.text);
    if (const auto id = lookup(walk.scope, full)) return whole(walk.scope, *id, expr.span);
    if (walk.scope.interfaces.count(name) || instance) {
      report_unknown(walk, expr, full);
      return {};
    }
  }
  Place place = find_place(walk.checker, walk.scope, owner);
  if (!place.ok()) return place;
  place.span = expr.span;
  if (expr.text == "depth") return take_aspect(walk, expr, std::move(place), aspect_depth);
  if (expr.text == "stencil") return take_aspect(walk, expr, std::move(place), aspect_stencil);
  const auto length = static_cast<uint32_t>(expr.text.size());
  const Span span{expr.span.file, expr.span.end - length, expr.span.end};
  walk.scope.incomplete = true;
  Diagnostic diagnostic(DiagnosticKind::UnknownPart, span, {std::string(expr.text)});
  const Guess guess = closest(expr.text, {"mip", "mips", "layer", "layers", "slice", "slices", "depth", "stencil", "bytes", "prev", "view"});
  suggest(diagnostic, span, guess);
  walk.checker.diagnostics.report(std::move(diagnostic));
  return {};
}

std::optional<int64_t> argument(Walk walk, const Expr& call, size_t index, int64_t least, int64_t greatest) {
  const auto value = evaluate_integer(walk.checker, &walk.scope, walk.scope.module, call.operands[index + 1], least, greatest);
  if (!value) walk.scope.incomplete = true;
  return value;
}

// A subrange [first, first + count) of what `place` has so far.
bool narrow(Walk walk, const Expr& call, uint32_t have, const char* what, bool many, uint32_t& first, uint32_t& count) {
  const auto begin = argument(walk, call, 0, INT32_MIN, INT32_MAX);
  const auto length = many ? argument(walk, call, 1, INT32_MIN, INT32_MAX) : std::optional<int64_t>(1);
  if (!begin || !length) return false;
  if (*begin < 0 || *length < 1 || *begin + *length > have) {
    const std::string asked = *length == 1 ? std::to_string(*begin) : std::to_string(*begin) + " to " + std::to_string(*begin + *length - 1);
    fail(walk, DiagnosticKind::NoSuchSubresource, call.span, {spelled(root_of(call)), std::to_string(have), what, asked});
    return false;
  }
  first += static_cast<uint32_t>(*begin);
  count = static_cast<uint32_t>(*length);
  return true;
}

Place take_mips(Walk walk, const Expr& call, Place place, bool many) {
  const Resource& resource = walk.scope.graph.resources[place.resource];
  if (!narrow(walk, call, mip_count(resource, place.range), "mips", many, place.range.mip, place.range.mips)) return {};
  return place;
}

Place take_layers(Walk walk, const Expr& call, Place place, bool many) {
  const Resource& resource = walk.scope.graph.resources[place.resource];
  if (!narrow(walk, call, layer_count(resource, place.range), "layers", many, place.range.layer, place.range.layers)) return {};
  return place;
}

// Slices that the image has at every extent; of a depth known now all of them are the whole.
Place take_slices(Walk walk, const Expr& call, Place place, bool many) {
  const Resource& image = walk.scope.graph.resources[place.resource];
  if (image.dimension != Dimension::d3)
    return fail(walk, DiagnosticKind::PartOfOtherKind, call.span, {image.name, "no 3D image", many ? "slices" : "slice"});
  const uint32_t depth = least_depth(walk.checker, image, place.range.mip);
  uint32_t first = 0, count = 0;
  if (!narrow(walk, call, depth, "slices", many, first, count)) return {};
  const bool whole = count == depth && walk.checker.program.exprs[image.depth].op == ExprOp::constant;
  if (!whole) place.range.slice = first, place.range.slices = count;
  return place;
}

Place take_previous(Walk walk, const Expr& call, Place place) {
  const Resource& resource = walk.scope.graph.resources[place.resource];
  if (resource.history == 0) {
    walk.scope.incomplete = true;
    walk.checker.report(DiagnosticKind::NoHistory, call.span, {resource.name}).note(DiagnosticKind::DeclaredHere, resource.span, {resource.name});
    return {};
  }
  const auto age = argument(walk, call, 0, INT32_MIN, INT32_MAX);
  if (!age) return {};
  if (*age < 1 || *age > resource.history) {
    walk.scope.incomplete = true;
    walk.checker.report(DiagnosticKind::HistoryTooShort, call.span, {resource.name, std::to_string(resource.history), std::to_string(*age)})
        .note(DiagnosticKind::DeclaredHere, resource.span, {resource.name});
    return {};
  }
  place.age = static_cast<uint32_t>(*age);
  place.default_name += *age == 1 ? "_prev" : "_prev" + std::to_string(*age);
  return place;
}

// Reports a range that leaves the buffer at some extents.
bool inside(Walk walk, const Expr& call, const Resource& buffer, const Range& range) {
  Checker& checker = walk.checker;
  const std::vector<ExprId> exprs{range.offset, range.size, buffer.count};
  const Polynomial offset = checker.formulas.of(range.offset), size = checker.formulas.of(range.size);
  const auto proved = [&](const Polynomial& value) { return checker.formulas.never_negative(value); };
  const bool begins = proved(offset) && proved(size);
  const bool ends = !buffer.count.valid() || proved(checker.formulas.of(buffer.count) * Polynomial(buffer.stride) - offset - size);
  if (begins && ends) return true;
  for (const auto& extents : telling_extents(checker.program, exprs)) {
    const int64_t first = evaluate(checker.program, range.offset, extents), count = evaluate(checker.program, range.size, extents);
    if (first < 0 || count < 0) return fail(walk, DiagnosticKind::EmptyByteRange, call.span, {}).ok();
    if (!buffer.count.valid()) continue;
    const int64_t has = evaluate(checker.program, buffer.count, extents) * int64_t{buffer.stride};
    if (first <= has - count) continue;
    const int64_t end = first > INT64_MAX - count ? INT64_MAX : first + count;
    return fail(walk, DiagnosticKind::BytesBeyondBuffer, call.span,
                {buffer.name, std::to_string(end), std::to_string(has), where_extents(checker.program, exprs, extents)})
        .ok();
  }
  return true;
}

Place take_bytes(Walk walk, const Expr& call, Place place) {
  const Value offset = evaluate_expr(walk.checker, &walk.scope, walk.scope.module, call.operands[1]);
  const Value size = evaluate_expr(walk.checker, &walk.scope, walk.scope.module, call.operands[2]);
  const auto whole_number = [](const Value& value) { return value.kind == Value::Kind::integer && value.axes == 1; };
  if (!whole_number(offset) || !whole_number(size)) {
    if (offset.ok() && size.ok()) walk.checker.report(DiagnosticKind::NotAnInteger, call.span);
    walk.scope.incomplete = true;
    return {};
  }
  const bool negative = (offset.at[0].known() && offset.at[0].value < 0) || (size.at[0].known() && size.at[0].value <= 0);
  if (negative) return fail(walk, DiagnosticKind::EmptyByteRange, call.span, {});
  place.range.offset = to_expr(walk.checker, offset.at[0]);
  place.range.size = to_expr(walk.checker, size.at[0]);
  return inside(walk, call, walk.scope.graph.resources[place.resource], place.range) ? place : Place{};
}

// Why texels of `from` cannot be read as texels of `to`, or nothing.
const char* view_fault(const FormatInfo& from, const FormatInfo& to) {
  if (!from.is_color() || !to.is_color()) return "depth and stencil have one format each";
  if (from.is_block() || to.is_block())
    return from.block_width == to.block_width && from.block_bytes == to.block_bytes ? nullptr : "the blocks differ";
  return from.block_bytes == to.block_bytes ? nullptr : "the texels are not of one size";
}

Place take_view(Walk walk, const Expr& call, Place place) {
  const Resource& resource = walk.scope.graph.resources[place.resource];
  const std::string wanted = spelled(call.operands[1]);
  const Format format = find_format(wanted);
  if (format == Format::none) {
    walk.scope.incomplete = true;
    Diagnostic diagnostic(DiagnosticKind::UnknownFormat, call.operands[1].span, {wanted});
    const Guess guess = closest_type(wanted, format_names());
    suggest(diagnostic, call.operands[1].span, guess);
    walk.checker.diagnostics.report(std::move(diagnostic));
    return {};
  }
  if (const char* fault = view_fault(info(resource.format), info(format))) {
    walk.scope.incomplete = true;
    walk.checker.report(DiagnosticKind::ViewSize, call.span, {resource.name, name(resource.format), wanted, fault})
        .note(DiagnosticKind::DeclaredHere, resource.span, {resource.name});
    return {};
  }
  place.view = format == resource.format ? Format::none : format;
  return place;
}

struct Part {
  std::string_view name;
  size_t arguments;
  bool of_images;
};
constexpr Part kParts[] = {{"mip", 1, true},    {"mips", 2, true}, {"layer", 1, true}, {"layers", 2, true}, {"prev", 1, false},
                           {"bytes", 2, false}, {"view", 1, true}, {"slice", 1, true}, {"slices", 2, true}};

Place called_place(Walk walk, const Expr& call) {
  const Expr& callee = call.operands[0];
  if (callee.kind != ExprKind::member) return fail(walk, DiagnosticKind::NotAPlace, call.span, {});
  const auto* part = std::find_if(std::begin(kParts), std::end(kParts), [&](const Part& row) { return row.name == callee.text; });
  if (part == std::end(kParts)) return member_place(walk, callee);
  Place place = find_place(walk.checker, walk.scope, callee.operands[0]);
  if (!place.ok()) return place;
  if (call.operands.size() - 1 != part->arguments)
    return fail(walk, DiagnosticKind::WrongArgumentCount, call.span,
                {std::string(part->name), std::to_string(call.operands.size() - 1), counted(part->arguments, "argument")});
  place.span = call.span;
  const Resource& resource = walk.scope.graph.resources[place.resource];
  const bool is_image = resource.kind == ResourceKind::image;
  const bool fits = part->name == "prev" || part->of_images == is_image;
  if (!fits)
    return fail(walk, DiagnosticKind::PartOfOtherKind, call.span, {resource.name, is_image ? "an image" : "a buffer", std::string(part->name)});
  if (part->name == "mip" || part->name == "mips") return take_mips(walk, call, std::move(place), part->arguments == 2);
  if (part->name == "layer" || part->name == "layers") return take_layers(walk, call, std::move(place), part->arguments == 2);
  if (part->name == "slice" || part->name == "slices") return take_slices(walk, call, std::move(place), part->arguments == 2);
  if (part->name == "prev") return take_previous(walk, call, std::move(place));
  if (part->name == "view") return take_view(walk, call, std::move(place));
  return take_bytes(walk, call, std::move(place));
}

Value image_size(Checker& checker, const Resource& image, const Place& place) {
  Value size = integer_value(0);
  const ExprId axes[3] = {image.width, image.height, image.depth};
  const uint32_t layers = layer_count(image, place.range);
  size.axes = static_cast<uint8_t>(image.dimension == Dimension::d3 || layers > 1 ? 3 : image.dimension == Dimension::d1 ? 1 : 2);
  for (uint8_t axis = 0; axis < size.axes; ++axis) {
    if (!axes[axis].valid()) {
      size.at[axis].value = axis == 2 ? layers : 1;
      continue;
    }
    Scalar64 extent;
    const rg::dsl::Expr& node = checker.program.exprs[axes[axis]];
    if (node.op == ExprOp::constant)
      extent.value = node.value;
    else
      extent.expr = axes[axis];
    Scalar64 mip;
    mip.value = place.range.mip;
    size.at[axis] = combine(checker, ExprOp::mip, extent, mip, place.span);
  }
  return size;
}

}  // namespace

std::optional<std::string> evaluated_name(Checker& checker, GraphScope& scope, const ast::Expr& expr) {
  if (expr.kind == ExprKind::member) {
    const auto owner = evaluated_name(checker, scope, expr.operands[0]);
    return owner ? std::optional(*owner + "." + std::string(expr.text)) : std::nullopt;
  }
  const auto indices = index_text(checker, scope, expr);
  return indices ? std::optional(spelled(family_of(expr)) + *indices) : std::nullopt;
}

uint32_t least_depth(Checker& checker, const Resource& image, uint32_t mip) {
  const Program& program = checker.program;
  int64_t most = UINT32_MAX, least = 1;
  for (const auto& extents : {minimum_extents(program), initial_extents(program), maximum_extents(program)})
    most = std::min(most, std::max<int64_t>(evaluate(program, image.depth, extents) >> mip, 1));
  const Polynomial depth = checker.formulas.of(image.depth);
  const auto has = [&](int64_t slices) { return slices == 1 || checker.formulas.never_negative(depth - Polynomial(slices << mip)); };
  if (has(most)) return static_cast<uint32_t>(most);
  while (most - least > 1) (has((least + most) / 2) ? least : most) = (least + most) / 2;
  return static_cast<uint32_t>(least);
}

uint32_t mip_count(const Resource& resource, const Range& range) { return range.mips == kAll ? resource.mips - range.mip : range.mips; }
uint32_t layer_count(const Resource& resource, const Range& range) { return range.layers == kAll ? resource.layers - range.layer : range.layers; }

bool names_resource(const GraphScope& scope, const ast::Expr& expr) {
  const ast::Expr& root = root_of(expr);
  if (root.kind != ExprKind::name) return false;
  const auto bound = std::find_if(scope.bindings.rbegin(), scope.bindings.rend(), [&](const Binding& binding) { return binding.name == root.text; });
  if (bound != scope.bindings.rend()) return bound->kind == Binding::Kind::place;
  const std::string name = scope.prefix + std::string(root.text);
  return scope.resources.count(name) || scope.families.count(name) || scope.interfaces.count(name);
}

bool is_failed(const Checker& checker, const GraphScope& scope, const ast::Expr& expr) {
  const ast::Expr& root = root_of(expr);
  if (root.kind != ExprKind::name) return false;
  if (scope.failed.count(scope.prefix + std::string(root.text))) return true;
  return checker.lost_names && !names_resource(scope, expr) && !peek_symbol(checker, scope.module, root);
}

Place find_place(Checker& checker, GraphScope& scope, const ast::Expr& expr) {
  const Walk walk{checker, scope};
  Place place;
  switch (expr.kind) {
    case ExprKind::error:
      scope.incomplete = true;
      return {};
    case ExprKind::name:
      place = find_root(walk, expr);
      break;
    case ExprKind::index:
      place = find_indexed(walk, expr);
      break;
    case ExprKind::member:
      place = member_place(walk, expr);
      break;
    case ExprKind::call:
      place = called_place(walk, expr);
      break;
    default:
      return fail(walk, DiagnosticKind::NotAPlace, expr.span, {});
  }
  if (place.ok()) scope.resource_used[place.resource.value] = true;
  return place;
}

bool check_writable(Checker& checker, GraphScope& scope, const Place& place, const ast::Expr& expr) {
  if (place.age > 0) {
    checker.report(DiagnosticKind::PreviousWritten, expr.span, {spelled(expr), scope.graph.resources[place.resource].name});
    return false;
  }
  if (!place.read_only) return true;
  checker.report(DiagnosticKind::ReadOnlyParameter, expr.span, {std::string(place.read_only->name)})
      .note(DiagnosticKind::DeclaredHere, place.read_only->span, {std::string(place.read_only->name)})
      .fix({place.read_only->span.file, place.read_only->span.begin, place.read_only->span.begin}, "inout ");
  return false;
}

Value size_of(Checker& checker, GraphScope& scope, const Place& place) {
  if (!place.ok()) return {};
  const Resource& resource = scope.graph.resources[place.resource];
  if (resource.kind == ResourceKind::image) return image_size(checker, resource, place);
  if (!resource.count.valid()) {
    checker.report(DiagnosticKind::UnknownSize, place.span, {resource.name});
    return {};
  }
  Value size = integer_value(0);
  const rg::dsl::Expr& node = checker.program.exprs[resource.count];
  if (node.op == ExprOp::constant)
    size = integer_value(node.value);
  else
    size.at[0].expr = resource.count;
  return size;
}

}  // namespace rg::dsl
