#include <cmath>
#include <string>

#include "examples/demo/plaza_parts.h"

namespace rg::demo {
namespace {

using glm::vec2, glm::vec3;

// One row of columns with what stands on it: along `along` from `first`, `bays` bays; `inward` points into the court.
struct Side {
  const char* name;
  vec3 first, along, inward;
  int bays;
  float floor;
  uint32_t wall;
};
const Side kSides[] = {
    {"west", {-plan::court_x, 0, plan::court_z}, {0, 0, -1}, {1, 0, 0}, 5, plan::walk_floor, paint_of::ochre},
    {"north", {-plan::court_x, 0, -plan::court_z}, {1, 0, 0}, {0, 0, 1}, 7, plan::terrace, paint_of::plaster},
    {"east", {plan::court_x, 0, -plan::court_z}, {0, 0, 1}, {-1, 0, 0}, 5, plan::walk_floor, paint_of::brick},
    {"south", {plan::court_x, 0, plan::court_z}, {-1, 0, 0}, {0, 0, -1}, 7, plan::walk_floor, paint_of::plaster},
};
constexpr float kWallDepth = 0.6f;

std::string part(const Side& side, const char* what, int number) { return std::string(side.name) + " " + what + " " + std::to_string(number); }

// A box given in the side's own axes: along, up, inward.
void side_box(Workshop& shop, const Side& side, const std::string& name, uint32_t material, vec3 low, vec3 high, float cell = 1) {
  const vec3 a = side.first + side.along * low.x + vec3(0, low.y, 0) + side.inward * low.z;
  const vec3 b = side.first + side.along * high.x + vec3(0, high.y, 0) + side.inward * high.z;
  place_box(shop, name, material, glm::min(a, b), glm::max(a, b), cell);
}

void build_column(Workshop& shop, vec3 foot, int number) {
  const std::string name = std::to_string(number);
  const float height = plan::spring - foot.y;
  place_box(shop, "plinth " + name, paint_of::sandstone, foot + vec3(-0.46f, 0, -0.46f), foot + vec3(0.46f, 0.18f, 0.46f), 0.46f);
  MeshData base, shaft, capital, abacus;
  const vec2 torus[] = {{0.44f, 0.18f}, {0.46f, 0.23f}, {0.44f, 0.28f}, {0.37f, 0.31f},
                        {0.35f, 0.35f}, {0.40f, 0.39f}, {0.40f, 0.43f}, {0.33f, 0.46f}};
  add_lathe(base, foot, torus, 32);
  place(shop, "base " + name, paint_of::marble, std::move(base));
  std::vector<vec2> line;
  for (int i = 0; i <= 18; ++i) {
    const float t = static_cast<float>(i) / 18;
    line.push_back({0.33f - 0.055f * t * t, 0.44f + (height - 0.95f) * t});
  }
  add_lathe(shaft, foot, line, 64, 16);
  place(shop, "shaft " + name, paint_of::marble, std::move(shaft));
  const float top = height - 0.52f;
  const vec2 bell[] = {{0.285f, top},        {0.32f, top + 0.03f}, {0.32f, top + 0.07f}, {0.28f, top + 0.10f}, {0.29f, top + 0.18f},
                       {0.33f, top + 0.26f}, {0.40f, top + 0.33f}, {0.47f, top + 0.37f}, {0.44f, top + 0.41f}, {0.38f, top + 0.43f}};
  add_lathe(capital, foot, bell, 40, 8);
  place(shop, "capital " + name, number % 2 == 0 ? paint_of::gold : paint_of::bronze, std::move(capital));
  add_box(abacus, foot + vec3(-0.46f, height - 0.10f, -0.46f), foot + vec3(0.46f, height, 0.46f), 0.46f);
  place(shop, "abacus " + name, paint_of::marble, std::move(abacus));
  shop.solids.push_back({foot + vec3(-0.26f, 0, -0.26f), foot + vec3(0.26f, height, 0.26f)});
}

void build_arch(Workshop& shop, const Side& side, int i) {
  const vec3 base = side.first + vec3(0, plan::spring, 0);
  const float a = plan::bay * static_cast<float>(i);
  ArchShape shape;
  // The wall's front looks into the court, whichever way the side runs.
  shape.left = base + side.along * (a + 0.3f);
  shape.right = base + side.along * (a + plan::bay - 0.3f);
  if (glm::dot(glm::cross(side.along, vec3(0, 1, 0)), side.inward) < 0) std::swap(shape.left, shape.right);
  shape.thickness = 0.3f;
  shape.depth = kWallDepth;
  shape.top = plan::upper - plan::spring;
  shape.segments = 20;
  MeshData data;
  add_arch(data, shape);
  place(shop, part(side, "arch", i), paint_of::sandstone, std::move(data));
  const vec3 low = side.first + side.along * a + vec3(0, plan::spring + 2.0f, 0) - side.inward * 0.3f;
  const vec3 high = side.first + side.along * (a + plan::bay) + vec3(0, plan::upper, 0) + side.inward * 0.3f;
  shop.solids.push_back({glm::min(low, high), glm::max(low, high)});
}

// A bay of the upper floor: wall around a window, its frame, its sill, and the panes, some of them lit.
void build_window_bay(Workshop& shop, const Side& side, int i) {
  const float a = plan::bay * static_cast<float>(i), left = a + 1.25f, right = a + plan::bay - 1.25f;
  const float sill = plan::upper + 0.8f, lintel = plan::upper + 2.9f, front = 0.3f, back = -0.3f;
  side_box(shop, side, part(side, "wall left", i), side.wall, {a, plan::upper, back}, {left, plan::eaves, front});
  side_box(shop, side, part(side, "wall right", i), side.wall, {right, plan::upper, back}, {a + plan::bay, plan::eaves, front});
  side_box(shop, side, part(side, "parapet", i), side.wall, {left, plan::upper, back}, {right, sill, front});
  side_box(shop, side, part(side, "lintel wall", i), side.wall, {left, lintel, back}, {right, plan::eaves, front});
  side_box(shop, side, part(side, "sill", i), paint_of::marble, {left - 0.15f, sill - 0.1f, front}, {right + 0.15f, sill, front + 0.16f});
  side_box(shop, side, part(side, "hood", i), paint_of::sandstone, {left - 0.15f, lintel, front}, {right + 0.15f, lintel + 0.16f, front + 0.12f});
  const float middle = 0.5f * (left + right);
  side_box(shop, side, part(side, "mullion", i), paint_of::plain_white, {middle - 0.03f, sill, -0.02f}, {middle + 0.03f, lintel, 0.06f});
  side_box(shop, side, part(side, "transom", i), paint_of::plain_white, {left, sill + 1.35f, -0.02f}, {right, sill + 1.41f, 0.06f});
  const uint32_t seed = static_cast<uint32_t>(side.name[0]) * 64u + static_cast<uint32_t>(i);
  const bool lit = random_unit(seed) > 0.45f;
  side_box(shop, side, part(side, "pane", i), lit ? paint_of::glow_warm : paint_of::dark_marble, {left, sill, -0.06f}, {right, lintel, -0.04f}, 4);
}

void build_side(Workshop& shop, const Side& side) {
  const float length = plan::bay * static_cast<float>(side.bays), w = plan::walk;
  for (int i = 0; i < side.bays; ++i) {
    const float a = plan::bay * static_cast<float>(i);
    build_arch(shop, side, i);
    build_window_bay(shop, side, i);
    side_box(shop, side, part(side, "walk", i), paint_of::mosaic, {a, -0.05f, -w}, {a + plan::bay, side.floor, 0.62f}, 0.8f);
    side_box(shop, side, part(side, "vault", i), paint_of::beams, {a, plan::upper - 0.12f, -w}, {a + plan::bay, plan::upper, -0.3f}, 0.8f);
    side_box(shop, side, part(side, "beam", i), paint_of::planks, {a - 0.12f, plan::upper - 0.42f, -w}, {a + 0.12f, plan::upper - 0.12f, -0.3f},
             0.7f);
    side_box(shop, side, part(side, "string course", i), paint_of::marble, {a, plan::upper - 0.12f, 0.3f},
             {a + plan::bay, plan::upper + 0.12f, 0.5f});
    side_box(shop, side, part(side, "cornice", i), paint_of::marble, {a, plan::eaves - 0.25f, 0.3f}, {a + plan::bay, plan::eaves + 0.1f, 0.62f});
    side_box(shop, side, part(side, "dentils", i), paint_of::sandstone, {a, plan::eaves - 0.42f, 0.3f}, {a + plan::bay, plan::eaves - 0.25f, 0.45f});
  }
  MeshData roof;
  const vec3 up(0, 1, 0), eaves = side.first + side.inward * 0.9f + up * plan::eaves, slope = -side.inward * 5.3f + up * 2.3f;
  const bool forward = glm::dot(glm::cross(side.along, slope), up) > 0;
  add_grid(roof, forward ? eaves - side.along : eaves + side.along * (length + 1), side.along * ((length + 2) * (forward ? 1.0f : -1.0f)), slope,
           side.bays * 4, 5);
  place(shop, part(side, "roof", 0), paint_of::roof, std::move(roof));
}

// The back walls of the walks. The northern one belongs to the hall.
void build_back_walls(Workshop& shop) {
  const float x = plan::court_x + plan::walk, z = plan::court_z + plan::walk;
  place_box(shop, "west back wall", paint_of::ochre, {-x - 0.3f, 0, -z}, {-x, plan::eaves, z}, 0.8f);
  place_box(shop, "east back wall", paint_of::brick, {x, 0, -z}, {x + 0.3f, plan::eaves, z}, 0.8f);
  place_box(shop, "south back wall", paint_of::plaster, {-x, 0, z}, {x, plan::eaves, z + 0.3f}, 0.8f);
  for (int i = 0; i < 4; ++i) {
    const float at = -6.0f + 4.0f * static_cast<float>(i);
    place_box(shop, "west door " + std::to_string(i), paint_of::planks, {-x, plan::walk_floor, at - 0.7f}, {-x + 0.06f, 2.6f, at + 0.7f}, 0.5f);
    place_box(shop, "east niche " + std::to_string(i), paint_of::verdigris, {x - 0.08f, 0.9f, at - 0.6f}, {x, 2.9f, at + 0.6f}, 0.5f);
    place_box(shop, "niche light " + std::to_string(i), i % 2 == 0 ? paint_of::glow_teal : paint_of::glow_rose, {x - 0.1f, 2.95f, at - 0.6f},
              {x, 3.0f, at + 0.6f}, 2);
  }
}

}  // namespace

std::vector<vec3> column_places() {
  std::vector<vec3> places;
  for (const Side& side : kSides)
    for (int i = 0; i < side.bays; ++i) {
      const bool on_terrace = side.floor > plan::walk_floor || (i == 0 && side.first.z < 0);
      places.push_back(side.first + side.along * (plan::bay * static_cast<float>(i)) + vec3(0, on_terrace ? plan::terrace : plan::walk_floor, 0));
    }
  return places;
}

void build_arcades(Workshop& shop) {
  int number = 0;
  for (const vec3& foot : column_places()) build_column(shop, foot, number++);
  for (const Side& side : kSides) build_side(shop, side);
  build_back_walls(shop);
  for (const float x : {-1.0f, 1.0f})  // the corners of the walks
    for (const float z : {-1.0f, 1.0f}) {
      const vec3 a(x * plan::court_x, 0, z * plan::court_z), b = a + vec3(x, 0, z) * plan::walk;
      const vec3 low = glm::min(a, b), high = glm::max(a, b);
      place_box(shop, "corner floor", paint_of::mosaic, low - vec3(0, 0.05f, 0), high + vec3(0, z < 0 ? plan::terrace : plan::walk_floor, 0), 0.9f);
      place_box(shop, "corner vault", paint_of::beams, low + vec3(0, plan::upper - 0.12f, 0), high + vec3(0, plan::upper, 0), 0.9f);
    }
}

}  // namespace rg::demo
