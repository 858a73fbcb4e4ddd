// What some devices can and others cannot, one graph a capability: a device that can draws by the pipelines made for it, another, or one that is told
// to leave it alone, by those without. Both are built into one plan.
#include <gtest/gtest.h>

#include "runtime/graph.h"
#include "tests/unit/e2e/run_frame.h"

namespace rg::test {
namespace {

// `expected(x, y, has)`: a texel, on a device that has the capability or has not.
template <class Expected>
void expect_texels(const Files& files, Capability capability, Expected expected) {
  for (const bool refused : {false, true}) {
    const bool has = !refused && device_has(capability);
    const auto words = run(files, 1, true, refused ? std::vector<Capability>{capability} : std::vector<Capability>{});
    if (!words) GTEST_SKIP() << "no device";
    ASSERT_EQ(words->size(), 64u);
    for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ((*words)[i], expected(i % 8, i / 8, has)) << i % 8 << " " << i / 8 << (has ? " with" : " without");
  }
}

// Of the pass with a feature of the device: without it, and with it.
struct Choices {
  RasterState without, with;
};
Choices choices_of(const PlanData& plan) {
  for (const Pass& pass : plan.passes)
    if (pass.choice_count == 2)
      return {plan.pipelines[plan.pipeline_choices[pass.first_choice]].raster, plan.pipelines[plan.pipeline_choices[pass.first_choice + 1]].raster};
  ADD_FAILURE() << "no pass has two pipelines";
  return {};
}

// Depth rises from left to right; light falls where it lies within the bounds.
const Files kBounds = {{"frame.rg", R"(
feature bounds : device depth_bounds
state anyhow { depth test always }
state lit    { cull none  depth bounds 0.25 0.75 }
graph frame() {
  image depth : d32f 8x8
  image seen  : r32ui 8x8
  pass prepare : raster { fullscreen "slope.frag"  state anyhow  depth depth clear 0 }
  pass light   : raster { fullscreen "one.frag"  features bounds  state lit  depth depth readonly  color seen clear 9 })" +
                                        kShow},
                       {"slope.frag", "void main() { gl_FragDepth = gl_FragCoord.x / 8.0; }"},
                       {"one.frag", "void main() { seen = uvec4(1); }"},
                       {"show.comp", kShowShader}};

TEST(DeviceState, DepthBoundsLeaveOutWhatLiesBeyond) {
  const compiler::CompileResult result = compile_files(kBounds);
  const Choices choices = choices_of(result.graphs[0].plans[0].plan);
  EXPECT_FALSE(choices.without.depth_bounds);
  EXPECT_TRUE(choices.with.depth_bounds);
  EXPECT_EQ(choices.with.depth_min, 0.25f);
  EXPECT_EQ(choices.with.depth_max, 0.75f);
  expect_texels(kBounds, Capability::depth_bounds, [](uint32_t x, uint32_t, bool has) {
    const double depth = (x + 0.5) / 8;
    return !has || (depth >= 0.25 && depth <= 0.75) ? 1u : 9u;
  });
}

// A sliver that holds the centre of no pixel and touches all of the first row.
const Files kConservative = {{"frame.rg", R"(
feature whole : device conservative_rasterization
state covering { cull none  conservative }
graph frame() {
  image seen : r32ui 8x8
  pass draw : raster { shader "sliver.vert" "one.frag"  features whole  state covering  color seen clear 0  draw 3 })" +
                                              kShow},
                             {"sliver.vert", R"(void main() {
  const vec2 kCorners[3] = vec2[](vec2(0.1, 0.1), vec2(7.9, 0.1), vec2(7.9, 0.2));
  gl_Position = vec4(kCorners[gl_VertexIndex] / 4.0 - 1.0, 0.0, 1.0);
})"},
                             {"one.frag", "void main() { seen = uvec4(1); }"},
                             {"show.comp", kShowShader}};

TEST(DeviceState, ConservativeRasterisationCoversWhatIsTouched) {
  const compiler::CompileResult result = compile_files(kConservative);
  const Choices choices = choices_of(result.graphs[0].plans[0].plan);
  EXPECT_FALSE(choices.without.conservative);
  EXPECT_TRUE(choices.with.conservative);
  expect_texels(kConservative, Capability::conservative_rasterization, [](uint32_t, uint32_t y, bool has) { return has && y == 0 ? 1u : 0u; });
}

// Where the device has barycentrics the fragment shader asks for them; else the vertex shader hands them on. The picture is the same.
const Files kBarycentrics = {{"frame.rg", R"(
feature corners : device barycentrics
state flat_sided { cull none }
graph frame() {
  image seen : r32ui 8x8
  pass draw : raster { shader "corners.vert" "corners.frag"  features corners  state flat_sided  color seen clear 0  draw 3 })" +
                                              kShow},
                             {"corners.vert", R"(layout(location = 0) out vec3 weights;
void main() {
  const vec2 kCorners[3] = vec2[](vec2(0.0, 0.0), vec2(16.0, 0.0), vec2(0.0, 16.0));
  weights = vec3(gl_VertexIndex == 0, gl_VertexIndex == 1, gl_VertexIndex == 2);
  gl_Position = vec4(kCorners[gl_VertexIndex] / 4.0 - 1.0, 0.0, 1.0);
})"},
                             {"corners.frag", R"(
#if FEATURE_corners
#extension GL_EXT_fragment_shader_barycentric : require
#else
layout(location = 0) in vec3 weights;
#endif
void main() {
#if FEATURE_corners
  vec3 at = gl_BaryCoordEXT;
#else
  vec3 at = weights;
#endif
  seen = uvec4(uint(at.y * 32.0 + 0.25) + 100u * uint(at.z * 32.0 + 0.25));
})"},
                             {"show.comp", kShowShader}};

TEST(DeviceState, BarycentricsComeFromTheDeviceOrFromTheVertices) {
  const compiler::CompileResult result = compile_files(kBarycentrics);
  const PlanData& plan = result.graphs[0].plans[0].plan;
  EXPECT_EQ(plan.pipeline_choices.size(), 2u);
  EXPECT_EQ(plan.pipelines[plan.pipeline_choices[0]].shader_count, 2u);
  expect_texels(kBarycentrics, Capability::barycentrics, [](uint32_t x, uint32_t y, bool) { return 2 * x + 1 + 100 * (2 * y + 1); });
}

// The left half of every second pixel is covered: all of its samples where they are placed there, else some.
const Files kSamples = {{"frame.rg", R"(
feature placed : device sample_locations
state left { cull none  samples at 0.25 0.125, 0.25 0.375, 0.25 0.625, 0.25 0.875 }
graph frame() {
  image many : rgba8 8x8 samples 4
  image one  : rgba8 8x8
  image seen : r32ui 8x8
  pass draw  : raster { shader "halves.vert" "white.frag"  features placed  state left  color many clear 0  resolve many -> one  draw 24 }
  pass count : compute { shader "count.comp" group 8 8 1  read one as sampled  write seen as storage  dispatch over 8x8 })" +
                                         kShow},
                        {"halves.vert", R"(void main() {
  int stripe = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
  const vec2 kCorners[6] = vec2[](vec2(0, 0), vec2(0.4, 0), vec2(0, 8), vec2(0.4, 0), vec2(0, 8), vec2(0.4, 8));
  gl_Position = vec4((kCorners[corner] + vec2(2 * stripe, 0)) / 4.0 - 1.0, 0.0, 1.0);
})"},
                        {"white.frag", "void main() { many = vec4(1); }"},
                        {"count.comp",
                         "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); float part = texelFetch(one, at, 0).x;\n"
                         "  imageStore(seen, at, uvec4(part > 0.9 ? 2u : part > 0.1 ? 1u : 0u)); }"},
                        {"show.comp", kShowShader}};

