#include "examples/demo/camera.h"

#include <cmath>

namespace rg::demo {
namespace {

glm::mat4 look(glm::vec3 eye, glm::vec3 forward) {
  const glm::vec3 up = std::abs(forward.y) > 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(forward, up)), down = glm::cross(forward, right);
  glm::mat4 m(1);
  const glm::vec3 rows[] = {right, down, forward};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[c][r] = rows[r][c];
    m[3][r] = -glm::dot(rows[r], eye);
  }
  return m;
}

float halton(uint32_t index, uint32_t base) {
  float result = 0, f = 1;
  for (uint32_t i = index; i > 0; i /= base) {
    f /= static_cast<float>(base);
    result += f * static_cast<float>(i % base);
  }
  return result;
}

}  // namespace

glm::mat4 world_to_view(const NamedCamera& camera) { return look(camera.eye, glm::normalize(camera.target - camera.eye)); }

glm::mat4 view_to_clip(const Projection& p) {
  glm::mat4 m(0);
  m[0][0] = p.scale.x;
  m[1][1] = p.scale.y;
  m[2] = glm::vec4(p.jitter, 0, 1);
  m[3][2] = p.near;
  return m;
}

Projection project(const NamedCamera& camera, glm::vec2 size) {
  const float y = 1 / std::tan(0.5f * camera.field_of_view);
  return {{y * size.y / size.x, y}, {0, 0}, 0.1f};
}

glm::vec2 jitter_of(uint32_t frame, glm::vec2 size) {
  const uint32_t i = frame % 8 + 1;
  return (glm::vec2(halton(i, 2), halton(i, 3)) - 0.5f) * 2.0f / size;
}

glm::mat4 world_to_sun(const Sun& sun) {
  const float reach = 1 / sun.radius, depth = 1 / (2 * 1.6f * sun.radius);
  glm::mat4 scale(1);
  scale[0][0] = scale[1][1] = reach;
  scale[2][2] = -depth;
  scale[3][2] = 0.5f;
  return scale * look(sun.center, -sun.direction);
}

}  // namespace rg::demo
