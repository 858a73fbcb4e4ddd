// Constructs of the language on a real driver: what a frame with each leaves in a buffer.
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "tests/unit/e2e/run_frame.h"

namespace rg::test {
namespace {

TEST(Constructs, InputsAreTexelsOfTheirPixel) {
  const auto found =
      run({{"frame.rg", R"(
graph frame() {
  image  values : r32ui 8x8
  image  eyes   : r32ui 8x8
  buffer shown  : u32[64] readback
  pass make   : compute { shader "make.comp" group 8 8 1  write values as storage  dispatch over values }
  pass stereo : raster  { fullscreen "stereo.frag"  read values as input  color eyes }
  pass show   : compute { shader "show.comp" group 8 8 1  read eyes as sampled  write shown as storage  dispatch over eyes }
})"},
           {"make.comp", "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); imageStore(values, at, uvec4(at.x + 8 * at.y)); }"},
           {"stereo.frag", "void main() { eyes = uvec4(values.x * 10u + 1u); }"},
           {"show.comp",
            "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
            "  shown[8 * at.y + at.x] = texelFetch(eyes, at, 0).x; }"}});
  if (!found) GTEST_SKIP() << "no device";
  const Words& words = *found;
  ASSERT_EQ(words.size(), 64u);
  for (uint32_t i = 0; i < words.size(); ++i) EXPECT_EQ(words[i], i * 10 + 1) << i;
}

TEST(Constructs, ScalarBlocksHaveNoPadding) {
  const auto found = run({{"frame.rg", R"(
struct Inner scalar { a: vec3 }
struct Particle scalar { at: vec3  turn: mat3  ages: f32[3]  inner: Inner[2] }
graph frame() {
  buffer particles : Particle[2] readback
  pass make : compute { shader "make.comp" group 2 1 1  write particles as storage  dispatch over 2 }
})"},
                          {"make.comp",
                           "void main() { uint i = gl_GlobalInvocationID.x; float b = float(100u * i);\n"
                           "  particles[i].at = vec3(b, b + 1.0, b + 2.0);\n"
                           "  for (int c = 0; c < 3; ++c) particles[i].turn[c] = b + 3.0 + float(3 * c) + vec3(0.0, 1.0, 2.0);\n"
                           "  for (int k = 0; k < 3; ++k) particles[i].ages[k] = b + 12.0 + float(k);\n"
                           "  for (int k = 0; k < 2; ++k) particles[i].inner[k].a = b + 15.0 + float(3 * k) + vec3(0.0, 1.0, 2.0); }"}});
  if (!found) GTEST_SKIP() << "no device";
  const Words& words = *found;
  ASSERT_EQ(words.size(), 42u);
  for (uint32_t i = 0; i < words.size(); ++i) EXPECT_EQ(std::bit_cast<float>(words[i]), float((i / 21) * 100 + i % 21)) << i;
}

TEST(Constructs, DepthIsResolvedAtTheEndOfARendering) {
  const auto found =
      run({{"frame.rg", R"(
state far { depth test always }
graph frame() {
  image  many  : d32f 8x8 samples 4
  image  depth : d32f 8x8
  buffer shown : f32[64] readback
  pass draw : raster  { state far  fullscreen "draw.frag"  depth many clear 0  resolve many -> depth }
  pass show : compute { shader "show.comp" group 8 8 1  read depth as sampled  write shown as storage  dispatch over depth }
})"},
           {"draw.frag", "void main() { gl_FragDepth = floor(gl_FragCoord.x) / 16.0; }"},
           {"show.comp", "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); shown[8 * at.y + at.x] = texelFetch(depth, at, 0).x; }"}});
  if (!found) GTEST_SKIP() << "no device";
  const Words& words = *found;
  ASSERT_EQ(words.size(), 64u);
  for (uint32_t i = 0; i < words.size(); ++i) EXPECT_EQ(std::bit_cast<float>(words[i]), float(i % 8) / 16.0f) << i;
}

TEST(Constructs, FamiliesBundlesAndInstancesAddUp) {
  const auto found = run({{"frame.rg", R"(
technique twice(buffer source: u32, inout buffer target: u32) {
  bundle both {
    shader "twice.comp" group 4 1 1
    read   source as storage
    update target as storage
    dispatch over 4
  }
  pass once[0][0] : compute { with both }
  pass once[0][1] : compute { with both  after once[0][0] }
}
graph frame() {
  for i in 0..2 { buffer terms[i] : u32[4] }
  buffer shown : u32[4] readback
  for i in 0..2 { pass start[i] : transfer { fill terms[i] (i + 1) } }
  pass zero : transfer { fill shown 0 }
  for i in 0..2 { use add[i] = twice(terms[i], inout shown) }
  assert live(add[1].once[0][1])
})"},
                          {"twice.comp", "void main() { uint i = gl_GlobalInvocationID.x; target[i] += source[i] * (i + 1u); }"}});
  if (!found) GTEST_SKIP() << "no device";
  const Words& words = *found;
  ASSERT_EQ(words.size(), 4u);
  for (uint32_t i = 0; i < words.size(); ++i) EXPECT_EQ(words[i], 2 * (1 + 2) * (i + 1)) << i;
}

TEST(Constructs, HistoryReachesAsFarBackAsDeclared) {
  const auto found = run({{"frame.rg", R"(
graph frame() {
  buffer count : u32[1] history 3 init clear 7
  buffer shown : u32[4] readback
  pass step : compute { shader "step.comp" group 1 1 1  read count.prev(1) as storage  write count as storage  dispatch groups 1 }
  pass show : compute {
    shader "show.comp" group 1 1 1
    read  count as storage
    read  count.prev(1) as storage
    read  count.prev(3) as storage
    write shown as storage
    dispatch groups 1
  }
})"},
                          {"step.comp", "void main() { count[0] = count_prev[0] + 1u; }"},
                          {"show.comp", "void main() { shown[0] = count[0]; shown[1] = count_prev[0]; shown[2] = count_prev3[0]; shown[3] = 1u; }"}},
                         5);
  if (!found) GTEST_SKIP() << "no device";
  const Words& words = *found;
  ASSERT_EQ(words.size(), 4u);
  EXPECT_EQ(words, (Words{12, 11, 9, 1}));
}

}  // namespace
}  // namespace rg::test
