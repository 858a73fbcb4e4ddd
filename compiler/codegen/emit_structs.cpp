#include "compiler/codegen/emit_structs.h"

#include "compiler/codegen/cpp_writer.h"
#include "compiler/codegen/plan_values.h"
#include "dsl/check_macro.h"
#include "dsl/format_table.h"
#include "dsl/layout.h"

namespace rg::compiler {
namespace {

using Uses = std::vector<StructUse>;

void mark(const dsl::Program& program, Uses& uses, const dsl::Type& type, bool std140) {
  if (!type.record.valid()) return;
  (std140 ? uses[type.record.value].std140 : uses[type.record.value].std430) = true;
  for (const dsl::Field& field : program.structs[type.record].fields) mark(program, uses, field.type, std140);
}

void mark_struct(const dsl::Program& program, Uses& uses, dsl::StructId id, bool std140) {
  dsl::Type type;
  type.record = id;
  mark(program, uses, type, std140);
}

void mark_graph(const dsl::Program& program, const dsl::Graph& graph, Uses& uses) {
  for (const dsl::Params& params : graph.params) mark_struct(program, uses, params.type, true);
  for (const dsl::Pass& pass : graph.passes) {
    if (pass.draw.per_draw.valid()) mark_struct(program, uses, pass.draw.per_draw, false);
    for (const dsl::VertexInput& input : pass.draw.vertex) mark_struct(program, uses, input.type, false);
    for (const dsl::Access& access : pass.accesses) {
      const dsl::Resource& resource = graph.resources[access.resource];
      if (resource.kind == dsl::ResourceKind::buffer) mark(program, uses, resource.element, access.role == dsl::Role::uniform);
    }
  }
}

struct Layout {
  const dsl::Program& program;
  const Uses& uses;
  bool std140 = false;
  bool scalar = false;  // of the struct that is being written
  uint32_t offset(const dsl::Field& field) const { return std140 ? field.offset140 : field.offset430; }
  uint32_t size(const dsl::Struct& record) const { return std140 ? record.size140 : record.size430; }
};

// Bytes of one element in C++, and the distance GLSL puts between elements of an array.
uint32_t element_bytes(const Layout& layout, const dsl::Type& type) {
  if (type.record.valid()) return layout.size(layout.program.structs[type.record]);
  if (type.packed != dsl::Format::none) return dsl::info(type.packed).block_bytes;
  if (layout.scalar) return 4u * type.rows * type.columns;
  if (type.columns > 1) return 16u * type.columns;
  return 4u * type.rows;
}
uint32_t array_stride(const Layout& layout, const dsl::Type& type) {
  const uint32_t bytes = element_bytes(layout, type);
  if (type.record.valid() || type.packed != dsl::Format::none || type.columns > 1 || layout.scalar) return bytes;
  return layout.std140 || type.rows == 3 ? 16 : bytes;
}

bool same_layout(const dsl::Program& program, dsl::StructId id) {
  const dsl::Struct& record = program.structs[id];
  if (dsl::is_scalar(record)) return true;
  if (record.size140 != record.size430) return false;
  for (const dsl::Field& field : record.fields) {
    if (field.offset140 != field.offset430) return false;
    if (field.type.record.valid() && !same_layout(program, field.type.record)) return false;
    const bool padded_elements = field.type.count > 0 && !field.type.record.valid() && field.type.columns == 1 && field.type.rows < 3;
    if (padded_elements) return false;
  }
  return true;
}

// Names the generated API takes for itself.
bool is_api_name(const dsl::Program& program, const std::string& name) {
  for (const char* taken : {"Extents", "Imports", "Params", "EngineSets", "Updates", "Conditions"})
    if (name == taken) return true;
  for (const dsl::Graph& graph : program.graphs)
    if (name == cpp_type_name(graph.name) || name == cpp_type_name(graph.name) + "Recorder") return true;
  return false;
}

class StructEmitter {
 public:
  StructEmitter(const Layout& layout, const dsl::SourceFiles& files) : layout_(layout), files_(files) {}

  std::string emit(dsl::StructId id) {
    const dsl::Struct& record = layout_.program.structs[id];
    layout_.scalar = dsl::is_scalar(record);
    const std::string name = mirror_name(layout_.program, layout_.uses, id, layout_.std140);
    const std::string place = origin(files_, record.span);
    out_.line("struct " + name + " {" + (place.empty() ? "" : "  // " + place));
    for (const dsl::Field& field : record.fields) member(field);
    pad_to(layout_.size(record));
    out_.line("};");
    asserts(record, name);
    out_.line();
    return out_.text();
  }

 private:
  void pad_to(uint32_t offset) {
    RG_CHECK(offset >= at_, "a struct's fields overlap");
    const bool words = at_ % 4 == 0 && offset % 4 == 0;
    const std::string count = std::to_string((offset - at_) / (words ? 4 : 1));
    if (offset > at_)
      out_.line(std::string(words ? "  uint32_t" : "  uint8_t") + " padding_" + std::to_string(paddings_++) + "[" + count + "] = {};");
    at_ = offset;
  }

