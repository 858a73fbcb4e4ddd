#include "dsl/reserved.h"

#include <algorithm>
#include <iterator>

namespace rg::dsl {

// Words that GLSL keeps for its future are left to the compiler of the shaders.
bool reserved_in_glsl(std::string_view name) {
  static constexpr std::string_view kWords[] = {
      "attribute",   "bool",     "break",   "buffer",    "bvec2",      "bvec3",    "bvec4",   "case",     "centroid", "coherent",
      "const",       "continue", "default", "discard",   "do",         "double",   "dvec2",   "dvec3",    "dvec4",    "else",
      "false",       "flat",     "float",   "for",       "highp",      "if",       "image2D", "in",       "inout",    "int",
      "invariant",   "ivec2",    "ivec3",   "ivec4",     "layout",     "lowp",     "mat2",    "mat2x2",   "mat2x3",   "mat2x4",
      "mat3",        "mat3x2",   "mat3x3",  "mat3x4",    "mat4",       "mat4x2",   "mat4x3",  "mat4x4",   "mediump",  "noperspective",
      "out",         "patch",    "precise", "precision", "readonly",   "restrict", "return",  "sample",   "sampler",  "sampler2D",
      "samplerCube", "shared",   "smooth",  "struct",    "subroutine", "switch",   "true",    "uint",     "uniform",  "uvec2",
      "uvec3",       "uvec4",    "varying", "vec2",      "vec3",       "vec4",     "void",    "volatile", "while",    "writeonly"};
  return name.starts_with("gl_") || name.find("__") != std::string_view::npos || std::binary_search(std::begin(kWords), std::end(kWords), name);
}

}  // namespace rg::dsl
