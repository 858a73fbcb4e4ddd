#include "examples/demo/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

namespace rg::demo {
namespace {

constexpr float kTau = 2 * std::numbers::pi_v<float>;

uint32_t add_vertex(MeshData& mesh, glm::vec3 position, glm::vec3 normal, glm::vec3 tangent, glm::vec2 uv) {
  mesh.vertices.push_back({position, uv.x, normal, uv.y, glm::vec4(tangent, 1)});
  return static_cast<uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(MeshData& mesh, uint32_t a, uint32_t b, uint32_t c) { mesh.indices.insert(mesh.indices.end(), {a, b, c}); }

// Indices of a sheet of (nu + 1) x (nv + 1) vertices that starts at `first`, rows along u.
void add_cells(MeshData& mesh, uint32_t first, int nu, int nv) {
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const uint32_t at = first + static_cast<uint32_t>(j * (nu + 1) + i), up = at + static_cast<uint32_t>(nu) + 1;
      add_triangle(mesh, at, at + 1, up + 1);
      add_triangle(mesh, at, up + 1, up);
    }
  }
}

// Texture coordinates that agree between neighbours: world metres across the dominant axis of the normal.
glm::vec2 world_uv(glm::vec3 p, glm::vec3 n, float scale) {
  const glm::vec3 a = glm::abs(n);
  if (a.y >= a.x && a.y >= a.z) return glm::vec2(p.x, p.z) * scale;
  return (a.x >= a.z ? glm::vec2(p.z, -p.y) : glm::vec2(p.x, -p.y)) * scale;
}
glm::vec3 world_tangent(glm::vec3 n) { return std::abs(n.x) > std::max(std::abs(n.y), std::abs(n.z)) ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0); }

void add_face(MeshData& mesh, const glm::vec3 (&corners)[4], float scale) {
  const glm::vec3 n = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (const glm::vec3& p : corners) add_vertex(mesh, p, n, world_tangent(n), world_uv(p, n, scale));
  add_triangle(mesh, first, first + 1, first + 2);
  add_triangle(mesh, first, first + 2, first + 3);
}

int cells(float length, float cell) { return std::max(1, static_cast<int>(std::ceil(length / cell - 0.01f))); }

}  // namespace

void add_grid(MeshData& mesh, glm::vec3 origin, glm::vec3 du, glm::vec3 dv, int nu, int nv, float texture_scale) {
  const glm::vec3 n = glm::normalize(glm::cross(du, dv));
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) {
      const glm::vec3 p = origin + du * (static_cast<float>(i) / static_cast<float>(nu)) + dv * (static_cast<float>(j) / static_cast<float>(nv));
      add_vertex(mesh, p, n, world_tangent(n), world_uv(p, n, texture_scale));
    }
  }
  add_cells(mesh, first, nu, nv);
}

void add_box(MeshData& mesh, glm::vec3 low, glm::vec3 high, float cell, float texture_scale) {
  const glm::vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  const int nx = cells(d.x, cell), ny = cells(d.y, cell), nz = cells(d.z, cell);
  add_grid(mesh, low + z, x, y, nx, ny, texture_scale);
  add_grid(mesh, low + x, -x, y, nx, ny, texture_scale);
  add_grid(mesh, high - y, -z, y, nz, ny, texture_scale);
  add_grid(mesh, low, z, y, nz, ny, texture_scale);
  add_grid(mesh, low + y + z, x, -z, nx, nz, texture_scale);
  add_grid(mesh, low, x, z, nx, nz, texture_scale);
}

void add_slab(MeshData& mesh, glm::vec3 low, glm::vec3 high, float bevel, float texture_scale) {
  const glm::vec3 a(low.x + bevel, high.y, low.z + bevel), b(high.x - bevel, high.y, low.z + bevel);
  const glm::vec3 c(high.x - bevel, high.y, high.z - bevel), d(low.x + bevel, high.y, high.z - bevel);
  const float rim = high.y - bevel;
  const glm::vec3 e(low.x, rim, low.z), f(high.x, rim, low.z), g(high.x, rim, high.z), h(low.x, rim, high.z);
  const auto foot = [&](glm::vec3 p) { return glm::vec3(p.x, low.y, p.z); };
  add_face(mesh, {d, c, b, a}, texture_scale);
  add_face(mesh, {h, g, c, d}, texture_scale);
  add_face(mesh, {g, f, b, c}, texture_scale);
  add_face(mesh, {f, e, a, b}, texture_scale);
  add_face(mesh, {e, h, d, a}, texture_scale);
  add_face(mesh, {foot(h), foot(g), g, h}, texture_scale);
  add_face(mesh, {foot(g), foot(f), f, g}, texture_scale);
  add_face(mesh, {foot(f), foot(e), e, f}, texture_scale);
  add_face(mesh, {foot(e), foot(h), h, e}, texture_scale);
}

