// Arithmetic on constants and extents. What is known is folded; the rest becomes expressions.
#include <algorithm>
#include <cmath>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

using ast::ExprKind;

struct Evaluator {
  Checker& checker;
  GraphScope* scope;
  uint32_t module;
};

constexpr double kExactIntegers = 9007199254740992.0;  // 2^53

Value error_value() { return {}; }

Value real_value(double real) {
  Value value;
  value.kind = Value::Kind::real;
  value.real = real;
  return value;
}

bool fold(ExprOp op, int64_t a, int64_t b, int64_t& out) {
  switch (op) {
    case ExprOp::add:
      return !__builtin_add_overflow(a, b, &out);
    case ExprOp::sub:
      return !__builtin_sub_overflow(a, b, &out);
    case ExprOp::mul:
      return !__builtin_mul_overflow(a, b, &out);
    case ExprOp::floor_div:
    case ExprOp::ceil_div:
      if (b == 0 || (a == INT64_MIN && b == -1)) return false;
      out = a / b;
      if (a % b != 0 && ((a < 0) != (b < 0)) == (op == ExprOp::floor_div)) out += op == ExprOp::floor_div ? -1 : 1;
      return true;
    case ExprOp::min:
      out = std::min(a, b);
      return true;
    case ExprOp::max:
      out = std::max(a, b);
      return true;
    case ExprOp::mip:
      out = std::max<int64_t>(b >= 63 ? 0 : a >> b, 1);
      return true;
    default:
      return false;
  }
}

ExprOp op_of(ExprKind kind) {
  if (kind == ExprKind::add) return ExprOp::add;
  if (kind == ExprKind::sub) return ExprOp::sub;
  return kind == ExprKind::mul ? ExprOp::mul : ExprOp::floor_div;
}

Value from_symbol(Evaluator& at, uint32_t symbol, const ast::Expr& expr);
Value evaluate(Evaluator& at, const ast::Expr& expr);

Value wrong_operand(Evaluator& at, const ast::Expr& expr, const char* wanted) {
  at.checker.report(DiagnosticKind::WrongOperand, expr.span, {wanted});
  return error_value();
}

Value apply_real(Evaluator& at, ExprKind kind, double a, double b, Span span) {
  if (kind == ExprKind::div && b == 0) {
    at.checker.report(DiagnosticKind::DivisionByZero, span);
    return error_value();
  }
  if (kind == ExprKind::add) return real_value(a + b);
  if (kind == ExprKind::sub) return real_value(a - b);
  return real_value(kind == ExprKind::mul ? a * b : a / b);
}

// Sizes work axis by axis; a number goes with every axis.
Value apply_axes(Evaluator& at, ExprOp op, const Value& a, const Value& b, Span span) {
  if (a.axes != b.axes && a.axes != 1 && b.axes != 1) {
    at.checker.report(DiagnosticKind::AxesDiffer, span, {std::to_string(a.axes), std::to_string(b.axes)});
    return error_value();
  }
  Value result = integer_value(0);
  result.axes = std::max(a.axes, b.axes);
  for (uint8_t axis = 0; axis < result.axes; ++axis) {
    const Scalar64 left = a.at[a.axes == 1 ? 0 : axis], right = b.at[b.axes == 1 ? 0 : axis];
    const bool division = op == ExprOp::floor_div || op == ExprOp::ceil_div;
    if (division && right.known() && right.value == 0) {
      at.checker.report(DiagnosticKind::DivisionByZero, span);
      return error_value();
    }
    result.at[axis] = combine(at.checker, op, left, right, span);
  }
  result.real = static_cast<double>(result.at[0].value);
  return result;
}

