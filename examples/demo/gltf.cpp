#include "examples/demo/gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <set>

#include "examples/demo/gltf_materials.h"
#include "examples/demo/gltf_outline.h"
#include "examples/demo/gltf_read.h"
#include "examples/demo/mesh_builder.h"

namespace rg::demo {
namespace {

constexpr size_t kMaxInstances = 1024, kMaxLights = 512, kMaxDepth = 256;
constexpr size_t kMaxVertices = size_t{1} << 22;  // a storage buffer of 192 MiB

// Which scene mesh a primitive became, and with what material.
struct Part {
  uint32_t mesh = 0;
  int material = -1;
};
using MeshParts = std::vector<std::vector<Part>>;  // by glTF mesh

std::vector<uint32_t> triangles(const tinygltf::Primitive& primitive, std::vector<uint32_t> list) {
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1) {
    list.resize(list.size() / 3 * 3);
    return list;
  }
  std::vector<uint32_t> out;
  const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
  for (size_t i = 2; i < list.size(); ++i) {
    if (fan)
      out.insert(out.end(), {list[0], list[i - 1], list[i]});
    else if (i % 2 == 0)
      out.insert(out.end(), {list[i - 2], list[i - 1], list[i]});
    else
      out.insert(out.end(), {list[i - 1], list[i - 2], list[i]});
  }
  return out;
}

// Each corner its own vertex, with the triangle's normal.
void make_flat(MeshData& data) {
  MeshData flat;
  for (size_t i = 0; i + 2 < data.indices.size(); i += 3) {
    std::array<Vertex, 3> corner;
    for (size_t k = 0; k < 3; ++k) corner[k] = data.vertices[data.indices[i + k]];
    const glm::vec3 n = glm::cross(corner[1].position - corner[0].position, corner[2].position - corner[0].position);
    const float length = glm::length(n);
    for (Vertex& v : corner) {
      v.normal = length > 0 ? n / length : glm::vec3(0, 1, 0);
      flat.indices.push_back(static_cast<uint32_t>(flat.vertices.size()));
      flat.vertices.push_back(v);
    }
  }
  data = std::move(flat);
}

// Along growing u, averaged over the triangles of a vertex.
void make_tangents(MeshData& data) {
  std::vector<glm::vec3> sum(data.vertices.size(), glm::vec3(0)), across = sum;
  for (size_t i = 0; i + 2 < data.indices.size(); i += 3) {
    const Vertex &a = data.vertices[data.indices[i]], &b = data.vertices[data.indices[i + 1]], &c = data.vertices[data.indices[i + 2]];
    const glm::vec3 e = b.position - a.position, f = c.position - a.position;
    const float du = b.u - a.u, dv = b.v - a.v, eu = c.u - a.u, ev = c.v - a.v, determinant = du * ev - eu * dv;
    if (std::abs(determinant) < 1e-20f) continue;
    for (size_t k = 0; k < 3; ++k) {
      sum[data.indices[i + k]] += (e * ev - f * dv) / determinant;
      across[data.indices[i + k]] += (f * du - e * eu) / determinant;
    }
  }
  for (size_t i = 0; i < data.vertices.size(); ++i) {
    Vertex& v = data.vertices[i];
    glm::vec3 t = sum[i] - v.normal * glm::dot(v.normal, sum[i]);
    if (!(glm::length(t) > 1e-12f)) t = glm::cross(v.normal, std::abs(v.normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
    v.tangent = glm::vec4(glm::normalize(t), glm::dot(glm::cross(v.normal, t), across[i]) < 0 ? -1 : 1);
  }
}

std::vector<float> read_attribute(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const char* name, int columns, size_t count,
                                  const std::string& user) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) return {};
  std::vector<float> values = read_floats(model, found->second, columns, user + " " + name);
  if (values.size() != count * static_cast<size_t>(columns))
    throw GltfError(user + ": " + name + " has " + std::to_string(values.size() / static_cast<size_t>(columns)) + " elements for " +
                    std::to_string(count) + " positions");
  return values;
}

glm::vec3 row3(const std::vector<float>& values, size_t i) { return {values[3 * i], values[3 * i + 1], values[3 * i + 2]}; }

MeshData read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::string& user) {
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) throw GltfError(user + ": has no positions");
  const std::vector<float> positions = read_floats(model, position->second, 3, user + " POSITION");
  const size_t count = positions.size() / 3;
  const std::vector<float> normals = read_attribute(model, primitive, "NORMAL", 3, count, user),
                           uvs = read_attribute(model, primitive, "TEXCOORD_0", 2, count, user);
  const std::vector<float> tangents = read_attribute(model, primitive, "TANGENT", 4, count, user);
  MeshData data;
  data.vertices.resize(count);
  for (size_t i = 0; i < count; ++i) {
    Vertex& v = data.vertices[i];
    v.position = row3(positions, i);
    if (!normals.empty()) v.normal = glm::length(row3(normals, i)) > 1e-6f ? glm::normalize(row3(normals, i)) : glm::vec3(0, 1, 0);
    if (!uvs.empty()) std::tie(v.u, v.v) = std::pair(uvs[2 * i], uvs[2 * i + 1]);
    if (!tangents.empty()) v.tangent = {tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2], tangents[4 * i + 3] < 0 ? -1 : 1};
  }
  std::vector<uint32_t> indices;
  if (primitive.indices >= 0)
    indices = read_indices(model, primitive.indices, count, user);
  else
    for (uint32_t i = 0; i < count; ++i) indices.push_back(i);
  data.indices = triangles(primitive, std::move(indices));
  if (normals.empty()) make_flat(data);
  if (tangents.empty() || normals.empty()) make_tangents(data);
  return data;
}

