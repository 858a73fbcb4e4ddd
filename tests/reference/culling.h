// Plain statements of what the culling passes must give. Double precision, no bit tricks, nothing shared with the shaders.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame.h"

namespace rg::reference {

inline glm::dvec3 to_double(const rg::vec3& v) { return {v.x, v.y, v.z}; }
inline glm::dvec2 to_double(const rg::vec2& v) { return {v.x, v.y}; }
inline glm::dmat4 to_double(const rg::mat4& m) {
  glm::dmat4 out;
  for (int c = 0; c < 4; ++c) out[c] = {m.column[c].x, m.column[c].y, m.column[c].z, m.column[c].w};
  return out;
}

// Where the centre of a pixel lies in the world, at reversed depth `depth` > 0.
glm::dvec3 world_position(const frame::View& view, int x, int y, double depth);

// True if the light adds something to a point that faces it.
bool contains(const frame::Light& light, glm::dvec3 point);

// min | max << 16 of the indices of the lights that overlap each bin; 0x0000FFFF where none does.
// The bin of a depth is computed in float, as one product: it has to agree bit for bit.
std::vector<uint32_t> build_zbins(const std::vector<frame::Light>& lights, float bins_per_metre);

// Distance from a point to a solid cone with its tip at the origin along +z, cut off flat at `height`. Zero inside.
double cone_distance(glm::dvec3 point, double half_angle, double height);

}  // namespace rg::reference