// a % b has the sign of b: indices wrap around both ends.
Value remainder(Evaluator& at, const ast::Expr& expr, const Value& a, const Value& b) {
  if (a.kind != Value::Kind::integer || b.kind != Value::Kind::integer) return wrong_operand(at, expr, "whole numbers");
  const Value quotient = apply_axes(at, ExprOp::floor_div, a, b, expr.span);
  if (!quotient.ok()) return quotient;
  return apply_axes(at, ExprOp::sub, a, apply_axes(at, ExprOp::mul, quotient, b, expr.span), expr.span);
}

Value apply(Evaluator& at, const ast::Expr& expr, const Value& a, const Value& b) {
  if (!a.ok() || !b.ok()) return error_value();
  if (expr.kind == ExprKind::mod) return remainder(at, expr, a, b);
  if (a.kind == Value::Kind::list || b.kind == Value::Kind::list) return wrong_operand(at, expr, "numbers and sizes");
  if (a.kind == Value::Kind::integer && b.kind == Value::Kind::integer) return apply_axes(at, op_of(expr.kind), a, b, expr.span);
  if (!a.is_number() || !b.is_number()) return wrong_operand(at, expr, "whole numbers, because extents are whole numbers");
  return apply_real(at, expr.kind, a.real, b.real, expr.span);
}

Value negate(Evaluator& at, const ast::Expr& expr) {
  const Value operand = evaluate(at, expr.operands[0]);
  if (operand.kind == Value::Kind::real) return real_value(-operand.real);
  if (!operand.ok()) return operand;
  if (operand.kind == Value::Kind::list) return wrong_operand(at, expr, "a number");
  return apply_axes(at, ExprOp::sub, integer_value(0), operand, expr.span);
}

Value dimensions(Evaluator& at, const ast::Expr& expr) {
  Value value = integer_value(0);
  if (expr.operands.size() > 3) return wrong_operand(at, expr, "at most three axes");
  value.axes = static_cast<uint8_t>(expr.operands.size());
  for (size_t axis = 0; axis < expr.operands.size(); ++axis) value.at[axis].value = expr.operands[axis].integer;
  return value;
}

// `[w, h, d]` is a size if all parts are whole, as is `[view, d]`; `[0.0, 0.5, 1.0, 1.0]` is a list of numbers.
Value list(Evaluator& at, const ast::Expr& expr) {
  Value result = integer_value(0);
  std::vector<double> numbers;
  bool whole = true;
  size_t axes = 0;
  for (const ast::Expr& operand : expr.operands) {
    const Value part = evaluate(at, operand);
    if (!part.ok()) return part;
    if (part.kind == Value::Kind::list || (part.axes > 1 && axes + part.axes > 3)) return wrong_operand(at, operand, "a number");
    whole = whole && part.kind == Value::Kind::integer && axes + part.axes <= 3;
    if (part.is_number()) numbers.push_back(part.real);
    for (uint8_t axis = 0; whole && axis < part.axes; ++axis) result.at[axes + axis] = part.at[axis];
    axes += part.axes;
  }
  result.axes = static_cast<uint8_t>(std::min<size_t>(axes, 3));
  result.numbers = std::move(numbers);
  if (!whole) result.kind = Value::Kind::list;
  if (!whole && result.numbers.size() != expr.operands.size()) return wrong_operand(at, expr, "numbers known now");
  return result;
}