  void member(const dsl::Field& field) {
    pad_to(layout_.offset(field));
    const dsl::Type& type = field.type;
    const uint32_t bytes = element_bytes(layout_, type), stride = array_stride(layout_, type);
    std::string text = mirror_type(layout_.program, layout_.uses, type, layout_.std140);
    if (type.count > 0 && stride != bytes) text = "rg::Padded<" + text + ", " + std::to_string(stride) + ">";
    std::string array = type.count > 0 ? "[" + std::to_string(type.count) + "]" : "";
    const bool tight = layout_.scalar && type.columns > 1 && type.rows == 3;  // columns of 12 bytes, which rg::mat3 pads
    if (tight) text = "rg::vec3", array += "[" + std::to_string(type.columns) + "]";
    const bool is_class = type.record.valid() || (type.packed != dsl::Format::none && bytes < 4u * type.rows);
    const bool is_scalar = array.empty() && !is_class && type.rows == 1 && type.columns == 1;
    out_.line("  " + text + " " + cpp_name(field.name) + array + (is_scalar ? " = 0;" : " = {};"));
    at_ += type.count > 0 ? stride * type.count : bytes;
  }

  void asserts(const dsl::Struct& record, const std::string& name) {
    std::string offsets;
    for (const dsl::Field& field : record.fields) {
      if (layout_.offset(field) == 0) continue;
      offsets += " && offsetof(" + name + ", " + cpp_name(field.name) + ") == " + std::to_string(layout_.offset(field));
    }
    const std::string check = "static_assert(sizeof(" + name + ") == " + std::to_string(layout_.size(record));
    if (check.size() + offsets.size() < 146) {
      out_.line(check + offsets + ");");
      return;
    }
    out_.line(check + ");");
    for (const dsl::Field& field : record.fields)
      if (layout_.offset(field) != 0)
        out_.line("static_assert(offsetof(" + name + ", " + cpp_name(field.name) + ") == " + std::to_string(layout_.offset(field)) + ");");
  }

  Layout layout_;
  const dsl::SourceFiles& files_;
  CppWriter out_;
  uint32_t at_ = 0, paddings_ = 0;
};

// Emits `id` in one layout after what it holds; `done` keeps each mirror to one appearance.
void emit_nested(const Layout& layout, const dsl::SourceFiles& files, dsl::StructId id, std::vector<std::string>& done, std::string& text) {
  for (const dsl::Field& field : layout.program.structs[id].fields)
    if (field.type.record.valid()) emit_nested(layout, files, field.type.record, done, text);
  const std::string name = mirror_name(layout.program, layout.uses, id, layout.std140);
  for (const std::string& other : done)
    if (other == name) return;
  done.push_back(name);
  text += StructEmitter(layout, files).emit(id);
}

// "rg::Normalized<uint8_t, 4>", of what runtime/vertex_types.h has; none where the plain types are that wide.
std::string packed_mirror(dsl::Format format) {
  const dsl::FormatInfo& row = dsl::info(format);
  const uint32_t count = dsl::components(format);
  if (format == dsl::Format::none || row.block_bytes == 4 * count) return "";
  if (format == dsl::Format::rgb10a2) return "rg::Rgb10a2";
  if (format == dsl::Format::bgra8) return "rg::Bgra8";
  const std::string components = std::to_string(count);
  if (row.numeric == dsl::Numeric::floating) return "rg::Half<" + components + ">";
  const bool is_signed = row.numeric == dsl::Numeric::snorm || row.numeric == dsl::Numeric::sint;
  const std::string number = std::string(is_signed ? "int" : "uint") + std::to_string(row.block_bytes * 8 / count) + "_t";
  return (row.is_integer() ? "rg::Integers<" : "rg::Normalized<") + number + ", " + components + ">";
}

}  // namespace

std::vector<StructUse> find_struct_uses(const dsl::Program& program) {
  Uses uses(program.structs.size());
  for (const dsl::Graph& graph : program.graphs) mark_graph(program, graph, uses);
  return uses;
}

std::string mirror_name(const dsl::Program& program, const Uses& uses, dsl::StructId id, bool std140) {
  const StructUse& use = uses[id.value];
  std::string name = cpp_name(program.structs[id].name);
  if (is_api_name(program, name)) name += "_";
  return std140 && use.std430 && !same_layout(program, id) ? name + "_std140" : name;
}

std::string mirror_type(const dsl::Program& program, const Uses& uses, const dsl::Type& type, bool std140) {
  if (type.record.valid()) return mirror_name(program, uses, type.record, std140);
  if (const std::string packed = packed_mirror(type.packed); !packed.empty()) return packed;
  if (type.columns > 1) {
    if (type.columns == type.rows) return "rg::mat" + std::to_string(type.rows);
    return "rg::mat" + std::to_string(type.columns) + "x" + std::to_string(type.rows);
  }
  const bool is_float = type.scalar == dsl::Scalar::f32, is_int = type.scalar == dsl::Scalar::i32;
  if (type.rows == 1) return is_float ? "float" : is_int ? "int32_t" : "uint32_t";
  return std::string("rg::") + (is_float ? "" : is_int ? "i" : "u") + "vec" + std::to_string(type.rows);
}

std::string emit_structs(const dsl::Program& program, const dsl::SourceFiles& files) {
  const Uses uses = find_struct_uses(program);
  std::vector<std::string> done;
  std::string text;
  for (size_t i = 0; i < program.structs.size(); ++i) {
    if (uses[i].std430) emit_nested({program, uses, false}, files, dsl::StructId{i}, done, text);
    if (uses[i].std140) emit_nested({program, uses, true}, files, dsl::StructId{i}, done, text);
  }
  return text;
}

}  // namespace rg::compiler
