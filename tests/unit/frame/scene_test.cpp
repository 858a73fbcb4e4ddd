// The scene, the files it may come from, the pictures it goes to, and whole frames.
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>

#include "examples/demo/gltf.h"
#include "examples/demo/png.h"
#include "tests/unit/frame/lab.h"

namespace rg::test {
namespace {

namespace fs = std::filesystem;

TEST(Plaza, IsAsLargeAsPromised) {
  const Scene& scene = plaza();
  EXPECT_GE(scene.meshes.size(), 200u);
  EXPECT_LE(scene.instances.size(), static_cast<size_t>(frame::MAX_INSTANCES));
  EXPECT_GE(scene.materials.size(), 20u);
  EXPECT_GE(scene.indices.size() / 3, 100000u);
  EXPECT_GT(scene.prop_indices.size(), 0u);
  EXPECT_GE(scene.lights.size(), 256u);
  EXPECT_LE(scene.lights.size(), static_cast<size_t>(frame::MAX_LIGHTS));
  EXPECT_LE(scene.textures.size(), static_cast<size_t>(frame::TEXTURE_LAYERS));
  std::vector<std::string> cameras;
  for (const auto& camera : scene.cameras) cameras.push_back(camera.name);
  EXPECT_EQ(cameras, (std::vector<std::string>{"courtyard", "interior", "overview"}));
}

TEST(Plaza, RefersToNothingThatIsNotThere) {
  const Scene& scene = plaza();
  for (const uint32_t index : scene.indices) ASSERT_LT(index, scene.vertices.size());
  for (const uint32_t index : scene.prop_indices) ASSERT_LT(index, scene.prop_vertices.size());
  for (const auto& instance : scene.instances) {
    ASSERT_LT(instance.mesh, scene.meshes.size());
    ASSERT_LT(instance.material, scene.materials.size());
  }
  for (const auto& vertex : scene.vertices) {
    ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-3);
    ASSERT_GT(std::abs(vertex.tangent.w), 0);
  }
}

TEST(Frame, IsTheSameTwiceAndWithoutAliasing) {
  std::vector<demo::Picture> pictures;
  for (const bool aliasing : {true, true, false}) {
    auto renderer = demo::Renderer::create(device(), plaza(), {.width = 160, .height = 90, .aliasing = aliasing});
    ASSERT_TRUE(renderer) << renderer.error().message;
    for (uint32_t number = 0; number < 3; ++number) {
      const Status drawn = renderer->render(demo::make_frame(plaza(), plaza().cameras[0], {.width = 160, .height = 90, .number = number}));
      ASSERT_TRUE(drawn) << drawn.error().message;
    }
    auto picture = renderer->picture();
    ASSERT_TRUE(picture) << picture.error().message;
    pictures.push_back(std::move(*picture));
  }
  EXPECT_EQ(pictures[0].texels, pictures[1].texels);
  EXPECT_EQ(pictures[0].texels, pictures[2].texels);
}

TEST(Frame, ShowsSomethingInEveryView) {
  Lab lab(plaza(), 160, 90);
  for (uint32_t view = 0; view < static_cast<uint32_t>(frame::DEBUG_COUNT); ++view) {
    lab.render(lab.prepare(0, {.number = 4, .debug_view = view}));
    std::map<uint32_t, uint32_t> colors;
    const demo::Picture picture = lab.picture();
    for (size_t i = 0; i < picture.texels.size(); i += 4) ++colors[picture.texels[i] | picture.texels[i + 1] << 8 | picture.texels[i + 2] << 16];
    EXPECT_GE(colors.size(), 2u) << demo::view_names()[view];
  }
}

// ---- glTF ---------------------------------------------------------------------------------------------------------------

class GltfTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rgc_gltf_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // The error's message without the path, or "loads".
  std::string load(const std::string& text) {
    const fs::path path = folder_ / "scene.gltf";
    std::ofstream(path) << text;
    auto scene = demo::load_gltf(path);
    if (scene) return "loads";
    const std::string start = "`" + path.string() + "`: ";
    EXPECT_EQ(scene.error().message.substr(0, start.size()), start);
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
    return scene.error().message.substr(start.size());
  }
  fs::path folder_;
};

// A triangle: three positions and, from byte 36 on, the indices 0 1 2 (and 9) as unsigned shorts.
std::string triangle(const std::string& from = "", const std::string& to = "") {
  std::string text = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": 44, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIACQA="}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";
  if (from.empty()) return text;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(GltfTest, LoadsATriangle) {
  EXPECT_EQ(load(triangle()), "loads");
  auto scene = demo::load_gltf(folder_ / "scene.gltf");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->indices.size(), 3u);
  ASSERT_EQ(scene->vertices.size(), 3u);
  EXPECT_NEAR(scene->vertices[0].normal.z, 1, 1e-6) << "made from the triangle";
  EXPECT_FALSE(scene->lights.empty());
}

