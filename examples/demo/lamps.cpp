#include "examples/demo/lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rg::demo {
namespace {

static_assert(lamp::round == frame::LAMP_ROUND && lamp::square == frame::LAMP_SQUARE && lamp::shadow == frame::LAMP_SHADOW &&
              lamp::soft == frame::LAMP_SOFT && lamp::projected == frame::LAMP_PROJECTED && lamp::area == frame::LAMP_AREA &&
              lamp::tube == frame::LAMP_TUBE && lamp::dark == frame::LAMP_DARK && lamp::clipped == frame::LAMP_CLIPPED &&
              kMaxLampShadows == frame::MAX_LAMP_SHADOWS);

constexpr float kTau = 2 * std::numbers::pi_v<float>;

glm::vec3 drifted(glm::vec3 at, const Animation& a, float time) {
  if (a.motion != Motion::drift) return at;
  const float turn = kTau * (a.rate * time + a.phase);
  return at + a.amount * glm::vec3(std::sin(turn), 0.5f * std::sin(1.7f * turn), std::cos(0.8f * turn));
}

struct Axes {
  glm::vec3 direction, side;
};
// Tubes keep their side, everything else its direction.
Axes axes_of(const Light& light) {
  const glm::vec3 side = glm::normalize(light.side), direction = glm::normalize(light.direction);
  if ((light.features & lamp::tube) != 0) return {direction, side};
  const glm::vec3 other = std::abs(glm::dot(side, direction)) < 0.99f ? side : glm::vec3(direction.y, direction.z, direction.x);
  return {direction, glm::normalize(other - direction * glm::dot(other, direction))};
}

// Steepness of the rim, and the cone around all that a spot reaches.
void set_beam(frame::Light& to, const Light& from) {
  const bool square = (from.features & lamp::square) != 0;
  const float slope = std::tan(from.outer), reach = square ? std::atan(std::sqrt(2.0f) * slope) : from.outer;
  to.cot = 1 / slope;
  to.cos_outer = std::cos(reach);
  to.sin_outer = std::sin(reach);
  to.edge = square ? 1 / std::max(1 - std::tan(from.inner) / slope, 1e-3f) : 1 / std::max(std::cos(from.inner) - std::cos(from.outer), 1e-4f);
}

frame::Light make_light(const Light& from, const glm::mat4& to_view, float time) {
  frame::Light to;
  const glm::vec3 at = drifted(from.position, from.animation, time);
  const Axes axes = axes_of(from);
  const float depth = (to_view * glm::vec4(at, 1)).z, margin = 1e-3f + 1e-3f * from.range;
  to.position = to_rg(at);
  to.range = from.range;
  to.color = to_rg(from.color);
  to.features = from.features;
  to.direction = to_rg(axes.direction);
  to.side = to_rg(axes.side);
  to.nearest = depth - from.range - margin;
  to.farthest = depth + from.range + margin;
  to.size = to_rg(from.size);
  to.picture = from.picture;
  for (size_t i = 0; i < 2; ++i) to.clip[i] = to_rg(from.clip[i]);
  set_beam(to, from);
  return to;
}

bool has_shadow(const Light& light) { return (light.features & lamp::shadow) != 0; }

}  // namespace

rg::vec2 to_rg(glm::vec2 v) { return {v.x, v.y}; }
rg::vec3 to_rg(glm::vec3 v) { return {v.x, v.y, v.z}; }
rg::vec4 to_rg(glm::vec4 v) { return {v.x, v.y, v.z, v.w}; }
rg::mat4 to_rg(const glm::mat4& m) { return {{to_rg(m[0]), to_rg(m[1]), to_rg(m[2]), to_rg(m[3])}}; }
rg::mat3x4 to_rows(const glm::mat4& m) {
  const glm::mat4 t = glm::transpose(m);
  return {{to_rg(t[0]), to_rg(t[1]), to_rg(t[2])}};
}

std::vector<frame::Light> make_lights(const Scene& scene, const glm::mat4& to_view, float time) {
  std::vector<frame::Light> lights;
  uint32_t maps = 0;
  for (const Light& light : scene.lights) {
    frame::Light& made = lights.emplace_back(make_light(light, to_view, time));
    if (!has_shadow(light)) continue;
    if (maps < kMaxLampShadows)
      made.shadow = maps++;
    else
      made.features &= ~static_cast<uint32_t>(lamp::shadow | lamp::soft);
  }
  std::stable_sort(lights.begin(), lights.end(), [](const frame::Light& a, const frame::Light& b) { return a.nearest < b.nearest; });
  if (lights.size() > static_cast<size_t>(frame::MAX_LIGHTS)) lights.resize(static_cast<size_t>(frame::MAX_LIGHTS));
  return lights;
}

frame::LampViews make_lamp_views(const Scene& scene) {
  frame::LampViews views;
  uint32_t map = 0;
  for (const Light& light : scene.lights) {
    if (!has_shadow(light) || map == kMaxLampShadows) continue;
    frame::LampView& view = views.view[map++];
    const Axes axes = axes_of(light);
    view.position = to_rg(light.position);
    view.range = light.range;
    view.direction = to_rg(axes.direction);
    view.side = to_rg(axes.side);
    view.cot = 1 / std::tan(light.outer);
    view.used = 1;
  }
  return views;
}

}  // namespace rg::demo
