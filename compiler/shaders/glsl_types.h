// How the language's types and formats are spelt in GLSL.
#pragma once

#include <cstdint>
#include <string>

#include "dsl/program.h"

namespace rg::compiler {

// "float", "uvec3", "mat3x4", "View"; without array brackets.
std::string glsl_type(const dsl::Program& program, const dsl::Type& type);
// "vec4 weights[4]"
std::string glsl_variable(const dsl::Program& program, const dsl::Type& type, const std::string& name);

// Storage-image qualifier, "rgba16f"; empty where GLSL has none for the format.
std::string glsl_image_format(dsl::Format format);
// What a texel reads as: 'f' float, 'u' unsigned, 'i' signed. `aspects` picks depth (2) or stencil (4) of a combined format.
char texel_kind(dsl::Format format, uint32_t aspects);

}  // namespace rg::compiler