bool is_drawable(const tinygltf::Primitive& primitive) { return primitive.mode >= TINYGLTF_MODE_TRIANGLES || primitive.mode == -1; }

MeshParts convert_meshes(const tinygltf::Model& model, Scene& scene) {
  MeshParts parts(model.meshes.size());
  for (size_t m = 0; m < model.meshes.size(); ++m) {
    const tinygltf::Mesh& mesh = model.meshes[m];
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = mesh.primitives[p];
      const std::string user = "mesh " + std::to_string(m) + " primitive " + std::to_string(p);
      if (primitive.material >= 0) element(model.materials, primitive.material, "material", user);
      if (!is_drawable(primitive)) continue;  // points and lines
      MeshData data = read_primitive(model, primitive, user);
      if (data.indices.empty()) continue;
      if (scene.vertices.size() + data.vertices.size() > kMaxVertices)
        throw GltfError(user + ": more than " + std::to_string(kMaxVertices) + " vertices in all");
      parts[m].push_back({add_mesh(scene, mesh.name.empty() ? user : mesh.name, data), primitive.material});
    }
  }
  return parts;
}

glm::mat4 local_transform(const tinygltf::Node& node) {
  glm::mat4 m(1);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<float>(node.matrix[static_cast<size_t>(i)]);
    return m;
  }
  const auto vector = [](const std::vector<double>& v) { return glm::vec3(v[0], v[1], v[2]); };
  if (node.translation.size() == 3) m = glm::translate(m, vector(node.translation));
  if (node.rotation.size() == 4) {
    const auto& r = node.rotation;
    m *= glm::mat4_cast(
        glm::normalize(glm::quat(static_cast<float>(r[3]), static_cast<float>(r[0]), static_cast<float>(r[1]), static_cast<float>(r[2]))));
  }
  return node.scale.size() == 3 ? glm::scale(m, vector(node.scale)) : m;
}

void add_camera(const tinygltf::Camera& camera, const glm::mat4& transform, Scene& scene) {
  if (camera.type != "perspective") return;
  const glm::vec3 eye = transform[3], forward = -glm::normalize(glm::vec3(transform[2]));
  scene.cameras.push_back({camera.name.empty() ? "camera" + std::to_string(scene.cameras.size()) : camera.name, eye, eye + forward,
                           std::clamp(static_cast<float>(camera.perspective.yfov), 0.1f, 2.5f), 0});
}

