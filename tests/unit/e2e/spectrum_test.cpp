// A spectrum on a real driver: whatever the kernels, every tile is shaded once and the result is that of the kernel with all features.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "compiler/compile.h"
#include "compiler/verify/verify.h"
#include "runtime/graph.h"
#include "tests/unit/e2e/compiled.h"

namespace rg::test {
namespace {

constexpr uint32_t kWidth = 203, kHeight = 117, kTile = 8;

const Files kFiles = {{"tiles.rg", R"(module tiles
extent view = runtime(203, 117) max(512, 512)
const TILE = 8
spectrum kinds {
  red
  deep_red requires red
  green
  blue
  modes 4
  profile "tiles.json"
}
graph frame() {
  buffer masks : u32[ceil(view / TILE).area]
  buffer shown : u32[view.area] readback
  pass mark : compute {
    shader "mark.comp" group 64 1 1
    write  masks as storage
    dispatch over ceil(view / TILE).area
  }
  pass start : transfer {
    fill shown 0
  }
  pass shade : compute {
    shader   "shade.comp" group 8 8 1
    spectrum kinds by masks
    read     own = masks as storage
    update   shown as storage disjoint
    dispatch over view
  }
}
)"},
                      {"mark.comp", R"(void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(masks.length())) return;
  uint x = i * 2654435761u;
  x ^= x >> 15;
  uint mask = (x >> 3) & 15u;
  if ((mask & 2u) != 0u) mask |= 1u;
  masks[i] = i % 3u == 0u ? 1u : mask;
}
)"},
                      {"shade.comp", R"(void main() {
  uvec2 pixel = spectrum_pixel(), tile = spectrum_tile();
  if (pixel.x >= 203u || pixel.y >= 117u) return;
  uint mask = own[tile.y * 26u + tile.x], value = 0u;
  if (red && (mask & 1u) != 0u) value += 3u + pixel.x;
  if (deep_red && (mask & 2u) != 0u) value *= 5u;
  if (green && (mask & 4u) != 0u) value += 7u * pixel.y;
  if (blue && (mask & 8u) != 0u) value ^= 0x155u;
  shown[pixel.y * 203u + pixel.x] += value + 0x1000000u;
}
)"},
                      {"tiles.json", R"({ "schema": "rgc-spectrum-1", "spectrum": "kinds", "scenes": [ { "masks": [
  { "features": ["red"], "tiles": 300 }, { "features": ["green", "blue"], "tiles": 90 }, { "features": [], "tiles": 40 },
  { "features": ["red", "deep_red"], "tiles": 70 } ] } ] })"}};

compiler::CompileResult compile_tiles(const Files& files, compiler::CompileOptions options, dsl::Diagnostics& diagnostics) {
  options.until = compiler::Until::plans;
  return compiler::compile("tiles.rg", reader_of(files), options, diagnostics);
}
compiler::CompileResult compile_tiles(std::optional<uint32_t> modes, dsl::Diagnostics& diagnostics) {
  compiler::CompileOptions options;
  options.spectrum_modes = modes;
  return compile_tiles(kFiles, options, diagnostics);
}

uint32_t mask_of(uint32_t i) {
  uint32_t x = i * 2654435761u;
  x ^= x >> 15;
  uint32_t mask = (x >> 3) & 15u;
  if (mask & 2u) mask |= 1u;
  return i % 3 == 0 ? 1u : mask;
}

// With every feature compiled in.
std::vector<uint32_t> expected() {
  std::vector<uint32_t> all;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const uint32_t mask = mask_of(y / kTile * ((kWidth + kTile - 1) / kTile) + x / kTile);
      uint32_t value = 0;
      if (mask & 1u) value += 3 + x;
      if (mask & 2u) value *= 5;
      if (mask & 4u) value += 7 * y;
      if (mask & 8u) value ^= 0x155;
      all.push_back(value + 0x1000000);
    }
  return all;
}

void prove(const compiler::CompileResult& result) {
  const compiler::FramePlan& frame = result.graphs[0].plans[0];
  for (const verify::Finding& finding :
       verify::verify(result.program, dsl::GraphId{0}, frame.configuration, frame.plan.view(), frame.plan.program_pass, frame.plan.program_resource))
    ADD_FAILURE() << verify::name(finding.hazard) << ": " << finding.text;
}

std::vector<uint32_t> run(const compiler::CompileResult& result) {
  DeviceOptions options;
  auto device = Device::create(options);
  if (!device && std::getenv("RGC_REQUIRE_GPU")) ADD_FAILURE() << device.error().message;
  if (!device) return {};
  const Plan plan = result.graphs[0].plans[0].plan.view();
  auto graph = GraphInstance::create(*device, plan, {});
  EXPECT_TRUE(graph) << (graph ? "" : graph.error().message);
  if (!graph) return {};
  for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(graph->execute({}));
  for (Index i = 0; i < plan.resources.size(); ++i) {
    if (plan.resources[i].name != "shown") continue;
    const auto bytes = graph->readback(i);
    EXPECT_TRUE(bytes);
    std::vector<uint32_t> words(bytes ? (*bytes).size() / 4 : 0);
    if (bytes) std::memcpy(words.data(), (*bytes).data(), words.size() * 4);
    return words;
  }
  return {};
}

