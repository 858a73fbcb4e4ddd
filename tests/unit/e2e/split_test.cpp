// Barriers in two halves on a real driver, under validation: the texels of plans without events.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/e2e/run_frame.h"

namespace rg::test {
namespace {

// `light` reads what `base` drew, while `tone`, which computes from it, and `more`, which draws, stand between the two. `trail` of the frame before
// is read and written.
const Files kFrame = {{"frame.rg", R"(
target vulkan 1.3 with split_barriers
state flat { cull none }
graph frame() {
  image base   : rgba8 8x8
  image mask   : rgba8 8x8
  image extra  : rgba8 8x8
  buffer tones : u32[64]
  image trail  : r32ui 8x8 history 1 init clear 7
  image seen   : r32ui 8x8
  pass first  : raster { shader "full.vert" "two.frag"  state flat  color base clear 0  color mask clear 0  draw 3 }
  pass tone   : compute { shader "tone.comp" group 8 8 1  read mask as sampled  write tones as storage  dispatch over 8x8 }
  pass more   : raster { shader "full.vert" "more.frag"  state flat  read mask as sampled in fragment  color extra clear 0  draw 3 }
  pass light  : compute { shader "light.comp" group 8 8 1  read base as sampled  read tones as storage  read trail.prev(1) as sampled  write trail as storage  dispatch over 8x8 }
  pass mix    : compute { shader "mix.comp" group 8 8 1  read trail as sampled  read extra as sampled  write seen as storage  dispatch over 8x8 })" +
                                       kShow},
                      {"full.vert", "void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0.5, 1.0); }"},
                      {"two.frag", "void main() { vec2 at = floor(gl_FragCoord.xy); base = vec4(at / 255.0, 0, 0); mask = vec4(0, at / 255.0, 0); }"},
                      {"more.frag", "void main() { extra = texelFetch(mask, ivec2(gl_FragCoord.xy), 0).yzzz; }"},
                      {"tone.comp",
                       "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
                       "  tones[8 * at.y + at.x] = uint(255.0 * texelFetch(mask, at, 0).y + 0.5); }"},
                      {"light.comp",
                       "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
                       "  uint old = texelFetch(trail_prev, at, 0).x, base_x = uint(255.0 * texelFetch(base, at, 0).x + 0.5);\n"
                       "  imageStore(trail, at, uvec4(old + 256u * base_x + tones[8 * at.y + at.x])); }"},
                      {"mix.comp",
                       "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
                       "  imageStore(seen, at, uvec4(texelFetch(trail, at, 0).x + 65536u * uint(255.0 * texelFetch(extra, at, 0).y + 0.5))); }"},
                      {"show.comp", kShowShader}};

size_t events_of(const PlanData& plan) {
  return static_cast<size_t>(std::count_if(plan.groups.begin(), plan.groups.end(), [](const BarrierGroup& group) { return group.event != kNone; }));
}

TEST(SplitBarriers, TexelsAreThoseOfWholeOnes) {
  compiler::PlanOptions apart, whole;
  apart.reorder = whole.reorder = false;  // else `more` runs where it is in nobody's way
  whole.split = false;
  EXPECT_GT(events_of(compile_files(kFrame, apart).graphs[0].plans[0].plan), 0u);
  EXPECT_EQ(events_of(compile_files(kFrame, whole).graphs[0].plans[0].plan), 0u);
  const auto with = run(kFrame, 3, true, {}, apart), without = run(kFrame, 3, true, {}, whole);
  if (!with || !without) GTEST_SKIP() << "no device";
  EXPECT_EQ(*with, *without);
  ASSERT_EQ(with->size(), 64u);
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 0; x < 8; ++x) EXPECT_EQ((*with)[8 * y + x], 7 + 3 * (256 * x + x) + 65536 * y) << x << ", " << y;
}

}  // namespace
}  // namespace rg::test
