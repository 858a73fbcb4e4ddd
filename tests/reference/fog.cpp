#include "tests/reference/fog.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/culling.h"
#include "tests/reference/lamps.h"

namespace rg::reference {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec2 slopes(const frame::View& view, const frame::Fog& fog, glm::dvec2 cell) {
  return (cell / glm::dvec2(fog.count.x, fog.count.y) * 2.0 - 1.0) / to_double(view.scale);
}

glm::dvec3 to_box(const frame::FogVolume& volume, glm::dvec3 p) {
  glm::dvec3 out;
  for (int row = 0; row < 3; ++row) {
    const rg::vec4& r = volume.to_box.column[static_cast<size_t>(row)];
    out[row] = r.x * p.x + r.y * p.y + r.z * p.z + r.w;
  }
  return out;
}

double greatest(glm::dvec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

double slice_depth(const frame::Fog& fog, double slice) {
  const double bounds[] = {fog.start, fog.ends.x, fog.ends.y, fog.ends.z, fog.ends.w};
  const double at = std::clamp(slice / fog.count.z, 0.0, 1.0) * 4;
  const int range = std::min(static_cast<int>(at), 3);
  return bounds[range] + (at - range) * (bounds[range + 1] - bounds[range]);
}

glm::dvec3 froxel_position(const frame::View& view, const frame::Fog& fog, glm::dvec3 cell) {
  const glm::dvec3 in_view = glm::dvec3(slopes(view, fog, glm::dvec2(cell)), 1) * slice_depth(fog, cell.z);
  return glm::inverse(to_double(view.world_to_view)) * glm::dvec4(in_view, 1);
}

bool holds(const frame::FogVolume& volume, glm::dvec3 point) { return greatest(to_box(volume, point)) < 1; }

double fog_density(const frame::Fog& fog, const std::vector<frame::FogVolume>& volumes, glm::dvec3 point) {
  double sum = fog.density * std::exp(-std::max(point.y - fog.ground, 0.0) * fog.thinning);
  for (uint32_t i = 0; i < fog.volume_count; ++i)
    sum += volumes[i].density * std::clamp((1 - greatest(to_box(volumes[i], point))) / volumes[i].edge, 0.0, 1.0);
  return sum;
}

glm::dvec3 scattered_light(const frame::View& view, const frame::Fog& fog, const std::vector<frame::Light>& lights, glm::dvec3 point) {
  const double cosine = glm::dot(glm::normalize(point - to_double(view.position)), to_double(view.sun_direction)), g = fog.phase;
  const double phase = (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  glm::dvec3 lamps(0);
  for (const frame::Light& light : lights) lamps += lamp_irradiance(light, point);
  return to_double(view.sun_color) * phase + to_double(view.ambient) + glm::max(lamps, 0.0) / (4 * kPi);
}

std::vector<FogSum> march(const frame::View& view, const frame::Fog& fog, glm::ivec2 column, const std::vector<glm::dvec3>& inscatter,
                          const std::vector<double>& extinction) {
  const double slant = glm::length(glm::dvec3(slopes(view, fog, glm::dvec2(column) + 0.5), 1));
  std::vector<FogSum> sums;
  FogSum sum;
  for (size_t z = 0; z < inscatter.size(); ++z) {
    const double metres = (slice_depth(fog, static_cast<double>(z) + 1) - slice_depth(fog, static_cast<double>(z))) * slant;
    const double thickness = extinction[z] * metres;
    sum.light += sum.through * inscatter[z] * (thickness > 0 ? -std::expm1(-thickness) / extinction[z] : metres);
    sum.through *= std::exp(-thickness);
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace rg::reference