void add_light(const tinygltf::Light& from, const glm::mat4& transform, Scene& scene) {
  const glm::vec3 color(from.color.size() == 3 ? glm::vec3(from.color[0], from.color[1], from.color[2]) : glm::vec3(1));
  const glm::vec3 forward = -glm::normalize(glm::vec3(transform[2]));
  if (from.type == "directional") {
    scene.sun.direction = -forward;
    scene.sun.color = color * static_cast<float>(from.intensity);
    return;
  }
  if (scene.lights.size() >= kMaxLights) throw GltfError("light " + from.name + ": more than " + std::to_string(kMaxLights) + " lights");
  Light light;
  light.position = transform[3];
  light.color = color * static_cast<float>(from.intensity);
  light.range = from.range > 0 ? static_cast<float>(from.range) : std::sqrt(std::max({light.color.r, light.color.g, light.color.b}) / 0.01f);
  if (from.type == "spot") light.features = lamp::round;
  light.direction = forward;
  light.outer = std::clamp(static_cast<float>(from.spot.outerConeAngle), 0.02f, 1.5f);
  light.inner = std::clamp(static_cast<float>(from.spot.innerConeAngle), 0.0f, light.outer - 0.01f);
  scene.lights.push_back(light);
}

struct Walk {
  const tinygltf::Model& model;
  const MeshParts& parts;
  Scene& scene;
  std::set<int> above;  // nodes between the root and here
};

void add_instances(Walk& walk, const tinygltf::Node& node, const std::string& user, const glm::mat4& transform) {
  if (node.mesh < 0) return;
  element(walk.model.meshes, node.mesh, "mesh", user);
  for (const Part& part : walk.parts[static_cast<size_t>(node.mesh)]) {
    if (walk.scene.instances.size() >= kMaxInstances) throw GltfError(user + ": more than " + std::to_string(kMaxInstances) + " primitives to draw");
    Instance instance;
    instance.mesh = part.mesh;
    instance.material = part.material >= 0 ? static_cast<uint32_t>(part.material) : static_cast<uint32_t>(walk.scene.materials.size() - 1);
    instance.transform = transform;
    instance.glass = is_blended(walk.model, part.material);
    instance.casts_shadow = !instance.glass;
    walk.scene.instances.push_back(instance);
  }
}

int light_of(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_lights_punctual");
  return found != node.extensions.end() && found->second.Has("light") ? found->second.Get("light").GetNumberAsInt() : -1;
}

void visit(Walk& walk, int index, const glm::mat4& parent, const std::string& user) {
  const tinygltf::Node& node = element(walk.model.nodes, index, "node", user);
  const std::string self = "node " + std::to_string(index);
  if (!walk.above.insert(index).second) throw GltfError(self + ": is its own ancestor");
  if (walk.above.size() > kMaxDepth) throw GltfError(self + ": nodes are nested more than " + std::to_string(kMaxDepth) + " deep");
  const glm::mat4 transform = parent * local_transform(node);
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(transform[i / 4][i % 4])) throw GltfError(self + ": its transform is not finite");
  add_instances(walk, node, self, transform);
  if (node.camera >= 0) add_camera(element(walk.model.cameras, node.camera, "camera", self), transform, walk.scene);
  if (const int light = light_of(node); light >= 0) add_light(element(walk.model.lights, light, "light", self), transform, walk.scene);
  for (const int child : node.children) visit(walk, child, transform, self);
  walk.above.erase(index);
}

void walk_nodes(const tinygltf::Model& model, const MeshParts& parts, Scene& scene) {
  Walk walk{model, parts, scene, {}};
  if (model.scenes.empty()) {  // the format allows it: every node that is nobody's child
    std::set<int> children;
    for (const tinygltf::Node& node : model.nodes) children.insert(node.children.begin(), node.children.end());
    for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i)
      if (!children.contains(i)) visit(walk, i, glm::mat4(1), "scene");
    return;
  }
  const int index = model.defaultScene >= 0 ? model.defaultScene : 0;
  for (const int root : element(model.scenes, index, "scene", "file").nodes) visit(walk, root, glm::mat4(1), "scene " + std::to_string(index));
}

