#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "examples/demo/plaza_parts.h"

namespace rg::demo {
namespace {

using glm::vec2, glm::vec3;
const vec3 kFountain{0, 0, 1};

// Slabs of uneven height with rounded edges, 7 x 5 patches of 5 x 5, and a disc of mosaic around the fountain.
void pave(Workshop& shop) {
  constexpr float side = 0.8f;
  for (int patch_z = 0; patch_z < 5; ++patch_z) {
    for (int patch_x = 0; patch_x < 7; ++patch_x) {
      MeshData data;
      for (int k = 0; k < 25; ++k) {
        const int x = patch_x * 5 + k % 5, z = patch_z * 5 + k / 5;
        const vec3 low(-plan::court_x + static_cast<float>(x) * side, -0.2f, -plan::court_z + static_cast<float>(z) * side);
        const float height = 0.012f * random_unit(static_cast<uint32_t>(z * 35 + x));
        if (glm::distance(vec2(low.x, low.z) + 0.5f * side, vec2(kFountain.x, kFountain.z)) < 4.6f) continue;
        add_slab(data, low + vec3(0.006f, 0, 0.006f), low + vec3(side - 0.006f, 0.2f - height, side - 0.006f), 0.018f);
      }
      if (data.indices.empty()) continue;
      place(shop, "paving " + std::to_string(patch_z * 7 + patch_x), paint_of::granite, std::move(data));
    }
  }
  MeshData bed;
  add_grid(bed, {-plan::court_x - plan::walk, -0.06f, plan::court_z + plan::walk}, {2 * (plan::court_x + plan::walk), 0, 0},
           {0, 0, -2 * (plan::court_z + plan::walk)}, 24, 18);
  place(shop, "ground", paint_of::sandstone, std::move(bed));
  MeshData disc;
  const vec2 rim[] = {{5.4f, -0.1f}, {5.4f, 0.03f}, {5.3f, 0.045f}, {5.0f, 0.045f}, {4.2f, 0.045f}, {3.0f, 0.045f}};
  add_lathe(disc, kFountain, rim, 72);
  for (Vertex& v : disc.vertices) {
    v.u = v.position.x;
    v.v = v.position.z;
  }
  place(shop, "mosaic around the fountain", paint_of::mosaic, std::move(disc));
}

MeshData turned(std::initializer_list<vec2> profile, int segments, vec3 base) {
  MeshData data;
  add_lathe(data, base, std::span(profile.begin(), profile.size()), segments);
  return data;
}

void add_water(Workshop& shop, const char* name, float radius, float height) {
  MeshData water;
  const vec2 disc[] = {{radius, height}, {radius * 0.66f, height}, {radius * 0.33f, height}, {0.0f, height}};
  add_lathe(water, kFountain, disc, 48);
  for (Vertex& v : water.vertices) {
    v.u = v.position.x;
    v.v = v.position.z;
    v.normal = {0, 1, 0};
  }
  const uint32_t at = place(shop, name, paint_of::water, std::move(water));
  shop.scene.instances[at].glass = true;
  shop.scene.instances[at].casts_shadow = false;
}

void build_fountain(Workshop& shop) {
  place(shop, "basin", paint_of::marble,
        turned({{3.35f, 0},
                {3.35f, 0.12f},
                {3.2f, 0.18f},
                {3.12f, 0.5f},
                {3.22f, 0.62f},
                {3.36f, 0.66f},
                {3.38f, 0.72f},
                {3.3f, 0.78f},
                {3.02f, 0.78f},
                {2.94f, 0.72f},
                {2.9f, 0.5f},
                {2.86f, 0.14f},
                {2.4f, 0.06f},
                {0.7f, 0.05f}},
               72, kFountain));
  place(shop, "pedestal", paint_of::dark_marble,
        turned({{0.72f, 0.05f}, {0.72f, 0.28f}, {0.5f, 0.36f}, {0.3f, 0.5f}, {0.24f, 0.9f}, {0.3f, 1.2f}, {0.42f, 1.34f}, {0.34f, 1.46f}}, 32,
               kFountain));
  place(shop, "upper bowl", paint_of::marble,
        turned({{0.2f, 1.4f}, {0.6f, 1.5f}, {1.05f, 1.68f}, {1.32f, 1.9f}, {1.38f, 2.0f}, {1.32f, 2.04f}, {1.2f, 1.98f}, {0.9f, 1.8f}, {0.3f, 1.72f}},
               48, kFountain));
  place(shop, "finial", paint_of::gold,
        turned({{0.2f, 1.72f}, {0.16f, 2.1f}, {0.26f, 2.22f}, {0.3f, 2.36f}, {0.2f, 2.5f}, {0.08f, 2.58f}, {0.07f, 2.72f}, {0.0f, 2.86f}}, 24,
               kFountain));
  for (int i = 0; i < 3; ++i) {  // rings that turn about the hologram
    MeshData ring;
    const float r = 1.05f + 0.13f * static_cast<float>(i);
    const vec2 profile[] = {{r, -0.03f}, {r + 0.03f, -0.02f}, {r + 0.03f, 0.02f}, {r, 0.03f}, {r - 0.02f, 0}, {r, -0.03f}};
    add_lathe(ring, {0, 0, 0}, profile, 64);
    const uint32_t at = place(shop, "ring " + std::to_string(i), i == 1 ? paint_of::verdigris : paint_of::gold, std::move(ring));
    Instance& instance = shop.scene.instances[at];
    instance.transform = glm::rotate(glm::translate(glm::mat4(1), vec3(0, 4.1f, 1)), 0.5f + 0.7f * static_cast<float>(i), vec3(0.3f, 0.1f, 1));
    instance.animation = {Motion::tumble, i == 1 ? -0.22f : 0.17f, 0, 0};
  }
  add_water(shop, "basin water", 2.92f, 0.6f);
  add_water(shop, "bowl water", 1.24f, 1.96f);
}

void build_steps(Workshop& shop) {
  for (int i = 0; i < 6; ++i) {
    const float top = plan::terrace * static_cast<float>(i + 1) / 6, front = -plan::court_z + 1.8f - 0.3f * static_cast<float>(i);
    MeshData step;
    add_slab(step, {-5.2f, -0.1f, -plan::court_z - 0.2f}, {5.2f, top, front}, 0.025f);
    place(shop, "step " + std::to_string(i), paint_of::sandstone, std::move(step));
    place_box(shop, "step light " + std::to_string(i), paint_of::glow_warm, {-5.1f, top - 0.05f, front + 0.001f}, {5.1f, top - 0.03f, front + 0.012f},
              6);
  }
  for (const float side : {-1.0f, 1.0f}) {
    const float a = side * 5.2f, b = side * 5.8f;
    place_box(shop, side < 0 ? "west cheek" : "east cheek", paint_of::marble, {std::min(a, b), 0, -plan::court_z},
              {std::max(a, b), 1.1f, -plan::court_z + 2.0f}, 0.5f);
    place(
        shop, "urn", paint_of::terracotta,
        turned({{0.2f, 0}, {0.22f, 0.05f}, {0.1f, 0.14f}, {0.2f, 0.3f}, {0.34f, 0.55f}, {0.36f, 0.72f}, {0.26f, 0.86f}, {0.3f, 0.92f}, {0.2f, 0.9f}},
               28, {side * 5.5f, 1.1f, -plan::court_z + 1.6f}));
  }
}

// A ball of leaves: a sphere with bumps.
MeshData foliage(vec3 center, float radius, uint32_t seed) {
  MeshData ball;
  add_sphere(ball, center, radius, 26);
  const vec3 shift(random_unit(seed) * 9, random_unit(seed + 1) * 9, random_unit(seed + 2) * 9);
  for (Vertex& v : ball.vertices) {
    const vec3 d = glm::normalize(v.position - center), p = d * 4.3f + shift;
    const float bump =
        std::sin(p.x * 1.7f + std::sin(p.y * 2.1f)) * std::sin(p.y * 1.9f + std::sin(p.z * 1.6f)) * std::sin(p.z * 1.8f + std::sin(p.x * 1.3f));
    v.position += d * (radius * 0.22f * bump);
    v.u *= 1.5f;
  }
  return ball;
}

void plant_tree(Workshop& shop, vec3 at, uint32_t seed) {
  const std::string number = std::to_string(seed);
  place_box(shop, "planter " + number, paint_of::sandstone, at + vec3(-0.8f, 0, -0.8f), at + vec3(0.8f, 0.6f, 0.8f), 0.4f);
  place_box(shop, "rim " + number, paint_of::marble, at + vec3(-0.9f, 0.6f, -0.9f), at + vec3(0.9f, 0.7f, 0.9f), 0.45f);
  MeshData trunk;
  const vec3 path[] = {at + vec3(0, 0.5f, 0), at + vec3(0.06f, 1.3f, 0.03f), at + vec3(-0.04f, 2.1f, 0.06f), at + vec3(0.05f, 2.9f, 0)};
  add_tube(trunk, path, 0.11f, 12);
  place(shop, "trunk " + number, paint_of::beams, std::move(trunk));
  const vec3 crowns[] = {{0, 3.2f, 0}, {0.7f, 2.8f, 0.3f}, {-0.6f, 2.9f, 0.4f}, {0.1f, 2.8f, -0.7f}, {0, 0.85f, 0}};
  for (uint32_t i = 0; i < 5; ++i)
    place(shop, "leaves " + number + "." + std::to_string(i), paint_of::leaves,
          foliage(at + crowns[i],
                  i == 0   ? 0.95f
                  : i == 4 ? 0.62f
                           : 0.72f,
                  seed * 16 + i));
}

void build_benches(Workshop& shop) {
  for (int i = 0; i < 6; ++i) {
    const float angle = 1.0471976f * static_cast<float>(i) + 0.5236f;
    const glm::mat4 turn = glm::rotate(glm::translate(glm::mat4(1), kFountain), angle, vec3(0, 1, 0));
    const struct {
      vec3 low, high;
      uint32_t material;
    } parts[] = {{{-0.9f, 0.4f, 6.1f}, {0.9f, 0.5f, 6.6f}, paint_of::marble},
                 {{-0.8f, 0.02f, 6.2f}, {-0.6f, 0.4f, 6.5f}, paint_of::sandstone},
                 {{0.6f, 0.02f, 6.2f}, {0.8f, 0.4f, 6.5f}, paint_of::sandstone}};
    for (const auto& part : parts) {
      MeshData data;
      add_box(data, part.low, part.high, 0.5f);
      const uint32_t at = place(shop, "bench " + std::to_string(i), part.material, std::move(data));
      shop.scene.instances[at].transform = turn;
    }
  }
}

}  // namespace

void build_court(Workshop& shop) {
  pave(shop);
  build_fountain(shop);
  build_steps(shop);
  uint32_t seed = 1;
  for (const float x : {-10.6f, 10.6f})
    for (const float z : {-5.4f, 6.6f}) plant_tree(shop, {x, 0, z}, seed++);
  build_benches(shop);
}

}  // namespace rg::demo
