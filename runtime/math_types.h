// Vectors and matrices as plain aggregates, laid out as GLSL's std430 lays them out. Arithmetic is the engine's business; fill them by memcpy or
// member.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rg {

struct vec2 {
  float x = 0, y = 0;
};
struct vec3 {
  float x = 0, y = 0, z = 0;
};  // 12 bytes; what follows may use the fourth word
struct vec4 {
  float x = 0, y = 0, z = 0, w = 0;
};
struct ivec2 {
  int32_t x = 0, y = 0;
};
struct ivec3 {
  int32_t x = 0, y = 0, z = 0;
};
struct ivec4 {
  int32_t x = 0, y = 0, z = 0, w = 0;
};
struct uvec2 {
  uint32_t x = 0, y = 0;
};
struct uvec3 {
  uint32_t x = 0, y = 0, z = 0;
};
struct uvec4 {
  uint32_t x = 0, y = 0, z = 0, w = 0;
};

// Columns first: `column[3]` is the translation of an affine mat4.
struct mat4 {
  vec4 column[4] = {};
};
struct mat3x4 {
  vec4 column[3] = {};
};  // 3 columns of 4 rows
struct mat3 {
  vec4 column[3] = {};
};  // of 3 rows; the fourth word of each column is padding

// An array element whose stride is larger than its type.
template <class T, size_t Stride>
struct Padded {
  static_assert(Stride > sizeof(T));
  T value = {};
  std::byte padding[Stride - sizeof(T)] = {};
};

}  // namespace rg
