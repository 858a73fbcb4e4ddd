#include "tests/reference/lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/culling.h"

namespace rg::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSize2 = 0.01;

bool has(const frame::Light& light, int32_t feature) { return (light.features & static_cast<uint32_t>(feature)) != 0; }
glm::dvec2 size_of(const frame::Light& light) { return to_double(light.size); }

double window(const frame::Light& light, double distance2) {
  return std::pow(std::max(1 - std::pow(distance2 / (static_cast<double>(light.range) * light.range), 2), 0.0), 2);
}

double beam(const frame::Light& light, glm::dvec3 point, glm::dvec3 towards) {
  double share = 1;
  const LampPlace place = lamp_place(light, point);
  if (has(light, frame::LAMP_ROUND))
    share *= std::pow(std::clamp((glm::dot(-towards, to_double(light.direction)) - light.cos_outer) * light.edge, 0.0, 1.0), 2);
  if (has(light, frame::LAMP_SQUARE)) {
    const double rim = std::clamp((1 - std::max(std::abs(place.across.x), std::abs(place.across.y))) * light.edge, 0.0, 1.0);
    share *= place.along > 0 ? rim * rim : 0;
  }
  return share;
}

bool is_clipped(const frame::Light& light, glm::dvec3 p) {
  const auto side = [&](const rg::vec4& plane) { return plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w; };
  return has(light, frame::LAMP_CLIPPED) && (side(light.clip[0]) < 0 || side(light.clip[1]) < 0);
}

glm::dvec3 filter(const frame::Light& light, glm::dvec3 p, glm::dvec3 towards, glm::dvec3 off, const LampTextures& textures) {
  if (is_clipped(light, p)) return glm::dvec3(0);
  glm::dvec3 share(beam(light, p, towards) * (has(light, frame::LAMP_DARK) ? -1 : 1));
  if (has(light, frame::LAMP_PROJECTED)) {
    const LampPlace place = lamp_place(light, p);
    const bool inside = place.along > 0 && std::max(std::abs(place.across.x), std::abs(place.across.y)) < 1;
    share *= inside ? textures.picture(light, place.across, 0) : glm::dvec3(0);
  }
  if (has(light, frame::LAMP_SHADOW)) share *= textures.visibility(light, p, off);
  return share;
}

// ---- tubes

struct Ends {
  glm::dvec3 a, b;
};
Ends ends_of(const frame::Light& light, glm::dvec3 to) {
  const glm::dvec3 half = to_double(light.side) * size_of(light).x;
  return {to - half, to + half};
}
double tube_spread(const Ends& e) { return 2 / (glm::length(e.a) * glm::length(e.b) + glm::dot(e.a, e.b) + 2 * kSize2); }

// The point of the capsule nearest to the mirrored ray, by search along the axis.
glm::dvec3 nearest_of_tube(const Ends& e, glm::dvec3 mirrored, double radius) {
  const glm::dvec3 axis = e.b - e.a;
  // Distance of a + t axis from the line along `mirrored`: a parabola in t.
  const auto across = [&](glm::dvec3 v) { return v - mirrored * glm::dot(v, mirrored); };
  const glm::dvec3 a = across(e.a), d = across(axis);
  const double t = glm::dot(d, d) > 1e-12 ? std::clamp(-glm::dot(a, d) / glm::dot(d, d), 0.0, 1.0) : 0.0;
  const glm::dvec3 p = e.a + axis * t, aside = -across(p);
  const double length = glm::length(aside);
  return length > 1e-9 ? p + aside * std::min(radius / length, 1.0) : p;
}

// Lobe of a surface as if it were lit from `towards` with an irradiance of one, without its diffuse part.
glm::dvec3 specular(const SurfacePoint& s, glm::dvec3 towards) { return specular_reflected(s, towards, glm::dvec3(1)); }

glm::dvec3 diffuse_color(const SurfacePoint& s) { return s.base * ((1 - s.metallic) / kPi); }
glm::dvec3 mirrored(const SurfacePoint& s) { return s.normal * (2 * glm::dot(s.normal, s.eye)) - s.eye; }

glm::dvec3 tube_radiance(const SurfacePoint& s, const frame::Light& light, glm::dvec3 to, glm::dvec3 color) {
  const Ends e = ends_of(light, to);
  const double cosine = 0.5 * (glm::dot(s.normal, glm::normalize(e.a)) + glm::dot(s.normal, glm::normalize(e.b)));
  glm::dvec3 sum = diffuse_color(s) * color * (std::max(cosine, 0.0) * tube_spread(e));
  const glm::dvec3 p = nearest_of_tube(e, mirrored(s), size_of(light).y);
  const double p2 = glm::dot(p, p), reach = std::sqrt(p2 + kSize2), alpha = s.roughness * s.roughness;
  const double wide = std::min(alpha + size_of(light).y / (3 * reach), 1.0), along = std::min(alpha + size_of(light).x / (3 * reach), 1.0);
  return sum + specular(s, glm::normalize(p)) * color * (std::pow(alpha / wide, 2) * (alpha / along) / (p2 + kSize2));
}

// ---- areas