TEST(DeviceState, SamplesLieWhereTheStatePutsThem) {
  const compiler::CompileResult result = compile_files(kSamples);
  const PlanData& plan = result.graphs[0].plans[0].plan;
  const Choices choices = choices_of(plan);
  EXPECT_EQ(choices.without.sample_location_count, 0u);
  ASSERT_EQ(choices.with.sample_location_count, 4u);
  EXPECT_EQ(plan.sample_locations[choices.with.first_sample_location + 2].y, 0.625f);
  expect_texels(kSamples, Capability::sample_locations, [](uint32_t x, uint32_t, bool has) { return x % 2 != 0 ? 0u : has ? 2u : 1u; });
}

// A null device is told what it has: the pipelines of a desktop GPU are made there.
TEST(DeviceState, PipelinesAreChosenWhenTheGraphIsCreated) {
  for (const auto& [files, capability, word] : {std::tuple(&kBounds, Capability::depth_bounds, "depth bounds 0.25 0.75"),
                                                std::tuple(&kConservative, Capability::conservative_rasterization, "conservative"),
                                                std::tuple(&kSamples, Capability::sample_locations, "samples at")}) {
    const compiler::CompileResult result = compile_files(*files);
    const Plan plan = result.graphs[0].plans[0].plan.view();
    for (const bool has : {false, true}) {
      std::string log;
      NullOptions options;
      if (has) options.capabilities = {capability};
      Device device = Device::null(&log, options);
      auto graph = GraphInstance::create(device, plan, {});
      ASSERT_TRUE(graph) << graph.error().message;
      EXPECT_EQ(log.find(word) != std::string::npos, has) << word;
    }
  }
}

}  // namespace
}  // namespace rg::test
