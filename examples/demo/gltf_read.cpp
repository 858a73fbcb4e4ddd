#include "examples/demo/gltf_read.h"

#include <cmath>
#include <cstring>

namespace rg::demo {
namespace {

// Bytes of an accessor: `count` elements of `element_bytes`, `stride` apart.
struct Elements {
  const unsigned char* data = nullptr;
  size_t count = 0, stride = 0;
  int component_type = 0, components = 0;
  bool normalized = false;
};

std::string named(const char* object, int index) { return std::string(object) + " " + std::to_string(index); }

const tinygltf::BufferView& checked_view(const tinygltf::Model& model, int index, const std::string& user) {
  const tinygltf::BufferView& view = element(model.bufferViews, index, "buffer view", user);
  const tinygltf::Buffer& buffer = element(model.buffers, view.buffer, "buffer", named("buffer view", index));
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
    fail("buffer view", index,
         "bytes " + std::to_string(view.byteOffset) + " to " + std::to_string(view.byteOffset + view.byteLength) + " exceed buffer " +
             std::to_string(view.buffer) + " of " + std::to_string(buffer.data.size()) + " bytes");
  return view;
}

Elements open_accessor(const tinygltf::Model& model, int index, const std::string& user) {
  const tinygltf::Accessor& accessor = element(model.accessors, index, "accessor", user);
  if (accessor.sparse.isSparse) fail("accessor", index, "is sparse, which is not supported");
  const int component_bytes = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType));
  const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
  if (component_bytes <= 0 || components <= 0) fail("accessor", index, "has an unknown type");
  if (accessor.count == 0) fail("accessor", index, "is empty");
  const tinygltf::BufferView& view = checked_view(model, accessor.bufferView, named("accessor", index));
  const size_t size = static_cast<size_t>(component_bytes) * static_cast<size_t>(components);
  const size_t stride = view.byteStride != 0 ? view.byteStride : size;
  if (stride < size)
    fail("accessor", index, "its elements of " + std::to_string(size) + " bytes are wider than the stride of " + std::to_string(stride));
  const size_t room = view.byteLength;
  const bool fits =
      accessor.byteOffset <= room && size <= room - accessor.byteOffset && (accessor.count - 1) <= (room - accessor.byteOffset - size) / stride;
  if (!fits)
    fail("accessor", index,
         std::to_string(accessor.count) + " elements from byte " + std::to_string(accessor.byteOffset) + " on do not fit buffer view " +
             std::to_string(accessor.bufferView) + " of " + std::to_string(room) + " bytes");
  const tinygltf::Buffer& buffer = model.buffers[static_cast<size_t>(view.buffer)];
  return {
      buffer.data.data() + view.byteOffset + accessor.byteOffset, accessor.count, stride, accessor.componentType, components, accessor.normalized};
}

template <class T>
T load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

float read_component(const unsigned char* at, int type, int index) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return load<float>(at + 4 * index);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return static_cast<float>(at[index]) / 255.0f;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return static_cast<float>(load<uint16_t>(at + 2 * index)) / 65535.0f;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return std::max(static_cast<float>(static_cast<int8_t>(at[index])) / 127.0f, -1.0f);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return std::max(static_cast<float>(load<int16_t>(at + 2 * index)) / 32767.0f, -1.0f);
    default:
      return 0;
  }
}

uint32_t read_index(const unsigned char* at, int type) {
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return load<uint32_t>(at);
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? load<uint16_t>(at) : *at;
}

}  // namespace

void fail(const std::string& object, int index, const std::string& reason) { throw GltfError(object + " " + std::to_string(index) + ": " + reason); }

std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int columns, const std::string& user) {
  const Elements elements = open_accessor(model, accessor, user);
  if (elements.components != columns)
    fail("accessor", accessor, "has " + std::to_string(elements.components) + " components where " + user + " needs " + std::to_string(columns));
  const bool integer = elements.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (integer && !elements.normalized) fail("accessor", accessor, "holds integers that are not normalised, where " + user + " needs floats");
  std::vector<float> out;
  out.reserve(elements.count * static_cast<size_t>(columns));
  for (size_t i = 0; i < elements.count; ++i) {
    for (int c = 0; c < columns; ++c) {
      const float value = read_component(elements.data + i * elements.stride, elements.component_type, c);
      if (!std::isfinite(value)) fail("accessor", accessor, "element " + std::to_string(i) + " is not a finite number");
      out.push_back(value);
    }
  }
  return out;
}

std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor, size_t limit, const std::string& user) {
  const Elements elements = open_accessor(model, accessor, user);
  const int type = elements.component_type;
  const bool known =
      type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  if (!known || elements.components != 1) fail("accessor", accessor, "cannot hold the indices of " + user);
  std::vector<uint32_t> out(elements.count);
  for (size_t i = 0; i < elements.count; ++i) {
    out[i] = read_index(elements.data + i * elements.stride, type);
    if (out[i] >= limit)
      fail(
          "accessor", accessor,
          "index " + std::to_string(out[i]) + " at position " + std::to_string(i) + " exceeds the " + std::to_string(limit) + " vertices of " + user);
  }
  return out;
}

}  // namespace rg::demo
