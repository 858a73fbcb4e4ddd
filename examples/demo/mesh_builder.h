// Solids of the plaza: surfaces are appended to one mesh with normals, tangents and texture coordinates in metres.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "examples/demo/scene.h"

namespace rg::demo {

struct MeshData {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
};

// A parallelogram, counter-clockwise from its front: origin, origin + du, origin + du + dv, origin + dv; cut into nu x nv cells.
void add_grid(MeshData& mesh, glm::vec3 origin, glm::vec3 du, glm::vec3 dv, int nu, int nv, float texture_scale = 1);
// Six sides; cells are at most `cell` metres long.
void add_box(MeshData& mesh, glm::vec3 low, glm::vec3 high, float cell = 1, float texture_scale = 1);
// A box whose upper edges are cut off by `bevel`; no bottom.
void add_slab(MeshData& mesh, glm::vec3 low, glm::vec3 high, float bevel, float texture_scale = 1);
// Turned about the vertical axis through `base`; the profile (radius, height) runs upwards, smooth along and around.
void add_lathe(MeshData& mesh, glm::vec3 base, std::span<const glm::vec2> profile, int segments, float flutes = 0);
// Half a ring of depth `depth` along `along`'s normal in the plane, from one springing point to the other: an arch.
struct ArchShape {
  glm::vec3 left, right;                          // springing points
  float thickness = 0.4f, depth = 0.6f, top = 2;  // of the ring; across the plane; height of the wall above the springing line
  int segments = 14;
};
void add_arch(MeshData& mesh, const ArchShape& arch);
void add_sphere(MeshData& mesh, glm::vec3 center, float radius, int segments);
// A tube through the points.
void add_tube(MeshData& mesh, std::span<const glm::vec3> points, float radius, int sides);

// Appends to the scene and returns the index of the new mesh.
uint32_t add_mesh(Scene& scene, std::string name, const MeshData& data);

struct PropPaint {
  glm::vec3 color{0.5f};
  float roughness = 0.6f, metallic = 0, emission = 0;
  uint32_t part = 0;
};
struct PropData {
  std::vector<PropVertex> vertices;
  std::vector<uint32_t> indices;
};
// The same solid in the compact layout.
void paint(PropData& prop, const MeshData& solid, const PropPaint& paint);
uint32_t add_prop_mesh(Scene& scene, std::string name, const PropData& data);

uint32_t pack_octahedral(glm::vec3 normal);
uint32_t pack_unorm(glm::vec4 color);

}  // namespace rg::demo