void add_lathe(MeshData& mesh, glm::vec3 base, std::span<const glm::vec2> profile, int segments, float flutes) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const int rows = static_cast<int>(profile.size());
  // One radius for all rows: a texture that narrows is better than one that shears.
  const float reach = std::max_element(profile.begin(), profile.end(), [](glm::vec2 a, glm::vec2 b) { return a.x < b.x; })->x;
  for (int j = 0; j < rows; ++j) {
    const glm::vec2 here = profile[static_cast<size_t>(j)];
    const glm::vec2 along = profile[static_cast<size_t>(std::min(j + 1, rows - 1))] - profile[static_cast<size_t>(std::max(j - 1, 0))];
    const glm::vec2 out = glm::length(along) > 0 ? glm::normalize(glm::vec2(along.y, -along.x)) : glm::vec2(1, 0);
    for (int i = 0; i <= segments; ++i) {
      const float turn = static_cast<float>(i) / static_cast<float>(segments), angle = turn * kTau;
      const float wave = flutes > 0 ? 0.035f * std::abs(std::sin(angle * flutes * 0.5f)) : 0.0f;
      const glm::vec3 radial(std::cos(angle), 0, -std::sin(angle)), around(-std::sin(angle), 0, -std::cos(angle));
      const float lean = flutes > 0 ? 0.6f * std::cos(angle * flutes * 0.5f) * (std::sin(angle * flutes * 0.5f) < 0 ? -1.0f : 1.0f) : 0.0f;
      const glm::vec3 normal = glm::normalize(radial * out.x + glm::vec3(0, out.y, 0) - around * (lean * 0.5f));
      add_vertex(mesh, base + radial * (here.x - wave) + glm::vec3(0, here.y, 0), normal, around, {turn * reach * kTau, -here.y});
    }
  }
  add_cells(mesh, first, segments, rows - 1);
}

void add_arch(MeshData& mesh, const ArchShape& arch) {
  const glm::vec3 span = arch.right - arch.left, along = glm::normalize(span), up(0, 1, 0), out = glm::cross(along, up);
  const glm::vec3 center = 0.5f * (arch.left + arch.right), half = out * (0.5f * arch.depth);
  const float radius = 0.5f * glm::length(span);
  const auto on_ring = [&](float r, float angle) { return center + along * (-r * std::cos(angle)) + up * (r * std::sin(angle)); };
  // From the ring straight up to the top of the wall, or to its end.
  const auto on_wall = [&](float angle) {
    const float x = -(radius + arch.thickness) * std::cos(angle);
    return center + along * x + up * arch.top;
  };
  for (int i = 0; i < arch.segments; ++i) {
    const float a = kTau * 0.5f * static_cast<float>(i) / static_cast<float>(arch.segments);
    const float b = kTau * 0.5f * static_cast<float>(i + 1) / static_cast<float>(arch.segments);
    const glm::vec3 ia = on_ring(radius, a), ib = on_ring(radius, b), oa = on_ring(radius + arch.thickness, a),
                    ob = on_ring(radius + arch.thickness, b);
    const glm::vec3 rim = out * 0.06f;
    add_face(mesh, {ia + half + rim, ib + half + rim, ob + half + rim, oa + half + rim}, 1);
    add_face(mesh, {oa - half - rim, ob - half - rim, ib - half - rim, ia - half - rim}, 1);
    add_face(mesh, {ib + half + rim, ia + half + rim, ia - half - rim, ib - half - rim}, 1);
    add_face(mesh, {oa + half + rim, ob + half + rim, ob + half, oa + half}, 1);
    add_face(mesh, {ob - half - rim, oa - half - rim, oa - half, ob - half}, 1);
    add_face(mesh, {oa + half, ob + half, on_wall(b) + half, on_wall(a) + half}, 1);
    add_face(mesh, {on_wall(a) - half, on_wall(b) - half, ob - half, oa - half}, 1);
  }
}

