// A small renderer for the tests of the frame: renders prepared frames and hands out what passes left behind.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <vector>

#include "examples/demo/plaza.h"
#include "examples/demo/renderer.h"

namespace rg::test {

using demo::FrameData;
using demo::FrameSettings;
using demo::Scene;

constexpr uint32_t kWidth = 213, kHeight = 117;  // odd on purpose: partial tiles at both edges

Device& device();  // shared by all tests; validates nothing
const Scene& plaza();
Scene make_room(glm::vec3 glow);  // the camera sits in a closed box that does nothing but glow
Scene make_floor();               // a grey floor of 12 x 12 metres below a camera, no lights, no sun

struct Texels {  // of an image, as floats, four to a texel
  int width = 0, height = 0;
  std::vector<glm::vec4> data;
  glm::vec4 at(int x, int y) const { return data[static_cast<size_t>(y * width + x)]; }
};

// Four floats a texel, in the order of the dump; slices and layers one after the other.
std::vector<glm::vec4> decode_texels(const Dump& dump);

Texels texels_of(const Dump& dump);  // of one slice, or all below each other

template <class T>
std::vector<T> values_of(const Dump& dump) {
  std::vector<T> values(dump.bytes.size() / sizeof(T));
  std::memcpy(values.data(), dump.bytes.data(), values.size() * sizeof(T));
  return values;
}

struct DumpOf {
  Index pass, resource;
  uint32_t mip = 0;
};

class Lab {
 public:
  explicit Lab(const Scene& scene, uint32_t width = kWidth, uint32_t height = kHeight);

  // Frame `number` through camera `camera`, standing still but for what `settings` asks.
  FrameData prepare(size_t camera = 0, FrameSettings settings = {.jitter = false, .noise = false, .animate = false}) const;
  void render(const FrameData& data);
  demo::Picture picture();

  // Renders and returns what the pass left in the resource.
  Dump dump(const FrameData& data, Index pass, Index resource, uint32_t mip = 0);
  Texels image(const FrameData& data, Index pass, Index resource, uint32_t mip = 0) { return texels_of(dump(data, pass, resource, mip)); }
  template <class T>
  std::vector<T> buffer(const FrameData& data, Index pass, Index resource) {
    return values_of<T>(dump(data, pass, resource));
  }
  // All of one frame, which costs less than a frame each.
  std::vector<Dump> dumps(const FrameData& data, const std::vector<DumpOf>& what);
  frame::Frame& graph() { return renderer_->graph(); }

 private:
  const Scene& scene_;
  uint32_t width_, height_;
  std::optional<demo::Renderer> renderer_;
};

// One for the plaza, kept: a scene is slow to upload.
Lab& plaza_lab();

// What passes/culling/culling.rg calls TileRecord.
struct Record {
  uint32_t count = 0, overflow = 0, light[64] = {};
};

// The last kernel of spectrum light_features in the frame: behind it, all of `hdr` is shaded.
Index deferred_light();

// Index of the tile of `size` pixels that holds (x, y).
inline size_t tile_of(int x, int y, int size, uint32_t width = kWidth) {
  return static_cast<size_t>(y / size) * ((width + static_cast<uint32_t>(size) - 1) / static_cast<uint32_t>(size)) + static_cast<size_t>(x / size);
}

}  // namespace rg::test
