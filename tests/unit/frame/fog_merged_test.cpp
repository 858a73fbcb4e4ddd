// The merged fog kernel against the chain of three, both compiled here from the same technique files: C26.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "compiler/compile.h"
#include "compiler/verify/verify.h"
#include "examples/demo/upload.h"
#include "tests/unit/frame/lab.h"

namespace rg::test {
namespace {

// The fog three times: as the frame has it, with nothing rounded between the kernels, and merged.
constexpr std::string_view kLab = R"(module fog_lab
import "passes/view/view.rg"
import "passes/scene/scene.rg"
import "passes/culling/culling.rg"
import "passes/fog/fog.rg"

interface World {
  lights:      buffer Light[]  ready as storage in compute
  fog_volumes: buffer FogVolume[]  ready as storage in compute
  albedo_maps: image rgba8_srgb 256x256 layers 32 mips 9  ready as sampled in compute
}
graph lab(params camera: View, params fog: Fog, world: World)
{
  image sun_shadow  : d32f 4x4
  image lamp_shadow : d32f 4x4 layers 8
  pass open_sky : transfer { clear sun_shadow 0.0  clear lamp_shadow 0.0 }

  image chain_light    : r11g11b10f froxels output
  image chain_through  : r16f froxels output
  image merged_light   : r11g11b10f froxels output
  image merged_through : r16f froxels output
  use chain = froxel_fog(camera, fog, world.lights, world.fog_volumes, world.albedo_maps, sun_shadow, lamp_shadow, chain_light, chain_through)
  use merged = merged_fog(camera, fog, world.lights, world.fog_volumes, world.albedo_maps, sun_shadow, lamp_shadow, merged_light, merged_through)

  image density       : r32f froxels
  image inscatter     : rgba32f froxels
  image extinction    : r32f froxels
  image memory        : rgba16f froxels history 1 init clear -1
  image exact_light   : rgba32f froxels output
  image exact_through : r32f froxels output
  image wide_light    : rgba32f froxels output
  image wide_through  : r32f froxels output
  buffer cluster_volumes : u32[ceil(froxels / FOG_CLUSTER).area * ceil(froxels / FOG_CLUSTER).z]
  buffer cluster_lights  : u32[ceil(froxels / FOG_CLUSTER).area * ceil(froxels / FOG_CLUSTER).z * LIGHT_WORDS]
  use clusters = fog_clusters(camera, fog, world.lights, world.fog_volumes, cluster_volumes, cluster_lights)
  use exact = fog_chain(camera, fog, world.lights, world.fog_volumes, cluster_volumes, cluster_lights, world.albedo_maps, sun_shadow,
                        lamp_shadow, density, inscatter, extinction, memory, exact_light, exact_through)
  use wide = merged_fog(camera, fog, world.lights, world.fog_volumes, world.albedo_maps, sun_shadow, lamp_shadow, wide_light, wide_through)
}
)";

compiler::CompileResult compile_lab() {
  const dsl::ReadSource read = [](const std::string& path, std::string& why) -> std::optional<std::string> {
    if (path == "fog_lab.rg") return std::string(kLab);
    std::ifstream file(std::filesystem::path(RGC_SOURCE_DIR) / path);
    if (!file) return why = "no such file", std::nullopt;
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  };
  dsl::Diagnostics diagnostics;
  compiler::CompileOptions options;
  options.until = compiler::Until::plans;
  compiler::CompileResult result = compiler::compile("fog_lab.rg", read, options, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.sources, false);
  return result;
}

demo::FogBox make_box(glm::vec3 at, float half, float density) {
  demo::FogBox box;
  box.transform[0] *= half, box.transform[1] *= half, box.transform[2] *= half;
  box.transform[3] = glm::vec4(at, 1);
  box.density = density;
  return box;
}

Scene make_misty_scene() {
  Scene scene = make_floor();
  scene.cameras[0].fog_reach = 20;
  scene.sun.color = {2, 1.5f, 1};
  scene.sun.ambient = {0.1f, 0.2f, 0.4f};
  scene.fog.density = 0.08f;
  scene.fog.phase = 0.4f;
  scene.fog.boxes = {make_box({0, 1, 0}, 2, 0.3f), make_box({2, 0.5f, 1}, 1.5f, 0.2f)};
  for (int i = 0; i < 12; ++i) {
    demo::Light light;
    light.position = {-4.0f + 0.7f * static_cast<float>(i), 0.8f, 0.5f * static_cast<float>(i % 5) - 1};
    const uint32_t features[] = {demo::lamp::round, demo::lamp::tube, 0};
    light.features = features[i % 3];
    light.size = {0.3f, 0.1f};
    light.range = 4;
    scene.lights.push_back(light);
  }
  return scene;
}

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

class FogLab {
 public:
  FogLab() : result_(compile_lab()), plan_(result_.graphs.at(0).plans.at(0).plan.view()), scene_(make_misty_scene()) {
    auto gpu = demo::upload(device(), scene_);
    auto lights = demo::make_buffer(device(), sizeof(frame::Light) * frame::MAX_LIGHTS, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, true);
    GraphOptions options;
    options.debug_readback = true;
    const int64_t extents[] = {40, 22, 64};
    options.extents = extents;
    auto graph = GraphInstance::create(device(), plan_, options);
    EXPECT_TRUE(gpu && lights && graph) << (graph ? "" : graph.error().message);
    gpu_ = std::move(*gpu);
    lights_ = std::move(*lights);
    graph_.emplace(std::move(*graph));
  }

