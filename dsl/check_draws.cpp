// The buffers of draws that no host records.
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

}  // namespace

bool bind_buffers(Checker& checker, const Graph& graph, Pass& pass, Span span) {
  const DrawKind kind = pass.draw.kind;
  if (!check_vertices({checker, graph, pass, span})) return false;
  if (kind != DrawKind::direct && kind != DrawKind::indirect && kind != DrawKind::indirect_count) return true;
  const Draws at{checker, graph, pass, span};
  return bind_vertices(at) && bind_indices(at);
}

}  // namespace rg::dsl
