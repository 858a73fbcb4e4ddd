// The fog in one kernel against the same blocks in three, compiled here from the technique of the frame: C24, C26.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "compiler/compile.h"
#include "compiler/fusion/fusion_figures.h"
#include "compiler/verify/fusion.h"
#include "compiler/verify/verify.h"
#include "examples/demo/upload.h"
#include "tests/unit/frame/lab.h"

namespace rg::test {
namespace {

// The fog four times: in three kernels and in one, with the frame's formats and with 32 bits between the blocks and behind them.
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
  buffer cluster_volumes : u32[ceil(froxels / FOG_CLUSTER).area]
  buffer cluster_lights  : u32[ceil(froxels / FOG_CLUSTER).area * LIGHT_WORDS]
  use clusters = fog_clusters(camera, fog, world.lights, world.fog_volumes, cluster_volumes, cluster_lights)
  use exact = fog_chain(camera, fog, world.lights, world.fog_volumes, cluster_volumes, cluster_lights, world.albedo_maps, sun_shadow,
                        lamp_shadow, density, inscatter, extinction, memory, exact_light, exact_through)

  image wide_density    : r32f froxels
  image wide_inscatter  : rgba32f froxels
  image wide_extinction : r32f froxels
  image wide_memory     : rgba16f froxels history 1 init clear -1
  fuse wide {
    use wide_chain = fog_chain(camera, fog, world.lights, world.fog_volumes, cluster_volumes, cluster_lights, world.albedo_maps, sun_shadow,
                               lamp_shadow, wide_density, wide_inscatter, wide_extinction, wide_memory, wide_light, wide_through)
  }
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
    const std::vector<uint32_t> all(plan_.features.size(), 1);  // sun, lamps and sky
    inputs.features = all;
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

// What stays in registers is rounded as the volumes between the kernels would round it.
TEST(MergedFog, IsTheChainWithTheFormatsOfTheFrame) {
  FogLab lab;
  expect_same(lab, "chain_light", "merged_light", 0, 0);
  expect_same(lab, "chain_through", "merged_through", 0, 0);
}

TEST(MergedFog, RemembersAsTheChainDoes) {
  FogLab lab;
  for (uint32_t number = 0; number < 4; ++number) lab.render(lab.prepare(number));
  const FrameData data = lab.prepare(4);
  const std::vector<glm::vec4> chain = lab.volume(data, "memory");
  FogLab other;
  for (uint32_t number = 0; number < 4; ++number) other.render(other.prepare(number));
  const std::vector<glm::vec4> merged = other.volume(data, "wide_memory");
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
  std::vector<verify::Kernel> kernels;
  for (const compiler::FusedKernel& kernel : lab.result().fused) kernels.push_back({kernel.pass, kernel.members});
  ASSERT_EQ(kernels.size(), 2u);
  for (const verify::Finding& finding :
       verify::verify_fusion(lab.result().written, lab.result().unfolded, dsl::GraphId{0}, frame.configuration, kernels))
    ADD_FAILURE() << finding.text;
}

// Bytes of volumes that the passes of these names read and write, by the plan's accesses and formats; history apart.
uint64_t volume_bytes(const Plan& plan, std::initializer_list<std::string_view> names, uint64_t froxels) {
  enum : uint32_t { r16f = 76, r11g11b10f = 122 };  // VkFormat
  uint64_t sum = 0;
  size_t found = 0;
  for (const Pass& pass : plan.passes) {
    if (std::find(names.begin(), names.end(), pass.name) == names.end()) continue;
    ++found;
    for (Index i = pass.first_access; i < pass.first_access + pass.access_count; ++i) {
      const Resource& what = plan.resources[plan.accesses[i].ref.resource];
      if (what.depth == kNone || what.copies > 1) continue;
      EXPECT_TRUE(static_cast<uint32_t>(what.format) == r16f || static_cast<uint32_t>(what.format) == r11g11b10f) << what.name;
      sum += froxels * (static_cast<uint32_t>(what.format) == r11g11b10f ? 4 : 2);
    }
  }
  EXPECT_EQ(found, names.size());
  return sum;
}

// The table of the talk, in kB: 5150, 10310, 15460, together 30920, and 7730 for what the merged kernel writes. Its first figure counts another 16
// bits a froxel, which its other figures do not read; one write is enough here.
TEST(FogBytes, AreThoseOfTheTalk) {
  FogLab lab;
  const uint64_t froxels = 112 * 90 * 128, half = 2 * froxels;
  EXPECT_EQ(volume_bytes(lab.plan(), {"chain.chain.inject"}, froxels), half);
  EXPECT_EQ(volume_bytes(lab.plan(), {"chain.chain.light"}, froxels), 4 * half);
  EXPECT_EQ(volume_bytes(lab.plan(), {"chain.chain.integrate"}, froxels), 6 * half);
  const uint64_t chain = volume_bytes(lab.plan(), {"chain.chain.inject", "chain.chain.light", "chain.chain.integrate"}, froxels);
  const uint64_t merged = volume_bytes(lab.plan(), {"merged.merged"}, froxels);
  EXPECT_NEAR(static_cast<double>(chain + half) / 1000, 30920, 60);
  EXPECT_NEAR(static_cast<double>(merged) / 1000, 7730, 15);
  EXPECT_EQ((chain + half) / merged, 4u);
}

// What rgc reports of the kernel is what the two plans differ by, history in both.
TEST(FogBytes, AreWhatTheReportSays) {
  FogLab lab;
  const std::vector<int64_t> extents = {112, 90, 128};
  const uint64_t froxels = 112 * 90 * 128;
  for (const compiler::FusedKernel& kernel : lab.result().fused) {
    if (kernel.pass != "merged.merged") continue;
    const compiler::FusionFigures figures = compiler::fusion_figures(lab.result().written, kernel, extents);
    EXPECT_EQ(figures.moved, froxels * 16);  // three volumes of 2, 4 and 2 bytes, each written and read
    EXPECT_EQ(figures.memory, froxels * 8);
    return;
  }
  ADD_FAILURE() << "no kernel";
}

}  // namespace
}  // namespace rg::test
