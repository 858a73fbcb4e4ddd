// Enough of GLSL in C++ to compile the frame's own shader includes into a test: what is checked is the text that the GPU runs.
// Include the .glsl file inside a namespace with using-declarations of these names and whatever else the file needs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace rg::reference::glsl {

using uint = uint32_t;
using glm::dot;
using glm::vec2, glm::vec3, glm::vec4;

// GLSL's literals are floats, C++'s are doubles.
template <class A, class B>
auto max(A a, B b) {
  return static_cast<A>(b) > a ? static_cast<A>(b) : a;
}
template <class A, class B>
auto min(A a, B b) {
  return static_cast<A>(b) < a ? static_cast<A>(b) : a;
}
template <class A, class B, class C>
A clamp(A x, B low, C high) {
  return min(max(x, low), high);
}
inline float sqrt(float x) { return std::sqrt(x); }

}  // namespace rg::reference::glsl