  const compiler::CompileResult& result() const { return result_; }
  const Plan& plan() const { return plan_; }

  // Frame `number` of a standing camera; history counts from the second on.
  FrameData prepare(uint32_t number) const {
    FrameSettings settings;
    settings.width = 400, settings.height = 220;
    settings.number = number;
    settings.jitter = settings.animate = false;
    FrameData data = demo::make_frame(scene_, scene_.cameras[0], settings);
    data.fog.count = {40, 22, 64};
    data.fog.blend = number == 0 ? 1 : 0.3f;
    return data;
  }

  void render(const FrameData& data) {
    std::memcpy(lights_.mapped, data.lights.data(), data.lights.size() * sizeof(frame::Light));
    std::vector<Import> imports(3);
    const std::span<const std::byte> params[] = {bytes_of(data.view), bytes_of(data.fog)};
    for (Index i = 0; i < plan_.resources.size(); ++i) {
      const Resource& r = plan_.resources[i];
      if (r.import_slot == kNone) continue;
      if (r.name == "world.lights") imports[r.import_slot].buffer = {lights_.buffer.get()};
      if (r.name == "world.fog_volumes") imports[r.import_slot].buffer = {gpu_.fog_volumes.buffer.get()};
      if (r.name == "world.albedo_maps") imports[r.import_slot].image = {gpu_.albedo_maps.image.get(), gpu_.albedo_maps.view.get()};
    }
    FrameInputs inputs;
    inputs.imports = imports;
    inputs.params = params;
    const Status done = graph_->execute(inputs);
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_TRUE(graph_->wait_idle());
  }

  std::vector<glm::vec4> volume(const FrameData& data, std::string_view name) {
    Index what = kNone;
    for (Index i = 0; i < plan_.resources.size(); ++i)
      if (plan_.resources[i].name == name) what = i;
    const Status asked = graph_->request_dump(writer_of(what), what);
    EXPECT_TRUE(asked) << (asked ? "" : asked.error().message);
    render(data);
    auto dump = graph_->take_dump();
    EXPECT_TRUE(dump) << (dump ? "" : dump.error().message);
    return dump ? decode_texels(*dump) : std::vector<glm::vec4>{};
  }

