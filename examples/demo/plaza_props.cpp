#include <cmath>
#include <string>

#include "examples/demo/plaza_parts.h"

namespace rg::demo {
namespace {

using glm::vec2, glm::vec3;
constexpr vec3 kWarm{1.0f, 0.60f, 0.26f}, kIron{0.035f, 0.035f, 0.04f};

MeshData box(vec3 low, vec3 high) {
  MeshData data;
  add_box(data, low, high, 1);
  return data;
}
MeshData lathe(std::initializer_list<vec2> profile, int segments, vec3 base = vec3(0)) {
  MeshData data;
  add_lathe(data, base, std::span(profile.begin(), profile.size()), segments);
  return data;
}
MeshData sphere(vec3 center, float radius, int segments) {
  MeshData data;
  add_sphere(data, center, radius, segments);
  return data;
}

// A lantern about `at`: cap, four bars, a glowing core.
void paint_lantern(PropData& prop, vec3 at, float size, uint32_t part) {
  const PropPaint iron{kIron, 0.45f, 1, 0, part};
  paint(prop, lathe({{0.0f, 0.62f}, {0.05f, 0.6f}, {0.06f, 0.52f}, {0.3f, 0.36f}, {0.28f, 0.32f}, {0.0f, 0.32f}}, 12, at), iron);
  paint(prop, lathe({{0.0f, -0.36f}, {0.2f, -0.34f}, {0.22f, -0.28f}, {0.0f, -0.28f}}, 12, at), iron);
  for (const float x : {-0.17f, 0.17f})
    for (const float z : {-0.17f, 0.17f})
      paint(prop, box(at + vec3(x - 0.015f, -0.3f, z - 0.015f) * size, at + vec3(x + 0.015f, 0.34f, z + 0.015f) * size), iron);
  paint(prop, lathe({{0.05f, -0.26f}, {0.12f, -0.16f}, {0.13f, 0.1f}, {0.06f, 0.28f}}, 12, at), {kWarm, 0.9f, 0, 4.5f, part});
}

void build_lanterns(Workshop& shop) {
  PropData post, hanging;
  paint(post, lathe({{0.24f, 0}, {0.24f, 0.1f}, {0.14f, 0.2f}, {0.1f, 0.3f}, {0.06f, 0.5f}, {0.055f, 2.4f}, {0.1f, 2.5f}, {0.05f, 2.6f}}, 16),
        {kIron, 0.5f, 1});
  paint_lantern(post, {0, 2.95f, 0}, 1, 0);
  const uint32_t post_mesh = add_prop_mesh(shop.scene, "lantern post", post);
  for (const vec3& at : lantern_post_places()) place_prop(shop, post_mesh, at - vec3(0, 2.95f, 0));
  // Hangs from its origin and swings about it.
  paint(hanging, box({-0.012f, -1.0f, -0.012f}, {0.012f, 0, 0.012f}), {kIron, 0.5f, 1, 0, 1});
  paint_lantern(hanging, {0, -1.5f, 0}, 1, 1);
  const uint32_t hanging_mesh = add_prop_mesh(shop.scene, "hanging lantern", hanging);
  uint32_t seed = 7;
  for (const vec3& at : hanging_lantern_places())
    place_prop(shop, hanging_mesh, at + vec3(0, 1.5f, 0), 0, {Motion::swing, 0.045f, 0.35f, random_unit(seed++)});
}

void build_strings(Workshop& shop) {
  int number = 0;
  for (const std::vector<Bulb>& bulbs : strings_of_bulbs()) {
    PropData prop;
    MeshData rope;
    std::vector<vec3> path;
    for (const Bulb& bulb : bulbs) path.push_back(bulb.position + vec3(0, 0.1f, 0));
    add_tube(rope, path, 0.012f, 5);
    paint(prop, rope, {kIron, 0.9f});
    for (const Bulb& bulb : bulbs) paint(prop, sphere(bulb.position, 0.055f, 6), {bulb.color, 0.9f, 0, 7.5f});
    place_prop(shop, add_prop_mesh(shop.scene, "string of bulbs " + std::to_string(number++), prop), vec3(0));
  }
}

// A strip of cloth that hangs from its upper edge.
void build_banners(Workshop& shop) {
  const vec3 colors[] = {{0.32f, 0.02f, 0.03f}, {0.03f, 0.07f, 0.22f}, {0.34f, 0.22f, 0.03f}, {0.02f, 0.16f, 0.10f}};
  for (uint32_t i = 0; i < 4; ++i) {
    PropData prop;
    MeshData cloth;
    add_grid(cloth, {-0.45f, -2.6f, 0}, {0.9f, 0, 0}, {0, 2.6f, 0}, 6, 16);
    for (Vertex& v : cloth.vertices) v.position.z += 0.06f * std::sin(v.position.y * 3.1f + v.position.x * 2.0f) * (0.3f - 0.3f * v.position.y);
    MeshData behind = cloth;
    for (size_t k = 0; k < behind.indices.size(); k += 3) std::swap(behind.indices[k], behind.indices[k + 1]);
    for (Vertex& v : behind.vertices) v.normal = -v.normal;
    paint(prop, cloth, {colors[i], 0.95f, 0, 0, 1});
    paint(prop, behind, {colors[i], 0.95f, 0, 0, 1});
    paint(prop, box({-0.42f, -2.55f, 0.001f}, {0.42f, -2.45f, 0.02f}), {{0.6f, 0.42f, 0.12f}, 0.5f, 1, 0, 1});
    paint(prop, box({-0.55f, -0.02f, -0.02f}, {0.55f, 0.03f, 0.02f}), {kIron, 0.5f, 1});
    const uint32_t mesh = add_prop_mesh(shop.scene, "banner " + std::to_string(i), prop);
    const float z = -6.0f + 4.0f * static_cast<float>(i);
    const Animation sway{Motion::swing, 0.03f, 0.22f, 0.21f * static_cast<float>(i)};
    place_prop(shop, mesh, {-plan::court_x + 0.62f, plan::eaves - 0.6f, z}, 1.5707963f, sway);
    place_prop(shop, mesh, {plan::court_x - 0.62f, plan::eaves - 0.6f, z}, -1.5707963f, sway);
  }
}

void build_barrels(Workshop& shop) {
  PropData barrel, crate;
  paint(
      barrel,
      lathe(
          {{0.0f, 0.0f}, {0.27f, 0.0f}, {0.34f, 0.25f}, {0.36f, 0.45f}, {0.34f, 0.65f}, {0.27f, 0.9f}, {0.25f, 0.9f}, {0.24f, 0.86f}, {0.0f, 0.86f}},
          24),
      {{0.20f, 0.10f, 0.045f}, 0.7f});
  for (const float y : {0.12f, 0.3f, 0.6f, 0.78f})
    paint(barrel,
          lathe({{0.30f + 0.08f * (0.45f - std::abs(y - 0.45f)) * 2, y - 0.03f},
                 {0.315f + 0.08f * (0.45f - std::abs(y - 0.45f)) * 2, y},
                 {0.30f + 0.08f * (0.45f - std::abs(y - 0.45f)) * 2, y + 0.03f}},
                24),
          {kIron, 0.5f, 1});
  paint(crate, box({-0.4f, 0.02f, -0.4f}, {0.4f, 0.78f, 0.4f}), {{0.24f, 0.135f, 0.06f}, 0.8f});
  for (const float y : {0.0f, 0.7f})
    for (const float z : {-0.42f, 0.36f}) {
      paint(crate, box({-0.43f, y, z}, {0.43f, y + 0.1f, z + 0.06f}), {{0.15f, 0.08f, 0.035f}, 0.8f});
      paint(crate, box({z, y, -0.43f}, {z + 0.06f, y + 0.1f, 0.43f}), {{0.15f, 0.08f, 0.035f}, 0.8f});
    }
  const uint32_t barrel_mesh = add_prop_mesh(shop.scene, "barrel", barrel), crate_mesh = add_prop_mesh(shop.scene, "crate", crate);
  const vec3 barrels[] = {{-12.6f, 0, 8.6f}, {-13.0f, 0, 7.7f}, {-12.2f, 0, 7.9f},
                          {12.8f, 0, -8.4f}, {12.5f, 0, -7.6f}, {16.6f, plan::walk_floor, 4.0f}};
  for (uint32_t i = 0; i < 6; ++i) place_prop(shop, barrel_mesh, barrels[i], random_unit(i) * 6, {}, vec3(0.8f + 0.5f * random_unit(i + 50)));
  const vec3 crates[] = {{-13.1f, 0, 5.9f}, {-12.3f, 0, 6.3f},    {-12.9f, 0.78f, 6.1f},         {12.9f, 0, 8.7f},
                         {12.0f, 0, 8.9f},  {12.6f, 0.78f, 8.8f}, {-6.2f, plan::terrace, -21.3f}};
  for (uint32_t i = 0; i < 7; ++i) place_prop(shop, crate_mesh, crates[i], random_unit(i + 90) * 0.8f, {}, vec3(0.8f + 0.5f * random_unit(i + 70)));
}

void build_candles(Workshop& shop) {
  PropData candle;
  paint(candle, lathe({{0.05f, -0.26f}, {0.05f, -0.24f}, {0.02f, -0.2f}, {0.028f, -0.18f}, {0.028f, -0.04f}, {0.0f, -0.04f}}, 10),
        {{0.75f, 0.70f, 0.58f}, 0.6f});
  paint(candle, lathe({{0.0f, -0.04f}, {0.016f, -0.01f}, {0.012f, 0.025f}, {0.0f, 0.06f}}, 8), {{1.0f, 0.66f, 0.25f}, 0.9f, 0, 8});
  const uint32_t mesh = add_prop_mesh(shop.scene, "candle", candle);
  for (const vec3& at : candle_places()) place_prop(shop, mesh, at);
}

void build_bookshelves(Workshop& shop) {
  for (uint32_t shelf = 0; shelf < 2; ++shelf) {
    PropData prop;
    const PropPaint wood{{0.12f, 0.055f, 0.025f}, 0.5f};
    for (int row = 0; row < 5; ++row) {
      const float y = 0.48f * static_cast<float>(row);
      paint(prop, box({-1.5f, y, -0.35f}, {1.5f, y + 0.05f, 0}), wood);
      for (uint32_t k = 0; k < 26 && row < 4; ++k) {
        const uint32_t seed = shelf * 1000 + static_cast<uint32_t>(row) * 40 + k;
        const float x = -1.42f + 0.109f * static_cast<float>(k), tall = 0.26f + 0.13f * random_unit(seed);
        const vec3 hue =
            glm::mix(vec3(0.22f, 0.05f, 0.03f), vec3(0.04f, 0.09f, 0.16f), random_unit(seed + 500)) * (0.6f + 0.9f * random_unit(seed + 900));
        paint(prop, box({x, y + 0.05f, -0.3f}, {x + 0.085f + 0.02f * random_unit(seed + 7), y + 0.05f + tall, -0.06f}), {hue, 0.6f});
      }
    }
    for (const float x : {-1.55f, 1.5f}) paint(prop, box({x, 0, -0.36f}, {x + 0.05f, 2.0f, 0.0f}), wood);
    place_prop(shop, add_prop_mesh(shop.scene, "bookshelf " + std::to_string(shelf), prop),
               {-6.88f, plan::terrace, -20.3f + 3.4f * static_cast<float>(shelf)}, -1.5707963f);
  }
}

}  // namespace

void build_props(Workshop& shop) {
  build_lanterns(shop);
  build_strings(shop);
  build_banners(shop);
  build_barrels(shop);
  build_candles(shop);
  build_bookshelves(shop);
}

}  // namespace rg::demo
