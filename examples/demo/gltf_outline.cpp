#include "examples/demo/gltf_outline.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "examples/demo/gltf_read.h"

namespace rg::demo {
namespace {

using nlohmann::json;

uint32_t word(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  if (at + 4 <= bytes.size()) std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

// A binary file is a 12 byte header, then chunks of {length, type, bytes}; the first is the JSON.
std::string json_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (bytes.compare(0, 4, "glTF") != 0) return bytes;
  const uint32_t length = word(bytes, 12);
  if (bytes.size() < 20 || length > bytes.size() - 20) throw GltfError("file: its JSON chunk is cut off");
  return bytes.substr(20, length);
}

// Singular of each array that something may refer to.
struct Kind {
  const char *array, *name;
};
constexpr Kind kKinds[] = {{"buffers", "buffer"},   {"bufferViews", "buffer view"}, {"accessors", "accessor"}, {"images", "image"},
                           {"textures", "texture"}, {"materials", "material"},      {"meshes", "mesh"},        {"nodes", "node"}};

size_t count(const json& root, const char* array) { return root.contains(array) && root[array].is_array() ? root[array].size() : 0; }

void check_reference(const json& root, const json& object, const std::string& self, const char* key, const char* array, const char* kind) {
  if (!object.contains(key)) return;
  const json& value = object[key];
  if (!value.is_number_integer() || value.get<int64_t>() < 0 || value.get<uint64_t>() >= count(root, array))
    throw GltfError(self + ": refers to " + kind + " " + value.dump() + ", but there are " + std::to_string(count(root, array)));
}

void check_size(const json& object, const std::string& self, const char* key) {
  if (!object.contains(key)) return;
  const json& value = object[key];
  const bool fits = value.is_number_integer() && (value.is_number_unsigned() ? value.get<uint64_t>() <= UINT32_MAX : value.get<int64_t>() >= 0);
  if (!fits) throw GltfError(self + ": its `" + key + "` of " + value.dump() + " is not a size");
}

void check_object(const json& root, const json& object, const std::string& self) {
  if (!object.is_object()) throw GltfError(self + ": is not an object");
  for (const char* key : {"byteLength", "byteOffset", "count"}) check_size(object, self, key);
  check_reference(root, object, self, "bufferView", "bufferViews", "buffer view");
  if (object.contains("byteLength") && object.contains("buffer")) check_reference(root, object, self, "buffer", "buffers", "buffer");
}

void check_primitives(const json& root, const json& mesh, const std::string& self) {
  if (!mesh.contains("primitives") || !mesh["primitives"].is_array()) throw GltfError(self + ": has no primitives");
  size_t number = 0;
  for (const json& primitive : mesh["primitives"]) {
    const std::string name = self + " primitive " + std::to_string(number++);
    if (!primitive.is_object()) throw GltfError(name + ": is not an object");
    check_reference(root, primitive, name, "indices", "accessors", "accessor");
    check_reference(root, primitive, name, "material", "materials", "material");
    if (!primitive.contains("attributes") || !primitive["attributes"].is_object()) continue;
    for (const auto& [key, value] : primitive["attributes"].items())
      check_reference(root, primitive["attributes"], name, key.c_str(), "accessors", "accessor");
  }
}

void check_buffer_file(const json& buffer, const std::string& self, const std::filesystem::path& folder) {
  if (!buffer.contains("uri") || !buffer["uri"].is_string()) return;
  const std::string uri = buffer["uri"];
  if (uri.rfind("data:", 0) == 0 || uri.find('%') != std::string::npos) return;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder / uri, ignored)) throw GltfError(self + ": its file `" + uri + "` is missing");
}

void check_extensions(const json& root) {
  static const std::set<std::string> known = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit",
                                              "KHR_materials_specular", "KHR_materials_ior"};
  if (!root.contains("extensionsRequired") || !root["extensionsRequired"].is_array()) return;
  for (const json& extension : root["extensionsRequired"])
    if (!extension.is_string() || !known.contains(extension.get<std::string>()))
      throw GltfError("file: requires the extension " + extension.dump() + ", which is not supported; export the scene without it");
}

}  // namespace

void check_outline(const std::filesystem::path& path) {
  const json root = json::parse(json_text(path), nullptr, false);
  if (root.is_discarded() || !root.is_object()) throw GltfError("file: holds no glTF, neither JSON nor binary");
  check_extensions(root);
  for (const Kind& kind : kKinds) {
    if (root.contains(kind.array) && !root[kind.array].is_array()) throw GltfError(std::string("file: `") + kind.array + "` is not an array");
    for (size_t i = 0; i < count(root, kind.array); ++i) check_object(root, root[kind.array][i], std::string(kind.name) + " " + std::to_string(i));
  }
  for (size_t i = 0; i < count(root, "buffers"); ++i) check_buffer_file(root["buffers"][i], "buffer " + std::to_string(i), path.parent_path());
  for (size_t i = 0; i < count(root, "meshes"); ++i) check_primitives(root, root["meshes"][i], "mesh " + std::to_string(i));
}

}  // namespace rg::demo
