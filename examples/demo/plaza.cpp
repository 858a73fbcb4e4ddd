#include "examples/demo/plaza.h"

#include <glm/gtc/matrix_transform.hpp>

#include "examples/demo/plaza_parts.h"
#include "examples/demo/textures.h"

namespace rg::demo {

uint32_t place(Workshop& shop, std::string name, uint32_t material, MeshData data) {
  const float repeats = 1 / shop.texture_metres[material];
  for (Vertex& v : data.vertices) {
    v.u *= repeats;
    v.v *= repeats;
  }
  Instance instance;
  instance.mesh = add_mesh(shop.scene, std::move(name), data);
  instance.material = material;
  shop.scene.instances.push_back(instance);
  return static_cast<uint32_t>(shop.scene.instances.size() - 1);
}

void place_box(Workshop& shop, std::string name, uint32_t material, glm::vec3 low, glm::vec3 high, float cell) {
  MeshData data;
  add_box(data, low, high, cell);
  place(shop, std::move(name), material, std::move(data));
  const glm::vec3 size = high - low;
  if (size.x * size.y * size.z > 0.4f) shop.solids.push_back({low, high});
}

void place_prop(Workshop& shop, uint32_t mesh, glm::vec3 at, float turn, Animation animation, glm::vec3 tint) {
  Prop prop;
  prop.mesh = mesh;
  prop.transform = glm::rotate(glm::translate(glm::mat4(1), at), turn, glm::vec3(0, 1, 0));
  prop.tint = tint;
  prop.animation = animation;
  shop.scene.props.push_back(prop);
}

float random_unit(uint32_t seed) {
  uint32_t h = seed * 0x9E3779B1u + 0x7F4A7C15u;
  h = (h ^ (h >> 16)) * 0x85EBCA6Bu;
  h = (h ^ (h >> 13)) * 0xC2B2AE35u;
  return static_cast<float>((h ^ (h >> 16)) >> 8) / 16777216.0f;
}

namespace {

struct Row {
  const char* name;
  glm::vec3 color;
  float roughness, metallic, bump;
  uint32_t layer;
  float metres;
  glm::vec3 emissive;
  float opacity;
};

constexpr Row kMaterials[] = {
    {"granite", {0.80f, 0.78f, 0.76f}, 0.95f, 0, 1, layer::granite, 2.0f, {}, 1},
    {"plaster", {0.92f, 0.86f, 0.78f}, 1, 0, 0.7f, layer::plaster, 3.0f, {}, 1},
    {"ochre plaster", {0.86f, 0.58f, 0.34f}, 1, 0, 0.8f, layer::plaster, 3.0f, {}, 1},
    {"brick", {1, 1, 1}, 1, 0, 1, layer::brick, 1.6f, {}, 1},
    {"marble", {1, 0.98f, 0.95f}, 1, 0, 0.5f, layer::marble, 2.2f, {}, 1},
    {"dark marble", {1, 1, 1}, 1, 0, 0.4f, layer::dark_marble, 1.8f, {}, 1},
    {"planks", {1, 1, 1}, 1, 0, 0.8f, layer::planks, 1.8f, {}, 1},
    {"beams", {0.55f, 0.48f, 0.42f}, 1, 0, 0.9f, layer::planks, 1.2f, {}, 1},
    {"roof tiles", {1, 1, 1}, 1, 0, 1, layer::roof, 1.7f, {}, 1},
    {"sandstone", {0.95f, 0.92f, 0.90f}, 1, 0, 0.9f, layer::sandstone, 1.9f, {}, 1},
    {"mosaic", {1, 1, 1}, 1, 0, 0.8f, layer::mosaic, 1.2f, {}, 1},
    {"bronze", {0.71f, 0.42f, 0.20f}, 0.6f, 1, 0.8f, layer::hammered, 0.7f, {}, 1},
    {"gold", {1.0f, 0.72f, 0.32f}, 0.45f, 1, 0.5f, layer::hammered, 0.5f, {}, 1},
    {"rug", {1, 1, 1}, 1, 0, 0.8f, layer::rug, 4.0f, {}, 1},
    {"leaves", {1, 1, 1}, 1, 0, 1, layer::leaves, 0.9f, {}, 1},
    {"verdigris", {1, 1, 1}, 1, 1, 0.7f, layer::verdigris, 1.1f, {}, 1},
    {"terracotta", {1, 1, 1}, 1, 0, 0.8f, layer::terracotta, 0.8f, {}, 1},
    {"painted wood", {0.80f, 0.78f, 0.72f}, 0.6f, 0, 0, layer::flat, 1, {}, 1},
    {"warm glow", {1.0f, 0.62f, 0.28f}, 0.8f, 0, 0, layer::flat, 1, {1.7f, 1.7f, 1.7f}, 1},
    {"teal glow", {0.10f, 0.85f, 0.80f}, 0.8f, 0, 0, layer::flat, 1, {3.0f, 3.0f, 3.0f}, 1},
    {"rose glow", {1.0f, 0.22f, 0.42f}, 0.8f, 0, 0, layer::flat, 1, {3.0f, 3.0f, 3.0f}, 1},
    {"embers", {1.0f, 0.30f, 0.06f}, 0.9f, 0, 1, layer::leaves, 0.4f, {60, 60, 60}, 1},
    {"glass", {0.75f, 0.85f, 0.85f}, 0.06f, 0.25f, 0, layer::flat, 1, {}, 0.10f},
    {"water", {0.05f, 0.16f, 0.17f}, 0.07f, 0.9f, 1, layer::flat, 1, {}, 0.55f},
    {"green glass", {0.10f, 0.42f, 0.30f}, 0.05f, 0.6f, 0, layer::flat, 1, {}, 0.45f},
    {"rose screen", {1, 1, 1}, 0.4f, 0, 0, layer::roses, 1.4f, {2.6f, 2.6f, 2.6f}, 1},
};
static_assert(std::size(kMaterials) == paint_of::count);

void set_cameras(Scene& scene) {
  scene.cameras = {
      {"courtyard", {-5.6f, 1.9f, 9.2f}, {1.5f, 3.1f, -8.0f}, 1.0f, -0.8f},
      {"interior", {-2.7f, 2.55f, -15.4f}, {1.5f, 1.95f, -21.4f}, 1.08f, -0.35f},
      {"overview", {-10.5f, 11.8f, 8.8f}, {1.9f, 0.6f, -4.2f}, 0.98f, -0.7f},
  };
  scene.sun.direction = glm::normalize(glm::vec3(-0.62f, 0.42f, 0.40f));
  scene.sun.color = {1.0f, 0.46f, 0.20f};
  scene.sun.ambient = {0.045f, 0.075f, 0.17f};
  scene.sun.center = {0, 3, -3};
  scene.sun.radius = 26;
}

// Haze under everything, mist that lies knee-high in the court, dust in the hall.
void let_in_fog(Scene& scene) {
  scene.fog.density = 0.012f;
  scene.fog.ground = 4;
  scene.fog.thinning = 0.25f;
  scene.fog.phase = 0.55f;
  const auto box = [&](glm::vec3 center, glm::vec3 half, float density, glm::vec2 scroll, float repeats) {
    const glm::mat4 transform = glm::scale(glm::translate(glm::mat4(1), center), half);
    scene.fog.boxes.push_back({transform, density, 0.6f, layer::mist, repeats, scroll});
  };
  box({0, 0.35f, 0}, {plan::court_x + 2, 0.75f, plan::court_z + 2}, 0.10f, {0.012f, 0.005f}, 3);
  box({0, 1.6f, 1}, {3.4f, 1.8f, 3.4f}, 0.16f, {-0.02f, 0.03f}, 1);
  box({0, 3.0f, -18}, {plan::hall_x, 2.6f, 4.2f}, 0.022f, {0.004f, 0.003f}, 1.5f);
}

}  // namespace

void make_materials(Workshop& shop) {
  for (const Row& row : kMaterials) {
    shop.scene.materials.push_back(
        {row.name, glm::vec4(row.color, row.opacity), row.emissive, row.roughness, row.metallic, row.bump, row.layer, row.layer});
    shop.texture_metres.push_back(row.metres);
  }
}

Scene make_plaza() {
  Workshop shop;
  shop.scene.name = "plaza";
  shop.scene.textures = make_plaza_textures();
  make_materials(shop);
  build_court(shop);
  build_arcades(shop);
  build_hall(shop);
  build_props(shop);
  hang_lights(shop);
  put_on_shows(shop);
  bake_sky(shop.scene, shop.solids);
  set_cameras(shop.scene);
  let_in_fog(shop.scene);
  shop.scene.has_hologram = true;
  shop.scene.hologram_center = {0, 4.1f, 1};
  return std::move(shop.scene);
}

}  // namespace rg::demo
