// The buffers of draws that no host records, and how much of them work takes.
#include <algorithm>

#include "dsl/check_state.h"
#include "dsl/print.h"

namespace rg::dsl {
namespace {

struct Draws {
  Checker& checker;
  const Graph& graph;
  Pass& pass;
  Span span;  // of the statement
};

std::vector<uint32_t> accesses_as(const Pass& pass, Role role) {
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < pass.accesses.size(); ++i)
    if (pass.accesses[i].role == role) found.push_back(i);
  return found;
}

const Resource& resource_of(const Draws& at, uint32_t access) { return at.graph.resources[at.pass.accesses[access].resource]; }

std::string elements_of(const Draws& at, const Resource& buffer) {
  return buffer.format != Format::none ? name(buffer.format) : print_type(at.checker.program, buffer.element);
}

bool report_of(const Draws& at, DiagnosticKind kind, uint32_t access, std::vector<std::string> arguments) {
  const Resource& buffer = resource_of(at, access);
  arguments.insert(arguments.begin(), {buffer.name, elements_of(at, buffer)});
  at.checker.report(kind, at.pass.accesses[access].span, std::move(arguments)).note(DiagnosticKind::DeclaredHere, buffer.span, {buffer.name});
  return false;
}

// Elements that are no structs are bytes.
bool bind_vertices(const Draws& at) {
  const std::vector<uint32_t> buffers = accesses_as(at.pass, Role::vertex);
  std::vector<VertexInput>& inputs = at.pass.draw.vertex;
  if (buffers.size() != inputs.size()) {
    at.checker.report(DiagnosticKind::VertexBuffers, at.span,
                      {at.pass.name, counted(inputs.size(), "vertex struct"), counted(buffers.size(), "buffer")});
    return false;
  }
  for (size_t i = 0; i < inputs.size(); ++i) {
    const StructId holds = resource_of(at, buffers[i]).element.record;
    if (holds.valid() && holds != inputs[i].type)
      return report_of(at, DiagnosticKind::VertexBufferOf, buffers[i], {at.checker.program.structs[inputs[i].type].name});
    inputs[i].buffer = buffers[i];
  }
  return true;
}

bool holds_indices(const Resource& buffer) {
  if (buffer.format != Format::none) return buffer.format == Format::r16ui || buffer.format == Format::r32ui;
  const Type& type = buffer.element;
  return !type.record.valid() && type.scalar == Scalar::u32 && type.rows == 1 && type.count == 0;
}

bool bind_indices(const Draws& at) {
  if (!at.pass.draw.indexed) return true;
  const std::vector<uint32_t> buffers = accesses_as(at.pass, Role::index);
  if (buffers.size() != 1) {
    at.checker.report(DiagnosticKind::IndexBuffer, at.span, {at.pass.name, buffers.empty() ? "no buffer" : counted(buffers.size(), "buffer")});
    return false;
  }
  if (!holds_indices(resource_of(at, buffers[0]))) return report_of(at, DiagnosticKind::IndexElements, buffers[0], {});
  at.pass.draw.indices = buffers[0];
  return true;
}

const Field* find_bool(const Program& program, const Struct& record) {
  for (const Field& field : record.fields) {
    if (field.type.scalar == Scalar::boolean && !field.type.record.valid()) return &field;
    const Field* inside = field.type.record.valid() ? find_bool(program, program.structs[field.type.record]) : nullptr;
    if (inside) return inside;
  }
  return nullptr;
}

// Vertices reach a shader as inputs, and GLSL has none of type bool.
bool check_vertices(const Draws& at) {
  for (const VertexInput& input : at.pass.draw.vertex) {
    const Struct& record = at.checker.program.structs[input.type];
    const Field* field = find_bool(at.checker.program, record);
    if (!field) continue;
    at.checker.report(DiagnosticKind::VertexBool, field->span, {field->name, record.name})
        .note(DiagnosticKind::AccessUsedHere, at.span, {record.name});
    return false;
  }
  return true;
}

// ---- amounts ----------------------------------------------------------------------------------------------------

// Both ends of what is named of the buffer may depend on extents; nothing is known of one that is as long as the host makes it.
std::optional<int64_t> bytes_of(const Draws& at, uint32_t access, const std::vector<int64_t>& extents) {
  const Range& range = at.pass.accesses[access].range;
  const Resource& buffer = resource_of(at, access);
  if (range.size.valid()) return evaluate(at.checker.program, range.size, extents);
  if (!buffer.count.valid()) return std::nullopt;
  return evaluate(at.checker.program, buffer.count, extents) * std::max<int64_t>(buffer.stride, 1);
}

bool stays_within_indices(const Draws& at, const std::vector<int64_t>& extents) {
  const Draw& draw = at.pass.draw;
  if (draw.kind != DrawKind::direct || draw.indices == kAll) return true;
  const auto bytes = bytes_of(at, draw.indices, extents);
  const int64_t first = draw.first.valid() ? evaluate(at.checker.program, draw.first, extents) : 0;
  const int64_t end = first + evaluate(at.checker.program, draw.vertices, extents);
  const Resource& buffer = resource_of(at, draw.indices);
  const int64_t held = bytes ? *bytes / std::max<int64_t>(buffer.stride, 1) : end;
  if (end <= held) return true;
  at.checker.report(DiagnosticKind::PastIndices, at.span, {at.pass.name, std::to_string(end - 1), buffer.name, std::to_string(held)})
      .note(DiagnosticKind::DeclaredHere, buffer.span, {buffer.name});
  return false;
}

bool holds_arguments(const Draws& at, uint32_t access, int64_t wanted, const std::vector<int64_t>& extents) {
  if (access == kAll) return true;
  const auto bytes = bytes_of(at, access, extents);
  if (!bytes || *bytes >= wanted) return true;
  const Resource& buffer = resource_of(at, access);
  at.checker.report(DiagnosticKind::PastArguments, at.span, {at.pass.name, std::to_string(wanted), buffer.name, std::to_string(*bytes)})
      .note(DiagnosticKind::DeclaredHere, buffer.span, {buffer.name});
  return false;
}

// Draws read a command every `stride` bytes.
bool holds_arguments(const Draws& at, const std::vector<int64_t>& extents) {
  constexpr int64_t kDispatch = 12, kCount = 4;  // VkDispatchIndirectCommand, the number of draws
  const Draw& draw = at.pass.draw;
  const int64_t command = draw.indexed ? 20 : 16, draws = command + (int64_t{draw.max_draws} - 1) * draw.stride;
  return holds_arguments(at, at.pass.dispatch.arguments, kDispatch, extents) && holds_arguments(at, draw.arguments, draws, extents) &&
         holds_arguments(at, draw.counts, kCount, extents);
}

bool draws_enough(const Draws& at) {
  const Draw& draw = at.pass.draw;
  if (draw.kind != DrawKind::direct) return true;
  const std::string things = draw.indexed ? "indices" : "vertices", one = draw.indexed ? "index" : "vertex";
  const auto is_enough = [&](ExprId count, int64_t least, const std::string& before, const std::string& after) {
    const auto few = count.valid() ? too_few(at.checker, count, least) : std::nullopt;
    if (few) at.checker.report(DiagnosticKind::DrawsTooLittle, at.span, {at.pass.name, before + std::to_string(*few) + after, std::to_string(least)});
    return !few;
  };
  return is_enough(draw.vertices, 1, "draws ", " " + things) && is_enough(draw.instances, 1, "draws ", " instances") &&
         is_enough(draw.first, 0, "begins at " + one + " ", "");
}

}  // namespace