// Into a sphere of six metres that stands on the ground.
void fit(Scene& scene) {
  glm::vec3 low(1e30f), high(-1e30f);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::vec3 center = instance.transform * glm::vec4(mesh.center, 1);
    const float stretch = std::max({glm::length(glm::vec3(instance.transform[0])), glm::length(glm::vec3(instance.transform[1])),
                                    glm::length(glm::vec3(instance.transform[2]))});
    low = glm::min(low, center - stretch * mesh.radius);
    high = glm::max(high, center + stretch * mesh.radius);
  }
  const float radius = std::max(0.5f * glm::length(high - low), 1e-6f), scale = 6 / radius;
  const glm::vec3 middle = 0.5f * (low + high), foot(middle.x, low.y, middle.z);
  const glm::mat4 fitting = glm::translate(glm::scale(glm::mat4(1), glm::vec3(scale)), -foot);
  for (Instance& instance : scene.instances) instance.transform = fitting * instance.transform;
  for (Light& light : scene.lights) {
    light.position = fitting * glm::vec4(light.position, 1);
    light.range *= scale;
    light.color *= scale * scale;
  }
  for (NamedCamera& camera : scene.cameras) {
    camera.eye = fitting * glm::vec4(camera.eye, 1);
    camera.target = fitting * glm::vec4(camera.target, 1);
  }
  const glm::vec3 center = fitting * glm::vec4(middle, 1);
  scene.sun.center = center;
  scene.sun.radius = 8;
  const NamedCamera views[] = {{"front", center + glm::vec3(4.5f, 3.0f, 8.5f), center, 0.9f, 0},
                               {"side", center + glm::vec3(-9.0f, 2.0f, 2.5f), center, 0.9f, 0},
                               {"above", center + glm::vec3(2, 11, 4), center, 0.9f, 0}};
  scene.cameras.insert(scene.cameras.end(), std::begin(views), std::end(views));
}

void light_by_default(Scene& scene) {
  scene.sun.direction = glm::normalize(glm::vec3(0.45f, 0.75f, 0.5f));
  scene.sun.color = glm::vec3(2.6f, 2.4f, 2.1f);
  scene.sun.ambient = {0.13f, 0.165f, 0.23f};
}
void add_lamps(Scene& scene) {
  if (!scene.lights.empty()) return;
  for (int i = 0; i < 24; ++i) {
    const float angle = 0.2617994f * static_cast<float>(i);
    Light light;
    light.position = scene.sun.center + glm::vec3(5.5f * std::cos(angle), -2.0f + 0.35f * static_cast<float>(i % 12), 5.5f * std::sin(angle));
    light.range = 6;
    light.color = glm::mix(glm::vec3(1.0f, 0.5f, 0.2f), glm::vec3(0.2f, 0.5f, 1.0f), 0.5f + 0.5f * std::sin(angle)) * 2.5f;
    scene.lights.push_back(light);
  }
}

bool decode_image(tinygltf::Image* image, const int index, std::string*, std::string* warning, int width, int height, const unsigned char* bytes,
                  int size, void* user) {
  std::string error;  // a broken image is an error only if a material uses it
  if (!tinygltf::LoadImageData(image, index, &error, warning, width, height, bytes, size, user)) image->image.clear();
  return true;
}

std::string first_line(std::string text) {
  text.erase(0, text.find_first_not_of(" \n\t"));
  text = text.substr(0, text.find('\n'));
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

tinygltf::Model parse(const std::filesystem::path& path) {
  check_outline(path);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(decode_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  char magic[4] = {};
  std::ifstream(path, std::ios::binary).read(magic, 4);
  const bool binary = std::string_view(magic, 4) == "glTF";
  const bool good =
      binary ? loader.LoadBinaryFromFile(&model, &error, &warning, path.string()) : loader.LoadASCIIFromFile(&model, &error, &warning, path.string());
  if (!good) throw GltfError("file: " + (error.empty() ? "is no glTF 2.0" : first_line(error)));
  return model;
}

Scene convert(const std::filesystem::path& path) {
  const tinygltf::Model model = parse(path);
  Scene scene;
  scene.name = path.stem().string();
  light_by_default(scene);
  convert_materials(model, scene);
  const MeshParts parts = convert_meshes(model, scene);
  walk_nodes(model, parts, scene);
  if (scene.instances.empty()) throw GltfError("file: no node of its scene draws a triangle");
  fit(scene);
  add_lamps(scene);
  return scene;
}

}  // namespace

Result<Scene> load_gltf(const std::filesystem::path& path) {
  std::error_code failure;
  const auto report = [&](const std::string& reason) { return Error{ErrorCode::io, "`" + path.string() + "`: " + reason}; };
  if (!std::filesystem::is_regular_file(path, failure)) return report(failure ? failure.message() : "is not a file");
  if (!std::ifstream(path)) return report("cannot be opened for reading");
  try {
    return convert(path);
  } catch (const std::exception& problem) {  // tinygltf and its JSON parser throw as well
    return report(first_line(problem.what()));
  }
}

}  // namespace rg::demo