Value part_of(Evaluator& at, const ast::Expr& expr, const Value& base) {
  if (!base.ok()) return base;
  constexpr std::string_view kParts[] = {"x", "width", "y", "height", "z", "depth"};
  const auto* part = std::find(std::begin(kParts), std::end(kParts), expr.text);
  if (base.kind == Value::Kind::integer && part != std::end(kParts)) {
    const auto axis = static_cast<uint8_t>((part - std::begin(kParts)) / 2);
    if (axis >= base.axes) return wrong_operand(at, expr, "an axis that the size has");
    Value result = integer_value(base.at[axis].value);
    result.at[0] = base.at[axis];
    return result;
  }
  if (base.kind == Value::Kind::integer && expr.text == "area") {
    Value result = integer_value(base.at[0].value);
    result.at[0] = base.at[0];
    for (uint8_t axis = 1; axis < base.axes; ++axis) result.at[0] = combine(at.checker, ExprOp::mul, result.at[0], base.at[axis], expr.span);
    result.real = static_cast<double>(result.at[0].value);
    return result;
  }
  Diagnostic diagnostic(DiagnosticKind::UnknownPart, expr.span, {std::string(expr.text)});
  const Guess guess = closest(expr.text, {"x", "y", "z", "width", "height", "depth", "area"});
  const auto length = static_cast<uint32_t>(expr.text.size());
  suggest(diagnostic, {expr.span.file, expr.span.end - length, expr.span.end}, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  return error_value();
}

// A name that means nothing else: perhaps a module.
bool is_unknown_module(const Evaluator& at, const ast::Expr& owner) {
  if (owner.kind != ExprKind::name || at.checker.scopes[at.module].count(owner.text)) return false;
  if (!at.scope) return true;
  const auto& bindings = at.scope->bindings;
  const bool bound = std::any_of(bindings.begin(), bindings.end(), [&](const Binding& binding) { return binding.name == owner.text; });
  return !bound && !names_resource(*at.scope, owner) && !is_failed(at.checker, *at.scope, owner);
}

Value member(Evaluator& at, const ast::Expr& expr) {
  if (at.scope && names_resource(*at.scope, expr)) {
    const bool part =
        expr.text == "width" || expr.text == "height" || expr.text == "area" || expr.text == "x" || expr.text == "y" || expr.text == "z";
    if (!part) return size_of(at.checker, *at.scope, find_place(at.checker, *at.scope, expr));
  } else if (const auto symbol = peek_symbol(at.checker, at.module, expr)) {
    return from_symbol(at, *symbol, expr);
  }
  if (at.scope && is_failed(at.checker, *at.scope, expr)) return error_value();
  if (is_unknown_module(at, expr.operands[0])) {
    find_symbol(at.checker, at.module, expr, SymbolKind::constant);
    return error_value();
  }
  return part_of(at, expr, evaluate(at, expr.operands[0]));
}

Value rounded(Evaluator& at, const ast::Expr& call, ExprOp op) {
  const ast::Expr& argument = call.operands[1];
  if (argument.kind == ExprKind::div) {
    const Value a = evaluate(at, argument.operands[0]), b = evaluate(at, argument.operands[1]);
    if (!a.ok() || !b.ok()) return error_value();
    if (a.kind == Value::Kind::integer && b.kind == Value::Kind::integer) return apply_axes(at, op, a, b, argument.span);
  }
  const Value value = evaluate(at, argument);
  if (!value.ok()) return value;
  if (value.kind == Value::Kind::integer && argument.kind == ExprKind::integer) return value;
  if (value.kind != Value::Kind::real) return wrong_operand(at, argument, "a quotient, such as `ceil(view / 8)`");
  const double whole = op == ExprOp::ceil_div ? std::ceil(value.real) : std::floor(value.real);
  if (!(std::fabs(whole) < kExactIntegers)) return wrong_operand(at, argument, "a number that fits 53 bits");
  return integer_value(static_cast<int64_t>(whole));
}

Value least_or_greatest(Evaluator& at, const ast::Expr& call, ExprOp op) {
  Value result = evaluate(at, call.operands[1]);
  for (size_t i = 2; i < call.operands.size(); ++i) {
    const Value next = evaluate(at, call.operands[i]);
    if (!result.ok() || !next.ok()) return error_value();
    const bool integers = result.kind == Value::Kind::integer && next.kind == Value::Kind::integer;
    if (integers)
      result = apply_axes(at, op, result, next, call.span);
    else if (result.is_number() && next.is_number())
      result = real_value(op == ExprOp::min ? std::min(result.real, next.real) : std::max(result.real, next.real));
    else
      return wrong_operand(at, call, "numbers of one kind");
  }
  return result;
}

Value count_of(Evaluator& at, const ast::Expr& call, uint32_t (*count)(const Resource&, const Range&)) {
  if (!at.scope) return wrong_operand(at, call, "a resource, which only graphs have");
  const Place place = find_place(at.checker, *at.scope, call.operands[1]);
  if (!place.ok()) return error_value();
  const Resource& resource = at.scope->graph.resources[place.resource];
  if (resource.kind == ResourceKind::buffer) return wrong_operand(at, call.operands[1], "an image");
  return integer_value(count(resource, place.range));
}

Value call(Evaluator& at, const ast::Expr& expr) {
  const ast::Expr& callee = expr.operands[0];
  if (at.scope && names_resource(*at.scope, expr)) return size_of(at.checker, *at.scope, find_place(at.checker, *at.scope, expr));
  const std::string_view name = callee.kind == ExprKind::name ? callee.text : std::string_view();
  const bool one = expr.operands.size() == 2, many = expr.operands.size() >= 3;
  if (name == "ceil" && one) return rounded(at, expr, ExprOp::ceil_div);
  if (name == "floor" && one) return rounded(at, expr, ExprOp::floor_div);
  if (name == "min" && many) return least_or_greatest(at, expr, ExprOp::min);
  if (name == "max" && many) return least_or_greatest(at, expr, ExprOp::max);
  if (name == "mips" && one) return count_of(at, expr, mip_count);
  if (name == "layers" && one) return count_of(at, expr, layer_count);
  constexpr std::string_view kFunctions[] = {"ceil", "floor", "min", "max", "mips", "layers"};
  if (std::find(std::begin(kFunctions), std::end(kFunctions), name) != std::end(kFunctions)) {
    const bool open_ended = name == "min" || name == "max";
    at.checker.report(DiagnosticKind::WrongArgumentCount, expr.span,
                      {std::string(name), std::to_string(expr.operands.size() - 1), open_ended ? "2 arguments or more" : "1 argument"});
    return error_value();
  }
  if (at.scope && is_failed(at.checker, *at.scope, expr)) return error_value();
  Diagnostic diagnostic(DiagnosticKind::UnknownFunction, callee.span, {spelled(callee)});
  const Guess guess = closest(callee.text, {std::begin(kFunctions), std::end(kFunctions)});
  suggest(diagnostic, callee.span, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  return error_value();
}

Value extent_value(Checker& checker, uint32_t symbol) {
  const ExtentId id = extent_of(checker, symbol);
  if (!id.valid()) return error_value();
  Value value = integer_value(0);
  value.axes = static_cast<uint8_t>(checker.program.extents[id].axes);
  for (uint8_t axis = 0; axis < value.axes; ++axis) {
    Expr node;
    node.op = ExprOp::extent;
    node.value = 3 * static_cast<int64_t>(id.value) + axis;
    value.at[axis].expr = add_node(checker, node);
  }
  return value;
}

Value from_symbol(Evaluator& at, uint32_t symbol, const ast::Expr& expr) {
  at.checker.used[symbol] = true;
  const Symbol& found = at.checker.symbols[symbol];
  if (found.kind == SymbolKind::constant) return constant_value(at.checker, symbol);
  if (found.kind == SymbolKind::extent) return extent_value(at.checker, symbol);
  at.checker
      .report(DiagnosticKind::WrongKindOfName, expr.span, {std::string(found.name.text), with_article(describe(found.kind)), "a number or a size"})
      .note(DiagnosticKind::DeclaredHere, found.name.span, {std::string(found.name.text)});
  return error_value();
}

// `WIDTHxHEIGHT`, which is one word: sizes of names stand in brackets.
std::string meant_axes(std::string_view word, const std::vector<std::string_view>& names) {
  for (size_t at = word.find('x'); at != std::string_view::npos; at = word.find('x', at + 1)) {
    const std::string_view first = word.substr(0, at), second = word.substr(at + 1);
    const auto known = [&](std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
    if (known(first) && known(second)) return "[" + std::string(first) + ", " + std::string(second) + "]";
  }
  return "";
}

void report_unknown_value(Evaluator& at, const ast::Expr& expr) {
  if (at.checker.lost_names || !at.checker.unknown.emplace(std::to_string(at.module) + " " + std::string(expr.text)).second) return;
  if (report_if_private(at.checker, at.module, expr.text, expr.span)) return;
  std::vector<std::string_view> names;
  for (const Symbol& symbol : at.checker.symbols) {
    const bool usable = symbol.kind == SymbolKind::constant || symbol.kind == SymbolKind::extent;
    if (usable && at.checker.scopes[at.module].count(symbol.name.text)) names.push_back(symbol.name.text);
  }
  if (at.scope) {
    for (const Binding& binding : at.scope->bindings) names.push_back(binding.name);
    for (const Resource& resource : at.scope->graph.resources) names.push_back(resource.name);
  }
  Diagnostic diagnostic(DiagnosticKind::UnknownName, expr.span, {"constant, extent or resource", std::string(expr.text)});
  if (const std::string axes = meant_axes(expr.text, names); !axes.empty())
    diagnostic.fix(expr.span, axes);
  else
    suggest(diagnostic, expr.span, closest(expr.text, names));
  at.checker.diagnostics.report(std::move(diagnostic));
}

Value name(Evaluator& at, const ast::Expr& expr) {
  if (at.scope) {
    const auto& bindings = at.scope->bindings;
    const auto found = std::find_if(bindings.rbegin(), bindings.rend(), [&](const Binding& binding) { return binding.name == expr.text; });
    if (found != bindings.rend() && found->kind == Binding::Kind::integer) return integer_value(found->value);
    if (names_resource(*at.scope, expr)) return size_of(at.checker, *at.scope, find_place(at.checker, *at.scope, expr));
    if (at.scope->failed.count(at.scope->prefix + std::string(expr.text))) return error_value();
  }
  const auto visible = at.checker.scopes[at.module].find(expr.text);
  if (visible == at.checker.scopes[at.module].end()) return report_unknown_value(at, expr), error_value();
  if (visible->second.other != UINT32_MAX) {
    const SymbolKind kind = at.checker.symbols[visible->second.symbol].kind;
    if (!find_symbol(at.checker, at.module, expr, kind)) return error_value();
  }
  return from_symbol(at, visible->second.symbol, expr);
}

Value evaluate(Evaluator& at, const ast::Expr& expr) {
  constexpr uint32_t kMaxDepth = 3000;  // through constants that need constants, too
  const Deeper deeper(at.checker.depth);
  if (at.checker.depth > kMaxDepth) {
    at.checker.report(DiagnosticKind::NestingTooDeep, expr.span, {std::to_string(kMaxDepth)});
    return error_value();
  }
  switch (expr.kind) {
    case ExprKind::error:
      return error_value();
    case ExprKind::integer:
      return integer_value(expr.integer);
    case ExprKind::real:
      return real_value(expr.real);
    case ExprKind::dimensions:
      return dimensions(at, expr);
    case ExprKind::name:
      return name(at, expr);
    case ExprKind::member:
      return member(at, expr);
    case ExprKind::index:
      return at.scope ? size_of(at.checker, *at.scope, find_place(at.checker, *at.scope, expr)) : wrong_operand(at, expr, "a number");
    case ExprKind::call:
      return call(at, expr);
    case ExprKind::list:
      return list(at, expr);
    case ExprKind::negate:
      return negate(at, expr);
    case ExprKind::add:
    case ExprKind::sub:
    case ExprKind::mul:
    case ExprKind::div:
    case ExprKind::mod:
      break;
  }
  const Value a = evaluate(at, expr.operands[0]);
  return apply(at, expr, a, evaluate(at, expr.operands[1]));
}

}  // namespace

Value integer_value(int64_t value) {
  Value result;
  result.kind = Value::Kind::integer;
  result.at[0].value = value;
  result.real = static_cast<double>(value);
  return result;
}

ExprId add_node(Checker& checker, const Expr& node) {
  const auto [at, fresh] = checker.nodes.emplace(NodeKey{node.op, node.a.value, node.b.value, node.value}, ExprId{});
  if (fresh) at->second = checker.program.exprs.add(node);
  return at->second;
}

ExprId to_expr(Checker& checker, Scalar64 scalar) {
  if (!scalar.known()) return scalar.expr;
  Expr node;
  node.value = scalar.value;
  return add_node(checker, node);
}

Scalar64 combine(Checker& checker, ExprOp op, Scalar64 a, Scalar64 b, Span span) {
  Scalar64 result;
  if (a.known() && b.known()) {
    if (!fold(op, a.value, b.value, result.value)) checker.report(DiagnosticKind::Overflow, span);
    return result;
  }
  const bool neutral = b.known() && ((b.value == 1 && (op == ExprOp::mul || op == ExprOp::floor_div || op == ExprOp::ceil_div)) ||
                                     (b.value == 0 && (op == ExprOp::add || op == ExprOp::sub || op == ExprOp::mip)));
  if (neutral) return a;
  Expr node;
  node.op = op;
  node.a = to_expr(checker, a);
  node.b = to_expr(checker, b);
  result.expr = add_node(checker, node);
  return result;
}

Value evaluate_expr(Checker& checker, GraphScope* scope, uint32_t module, const ast::Expr& expr) {
  Evaluator at{checker, scope, module};
  return evaluate(at, expr);
}

std::optional<int64_t> evaluate_integer(Checker& checker, GraphScope* scope, uint32_t module, const ast::Expr& expr, int64_t least,
                                        int64_t greatest) {
  const Value value = evaluate_expr(checker, scope, module, expr);
  if (!value.ok()) return std::nullopt;
  if (!value.known_integer()) {
    checker.report(value.kind == Value::Kind::integer && value.axes == 1 ? DiagnosticKind::NotConstant : DiagnosticKind::NotAnInteger, expr.span);
    return std::nullopt;
  }
  const int64_t number = value.at[0].value;
  if (number >= least && number <= greatest) return number;
  checker.report(DiagnosticKind::OutOfRange, expr.span, {std::to_string(number), std::to_string(least), std::to_string(greatest)});
  return std::nullopt;
}

std::optional<double> evaluate_number(Checker& checker, GraphScope* scope, uint32_t module, const ast::Expr& expr) {
  const Value value = evaluate_expr(checker, scope, module, expr);
  if (!value.ok()) return std::nullopt;
  if (value.is_number()) return value.real;
  checker.report(DiagnosticKind::NotANumber, expr.span);
  return std::nullopt;
}

// False if the declaration is being worked on already: it needs itself.
bool begin_declaration(Checker& checker, uint32_t symbol) {
  Symbol& found = checker.symbols[symbol];
  if (found.progress == Symbol::Progress::running) {
    checker.report(DiagnosticKind::NeedsItself, found.name.span, {std::string(found.name.text)});
    found.progress = Symbol::Progress::done;
  }
  if (found.progress == Symbol::Progress::done) return false;
  found.progress = Symbol::Progress::running;
  return true;
}

const Value& constant_value(Checker& checker, uint32_t symbol) {
  if (begin_declaration(checker, symbol)) {
    const auto& node = std::get<ast::Constant>(*checker.symbols[symbol].declaration);
    Value value = evaluate_expr(checker, nullptr, checker.symbols[symbol].module, node.value);
    checker.symbols[symbol].value = std::move(value);
    checker.symbols[symbol].progress = Symbol::Progress::done;
  }
  return checker.symbols[symbol].value;
}

}  // namespace rg::dsl