std::optional<int64_t> too_few(const Checker& checker, ExprId count, int64_t least) {
  const Program& program = checker.program;
  int64_t value = INT64_MAX;
  for (const auto& extents : {minimum_extents(program), initial_extents(program), maximum_extents(program)})
    value = std::min(value, evaluate(program, count, extents));
  const bool few = value < (program.exprs[count].op == ExprOp::constant ? least : 0);
  return few ? std::optional(value) : std::nullopt;
}

bool check_amounts(Checker& checker, const Graph& graph, Pass& pass, Span work) {
  const Draws at{checker, graph, pass, work};
  if (!draws_enough(at)) return false;
  for (const auto& extents : {initial_extents(checker.program), maximum_extents(checker.program)})
    if (!stays_within_indices(at, extents) || !holds_arguments(at, extents)) return false;
  return true;
}

bool bind_buffers(Checker& checker, const Graph& graph, Pass& pass, Span span) {
  const DrawKind kind = pass.draw.kind;
  if (!check_vertices({checker, graph, pass, span})) return false;
  if (kind != DrawKind::direct && kind != DrawKind::indirect && kind != DrawKind::indirect_count) return true;
  const Draws at{checker, graph, pass, span};
  return bind_vertices(at) && bind_indices(at);
}

}  // namespace rg::dsl
