#include "examples/demo/gltf_materials.h"

#include <algorithm>
#include <cmath>

namespace rg::demo {
namespace {

struct Picture {
  int width = 0, height = 0, channels = 0;
  const unsigned char* texels = nullptr;
};

// The image behind a texture reference; nothing where there is none.
Picture find_picture(const tinygltf::Model& model, int texture, int uv_set, const std::string& user) {
  if (texture < 0) return {};
  if (uv_set != 0) throw GltfError(user + ": uses texture coordinates " + std::to_string(uv_set) + ", only set 0 is supported");
  const int source = element(model.textures, texture, "texture", user).source;
  const tinygltf::Image& image = element(model.images, source, "image", "texture " + std::to_string(texture));
  if (image.width <= 0 || image.height <= 0 || image.component < 1 || image.bits != 8 || image.image.empty())
    fail("image", source, (image.uri.empty() ? std::string("embedded data") : "`" + image.uri + "`") + " is missing or cannot be decoded");
  const size_t needed = static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * static_cast<size_t>(image.component);
  if (image.image.size() < needed) fail("image", source, "has fewer bytes than its size needs");
  return {image.width, image.height, image.component, image.image.data()};
}

uint8_t fetch(const Picture& p, int x, int y, int channel) {
  if (channel >= p.channels) return p.channels == 1 ? p.texels[y * p.width + x] : 255;
  return p.texels[(static_cast<size_t>(y) * static_cast<size_t>(p.width) + static_cast<size_t>(x)) * static_cast<size_t>(p.channels) +
                  static_cast<size_t>(channel)];
}

// The mean of the source texels under a texel of the layer.
uint8_t resample(const Picture& p, uint32_t x, uint32_t y, int channel) {
  const auto edge = [](uint32_t i, int size) { return static_cast<int>(static_cast<uint64_t>(i) * static_cast<uint64_t>(size) / kTextureSize); };
  const int x0 = edge(x, p.width), x1 = std::max(edge(x + 1, p.width), x0 + 1), y0 = edge(y, p.height), y1 = std::max(edge(y + 1, p.height), y0 + 1);
  uint32_t sum = 0;
  for (int j = y0; j < y1; ++j)
    for (int i = x0; i < x1; ++i) sum += fetch(p, i, j, channel);
  const auto count = static_cast<uint32_t>((x1 - x0) * (y1 - y0));
  return static_cast<uint8_t>((sum + count / 2) / count);
}

constexpr size_t kLayerBytes = size_t{kTextureSize} * kTextureSize * 4;

TextureLayer flat_layer() {
  TextureLayer layer{std::vector<uint8_t>(kLayerBytes, 255), std::vector<uint8_t>(kLayerBytes, 255)};
  for (size_t i = 0; i < kLayerBytes; i += 4) layer.surface[i] = layer.surface[i + 1] = 128;
  return layer;
}

void fill(std::vector<uint8_t>& texels, const Picture& picture, std::initializer_list<std::pair<int, int>> channels) {
  if (picture.texels == nullptr) return;
  for (uint32_t i = 0; i < kTextureSize * kTextureSize; ++i)
    for (const auto& [from, to] : channels) texels[i * 4 + static_cast<size_t>(to)] = resample(picture, i % kTextureSize, i / kTextureSize, from);
}

uint32_t add_layer(const Picture& base, const Picture& normal, const Picture& metal_rough, Scene& scene) {
  const bool plain = base.texels == nullptr && normal.texels == nullptr && metal_rough.texels == nullptr;
  if (plain || scene.textures.size() >= kTextureLayers) return 0;
  TextureLayer layer = flat_layer();
  fill(layer.albedo, base, {{0, 0}, {1, 1}, {2, 2}});
  fill(layer.surface, normal, {{0, 0}, {1, 1}});
  fill(layer.surface, metal_rough, {{1, 2}, {2, 3}});
  scene.textures.push_back(std::move(layer));
  return static_cast<uint32_t>(scene.textures.size() - 1);
}

float component(const std::vector<double>& values, size_t i, float otherwise) {
  return i < values.size() ? static_cast<float>(values[i]) : otherwise;
}

float emissive_strength(const tinygltf::Material& material) {
  const auto found = material.extensions.find("KHR_materials_emissive_strength");
  if (found == material.extensions.end() || !found->second.Has("emissiveStrength")) return 1;
  return static_cast<float>(found->second.Get("emissiveStrength").GetNumberAsDouble());
}

Material convert(const tinygltf::Model& model, const tinygltf::Material& from, const std::string& user, Scene& scene) {
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  const Picture base = find_picture(model, pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord, user);
  const Picture normal = find_picture(model, from.normalTexture.index, from.normalTexture.texCoord, user);
  const Picture metal_rough = find_picture(model, pbr.metallicRoughnessTexture.index, pbr.metallicRoughnessTexture.texCoord, user);
  Material to;
  to.name = from.name.empty() ? user : from.name;
  for (int i = 0; i < 4; ++i) to.base_color[i] = component(pbr.baseColorFactor, static_cast<size_t>(i), 1);
  for (int i = 0; i < 3; ++i) to.emissive[i] = component(from.emissiveFactor, static_cast<size_t>(i), 0) * emissive_strength(from);
  to.roughness = static_cast<float>(pbr.roughnessFactor);
  to.metallic = static_cast<float>(pbr.metallicFactor);
  to.bump = normal.texels != nullptr ? static_cast<float>(from.normalTexture.scale) : 0;
  to.albedo_layer = to.surface_layer = add_layer(base, normal, metal_rough, scene);
  if (from.alphaMode == "BLEND") to.metallic = 0.6f;  // the share of the sky that glass mirrors
  return to;
}

}  // namespace

void convert_materials(const tinygltf::Model& model, Scene& scene) {
  scene.textures.push_back(flat_layer());
  for (size_t i = 0; i < model.materials.size(); ++i)
    scene.materials.push_back(convert(model, model.materials[i], "material " + std::to_string(i), scene));
  Material plain;
  plain.name = "default";
  plain.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1);
  plain.roughness = 0.7f;
  plain.bump = 0;
  scene.materials.push_back(plain);
}

bool is_blended(const tinygltf::Model& model, int material) {
  return material >= 0 && static_cast<size_t>(material) < model.materials.size() &&
         model.materials[static_cast<size_t>(material)].alphaMode == "BLEND";
}

}  // namespace rg::demo
