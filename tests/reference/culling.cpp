#include "tests/reference/culling.h"

#include <algorithm>
#include <cmath>

namespace rg::reference {
namespace {

uint32_t bin_of(float depth, float bins_per_metre) {
  const float scaled = depth * bins_per_metre;
  if (!(scaled > 0)) return 0;
  return std::min(static_cast<uint32_t>(std::min(scaled, 1e6f)), static_cast<uint32_t>(frame::ZBINS - 1));
}

double segment_distance(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 d = b - a;
  const double t = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
  return glm::distance(p, a + t * d);
}

}  // namespace

glm::dvec3 world_position(const frame::View& view, int x, int y, double depth) {
  const glm::dvec2 size = to_double(view.size), clip = (glm::dvec2(x, y) + 0.5) / size * 2.0 - 1.0;
  const double z = view.near / depth;
  const glm::dvec2 at = (clip - to_double(view.jitter)) / to_double(view.scale) * z;
  return glm::inverse(to_double(view.world_to_view)) * glm::dvec4(at, z, 1);
}

bool contains(const frame::Light& light, glm::dvec3 point) {
  const glm::dvec3 from = point - to_double(light.position);
  const double distance = glm::length(from);
  if (distance >= light.range) return false;
  if ((light.features & static_cast<uint32_t>(frame::LAMP_ROUND | frame::LAMP_SQUARE)) == 0) return true;
  return glm::dot(from / std::max(distance, 1e-9), to_double(light.direction)) > light.cos_outer;
}

std::vector<uint32_t> build_zbins(const std::vector<frame::Light>& lights, float bins_per_metre) {
  std::vector<uint32_t> least(frame::ZBINS, 0xFFFF), greatest(frame::ZBINS, 0);
  for (uint32_t index = 0; index < lights.size(); ++index) {
    if (lights[index].farthest < 0) continue;
    for (uint32_t bin = bin_of(lights[index].nearest, bins_per_metre); bin <= bin_of(lights[index].farthest, bins_per_metre); ++bin) {
      least[bin] = std::min(least[bin], index);
      greatest[bin] = std::max(greatest[bin], index);
    }
  }
  std::vector<uint32_t> bins(frame::ZBINS);
  for (size_t i = 0; i < bins.size(); ++i) bins[i] = least[i] | greatest[i] << 16;
  return bins;
}

// In the half plane of the axis and the point, the cone is a triangle.
double cone_distance(glm::dvec3 point, double half_angle, double height) {
  const glm::dvec2 p(glm::length(glm::dvec2(point)), point.z), rim(height * std::tan(half_angle), height);
  const bool inside = p.y >= 0 && p.y <= height && p.x <= p.y * std::tan(half_angle);
  if (inside) return 0;
  return std::min({segment_distance(p, {0, 0}, rim), segment_distance(p, rim, {0, height}), segment_distance(p, {0, 0}, {0, height})});
}

}  // namespace rg::reference