struct Rectangle {
  glm::dvec3 u, v, corner[4];  // half sides; corners seen from the point
};
Rectangle rectangle_of(const frame::Light& light, glm::dvec3 to) {
  Rectangle r;
  r.u = to_double(light.side) * size_of(light).x;
  r.v = glm::cross(to_double(light.direction), to_double(light.side)) * size_of(light).y;
  const glm::dvec2 signs[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int i = 0; i < 4; ++i) r.corner[i] = to + r.u * signs[i].x + r.v * signs[i].y;
  return r;
}

glm::dvec2 place_on(const frame::Light& light, const Rectangle& r, glm::dvec3 from_middle) {
  const glm::dvec2 at = {glm::dot(from_middle, glm::normalize(r.u)), glm::dot(from_middle, glm::normalize(r.v))};
  return glm::clamp(at, -size_of(light), size_of(light));
}

glm::dvec3 area_radiance(const SurfacePoint& s, const frame::Light& light, glm::dvec3 to, glm::dvec3 color, const LampTextures& textures) {
  const double behind = glm::dot(to, to_double(light.direction));
  if (behind >= 0) return glm::dvec3(0);
  const Rectangle r = rectangle_of(light, to);
  const double angle = rectangle_angle(r.corner);
  double cosines = std::max(glm::dot(s.normal, glm::normalize(to)), 0.0);
  for (const glm::dvec3& corner : r.corner) cosines += std::max(glm::dot(s.normal, glm::normalize(corner)), 0.0);
  const glm::dvec3 shown = textures.picture(light, place_on(light, r, -to) / size_of(light), -2 * behind);
  const glm::dvec3 sum = diffuse_color(s) * color * shown * (angle * cosines / 5);

  const glm::dvec3 ray = mirrored(s);
  const double facing = glm::dot(ray, to_double(light.direction));
  const glm::dvec2 at = place_on(light, r, facing < -1e-3 ? ray * (behind / facing) - to : -to);
  const glm::dvec3 p = to + glm::normalize(r.u) * at.x + glm::normalize(r.v) * at.y;
  const double alpha = s.roughness * s.roughness, wide = std::min(alpha + 0.5 * std::sqrt(angle / kPi), 1.0);
  return sum + specular(s, glm::normalize(p)) * color * textures.picture(light, at / size_of(light), 2 * alpha * glm::length(p)) *
                   (angle * std::pow(alpha / wide, 2));
}

}  // namespace

LampPlace lamp_place(const frame::Light& light, glm::dvec3 point) {
  const glm::dvec3 from = point - to_double(light.position), forward = to_double(light.direction), side = to_double(light.side);
  const double along = glm::dot(from, forward);
  return {along, glm::dvec2(glm::dot(from, side), glm::dot(from, glm::cross(forward, side))) * (light.cot / std::max(along, 1e-3))};
}

double rectangle_angle(const glm::dvec3 (&corners)[4]) {
  glm::dvec3 normal[4];
  for (int i = 0; i < 4; ++i) normal[i] = glm::normalize(glm::cross(corners[i], corners[(i + 1) % 4]));
  double sum = -2 * kPi;
  for (int i = 0; i < 4; ++i) sum += std::acos(std::clamp(-glm::dot(normal[i], normal[(i + 1) % 4]), -1.0, 1.0));
  return sum;
}

glm::dvec3 lamp_radiance(const SurfacePoint& s, const frame::Light& light, const LampTextures& textures) {
  const glm::dvec3 to = to_double(light.position) - s.position;
  const double distance2 = glm::dot(to, to);
  if (distance2 >= static_cast<double>(light.range) * light.range) return glm::dvec3(0);
  const glm::dvec3 towards = glm::normalize(to);
  const glm::dvec3 color = to_double(light.color) * filter(light, s.position, towards, s.normal, textures) * window(light, distance2);
  if (has(light, frame::LAMP_AREA)) return area_radiance(s, light, to, color, textures);
  if (has(light, frame::LAMP_TUBE)) return tube_radiance(s, light, to, color);
  return reflected(s, towards, color / (distance2 + kSize2));
}

glm::dvec3 lamps_radiance(const SurfacePoint& surface, const std::vector<frame::Light>& lights, const LampTextures& textures) {
  glm::dvec3 sum(0);
  for (const frame::Light& light : lights) sum += lamp_radiance(surface, light, textures);
  return sum;
}

glm::dvec3 lamp_irradiance(const frame::Light& light, glm::dvec3 point, const LampTextures& textures) {
  const glm::dvec3 to = to_double(light.position) - point;
  const double distance2 = glm::dot(to, to);
  if (distance2 >= static_cast<double>(light.range) * light.range) return glm::dvec3(0);
  const glm::dvec3 color = to_double(light.color) * filter(light, point, glm::normalize(to), glm::dvec3(0), textures) * window(light, distance2);
  if (has(light, frame::LAMP_AREA)) {
    if (glm::dot(to, to_double(light.direction)) >= 0) return glm::dvec3(0);
    return color * textures.picture(light, {0, 0}, 1e3) * rectangle_angle(rectangle_of(light, to).corner);
  }
  if (has(light, frame::LAMP_TUBE)) return color * tube_spread(ends_of(light, to));
  return color / (distance2 + kSize2);
}

}  // namespace rg::reference