TEST(Spectrum, EveryTileIsShadedOnceByAKernelThatServesIt) {
  for (const uint32_t modes : {1u, 2u, 4u, 8u}) {
    dsl::Diagnostics diagnostics;
    const compiler::CompileResult result = compile_tiles(modes, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.sources, false);
    ASSERT_EQ(result.spectra.size(), 1u);
    EXPECT_LE(result.spectra[0].choice.modes.size(), modes);
    EXPECT_EQ(result.spectra[0].choice.modes.back(), 15u);
    prove(result);
    const std::vector<uint32_t> shown = run(result);
    if (!shown.empty()) {
      EXPECT_EQ(shown, expected()) << modes;
    }
  }
}

// Somebody edits the shader and waits: the kernels are those of the build before, whatever they cost now, and shade the same.
TEST(Spectrum, APreviewTakesTheKernelsOfTheBuildBefore) {
  dsl::Diagnostics diagnostics;
  compiler::CompileOptions options;
  options.spectrum_modes = 3;
  const compiler::CompileResult before = compile_tiles(kFiles, options, diagnostics);
  EXPECT_TRUE(before.complete);
  Files edited = kFiles;
  std::string& shader = edited["shade.comp"];
  const std::string cheap = "if (blue &&", dear = "if (red) for (uint i = 0u; i < own[0]; ++i) value ^= own[i] & 0u * i;\n  if (blue &&";
  shader.replace(shader.find(cheap), cheap.size(), dear);
  options.preview = true;
  options.earlier = &before.spectra;
  const compiler::CompileResult preview = compile_tiles(edited, options, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, preview.sources, false);
  EXPECT_FALSE(preview.complete);
  EXPECT_TRUE(preview.spectra[0].provisional);
  EXPECT_EQ(preview.spectra[0].choice.modes, before.spectra[0].choice.modes);
  prove(preview);
  if (const std::vector<uint32_t> shown = run(preview); !shown.empty()) {
    EXPECT_EQ(shown, expected());
  }
  options.spectrum_modes = 2;  // another problem: nothing to take
  EXPECT_FALSE(compile_tiles(edited, options, diagnostics).spectra[0].provisional);
}

compiler::CompileResult compile_timed(const std::string& costs, dsl::Diagnostics& diagnostics) {
  Files files = kFiles;
  std::string& profile = files["tiles.json"];
  profile.insert(profile.rfind('}'), ", \"costs\": [" + costs + "]");
  return compile_tiles(files, {}, diagnostics);
}

// Two kernels that were timed: they cost their times, and what the statistics say of others is brought to the unit of the times.
TEST(Spectrum, TimesThatDoNotTellFeaturesApartAreCompletedByStatistics) {
  dsl::Diagnostics diagnostics;
  const compiler::CompileResult estimated = compile_tiles(4, diagnostics);
  const compiler::CompileResult timed =
      compile_timed("{ \"features\": [], \"ms\": 0.25 }, { \"features\": [\"red\", \"deep_red\", \"green\", \"blue\"], \"ms\": 2.5 }", diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, timed.sources, false);
  EXPECT_EQ(estimated.spectra[0].source, compiler::CostSource::statistics);
  EXPECT_EQ(timed.spectra[0].source, compiler::CostSource::both);
  const auto cost_of = [](const compiler::CompileResult& result, compiler::Mask set) { return compiler::cost(result.spectra[0].problem.costs, set); };
  EXPECT_EQ(cost_of(timed, 0), 0.25);
  EXPECT_EQ(cost_of(timed, 15), 2.5);
  const double none = cost_of(estimated, 0), all = cost_of(estimated, 15), factor = (none * 0.25 + all * 2.5) / (none * none + all * all);
  EXPECT_NEAR(cost_of(timed, 4), cost_of(estimated, 4) * factor, 1e-9) << "green, which was built for its statistics";
}

TEST(Spectrum, TimesThatTellFeaturesApartStandAlone) {
  dsl::Diagnostics diagnostics;
  const compiler::CompileResult timed = compile_timed(
      "{ \"features\": [], \"ms\": 1 }, { \"features\": [\"red\"], \"ms\": 2 }, { \"features\": [\"deep_red\"], \"ms\": 4 },"
      "{ \"features\": [\"green\"], \"ms\": 5 }, { \"features\": [\"blue\"], \"ms\": 9 }",
      diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, timed.sources, false);
  EXPECT_EQ(timed.spectra[0].source, compiler::CostSource::times);
  const compiler::CostModel& costs = timed.spectra[0].problem.costs;
  EXPECT_EQ(compiler::cost(costs, 3), 4) << "a kernel with deep_red has red";
  EXPECT_NEAR(compiler::cost(costs, 4 | 8), 1 + 4 + 8, 0.05) << "terms add up";
}

TEST(Spectrum, NothingWaitsBetweenKernels) {
  dsl::Diagnostics diagnostics;
  const compiler::CompileResult result = compile_tiles(4, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors());
  const PlanData& plan = result.graphs[0].plans[0].plan;
  size_t kernels = 0, groups = 0;
  bool inside = false;
  for (const Step& step : plan.steps) {
    const bool is_kernel = step.kind == StepKind::pass && plan.passes[step.index].name.starts_with("shade[");
    if (is_kernel) kernels += 1, inside = true;
    if (inside && step.kind == StepKind::barriers && kernels < result.spectra[0].choice.modes.size()) ++groups;
  }
  EXPECT_EQ(kernels, result.spectra[0].choice.modes.size());
  EXPECT_EQ(groups, 0u);
}

}  // namespace
}  // namespace rg::test
