#include "compiler/shaders/glsl_types.h"

#include <map>

#include "dsl/format_table.h"

namespace rg::compiler {
namespace {

const char* scalar_name(dsl::Scalar scalar) {
  switch (scalar) {
    case dsl::Scalar::f32:
      return "float";
    case dsl::Scalar::i32:
      return "int";
    case dsl::Scalar::u32:
      return "uint";
    case dsl::Scalar::boolean:
      return "bool";
  }
  return "float";
}

const char* vector_prefix(dsl::Scalar scalar) {
  switch (scalar) {
    case dsl::Scalar::f32:
      return "";
    case dsl::Scalar::i32:
      return "i";
    case dsl::Scalar::u32:
      return "u";
    case dsl::Scalar::boolean:
      return "b";
  }
  return "";
}

}  // namespace

std::string glsl_type(const dsl::Program& program, const dsl::Type& type) {
  if (type.record.valid()) return program.structs[type.record].name;
  const std::string rows = std::to_string(type.rows);
  if (type.columns > 1) {
    if (type.columns == type.rows) return "mat" + rows;
    return "mat" + std::to_string(type.columns) + "x" + rows;
  }
  if (type.rows == 1) return scalar_name(type.scalar);
  return std::string(vector_prefix(type.scalar)) + "vec" + rows;
}

std::string glsl_variable(const dsl::Program& program, const dsl::Type& type, const std::string& name) {
  const std::string array = type.count > 0 ? "[" + std::to_string(type.count) + "]" : "";
  return glsl_type(program, type) + " " + name + array;
}

std::string glsl_image_format(dsl::Format format) {
  using dsl::Format;
  static const std::map<Format, const char*> names = {
      {Format::r8, "r8"},
      {Format::r8ui, "r8ui"},
      {Format::rg8, "rg8"},
      {Format::rgba8, "rgba8"},
      {Format::rgba8_snorm, "rgba8_snorm"},
      {Format::rgba8ui, "rgba8ui"},
      {Format::rgb10a2, "rgb10_a2"},
      {Format::r16, "r16"},
      {Format::r16ui, "r16ui"},
      {Format::r16f, "r16f"},
      {Format::rg16, "rg16"},
      {Format::rg16_snorm, "rg16_snorm"},
      {Format::rg16f, "rg16f"},
      {Format::rgba16, "rgba16"},
      {Format::rgba16f, "rgba16f"},
      {Format::r32ui, "r32ui"},
      {Format::r32i, "r32i"},
      {Format::r32f, "r32f"},
      {Format::rg32ui, "rg32ui"},
      {Format::rg32f, "rg32f"},
      {Format::rgba32ui, "rgba32ui"},
      {Format::rgba32f, "rgba32f"},
      {Format::r11g11b10f, "r11f_g11f_b10f"},
      {Format::rgb10a2ui, "rgb10_a2ui"},
      {Format::r8_snorm, "r8_snorm"},
      {Format::r8i, "r8i"},
      {Format::rg8_snorm, "rg8_snorm"},
      {Format::rg8ui, "rg8ui"},
      {Format::rg8i, "rg8i"},
      {Format::rgba8i, "rgba8i"},
      {Format::r16_snorm, "r16_snorm"},
      {Format::r16i, "r16i"},
      {Format::rg16ui, "rg16ui"},
      {Format::rg16i, "rg16i"},
      {Format::rgba16_snorm, "rgba16_snorm"},
      {Format::rgba16ui, "rgba16ui"},
      {Format::rgba16i, "rgba16i"},
      {Format::rg32i, "rg32i"},
      {Format::rgba32i, "rgba32i"},
  };
  const auto found = names.find(format);
  return found == names.end() ? "" : found->second;
}

char texel_kind(dsl::Format format, uint32_t aspects) {
  const dsl::FormatInfo& info = dsl::info(format);
  if (!info.is_color()) return aspects == dsl::aspect_stencil || info.aspects == dsl::aspect_stencil ? 'u' : 'f';
  if (info.numeric == dsl::Numeric::uint) return 'u';
  return info.numeric == dsl::Numeric::sint ? 'i' : 'f';
}

}  // namespace rg::compiler
