#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "examples/demo/plaza_parts.h"

namespace rg::demo {
namespace {

using glm::vec2, glm::vec3;

struct Opening {
  float left, right, low, high;
};

// A wall of thickness 0.3 along x with holes, which are sorted and apart.
void build_front(Workshop& shop, float z) {
  const Opening openings[] = {{-5.4f, -2.8f, 1.9f, 4.3f}, {-1.5f, 1.5f, plan::terrace, 3.9f}, {2.8f, 5.4f, 1.9f, 4.3f}};
  const float end = plan::court_x + plan::walk;
  float from = -end;
  int number = 0;
  for (const Opening& o : openings) {
    const std::string name = "hall front " + std::to_string(number++);
    place_box(shop, name, paint_of::plaster, {from, 0, z - 0.3f}, {o.left, plan::eaves, z}, 0.7f);
    place_box(shop, name + " above", paint_of::plaster, {o.left, o.high, z - 0.3f}, {o.right, plan::eaves, z}, 0.7f);
    place_box(shop, name + " below", paint_of::plaster, {o.left, 0, z - 0.3f}, {o.right, o.low, z}, 0.7f);
    place_box(shop, name + " lintel", paint_of::sandstone, {o.left - 0.2f, o.high, z - 0.36f}, {o.right + 0.2f, o.high + 0.25f, z + 0.08f}, 0.6f);
    for (const float x : {o.left, o.right})
      place_box(shop, name + " jamb", paint_of::sandstone, {x - 0.12f, o.low, z - 0.35f}, {x + 0.12f, o.high, z + 0.06f}, 0.6f);
    from = o.right;
  }
  place_box(shop, "hall front end", paint_of::plaster, {from, 0, z - 0.3f}, {end, plan::eaves, z}, 0.7f);
}

void glaze(Workshop& shop, const char* name, uint32_t material, vec3 low, vec3 du, vec3 dv) {
  MeshData pane;
  add_grid(pane, low, du, dv, 1, 1);
  const uint32_t at = place(shop, name, material, std::move(pane));
  shop.scene.instances[at].glass = true;
  shop.scene.instances[at].casts_shadow = false;
}

void build_windows(Workshop& shop, float z) {
  for (const float left : {-5.4f, 2.8f}) {
    for (int i = 0; i < 3; ++i)
      glaze(shop, "hall pane", i == 1 ? paint_of::green_glass : paint_of::glass, {left + 0.867f * static_cast<float>(i), 1.9f, z - 0.15f},
            {0.867f, 0, 0}, {0, 2.4f, 0});
    for (int i = 0; i < 4; ++i)
      place_box(shop, "glazing bar", paint_of::bronze, {left + 0.867f * static_cast<float>(i) - 0.025f, 1.9f, z - 0.18f},
                {left + 0.867f * static_cast<float>(i) + 0.025f, 4.3f, z - 0.12f}, 2);
    place_box(shop, "glazing rail", paint_of::bronze, {left, 3.2f, z - 0.18f}, {left + 2.6f, 3.25f, z - 0.12f}, 3);
  }
  for (const float side : {-1.0f, 1.0f}) {  // the doors stand open
    MeshData leaf;
    add_box(leaf, {0, plan::terrace, -0.04f}, {1.45f, 3.85f, 0.04f}, 0.5f);
    const uint32_t at = place(shop, "door leaf", paint_of::planks, std::move(leaf));
    shop.scene.instances[at].transform =
        glm::rotate(glm::translate(glm::mat4(1), vec3(side * 1.5f, 0, z - 0.3f)), side < 0 ? 1.75f : 1.39f, vec3(0, 1, 0));
  }
}

void build_shell(Workshop& shop) {
  const float x = plan::hall_x, front = plan::hall_front, back = plan::hall_back, floor = plan::terrace, top = plan::hall_ceiling;
  place_box(shop, "hall floor", paint_of::planks, {-x, floor - 0.3f, back}, {x, floor, front - 0.3f}, 0.5f);
  place_box(shop, "hall ceiling", paint_of::beams, {-x, top, back}, {x, top + 0.3f, front - 0.3f}, 0.6f);
  place_box(shop, "hall west wall", paint_of::ochre, {-x - 0.3f, 0, back}, {-x, top + 1, front}, 0.5f);
  place_box(shop, "hall east wall", paint_of::ochre, {x, 0, back}, {x + 0.3f, top + 1, front}, 0.5f);
  place_box(shop, "hall back wall", paint_of::brick, {-x - 0.3f, 0, back - 0.3f}, {x + 0.3f, top + 1, back}, 0.5f);
  place_box(shop, "hall roof", paint_of::roof, {-x - 0.6f, top + 1, back - 0.6f}, {x + 0.6f, top + 1.2f, front - 0.3f}, 1);
  for (int i = 0; i < 6; ++i) {
    const float z = back + 0.8f + 1.35f * static_cast<float>(i);
    place_box(shop, "hall beam " + std::to_string(i), paint_of::planks, {-x, top - 0.32f, z - 0.14f}, {x, top, z + 0.14f}, 0.7f);
  }
  for (const float side : {-1.0f, 1.0f}) {
    const float a = side * x, b = side * (x - 0.05f);
    place_box(shop, "wainscot", paint_of::planks, {std::min(a, b), floor, back}, {std::max(a, b), floor + 1.1f, front - 0.3f}, 0.5f);
    place_box(shop, "wainscot rail", paint_of::gold, {std::min(a, side * (x - 0.08f)), floor + 1.1f, back},
              {std::max(a, side * (x - 0.08f)), floor + 1.16f, front - 0.3f}, 1);
  }
}

void build_table(Workshop& shop) {
  const float floor = plan::terrace;
  place_box(shop, "rug", paint_of::rug, {-2.4f, floor, -20.2f}, {2.4f, floor + 0.02f, -15.2f}, 0.5f);
  place_box(shop, "table top", paint_of::planks, {-0.8f, floor + 0.74f, -19.6f}, {0.8f, floor + 0.82f, -15.8f}, 0.4f);
  for (const float x : {-0.65f, 0.65f})
    for (const float z : {-19.4f, -16.0f}) {
      MeshData leg;
      const vec2 profile[] = {{0.05f, 0}, {0.08f, 0.06f}, {0.05f, 0.14f}, {0.07f, 0.36f}, {0.09f, 0.5f}, {0.05f, 0.6f}, {0.07f, 0.74f}};
      add_lathe(leg, {x, floor, z}, profile, 20);
      place(shop, "table leg", paint_of::beams, std::move(leg));
    }
  for (const float x : {-1.35f, 1.35f})
    place_box(shop, "table bench", paint_of::beams, {x - 0.18f, floor + 0.38f, -19.2f}, {x + 0.18f, floor + 0.45f, -16.2f}, 0.6f);
  for (int i = 0; i < 4; ++i) {
    MeshData cup;
    const vec2 profile[] = {{0.09f, 0},     {0.1f, 0.02f},  {0.03f, 0.05f}, {0.03f, 0.12f},
                            {0.09f, 0.18f}, {0.11f, 0.28f}, {0.10f, 0.28f}, {0.06f, 0.19f}};
    add_lathe(cup, {i % 2 == 0 ? -0.4f : 0.4f, floor + 0.82f, -19.0f + 0.9f * static_cast<float>(i)}, profile, 24);
    place(shop, "goblet " + std::to_string(i), i % 2 == 0 ? paint_of::gold : paint_of::verdigris, std::move(cup));
  }
}

void build_fireplace(Workshop& shop) {
  const float floor = plan::terrace, back = plan::hall_back;
  place_box(shop, "hearth", paint_of::dark_marble, {-1.6f, floor, back}, {1.6f, floor + 0.12f, back + 1.0f}, 0.5f);
  place_box(shop, "chimney left", paint_of::sandstone, {-1.5f, floor, back}, {-0.9f, floor + 1.5f, back + 0.6f}, 0.5f);
  place_box(shop, "chimney right", paint_of::sandstone, {0.9f, floor, back}, {1.5f, floor + 1.5f, back + 0.6f}, 0.5f);
  place_box(shop, "mantel", paint_of::marble, {-1.7f, floor + 1.5f, back}, {1.7f, floor + 1.68f, back + 0.75f}, 0.5f);
  place_box(shop, "chimney breast", paint_of::sandstone, {-1.2f, floor + 1.68f, back}, {1.2f, plan::hall_ceiling, back + 0.5f}, 0.5f);
  place_box(shop, "bed of embers", paint_of::embers, {-0.7f, floor + 0.12f, back + 0.1f}, {0.7f, floor + 0.2f, back + 0.55f}, 0.3f);
  for (int i = 0; i < 4; ++i) {
    MeshData log;
    const float x = -0.45f + 0.3f * static_cast<float>(i);
    const vec3 path[] = {{x - 0.2f, floor + 0.2f, back + 0.16f}, {x, floor + 0.28f, back + 0.3f}, {x + 0.2f, floor + 0.24f, back + 0.5f}};
    add_tube(log, path, 0.06f, 12);
    place(shop, "log " + std::to_string(i), paint_of::beams, std::move(log));
  }
}

void build_pillars(Workshop& shop) {
  int number = 0;
  for (const float x : {-4.2f, 4.2f})
    for (const float z : {-19.6f, -15.9f}) {
      MeshData pillar;
      const float floor = plan::terrace, height = plan::hall_ceiling - floor;
      const vec2 profile[] = {{0.36f, 0},
                              {0.36f, 0.2f},
                              {0.28f, 0.28f},
                              {0.24f, 0.34f},
                              {0.23f, 1.6f},
                              {0.21f, height - 0.7f},
                              {0.25f, height - 0.66f},
                              {0.2f, height - 0.6f},
                              {0.3f, height - 0.34f},
                              {0.4f, height - 0.2f},
                              {0.4f, height}};
      add_lathe(pillar, {x, floor, z}, profile, 40);
      place(shop, "hall pillar " + std::to_string(number++), paint_of::dark_marble, std::move(pillar));
    }
}

void build_chandelier(Workshop& shop) {
  MeshData ring;
  const vec2 profile[] = {{1.0f, 4.1f}, {1.06f, 4.14f}, {1.06f, 4.2f}, {1.0f, 4.24f}, {0.94f, 4.2f}, {0.94f, 4.14f}, {1.0f, 4.1f}};
  add_lathe(ring, {0, 0, -17.7f}, profile, 48);
  place(shop, "chandelier", paint_of::gold, std::move(ring));
  for (int i = 0; i < 4; ++i) {
    MeshData rod;
    const float angle = 1.5707963f * static_cast<float>(i);
    const vec3 path[] = {{std::cos(angle), 4.2f, -17.7f + std::sin(angle)}, {0, 5.5f, -17.7f}};
    add_tube(rod, path, 0.015f, 6);
    place(shop, "chandelier rod " + std::to_string(i), paint_of::gold, std::move(rod));
  }
  MeshData orb;
  add_sphere(orb, {0, 0, 0}, 0.34f, 24);
  const uint32_t at = place(shop, "glass orb", paint_of::green_glass, std::move(orb));
  shop.scene.instances[at].transform = glm::translate(glm::mat4(1), vec3(0, plan::terrace + 1.25f, -17.7f));
  shop.scene.instances[at].glass = true;
  shop.scene.instances[at].casts_shadow = false;
}

}  // namespace

std::vector<vec3> candle_places() {
  std::vector<vec3> places;
  for (int i = 0; i < 12; ++i) {
    const float angle = 0.5235988f * static_cast<float>(i);
    places.push_back({std::cos(angle), 4.36f, -17.7f + std::sin(angle)});
  }
  for (int i = 0; i < 6; ++i) places.push_back({i % 2 == 0 ? 0.12f : -0.12f, plan::terrace + 1.08f, -19.3f + 0.62f * static_cast<float>(i)});
  for (int i = 0; i < 4; ++i) places.push_back({-1.2f + 0.8f * static_cast<float>(i), plan::terrace + 1.94f, plan::hall_back + 0.45f});
  return places;
}

void build_hall(Workshop& shop) {
  build_front(shop, plan::hall_front);
  build_windows(shop, plan::hall_front);
  build_shell(shop);
  build_table(shop);
  build_fireplace(shop);
  build_pillars(shop);
  build_chandelier(shop);
}

}  // namespace rg::demo