 private:
  Index writer_of(Index resource) const {
    for (Index p = 0; p < plan_.passes.size(); ++p)
      for (Index i = plan_.passes[p].first_access; i < plan_.passes[p].first_access + plan_.passes[p].access_count; ++i)
        if (plan_.accesses[i].ref.resource == resource && plan_.accesses[i].writes) return p;
    return kNone;
  }

  compiler::CompileResult result_;
  Plan plan_;
  Scene scene_;
  demo::GpuScene gpu_;
  demo::GpuBuffer lights_;
  std::optional<GraphInstance> graph_;
};

void expect_same(FogLab& lab, std::string_view a, std::string_view b, float relative, float absolute) {
  const FrameData data = lab.prepare(0);
  const std::vector<glm::vec4> left = lab.volume(data, a), right = lab.volume(data, b);
  ASSERT_EQ(left.size(), size_t{40 * 22 * 64});
  ASSERT_EQ(right.size(), left.size());
  float greatest = 0;
  for (size_t i = 0; i < left.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      greatest = std::max(greatest, left[i][c]);
      ASSERT_NEAR(left[i][c], right[i][c], relative * std::abs(left[i][c]) + absolute) << "froxel " << i;
    }
  EXPECT_GT(greatest, 0.1f);
}

TEST(MergedFog, IsTheChainWhereNothingIsRounded) {
  FogLab lab;
  expect_same(lab, "exact_light", "wide_light", 1e-5f, 1e-7f);
  expect_same(lab, "exact_through", "wide_through", 1e-5f, 0);
}

TEST(MergedFog, IsTheChainButForTheFormatsBetween) {
  FogLab lab;
  expect_same(lab, "chain_light", "merged_light", 1.0f / 24, 1e-4f);  // two roundings to 6 and 5 bits
  expect_same(lab, "chain_through", "merged_through", 2e-3f, 0);
}

TEST(MergedFog, RemembersAsTheChainDoes) {
  FogLab lab;
  for (uint32_t number = 0; number < 4; ++number) lab.render(lab.prepare(number));
  const FrameData data = lab.prepare(4);
  const std::vector<glm::vec4> chain = lab.volume(data, "memory");
  FogLab other;
  for (uint32_t number = 0; number < 4; ++number) other.render(other.prepare(number));
  const std::vector<glm::vec4> merged = other.volume(data, "wide.memory");
  ASSERT_EQ(chain.size(), merged.size());
  for (size_t i = 0; i < chain.size(); ++i)
    for (int c = 0; c < 4; ++c) ASSERT_NEAR(chain[i][c], merged[i][c], 2e-3f * std::abs(chain[i][c]) + 1e-6f) << "froxel " << i;
}

TEST(MergedFog, IsProvedBesideTheChain) {
  FogLab lab;
  const compiler::FramePlan& frame = lab.result().graphs[0].plans[0];
  const auto findings = verify::verify(lab.result().program, dsl::GraphId{0}, frame.configuration, frame.plan.view(), frame.plan.program_pass,
                                       frame.plan.program_resource);
  for (const verify::Finding& finding : findings) ADD_FAILURE() << finding.text;
}

// What the merged kernel reads and writes of volumes at 112 x 90 x 128, history apart: a quarter of the published chain, which is 30,920 kB.
TEST(MergedFog, WritesItsSumsAndNothingElse) {
  FogLab lab;
  const uint64_t froxels = 112 * 90 * 128;
  uint64_t bytes = 0;
  for (const Pass& pass : lab.plan().passes)
    if (pass.name == "merged.merged")
      for (Index i = pass.first_access; i < pass.first_access + pass.access_count; ++i) {
        const Resource& what = lab.plan().resources[lab.plan().accesses[i].ref.resource];
        if (what.depth != kNone && what.copies == 1) bytes += froxels * (what.name == "merged_light" ? 4 : 2);
      }
  EXPECT_EQ(bytes, froxels * 6);
  EXPECT_NEAR(static_cast<double>(bytes) / 1000, 7730, 15);
}

}  // namespace
}  // namespace rg::test
