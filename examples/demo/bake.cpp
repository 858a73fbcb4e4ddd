#include "examples/demo/bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <thread>
#include <vector>

namespace rg::demo {
namespace {

constexpr uint32_t kRays = 24;

// Points of a disc in golden-angle order, lifted to the hemisphere: cosine-weighted.
std::array<glm::vec3, kRays> make_rays() {
  std::array<glm::vec3, kRays> rays;
  for (uint32_t i = 0; i < kRays; ++i) {
    const float r2 = (static_cast<float>(i) + 0.5f) / kRays, angle = static_cast<float>(i) * 2.39996323f;
    rays[i] = {std::sqrt(r2) * std::cos(angle), std::sqrt(r2) * std::sin(angle), std::sqrt(1 - r2)};
  }
  return rays;
}

bool hits(glm::vec3 origin, glm::vec3 inverse, const Box& box) {
  const glm::vec3 a = (box.low - origin) * inverse, b = (box.high - origin) * inverse;
  const glm::vec3 near = glm::min(a, b), far = glm::max(a, b);
  const float enter = std::max({near.x, near.y, near.z}), leave = std::min({far.x, far.y, far.z});
  return leave > std::max(enter, 0.02f);
}

bool sees_sky(glm::vec3 origin, glm::vec3 direction, std::span<const Box> boxes) {
  const glm::vec3 inverse = 1.0f / glm::mix(glm::vec3(1e-6f), direction, glm::greaterThan(glm::abs(direction), glm::vec3(1e-6f)));
  return std::none_of(boxes.begin(), boxes.end(), [&](const Box& box) { return hits(origin, inverse, box); });
}

void bake_vertices(std::span<Vertex> vertices, const glm::mat4& transform, std::span<const Box> boxes) {
  for (Vertex& v : vertices) {
    const glm::vec3 position = transform * glm::vec4(v.position, 1), normal = glm::normalize(glm::vec3(transform * glm::vec4(v.normal, 0)));
    v.tangent.w = std::copysign(sky_share(position, normal, boxes), v.tangent.w);
  }
}

// Vertices of a mesh are contiguous and no other mesh uses them.
std::span<Vertex> vertices_of(Scene& scene, const Mesh& mesh) {
  const auto first = scene.indices.begin() + mesh.first_index, last = first + mesh.index_count;
  const auto [low, high] = std::minmax_element(first, last);
  return std::span(scene.vertices).subspan(*low, *high - *low + 1);
}

}  // namespace

float sky_share(glm::vec3 position, glm::vec3 normal, std::span<const Box> boxes, float least) {
  static const std::array<glm::vec3, kRays> rays = make_rays();
  const glm::vec3 side = glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
  const glm::vec3 over = glm::cross(normal, side), origin = position + normal * 0.05f;
  uint32_t free = 0;
  // Rays below the horizon meet the ground, which is lit by the sky as well: half of it counts.
  uint32_t halves = 0;
  for (const glm::vec3& ray : rays) {
    const glm::vec3 direction = side * ray.x + over * ray.y + normal * ray.z;
    if (!sees_sky(origin, direction, boxes)) continue;
    (direction.y > 0 ? free : halves) += 1;
  }
  return std::max((static_cast<float>(free) + 0.5f * static_cast<float>(halves)) / kRays, least);
}

void bake_sky(Scene& scene, std::span<const Box> boxes) {
  const auto bake_every_second = [&](size_t first) {
    for (size_t i = first; i < scene.instances.size(); i += 2)
      bake_vertices(vertices_of(scene, scene.meshes[scene.instances[i].mesh]), scene.instances[i].transform, boxes);
  };
  std::thread other(bake_every_second, 1);
  bake_every_second(0);
  other.join();
  for (Prop& prop : scene.props) {
    const glm::vec3 at = prop.transform * glm::vec4(scene.prop_meshes[prop.mesh].center, 1);
    prop.sky = 0.5f * (sky_share(at, {0, 1, 0}, boxes) + sky_share(at, {0, 0, 1}, boxes));
  }
}

}  // namespace rg::demo
