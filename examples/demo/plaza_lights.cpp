#include <cmath>

#include "examples/demo/plaza_parts.h"

namespace rg::demo {
namespace {

using glm::vec3;
constexpr vec3 kWarm{1.0f, 0.60f, 0.26f}, kCandle{1.0f, 0.55f, 0.20f}, kTeal{0.12f, 0.85f, 0.80f}, kRose{1.0f, 0.28f, 0.45f},
    kViolet{0.45f, 0.30f, 1.0f};

void omni(Workshop& shop, vec3 at, vec3 color, float range, Animation animation = {}) {
  Light light;
  light.position = at;
  light.color = color;
  light.range = range;
  light.animation = animation;
  shop.scene.lights.push_back(light);
}
void spot(Workshop& shop, vec3 at, vec3 direction, vec3 color, float range, float inner, float outer) {
  Light light;
  light.position = at;
  light.direction = glm::normalize(direction);
  light.color = color;
  light.range = range;
  light.features = lamp::round;
  light.inner = inner;
  light.outer = outer;
  shop.scene.lights.push_back(light);
}

void light_columns(Workshop& shop) {
  for (const vec3& foot : column_places()) {
    const vec3 inward = glm::normalize(vec3(std::abs(foot.x) > 13.9f ? -foot.x : 0, 0, std::abs(foot.z) > 9.9f ? -foot.z : 0));
    spot(shop, foot + inward * 0.62f + vec3(0, 0.06f, 0), vec3(0, 1, 0) - inward * 0.12f, vec3(1.0f, 0.66f, 0.34f) * 2.4f, 5.5f, 0.20f, 0.55f);
    spot(shop, foot + inward * 0.75f + vec3(0, plan::eaves - 0.5f - foot.y, 0), vec3(0, -1, 0) - inward * 0.18f, vec3(1.0f, 0.72f, 0.46f) * 2.0f,
         5.0f, 0.25f, 0.65f);
  }
}

void light_fountain(Workshop& shop) {
  for (int i = 0; i < 10; ++i) {
    const float angle = 0.6283185f * static_cast<float>(i);
    const vec3 out(std::cos(angle), 0, std::sin(angle));
    spot(shop, vec3(0, 0.5f, 1) + out * 2.5f, vec3(0, 1, 0) - out * 0.75f, (i % 2 == 0 ? kTeal : kViolet) * 1.4f, 4.5f, 0.3f, 0.7f);
  }
  omni(shop, {0, 4.1f, 1}, kTeal * 0.9f, 5);
}

void light_walks(Workshop& shop) {
  for (const vec3& at : hanging_lantern_places()) omni(shop, at, kWarm * 1.7f, 5.5f, {Motion::drift, 0.05f, 0.35f, 0.3f * at.x});
  for (const vec3& at : lantern_post_places()) omni(shop, at, kWarm * 2.6f, 7.0f);
  for (int i = 0; i < 16; ++i) {
    const float x = -4.8f + 1.2f * static_cast<float>(i % 9), z = -plan::court_z + (i < 9 ? 1.95f : 0.5f), y = i < 9 ? 0.14f : 0.9f;
    omni(shop, {x, y, z}, kWarm * 0.22f, 1.6f);
  }
}

void light_hall(Workshop& shop) {
  const size_t first = shop.scene.lights.size();
  uint32_t seed = 300;
  for (const vec3& at : candle_places()) omni(shop, at + vec3(0, 0.05f, 0), kCandle * 0.6f, 5.5f, {Motion::drift, 0.012f, 2.3f, random_unit(seed++)});
  omni(shop, {0, plan::terrace + 0.45f, plan::hall_back + 0.75f}, vec3(1.0f, 0.36f, 0.08f) * 1.4f, 4.5f, {Motion::drift, 0.05f, 1.7f, 0});
  omni(shop, {-0.4f, plan::terrace + 0.35f, plan::hall_back + 0.7f}, vec3(1.0f, 0.30f, 0.05f) * 1.2f, 3.5f, {Motion::drift, 0.04f, 2.9f, 0.4f});
  for (const float side : {-1.0f, 1.0f})
    for (int i = 0; i < 3; ++i)
      spot(shop, {side * 6.6f, 4.9f, -20.6f + 2.6f * static_cast<float>(i)}, {side * 0.22f, -1, 0}, vec3(1.0f, 0.68f, 0.38f) * 2.2f, 5.0f, 0.3f,
           0.7f);
  for (size_t i = first; i < shop.scene.lights.size(); ++i) keep_inside(shop.scene.lights[i]);
}

void release_fireflies(Workshop& shop) {
  for (uint32_t i = 0; i < 48; ++i) {
    const float x = -12.5f + 25 * random_unit(i * 3 + 1000), z = -8.5f + 17.5f * random_unit(i * 3 + 1001),
                y = 0.35f + 1.5f * random_unit(i * 3 + 1002);
    const vec3 hue = i % 3 == 0 ? vec3(0.75f, 1.0f, 0.25f) : i % 3 == 1 ? kTeal : kRose;
    omni(shop, {x, y, z}, hue * 0.16f, 1.7f, {Motion::drift, 0.5f, 0.11f + 0.07f * random_unit(i + 77), random_unit(i + 33)});
  }
}

}  // namespace

std::vector<std::vector<Bulb>> strings_of_bulbs() {
  std::vector<std::vector<Bulb>> strings;
  const vec3 hues[] = {{1.0f, 0.62f, 0.30f}, {1.0f, 0.50f, 0.20f}, {1.0f, 0.34f, 0.30f}, {0.35f, 0.85f, 0.70f}};
  for (int s = 0; s < 6; ++s) {
    std::vector<Bulb> bulbs;
    const float z = -7.0f + 2.9f * static_cast<float>(s), tilt = s % 2 == 0 ? 1.2f : -1.2f;
    for (int i = 0; i < 26; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) / 26, x = (2 * t - 1) * (plan::court_x - 0.55f);
      const float sag = 1.5f * 4 * t * (1 - t);
      bulbs.push_back({{x, 6.6f - sag, z + tilt * (2 * t - 1)}, hues[(i + s) % 7 == 0 ? 3 : (i + s) % 5 == 0 ? 2 : (i + s) % 2]});
    }
    strings.push_back(std::move(bulbs));
  }
  return strings;
}

