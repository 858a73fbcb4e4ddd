// The fog's equations in double precision, froxel by froxel, with brute force over lamps and boxes.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame.h"

namespace rg::reference {

// View depth of a place among the slices, 0 .. count.z; the four ranges are divided evenly.
double slice_depth(const frame::Fog& fog, double slice);
// World position of `cell`, in froxels: the middle of the first one is (0.5, 0.5, 0.5).
glm::dvec3 froxel_position(const frame::View& view, const frame::Fog& fog, glm::dvec3 cell);

// Extinction at a point, 1 / metre; `volumes` are masked by white.
double fog_density(const frame::Fog& fog, const std::vector<frame::FogVolume>& volumes, glm::dvec3 point);
bool holds(const frame::FogVolume& volume, glm::dvec3 point);

// Light scattered at a point towards the camera for a density and an albedo of one; nothing is in shadow.
glm::dvec3 scattered_light(const frame::View& view, const frame::Fog& fog, const std::vector<frame::Light>& lights, glm::dvec3 point);

// What a column of froxels adds up to: front to back, one entry a slice.
struct FogSum {
  glm::dvec3 light{0};
  double through = 1;
};
std::vector<FogSum> march(const frame::View& view, const frame::Fog& fog, glm::ivec2 column, const std::vector<glm::dvec3>& inscatter,
                          const std::vector<double>& extinction);

}  // namespace rg::reference