void add_sphere(MeshData& mesh, glm::vec3 center, float radius, int segments) {
  std::vector<glm::vec2> profile;
  for (int i = 0; i <= segments; ++i) {
    const float angle = kTau * 0.5f * (static_cast<float>(i) / static_cast<float>(segments) - 0.5f);
    profile.push_back({radius * std::max(std::cos(angle), 0.0f), radius * std::sin(angle)});
  }
  add_lathe(mesh, center, profile, segments * 2);
}

void add_tube(MeshData& mesh, std::span<const glm::vec3> points, float radius, int sides) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (size_t j = 0; j < points.size(); ++j) {
    const glm::vec3 along = glm::normalize(points[std::min(j + 1, points.size() - 1)] - points[j == 0 ? 0 : j - 1]);
    const glm::vec3 side = glm::normalize(glm::cross(along, std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    const glm::vec3 over = glm::cross(side, along);
    for (int i = 0; i <= sides; ++i) {
      const float angle = kTau * static_cast<float>(i) / static_cast<float>(sides);
      const glm::vec3 n = side * std::cos(angle) - over * std::sin(angle);
      add_vertex(mesh, points[j] + n * radius, n, along, {static_cast<float>(i) * radius, static_cast<float>(j)});
    }
  }
  add_cells(mesh, first, sides, static_cast<int>(points.size()) - 1);
}

namespace {
template <class V>
void bound(Mesh& mesh, std::span<const V> vertices) {
  glm::vec3 low(1e30f), high(-1e30f);
  for (const V& v : vertices) {
    low = glm::min(low, v.position);
    high = glm::max(high, v.position);
  }
  mesh.center = 0.5f * (low + high);
  for (const V& v : vertices) mesh.radius = std::max(mesh.radius, glm::distance(v.position, mesh.center));
}

template <class Data, class V>
uint32_t append(std::vector<Mesh>& meshes, std::vector<V>& vertices, std::vector<uint32_t>& indices, std::string name, const Data& data) {
  Mesh mesh{std::move(name), static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(data.indices.size())};
  bound<V>(mesh, data.vertices);
  const auto base = static_cast<uint32_t>(vertices.size());
  for (const uint32_t index : data.indices) indices.push_back(base + index);
  vertices.insert(vertices.end(), data.vertices.begin(), data.vertices.end());
  meshes.push_back(std::move(mesh));
  return static_cast<uint32_t>(meshes.size() - 1);
}
}  // namespace

uint32_t add_mesh(Scene& scene, std::string name, const MeshData& data) {
  return append(scene.meshes, scene.vertices, scene.indices, std::move(name), data);
}
uint32_t add_prop_mesh(Scene& scene, std::string name, const PropData& data) {
  return append(scene.prop_meshes, scene.prop_vertices, scene.prop_indices, std::move(name), data);
}

void paint(PropData& prop, const MeshData& solid, const PropPaint& paint) {
  const auto base = static_cast<uint32_t>(prop.vertices.size());
  const uint32_t color = pack_unorm({paint.color, 1}), surface = pack_unorm({paint.roughness, paint.metallic, paint.emission / 8, 0});
  for (const Vertex& v : solid.vertices) prop.vertices.push_back({v.position, pack_octahedral(v.normal), color, surface, paint.part, 0});
  for (const uint32_t index : solid.indices) prop.indices.push_back(base + index);
}

uint32_t pack_octahedral(glm::vec3 n) {
  n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  glm::vec2 p(n.x, n.y);
  if (n.z < 0) p = (1.0f - glm::abs(glm::vec2(n.y, n.x))) * glm::vec2(n.x >= 0 ? 1 : -1, n.y >= 0 ? 1 : -1);
  return glm::packUnorm2x16(p * 0.5f + 0.5f);
}
uint32_t pack_unorm(glm::vec4 color) { return glm::packUnorm4x8(color); }

}  // namespace rg::demo
