#include "dsl/reserved.h"

#include <algorithm>
#include <iterator>

namespace rg::dsl {
namespace {

// `image2D`, `usamplerCubeArray`, `texture2DMS`: of what shaders see through descriptors.
bool names_opaque_type(std::string_view name) {
  static constexpr std::string_view kShapes[] = {"1D",      "2D",        "3D",   "Cube",      "Buffer", "1DArray",
                                                 "2DArray", "CubeArray", "2DMS", "2DMSArray", "2DRect"};
  static constexpr std::string_view kShadows[] = {"Shadow",        "1DShadow",      "2DShadow",        "CubeShadow",
                                                  "1DArrayShadow", "2DArrayShadow", "CubeArrayShadow", "2DRectShadow"};
  const auto is_one = [](std::string_view word, std::string_view kind, const auto& shapes) {
    return word.starts_with(kind) && std::find(std::begin(shapes), std::end(shapes), word.substr(kind.size())) != std::end(shapes);
  };
  const std::string_view whole = name.starts_with('i') || name.starts_with('u') ? name.substr(1) : name;
  if (name == "sampler" || is_one(name, "sampler", kShadows)) return true;
  for (const std::string_view word : {name, whole}) {
    if (word == "subpassInput" || word == "subpassInputMS") return true;
    for (const std::string_view kind : {"image", "sampler", "texture"})
      if (is_one(word, kind, kShapes)) return true;
  }
  return false;
}

}  // namespace

// What the shaders' compiler takes for itself, words kept for GLSL's future among it.
bool reserved_in_glsl(std::string_view name) {
  static constexpr std::string_view kWords[] = {
      "active",   "asm",       "atomic_uint", "attribute",     "bool",      "break",         "buffer",        "bvec2",
      "bvec3",    "bvec4",     "case",        "cast",          "centroid",  "class",         "coherent",      "common",
      "const",    "continue",  "default",     "discard",       "dmat2",     "dmat2x2",       "dmat2x3",       "dmat2x4",
      "dmat3",    "dmat3x2",   "dmat3x3",     "dmat3x4",       "dmat4",     "dmat4x2",       "dmat4x3",       "dmat4x4",
      "do",       "double",    "dvec2",       "dvec3",         "dvec4",     "else",          "enum",          "extern",
      "external", "false",     "filter",      "fixed",         "flat",      "float",         "for",           "fvec2",
      "fvec3",    "fvec4",     "goto",        "half",          "highp",     "hvec2",         "hvec3",         "hvec4",
      "if",       "in",        "inline",      "inout",         "input",     "int",           "interface",     "invariant",
      "ivec2",    "ivec3",     "ivec4",       "layout",        "long",      "lowp",          "mat2",          "mat2x2",
      "mat2x3",   "mat2x4",    "mat3",        "mat3x2",        "mat3x3",    "mat3x4",        "mat4",          "mat4x2",
      "mat4x3",   "mat4x4",    "mediump",     "namespace",     "noinline",  "nonuniformEXT", "noperspective", "out",
      "output",   "partition", "patch",       "precise",       "precision", "public",        "readonly",      "resource",
      "restrict", "return",    "sample",      "sampler3DRect", "shared",    "short",         "sizeof",        "smooth",
      "static",   "struct",    "subroutine",  "superp",        "switch",    "template",      "this",          "true",
      "typedef",  "uint",      "uniform",     "union",         "unsigned",  "using",         "uvec2",         "uvec3",
      "uvec4",    "varying",   "vec2",        "vec3",          "vec4",      "void",          "volatile",      "while",
      "writeonly"};
  const bool word = std::binary_search(std::begin(kWords), std::end(kWords), name);
  return name.starts_with("gl_") || name.find("__") != std::string_view::npos || word || names_opaque_type(name);
}

}  // namespace rg::dsl
