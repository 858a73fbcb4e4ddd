#include "compiler/shaders/stage_interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <spirv_cross.hpp>
#include <tuple>

namespace rg::compiler {
namespace {

using spirv_cross::Compiler;
using spirv_cross::SPIRType;

// The kind of number, as GLSL begins the names of its vectors.
struct Number {
  const char *scalar, *prefix;
};
Number number_of(const SPIRType& type) {
  switch (type.basetype) {
    case SPIRType::Int:
      return {"int", "i"};
    case SPIRType::UInt:
      return {"uint", "u"};
    case SPIRType::Double:
      return {"double", "d"};
    case SPIRType::Half:
      return {"float16_t", "f16"};
    case SPIRType::Float:
      return {"float", ""};
    default:
      return {"another type", "another "};
  }
}

std::string type_text(const SPIRType& type) {
  const Number number = number_of(type);
  return type.vecsize == 1 ? number.scalar : number.prefix + ("vec" + std::to_string(type.vecsize));
}

// Appends the vectors of a type and gives the next location.
uint32_t add_slots(const Compiler& compiler, const SPIRType& type, const StageSlot& at, std::vector<StageSlot>& slots) {
  if (!type.array.empty()) {
    uint32_t location = at.location;
    const SPIRType& element = compiler.get_type(type.parent_type);
    for (uint32_t i = 0; i < type.array.back(); ++i) location = add_slots(compiler, element, {at.name, location, at.component, {}, 1}, slots);
    return location;
  }
  uint32_t location = at.location;
  if (type.basetype == SPIRType::Struct) {
    for (uint32_t i = 0; i < type.member_types.size(); ++i) {
      if (compiler.has_member_decoration(type.self, i, spv::DecorationBuiltIn)) continue;
      if (compiler.has_member_decoration(type.self, i, spv::DecorationLocation))
        location = compiler.get_member_decoration(type.self, i, spv::DecorationLocation);
      location = add_slots(compiler, compiler.get_type(type.member_types[i]), {at.name, location, 0, {}, 1}, slots);
    }
    return location;
  }
  const uint32_t locations = type.width == 64 && type.vecsize > 2 ? 2 : 1;
  for (uint32_t column = 0; column < type.columns; ++column, location += locations)
    slots.push_back({at.name, location, at.component, type_text(type), type.vecsize});
  return location;
}

// "vec2" where "vec3" is written is a part of it.
bool fits(const StageSlot& input, const StageSlot& output) {
  const auto kind = [](const StageSlot& slot) { return slot.components == 1 ? slot.type : slot.type.substr(0, slot.type.size() - 1); };
  if (input.components == output.components) return input.type == output.type;
  if (input.components > output.components) return false;
  const auto scalar = [](const std::string& vector) {
    return vector == "vec" ? std::string("float") : vector == "ivec" ? "int" : vector == "uvec" ? "uint" : vector == "dvec" ? "double" : "float16_t";
  };
  return input.components == 1 ? input.type == scalar(kind(output)) : kind(input) == kind(output);
}

}  // namespace

std::vector<StageSlot> stage_slots(const Words& words, bool inputs) {
  const Compiler compiler(words);
  const auto active = compiler.get_active_interface_variables();
  const auto resources = compiler.get_shader_resources(active);
  std::vector<StageSlot> slots;
  for (const auto& variable : inputs ? resources.stage_inputs : resources.stage_outputs) {
    const SPIRType& type = compiler.get_type(variable.base_type_id);
    const SPIRType& whole = compiler.get_type(variable.type_id);
    const StageSlot at{variable.name,
                       compiler.get_decoration(variable.id, spv::DecorationLocation),
                       compiler.get_decoration(variable.id, spv::DecorationComponent),
                       {},
                       1};
    add_slots(compiler, whole.array.empty() ? type : whole, at, slots);
  }
  std::sort(slots.begin(), slots.end(),
            [](const StageSlot& a, const StageSlot& b) { return std::tie(a.location, a.component) < std::tie(b.location, b.component); });
  return slots;
}

bool check_stage_interface(const PassContext& context, const ShaderUse& vertex, const Words& vertex_words, const ShaderUse& fragment,
                           const Words& fragment_words, ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  const std::vector<StageSlot> outputs = stage_slots(vertex_words, false);
  for (const StageSlot& input : stage_slots(fragment_words, true)) {
    const auto same = [&](const StageSlot& output) { return output.location == input.location && output.component == input.component; };
    const auto written = std::find_if(outputs.begin(), outputs.end(), same);
    if (written != outputs.end() && fits(input, *written)) continue;
    const std::string found = written == outputs.end() ? "nothing there" : "`" + written->type + " " + written->name + "`";
    dsl::Diagnostic& error = diagnostics.report(dsl::DiagnosticKind::StagesDisagree, places.word(fragment.path, input.name),
                                                {input.type + " " + input.name, std::to_string(input.location), context.pass.name, found});
    if (written == outputs.end() || is_generated_fullscreen(vertex))
      error.note(dsl::DiagnosticKind::ShaderOfPass, vertex.shader.span, {context.pass.name});
    else
      error.note(dsl::DiagnosticKind::AccessUsedHere, places.word(vertex.path, written->name), {written->name});
    return false;
  }
  return true;
}

bool check_own_outputs(const PassContext& context, const ShaderUse& fragment, const Words& words, ShaderPlaces& places,
                       dsl::Diagnostics& diagnostics) {
  const auto is_color = [](const dsl::Access& access) { return access.role == dsl::Role::color; };
  const auto colors = std::count_if(context.pass.accesses.begin(), context.pass.accesses.end(), is_color);
  for (const StageSlot& output : stage_slots(words, false)) {
    if (output.location < static_cast<uint32_t>(colors)) continue;
    const std::string has = colors == 0 ? "no colour" : fmt::format("{} colour{}", colors, colors == 1 ? "" : "s");
    diagnostics
        .report(dsl::DiagnosticKind::OwnOutput, places.word(fragment.path, output.name),
                {output.name, std::to_string(output.location), context.pass.name, has})
        .note(dsl::DiagnosticKind::ShaderOfPass, fragment.shader.span, {context.pass.name});
    return false;
  }
  return true;
}

}  // namespace rg::compiler
