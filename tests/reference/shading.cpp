#include "tests/reference/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rg::reference {
namespace {

constexpr double kPi = std::numbers::pi;

// Smith's masking function of GGX, for one direction.
double lambda(double cosine, double alpha) {
  const double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
  return 0.5 * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
}

}  // namespace

glm::dvec3 specular_reflected(const SurfacePoint& s, glm::dvec3 direction, glm::dvec3 strength) {
  const double n_l = glm::dot(s.normal, direction), n_v = std::max(glm::dot(s.normal, s.eye), 1e-3);
  if (n_l <= 0) return glm::dvec3(0);
  const double alpha = s.roughness * s.roughness;
  const glm::dvec3 half = glm::normalize(direction + s.eye);
  const double n_h = std::clamp(glm::dot(s.normal, half), 0.0, 1.0), v_h = std::clamp(glm::dot(s.eye, half), 0.0, 1.0);
  const double distribution = alpha * alpha / (kPi * std::pow(n_h * n_h * (alpha * alpha - 1) + 1, 2));
  const double masking = 1 / (1 + lambda(n_l, alpha) + lambda(n_v, alpha));
  const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), s.base, s.metallic);
  const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1 - v_h, 5);
  return fresnel * (distribution * masking / (4 * n_l * n_v)) * strength * n_l;
}

glm::dvec3 reflected(const SurfacePoint& s, glm::dvec3 direction, glm::dvec3 strength) {
  const glm::dvec3 diffuse = s.base * ((1 - s.metallic) / kPi) * strength * std::max(glm::dot(s.normal, direction), 0.0);
  return diffuse + specular_reflected(s, direction, strength);
}

glm::dvec3 decode_normal(uint16_t x, uint16_t y) {
  glm::dvec2 p = glm::dvec2(x, y) / 65535.0 * 2.0 - 1.0;
  const double z = 1 - std::abs(p.x) - std::abs(p.y);
  if (z < 0) p = glm::dvec2((1 - std::abs(p.y)) * (p.x >= 0 ? 1 : -1), (1 - std::abs(p.x)) * (p.y >= 0 ? 1 : -1));
  return glm::normalize(glm::dvec3(p, z));
}

glm::dvec3 tone_map(glm::dvec3 light) {
  glm::dvec3 out;
  for (int i = 0; i < 3; ++i) {
    const double x = light[i], film = std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    out[i] = film <= 0.0031308 ? 12.92 * film : 1.055 * std::pow(film, 1 / 2.4) - 0.055;
  }
  return out;
}

}  // namespace rg::reference
