// Clear values: numbers become the bits that a format or an element holds. Clears of storage become passes.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

int32_t to_signed(double value) { return static_cast<int32_t>(std::clamp(value, -2147483648.0, 2147483647.0)); }
uint32_t to_unsigned(double value) { return static_cast<uint32_t>(std::clamp(value, 0.0, 4294967295.0)); }

void set_image_clear(ClearValue& out, const FormatInfo& format, uint32_t aspects, const std::vector<double>& numbers) {
  out.integer = format.is_integer() && format.is_color();
  const bool is_color = format.is_color();
  for (size_t i = 0; i < 4; ++i) {
    const double number = numbers.size() == 1 ? numbers[0] : i < numbers.size() ? numbers[i] : 0.0;
    if (is_color && out.integer)
      out.u[i] = format.numeric == Numeric::sint ? static_cast<uint32_t>(to_signed(number)) : to_unsigned(number);
    else if (is_color)
      out.f[i] = static_cast<float>(number);
  }
  if (is_color) return;
  const bool depth = ((aspects ? aspects : format.aspects) & aspect_depth) != 0;
  if (depth)
    out.f[0] = static_cast<float>(numbers[0]);
  else
    out.u[1] = to_unsigned(numbers[0]);
  if (depth && numbers.size() > 1) out.u[1] = to_unsigned(numbers[1]);
}

void set_buffer_clear(ClearValue& out, Scalar scalar, double number) {
  const auto f = static_cast<float>(number);
  out.integer = scalar != Scalar::f32;
  out.f[0] = f;
  if (scalar == Scalar::f32)
    std::memcpy(&out.u[0], &f, sizeof f);
  else
    out.u[0] = scalar == Scalar::i32 ? static_cast<uint32_t>(to_signed(number)) : to_unsigned(number);
}

std::vector<double> numbers_of(Checker& checker, const Value& value, Span span) {
  if (!value.ok()) return {};
  if (value.is_number()) return {value.real};
  if (!value.numbers.empty()) return value.numbers;
  checker.report(DiagnosticKind::NotANumber, span);
  return {};
}

bool fits_bits(double number, uint32_t bits, bool is_signed) {
  const double most = std::ldexp(1.0, static_cast<int>(is_signed ? bits - 1 : bits)) - 1;
  return number == std::floor(number) && number >= (is_signed ? -most - 1 : 0) && number <= most;
}

bool fits_format(Format format, const std::vector<double>& numbers) {
  constexpr uint32_t kTenBits = 10, kTwoBits = 2;
  const FormatInfo& row = info(format);
  if (!row.is_integer()) return true;
  for (size_t i = 0; i < numbers.size(); ++i) {
    const uint32_t even = row.block_bytes * 8 / components(format);
    const uint32_t bits = format != Format::rgb10a2ui ? even : i == 3 ? kTwoBits : kTenBits;
    if (!fits_bits(numbers[i], bits, row.numeric == Numeric::sint)) return false;
  }
  return true;
}

// Stencils have eight bits in every format.
bool fits_stencil(const FormatInfo& format, uint32_t aspects, const std::vector<double>& numbers) {
  constexpr uint32_t kStencilBits = 8;
  const size_t at = aspects == aspect_stencil ? 0 : 1;
  return (format.aspects & aspect_stencil) == 0 || at >= numbers.size() || fits_bits(numbers[at], kStencilBits, false);
}

const char* word_of(Scalar scalar) { return scalar == Scalar::i32 ? "i32" : scalar == Scalar::u32 ? "u32" : "bool"; }

ClearValue buffer_value(Checker& checker, const Resource& buffer, const std::vector<double>& numbers, Span span) {
  ClearValue out;
  const bool words =
      buffer.format == Format::none || buffer.format == Format::r32f || buffer.format == Format::r32ui || buffer.format == Format::r32i;
  const bool simple = (!buffer.element.record.valid() && words) || numbers[0] == 0;
  const Scalar scalar = buffer.element.record.valid() ? Scalar::u32 : buffer.element.scalar;
  if (numbers.size() > 1 || !simple)
    checker.report(DiagnosticKind::ClearOfStruct, span, {buffer.name});
  else if (constexpr uint32_t kBits = 32; scalar != Scalar::f32 && !fits_bits(numbers[0], kBits, scalar == Scalar::i32))
    checker.report(DiagnosticKind::ClearOfFormat, span, {buffer.name, buffer.format == Format::none ? word_of(scalar) : name(buffer.format)});
  set_buffer_clear(out, scalar, numbers[0]);
  return out;
}

}  // namespace

ClearValue clear_value(Checker& checker, GraphScope& scope, const ast::Expr& expr, const Resource& resource, uint32_t aspects) {
  ClearValue out;
  const std::vector<double> numbers = numbers_of(checker, evaluate_expr(checker, &scope, scope.module, expr), expr.span);
  if (numbers.empty()) return out;
  if (resource.kind == ResourceKind::buffer) return buffer_value(checker, resource, numbers, expr.span);
  const FormatInfo& format = info(resource.format);
  const size_t most = format.is_color() ? 4 : 2;
  if (numbers.size() > most)
    checker.report(DiagnosticKind::ClearComponents, expr.span, {resource.name, std::to_string(most), std::to_string(numbers.size())});
  if (!fits_format(resource.format, numbers) || !fits_stencil(format, aspects, numbers))
    checker.report(DiagnosticKind::ClearOfFormat, expr.span, {resource.name, format.name});
  const bool depth = (format.aspects & aspect_depth) != 0 && aspects != aspect_stencil;
  if (depth && (numbers[0] < 0 || numbers[0] > 1)) checker.report(DiagnosticKind::DepthClearRange, expr.span, {resource.name});
  set_image_clear(out, format, aspects, numbers);
  return out;
}

// `atomic tiles clear 0` -> pass `NAME.clear` : transfer { fill tiles 0 }, right before.
Pass clear_pass(const Graph& graph, Pass& pass) {
  Pass clear;
  clear.name = pass.name + ".clear";
  clear.module = pass.module;
  clear.kind = PassKind::transfer;
  clear.queue = pass.queue;
  clear.queue_may = pass.queue_may;
  clear.guard = pass.guard;
  clear.conditions = pass.conditions;
  clear.span = pass.span;
  for (Access& access : pass.accesses) {
    if (!access.clear || !is_shader_role(access.role)) continue;
    const bool image = graph.resources[access.resource].kind == ResourceKind::image;
    Access target = access;
    target.mode = Mode::write;
    target.role = image ? Role::clear_dst : Role::fill_dst;
    target.stages = 0;
    target.clear.reset();
    target.disjoint = target.covers = false;
    Transfer transfer;
    transfer.kind = image ? TransferKind::clear : TransferKind::fill;
    transfer.dst = static_cast<uint32_t>(clear.accesses.size());
    transfer.value = *access.clear;
    clear.accesses.push_back(std::move(target));
    clear.transfers.push_back(std::move(transfer));
    access.clear.reset();
    if (access.mode == Mode::write) access.mode = Mode::update;
  }
  return clear;
}

}  // namespace rg::dsl
