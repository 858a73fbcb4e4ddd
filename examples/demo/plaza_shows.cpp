// Lamps that do more than shine: screens, tubes, pictures, shadows, darkness.
#include <array>
#include <string>

#include "examples/demo/plaza_parts.h"
#include "examples/demo/textures.h"

namespace rg::demo {
namespace {

using glm::vec3;

Light& add_lamp(Workshop& shop, uint32_t features, vec3 at, vec3 color, float range) {
  Light light;
  light.features = features;
  light.position = at;
  light.color = color;
  light.range = range;
  return shop.scene.lights.emplace_back(light);
}

Light& add_spot(Workshop& shop, uint32_t features, vec3 at, vec3 target, vec3 color, float range, float outer) {
  Light& light = add_lamp(shop, features, at, color, range);
  light.direction = glm::normalize(target - at);
  light.outer = outer;
  light.inner = 0.85f * outer;
  return light;
}

// Glass that glows: a panel, and the area light that is the same panel.
void hang_screen(Workshop& shop, const std::string& name, vec3 middle, vec3 facing, float half, uint32_t material, uint32_t layer, float glow,
                 float range) {
  const vec3 side = glm::normalize(glm::cross(vec3(0, 1, 0), facing)), up = glm::cross(facing, side);
  MeshData panel;
  add_grid(panel, middle - (side + up) * half, side * (2 * half), up * (2 * half), 1, 1);
  for (Vertex& v : panel.vertices) {  // the whole picture, once
    v.u = glm::dot(v.position - middle, side) + half;
    v.v = glm::dot(v.position - middle, up) + half;
  }
  place(shop, name, material, std::move(panel));
  Light& light = add_lamp(shop, lamp::area, middle + facing * 0.01f, vec3(glow), range);
  light.direction = facing;
  light.side = side;
  light.size = glm::vec2(half);
  light.picture = layer;
}

void hang_screens(Workshop& shop) {
  for (const float x : {-11.4f, -8.4f, 8.4f, 11.4f})
    hang_screen(shop, "rose screen " + std::to_string(static_cast<int>(x)), {x, 2.3f, plan::hall_front + 0.06f}, {0, 0, 1}, 0.7f,
                paint_of::rose_screen, layer::roses, 2.6f, 7);
  for (const float side : {-1.0f, 1.0f})
    hang_screen(shop, side < 0 ? "hall screen west" : "hall screen east", {side * (plan::hall_x - 0.06f), 2.7f, -16.4f}, {-side, 0, 0}, 0.7f,
                paint_of::rose_screen, layer::roses, 2.6f, 6);
  Light& hearth = add_lamp(shop, lamp::area, {0, plan::terrace + 0.75f, plan::hall_back + 0.62f}, vec3(5.0f), 7.5f);
  hearth.direction = {0, 0, 1};
  hearth.side = {1, 0, 0};
  hearth.size = {0.85f, 0.6f};
  hearth.picture = layer::embers;
}

void light_niches(Workshop& shop) {
  const vec3 teal(0.12f, 0.85f, 0.80f), rose(1.0f, 0.28f, 0.45f);
  for (int i = 0; i < 4; ++i) {
    Light& tube = add_lamp(shop, lamp::tube, {plan::court_x + plan::walk - 0.14f, 2.9f, -6.0f + 4.0f * static_cast<float>(i)},
                           (i % 2 == 0 ? teal : rose) * 1.2f, 4.2f);
    tube.side = {0, 0, 1};
    tube.size = {0.6f, 0.03f};
  }
}

// From under the eaves, through carved screens, on the paving; two of them are cut off by what stands in the way.
void project_lattices(Workshop& shop) {
  const vec3 warm(1.0f, 0.70f, 0.38f), cold(0.45f, 0.62f, 1.0f);
  struct Show {
    vec3 from, to, color;
    uint32_t more;
  };
  const Show shows[] = {{{-9.5f, 8.6f, 7.5f}, {-5.0f, 0, 3.4f}, warm * 150.0f, lamp::shadow},
                        {{9.0f, 8.6f, -6.5f}, {4.6f, 0, -3.0f}, warm * 150.0f, lamp::shadow},
                        {{-11.5f, 8.6f, -4.5f}, {-8.4f, 0, -2.6f}, cold * 110.0f, 0},
                        {{10.5f, 8.6f, 7.0f}, {8.2f, 0, 5.0f}, cold * 110.0f, 0}};
  for (const Show& show : shows) {
    Light& light = add_spot(shop, lamp::square | lamp::projected | show.more, show.from, show.to, show.color, 13, 0.30f);
    light.inner = 0.27f;
    light.picture = layer::lattice;
  }
}

void light_hall_softly(Workshop& shop) {
  Light& chandelier = add_spot(shop, lamp::round | lamp::shadow | lamp::soft | lamp::clipped, {0.0f, 5.2f, -17.7f}, {0, 0, -17.7f},
                               vec3(1.0f, 0.72f, 0.42f) * 9.0f, 6.5f, 0.95f);
  chandelier.side = {1, 0, 0};
  chandelier.size = {0.3f, 0};
  chandelier.clip[0] = {0, 0, -1, plan::hall_front - 0.15f};
  Light& window = add_spot(shop, lamp::square | lamp::projected | lamp::shadow | lamp::soft, {2.2f, 5.2f, -14.2f},
                           {-4.6f, plan::terrace + 0.4f, -20.4f}, vec3(1.0f, 0.95f, 0.9f) * 110.0f, 13, 0.21f);
  window.inner = 0.20f;
  window.size = {0.06f, 0};
  window.picture = layer::roses;
  Light& fountain =
      add_spot(shop, lamp::round | lamp::shadow | lamp::soft, {6.5f, 9.0f, 7.5f}, {0, 0.5f, 1}, vec3(0.62f, 0.75f, 1.0f) * 60.0f, 16, 0.36f);
  fountain.size = {0.35f, 0};
  for (const float x : {-11.0f, 11.0f}) {  // between the columns of the northern walk
    Light& walk = add_spot(shop, lamp::square | lamp::shadow, {x, 4.9f, -12.6f}, {x, 0, -6.5f}, vec3(1.0f, 0.6f, 0.3f) * 16.0f, 9, 0.55f);
    walk.inner = 0.45f;
  }
}

// Corners that should be darker than the lamps about them leave them.
void darken(Workshop& shop) {
  for (const float x : {-1.0f, 1.0f})
    for (const float z : {-1.0f, 1.0f})
      add_lamp(shop, lamp::dark, {x * (plan::court_x + 2.9f), 4.9f, z * (plan::court_z + 2.9f)}, vec3(0.9f, 0.8f, 0.6f), 4.5f);
  for (const float x : {-5.9f, 5.9f}) add_lamp(shop, lamp::dark | lamp::clipped, {x, 5.0f, -21.0f}, vec3(1.0f, 0.7f, 0.4f), 3.5f);
}

}  // namespace

void keep_inside(Light& light) {
  light.features |= lamp::clipped;
  light.clip[0] = {0, 0, -1, plan::hall_front - 0.15f};  // within the front wall and the ceiling
  light.clip[1] = {0, -1, 0, plan::hall_ceiling + 0.15f};
}

void put_on_shows(Workshop& shop) {
  hang_screens(shop);
  light_niches(shop);
  project_lattices(shop);
  light_hall_softly(shop);
  darken(shop);
}

}  // namespace rg::demo