TEST_F(GltfTest, NamesObjectAndReason) {
  EXPECT_EQ(load("hello"), "file: holds no glTF, neither JSON nor binary");
  EXPECT_EQ(load("[1]"), "file: holds no glTF, neither JSON nor binary");
  EXPECT_EQ(load(triangle(R"("count": 3, "type": "SCALAR")", R"("count": 4, "type": "SCALAR")")),
            "accessor 1: index 9 at position 3 exceeds the 3 vertices of mesh 0 primitive 0");
  EXPECT_EQ(load(triangle(R"("count": 3, "type": "SCALAR")", R"("count": 5, "type": "SCALAR")")),
            "accessor 1: 5 elements from byte 0 on do not fit buffer view 1 of 8 bytes");
  EXPECT_EQ(load(triangle(R"("byteLength": 36})", R"("byteLength": 99})")), "buffer view 0: bytes 0 to 99 exceed buffer 0 of 44 bytes");
  EXPECT_EQ(load(triangle(R"("bufferView": 1,)", R"("bufferView": 7,)")), "accessor 1: refers to buffer view 7, but there are 2");
  EXPECT_EQ(load(triangle(R"("indices": 1)", R"("indices": 5)")), "mesh 0 primitive 0: refers to accessor 5, but there are 2");
  EXPECT_EQ(load(triangle(R"("indices": 1)", R"("indices": 1, "material": 2)")), "mesh 0 primitive 0: refers to material 2, but there are 0");
  EXPECT_EQ(load(triangle(R"([{"mesh": 0}])", R"([{"mesh": 0, "children": [0]}])")), "node 0: is its own ancestor");
  EXPECT_EQ(load(triangle(R"([{"mesh": 0}])", R"([{"mesh": 3}])")), "node 0: refers to mesh 3, but there are 1");
  EXPECT_EQ(load(triangle(R"([{"mesh": 0}])", R"([{"translation": [1, 2, 3]}])")), "file: no node of its scene draws a triangle");
  EXPECT_EQ(load(triangle(R"("scene": 0)", R"("extensionsRequired": ["KHR_draco_mesh_compression"], "scene": 0)")),
            "file: requires the extension \"KHR_draco_mesh_compression\", which is not supported; export the scene without it");
  EXPECT_EQ(load(triangle("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIACQA=", "gone.bin")),
            "buffer 0: its file `gone.bin` is missing");
  EXPECT_EQ(load(triangle(R"("byteLength": 36})", R"("byteLength": 1e300})")), "buffer view 0: its `byteLength` of 1e+300 is not a size");
}

TEST_F(GltfTest, ReportsAFileThatIsNotThere) {
  auto scene = demo::load_gltf(folder_ / "none.gltf");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "`" + (folder_ / "none.gltf").string() + "`: No such file or directory");
}

TEST_F(GltfTest, Renders) {
  ASSERT_EQ(load(triangle()), "loads");
  auto scene = demo::load_gltf(folder_ / "scene.gltf");
  ASSERT_TRUE(scene);
  Lab lab(*scene, 64, 64);
  const Texels depth = lab.image(lab.prepare(), frame::pass::depth_props, frame::resource::depth);
  uint32_t covered = 0;
  for (const glm::vec4& texel : depth.data) covered += texel.x > 0;
  EXPECT_GT(covered, 100u);
}

// ---- pictures -----------------------------------------------------------------------------------------------------------

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class PngTest : public GltfTest {};

TEST_F(PngTest, FailsWithoutTouchingWhatWasThere) {
  const fs::path path = folder_ / "a.png";
  demo::Picture picture{64, 64, std::vector<uint8_t>(64 * 64 * 4)};
  for (size_t i = 0; i < picture.texels.size(); ++i) picture.texels[i] = static_cast<uint8_t>(i * i * 2654435761u >> 13);  // hard to compress
  ASSERT_TRUE(demo::write_png(path, picture));
  const std::string before = read(path);
  EXPECT_EQ(before.substr(1, 3), "PNG");

  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{2000, old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status failed = demo::write_png(path, picture);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);

  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "`" + path.string() + "` cannot be written: File too large; choose another folder with --out");
  EXPECT_EQ(read(path), before);
  EXPECT_FALSE(fs::exists(folder_ / "a.png.tmp"));
}

TEST_F(PngTest, NamesAFolderThatIsNotThere) {
  const fs::path path = folder_ / "none" / "a.png";
  const Status failed = demo::write_png(path, {1, 1, {0, 0, 0, 0}});
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "`" + path.string() + "` cannot be written: No such file or directory; choose another folder with --out");
}

}  // namespace
}  // namespace rg::test
