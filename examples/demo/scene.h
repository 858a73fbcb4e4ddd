// A world to render, as plain data: what `plaza` generates and what a glTF file loads to.
// Metres, y up, right-handed; colours linear. Every index is valid by construction.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace rg::demo {

struct Vertex {  // layout 1, as passes/scene/scene.rg has it
  glm::vec3 position{0};
  float u = 0;
  glm::vec3 normal{0, 1, 0};
  float v = 0;
  glm::vec4 tangent{1, 0, 0, 1};  // w: handedness times the share of the sky that is seen, never 0
};
struct PropVertex {  // layout 2
  glm::vec3 position{0};
  uint32_t normal = 0, color = 0, surface = 0, part = 0, spare = 0;
};
static_assert(sizeof(Vertex) == 48 && sizeof(PropVertex) == 32);

struct Material {
  std::string name;
  glm::vec4 base_color{1};
  glm::vec3 emissive{0};
  float roughness = 1, metallic = 0, bump = 1;
  uint32_t albedo_layer = 0, surface_layer = 0;
};

// How something moves with time; everything is a function of time alone.
enum class Motion : uint8_t { still, tumble, swing, drift };
struct Animation {
  Motion motion = Motion::still;
  float amount = 0;  // tumble: turns a second about x; swing: radians; drift: metres
  float rate = 0;    // cycles a second
  float phase = 0;   // cycles
};

struct Mesh {
  std::string name;
  uint32_t first_index = 0, index_count = 0;  // indices are absolute
  glm::vec3 center{0};                        // bounding sphere, of the mesh's own space
  float radius = 0;
};
struct Instance {
  uint32_t mesh = 0, material = 0;
  glm::mat4 transform{1};
  Animation animation;
  bool casts_shadow = true, glass = false;
};
struct Prop {
  uint32_t mesh = 0;  // of Scene::prop_meshes
  glm::mat4 transform{1};
  glm::vec3 tint{1};
  float sky = 1;  // share of the sky that is seen
  Animation animation;
};
namespace lamp {
enum : uint32_t { round = 1, square = 2, shadow = 4, soft = 8, projected = 16, area = 32, tube = 64, dark = 128, clipped = 256 };
}
struct Light {
  glm::vec3 position{0};
  float range = 1;
  glm::vec3 color{1};     // radiant intensity; of an area, radiance where its picture is white
  uint32_t features = 0;  // lamp::
  glm::vec3 direction{0, -1, 0};
  glm::vec3 side{1, 0, 0};           // roughly across the direction; tubes lie along it exactly
  float inner = 0.4f, outer = 0.6f;  // half angles, radians, below 90 degrees; of a square spot, to the middles of its sides
  glm::vec2 size{0};                 // half length and radius of a tube, half sides of an area, radius of a soft lamp, metres
  uint32_t picture = 0;              // texture layer
  glm::vec4 clip[2] = {{0, 0, 0, 1}, {0, 0, 0, 1}};
  Animation animation;
};
constexpr uint32_t kMaxLampShadows = 8;  // later lamps of a scene go without

// A box with fog of its own, masked by a texture that is seen along its y axis.
struct FogBox {
  glm::mat4 transform{1};  // of the box -1 .. 1
  float density = 0.1f;    // extinction in its middle, 1 / metre
  float edge = 0.5f;       // share of the half side over which it fades
  uint32_t layer = 0;
  float repeats = 1;
  glm::vec2 scroll{0};  // repeats a second
};
struct Fog {
  float density = 0;                  // extinction at and below `ground`, 1 / metre
  float ground = 0, thinning = 0.2f;  // metres; 1 / metre
  float phase = 0;                    // mean cosine of sunlight's deflection
  glm::vec3 albedo{0.95f};
  std::vector<FogBox> boxes;  // at most 32
};
struct NamedCamera {
  std::string name;
  glm::vec3 eye{0, 2, 10}, target{0};
  float field_of_view = 1.0f;  // vertical, radians
  float exposure_bias = 0;     // stops
  float fog_reach = 64;        // metres that the fog's volume covers
};
struct Sun {
  glm::vec3 direction{0, 1, 0};  // towards it
  glm::vec3 color{1}, ambient{0.2f};
  glm::vec3 center{0};  // of what casts and receives shadows
  float radius = 20;
};

constexpr uint32_t kTextureSize = 256, kTextureLayers = 32, kTextureMips = 9;
struct TextureLayer {            // rgba8, kTextureSize squared, mip 0
  std::vector<uint8_t> albedo;   // sRGB
  std::vector<uint8_t> surface;  // normal xy, roughness, metallic
};

struct Scene {
  std::string name;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<Mesh> meshes;
  std::vector<PropVertex> prop_vertices;
  std::vector<uint32_t> prop_indices;
  std::vector<Mesh> prop_meshes;
  std::vector<Material> materials;
  std::vector<TextureLayer> textures;  // at most kTextureLayers; layer 0 is white and flat
  std::vector<Instance> instances;     // at most 1024
  std::vector<Prop> props;
  std::vector<Light> lights;         // at most 512
  std::vector<NamedCamera> cameras;  // the first is the default
  Sun sun;
  Fog fog;
  bool has_hologram = false;
  glm::vec3 hologram_center{0};
};

}  // namespace rg::demo
