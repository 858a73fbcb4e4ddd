// Lamps and their features in double precision. Shadows and pictures are looked up in what was read back from the device, or in a texture layer.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "frame.h"
#include "tests/reference/shading.h"

namespace rg::reference {

// What a lamp shows at `at` in -1 .. 1 of its picture, seen with a blur of `metres` (areas; 0: sharp). White by default.
using Picture = std::function<glm::dvec3(const frame::Light&, glm::dvec2 at, double metres)>;
// Share of the lamp that a point sees; `off`: unit normal, 0 in the open. NaN where a compare is too close to call. 1 by default.
using Visibility = std::function<double(const frame::Light&, glm::dvec3 point, glm::dvec3 off)>;
struct LampTextures {
  Picture picture = [](const frame::Light&, glm::dvec2, double) { return glm::dvec3(1); };
  Visibility visibility = [](const frame::Light&, glm::dvec3, glm::dvec3) { return 1.0; };
};

// A point as a lamp sees it: distance along its direction, and -1 .. 1 between its sides.
struct LampPlace {
  double along = 0;
  glm::dvec2 across{0};
};
LampPlace lamp_place(const frame::Light& light, glm::dvec3 point);

// Radiance towards the eye, of one lamp and of all; irradiance on something small that is lit from all sides.
glm::dvec3 lamp_radiance(const SurfacePoint& surface, const frame::Light& light, const LampTextures& textures = {});
glm::dvec3 lamps_radiance(const SurfacePoint& surface, const std::vector<frame::Light>& lights, const LampTextures& textures = {});
glm::dvec3 lamp_irradiance(const frame::Light& light, glm::dvec3 point, const LampTextures& textures = {});

// Solid angle of a rectangle, by the angles between the planes through its sides.
double rectangle_angle(const glm::dvec3 (&corners)[4]);

}  // namespace rg::reference
