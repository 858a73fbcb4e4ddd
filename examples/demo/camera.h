// A camera's matrices. View space: x right, y down, z forward. Depth is reversed with an infinite far plane: near / z.
#pragma once

#include <glm/glm.hpp>

#include "examples/demo/scene.h"

namespace rg::demo {

struct Projection {
  glm::vec2 scale{1};   // clip = scale * (x / z, y / z) + jitter
  glm::vec2 jitter{0};  // clip space
  float near = 0.1f;
};

glm::mat4 world_to_view(const NamedCamera& camera);
glm::mat4 view_to_clip(const Projection& projection);
Projection project(const NamedCamera& camera, glm::vec2 size);

// Halton (2, 3), eight places, within half a pixel of its centre.
glm::vec2 jitter_of(uint32_t frame, glm::vec2 size);

// Orthographic, towards the ground from the sun; reversed depth in 0..1.
glm::mat4 world_to_sun(const Sun& sun);

}  // namespace rg::demo
