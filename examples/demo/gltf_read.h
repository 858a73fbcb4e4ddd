// Checked access to what tinygltf parsed.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace rg::demo {

// Thrown inside the loader only; load_gltf() turns it into an Error. `what()` is "object: reason".
struct GltfError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
[[noreturn]] void fail(const std::string& object, int index, const std::string& reason);

// The element of a glTF array, or an error that names who refers to it.
template <class T>
const T& element(const std::vector<T>& array, int index, const char* kind, const std::string& user) {
  if (index < 0 || static_cast<size_t>(index) >= array.size())
    throw GltfError(user + ": refers to " + kind + " " + std::to_string(index) + ", but there are " + std::to_string(array.size()));
  return array[static_cast<size_t>(index)];
}

// All elements of an accessor as floats (normalised integers converted), `columns` to a row. Checks every range on the way to the bytes.
std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int columns, const std::string& user);
// Indices, each below `limit`.
std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor, size_t limit, const std::string& user);

}  // namespace rg::demo
