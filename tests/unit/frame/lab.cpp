#include "tests/unit/frame/lab.h"

#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_precision.hpp>

#include "examples/demo/mesh_builder.h"

namespace rg::test {
namespace {

void add_white(Scene& scene) {
  const size_t bytes = size_t{demo::kTextureSize} * demo::kTextureSize * 4;
  demo::TextureLayer layer{std::vector<uint8_t>(bytes, 255), std::vector<uint8_t>(bytes, 255)};
  for (size_t i = 0; i < bytes; i += 4) layer.surface[i] = layer.surface[i + 1] = 128;
  scene.textures.push_back(std::move(layer));
}

void darken(Scene& scene) {
  scene.sun.color = scene.sun.ambient = glm::vec3(0);
  scene.sun.direction = {0, 1, 0};
}

void add_instance(Scene& scene, const demo::MeshData& mesh, const demo::Material& material) {
  demo::Instance instance;
  instance.mesh = demo::add_mesh(scene, "mesh", mesh);
  instance.material = static_cast<uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  scene.instances.push_back(instance);
}

glm::vec4 decode_packed_float(uint32_t bits) { return glm::vec4(glm::unpackF2x11_1x10(bits), 1); }

// VkFormat numbers of the images that the tests look at.
enum : uint32_t {
  kR8 = 9,
  kRgba8 = 37,
  kR16f = 76,
  kRg16 = 77,
  kRg16f = 83,
  kRgba16f = 97,
  kR32f = 100,
  kRg32f = 103,
  kRgba32f = 109,
  kR11g11b10f = 122,
  kD32f = 126
};

glm::vec4 decode(uint32_t format, const std::byte* at) {
  const auto word = [&](size_t i) {
    uint32_t v;
    std::memcpy(&v, at + 4 * i, 4);
    return v;
  };
  const auto half = [&](size_t i) {
    uint16_t v;
    std::memcpy(&v, at + 2 * i, 2);
    return v;
  };
  const auto number = [&](size_t i) {
    float v;
    std::memcpy(&v, at + 4 * i, 4);
    return v;
  };
  switch (format) {
    case kR8:
      return {static_cast<float>(at[0]) / 255, 0, 0, 1};
    case kRgba8:
      return glm::unpackUnorm4x8(word(0));
    case kR16f:
      return {glm::unpackHalf1x16(half(0)), 0, 0, 1};
    case kRg16:
      return {static_cast<float>(half(0)) / 65535, static_cast<float>(half(1)) / 65535, 0, 1};
    case kRg16f:
      return {glm::unpackHalf2x16(word(0)), 0, 1};
    case kRgba16f:
      return {glm::unpackHalf2x16(word(0)), glm::unpackHalf2x16(word(1))};
    case kRg32f:
      return {number(0), number(1), 0, 1};
    case kR11g11b10f:
      return decode_packed_float(word(0));
    case kRgba32f:
      return {number(0), number(1), number(2), number(3)};
    case kR32f:
    case kD32f:
      return {number(0), 0, 0, 1};
    default:
      ADD_FAILURE() << "no decoder for format " << format;
      return glm::vec4(0);
  }
}

}  // namespace

std::vector<glm::vec4> decode_texels(const Dump& dump) {
  std::vector<glm::vec4> texels;
  for (size_t i = 0; i + dump.bytes_per_texel <= dump.bytes.size() && dump.bytes_per_texel > 0; i += dump.bytes_per_texel)
    texels.push_back(decode(static_cast<uint32_t>(dump.format), dump.bytes.data() + i));
  return texels;
}

Texels texels_of(const Dump& dump) { return {static_cast<int>(dump.width), static_cast<int>(dump.height), decode_texels(dump)}; }

Device& device() {
  static Device device = [] {
    auto made = Device::create({});
    if (!made) {
      ADD_FAILURE() << made.error().message;
      std::abort();
    }
    return std::move(*made);
  }();
  return device;
}

const Scene& plaza() {
  static const Scene scene = demo::make_plaza();
  return scene;
}

Scene make_room(glm::vec3 glow) {
  Scene scene;
  add_white(scene);
  darken(scene);
  demo::MeshData box;
  demo::add_box(box, glm::vec3(-3), glm::vec3(3), 10);
  for (size_t i = 0; i < box.indices.size(); i += 3) std::swap(box.indices[i], box.indices[i + 1]);  // seen from inside
  demo::Material material;
  material.emissive = glow;
  add_instance(scene, box, material);
  scene.cameras.push_back({"inside", {0.3f, 0.2f, 0.1f}, {1, 0.5f, -1}, 1.0f, 0});
  return scene;
}

Scene make_floor() {
  Scene scene;
  add_white(scene);
  darken(scene);
  demo::MeshData floor;
  demo::add_grid(floor, {-6, 0, 6}, {12, 0, 0}, {0, 0, -12}, 8, 8);
  demo::Material material;
  material.base_color = {0.5f, 0.5f, 0.5f, 1};
  material.roughness = 0.6f;
  add_instance(scene, floor, material);
  scene.cameras.push_back({"above", {0, 5, 4}, {0, 0, 0}, 0.9f, 0});
  return scene;
}

Lab::Lab(const Scene& scene, uint32_t width, uint32_t height) : scene_(scene), width_(width), height_(height) {
  auto made = demo::Renderer::create(device(), scene, {.width = width, .height = height, .debug_readback = true});
  if (!made) {
    ADD_FAILURE() << made.error().message;
    std::abort();
  }
  renderer_.emplace(std::move(*made));
}

FrameData Lab::prepare(size_t camera, FrameSettings settings) const {
  settings.width = width_;
  settings.height = height_;
  return demo::make_frame(scene_, scene_.cameras[camera], settings);
}

void Lab::render(const FrameData& data) {
  const Status done = renderer_->render(data);
  ASSERT_TRUE(done) << done.error().message;
}

demo::Picture Lab::picture() {
  auto picture = renderer_->picture();
  if (picture) return std::move(*picture);
  ADD_FAILURE() << picture.error().message;
  return {};
}

Dump Lab::dump(const FrameData& data, Index pass, Index resource, uint32_t mip) { return dumps(data, {{pass, resource, mip}})[0]; }

std::vector<Dump> Lab::dumps(const FrameData& data, const std::vector<DumpOf>& what) {
  for (const DumpOf& one : what) {
    const Status asked = graph().instance().request_dump(one.pass, one.resource, one.mip);
    EXPECT_TRUE(asked) << asked.error().message;
  }
  render(data);
  std::vector<Dump> all(what.size());
  for (Dump& one : all) {
    auto taken = graph().instance().take_dump();
    EXPECT_TRUE(taken) << taken.error().message;
    if (taken) one = std::move(*taken);
  }
  return all;
}

Index deferred_light() {
  const Plan plan = frame::plan();
  Index last = kNone;
  for (const Step& step : plan.steps)
    if (step.kind == StepKind::pass && plan.passes[step.index].name.starts_with("deferred_light[")) last = step.index;
  return last;
}

Lab& plaza_lab() {
  static Lab lab(plaza());
  return lab;
}

}  // namespace rg::test
