// The lighting model of passes/lighting in double precision, written from its equations.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame.h"

namespace rg::reference {

struct SurfacePoint {
  glm::dvec3 position{0}, normal{0, 1, 0}, eye{0, 1, 0};  // eye: unit, towards the camera
  glm::dvec3 base{1};
  double roughness = 1, metallic = 0;
};
// Radiance towards the eye of a light from `direction` with irradiance `strength` on a plane that faces it; its glossy part alone.
glm::dvec3 reflected(const SurfacePoint& surface, glm::dvec3 direction, glm::dvec3 strength);
glm::dvec3 specular_reflected(const SurfacePoint& surface, glm::dvec3 direction, glm::dvec3 strength);

// Octahedral normal from two unorm16.
glm::dvec3 decode_normal(uint16_t x, uint16_t y);

// Narkowicz' filmic fit, then the sRGB curve.
glm::dvec3 tone_map(glm::dvec3 light);

}  // namespace rg::reference