std::vector<vec3> hanging_lantern_places() {
  std::vector<vec3> places;
  const float x = plan::court_x + 1.7f, z = plan::court_z + 1.7f;
  for (int i = 0; i < 5; ++i)
    for (const float side : {-1.0f, 1.0f}) places.push_back({side * x, 3.4f, -8.0f + 4.0f * static_cast<float>(i)});
  for (int i = 0; i < 7; ++i)
    for (const float side : {-1.0f, 1.0f}) places.push_back({-12.0f + 4.0f * static_cast<float>(i), side < 0 ? 3.9f : 3.4f, side * z});
  return places;
}

std::vector<vec3> lantern_post_places() {
  return {{-7.2f, 2.95f, -4.2f}, {7.2f, 2.95f, -4.2f}, {-7.2f, 2.95f, 5.8f}, {7.2f, 2.95f, 5.8f},
          {-12.4f, 2.95f, 0.8f}, {12.4f, 2.95f, 0.8f}, {-2.9f, 2.95f, 8.4f}, {2.9f, 2.95f, 8.4f}};
}

void hang_lights(Workshop& shop) {
  for (const std::vector<Bulb>& bulbs : strings_of_bulbs())
    for (const Bulb& bulb : bulbs) omni(shop, bulb.position, bulb.color * 0.42f, 3.0f);
  light_columns(shop);
  light_fountain(shop);
  light_walks(shop);
  light_hall(shop);
  release_fireflies(shop);
}

}  // namespace rg::demo
