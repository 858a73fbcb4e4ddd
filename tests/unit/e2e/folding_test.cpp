// Passes that clear and resolve, drawn as passes of their own and as parts of renderings: the same texels.
#include <gtest/gtest.h>

#include "tests/unit/e2e/run_frame.h"

namespace rg::test {
namespace {

// Half of every second pixel is covered, over a clear that shows through; depth and stencil keep what a clear left, so that both decide what is
// drawn.
const Files kFrame = {{"frame.rg", R"(
state left { cull none  depth test less  stencil test equal  stencil reference 3 }
graph frame() {
  image many   : rgba16f 8x8 samples 4
  image solid  : d32f_s8 8x8 samples 4
  image one    : rgba16f 8x8
  image seen   : r32ui 8x8
  pass wipe    : transfer { clear many (0.25, 0.5, 0.75, 1.0)  clear solid (0.5, 3) }
  pass draw    : raster { shader "halves.vert" "tint.frag"  state left  color many blend add(one, one)  depth solid  stencil solid  draw 24 }
  pass flatten : transfer { resolve many -> one }
  pass pack    : compute { shader "pack.comp" group 8 8 1  read one as sampled  write seen as storage  dispatch over 8x8 })" +
                                       kShow},
                      {"halves.vert", R"(void main() {
  int stripe = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
  const vec2 kCorners[6] = vec2[](vec2(0, 0), vec2(0.4, 0), vec2(0, 8), vec2(0.4, 0), vec2(0, 8), vec2(0.4, 8));
  gl_Position = vec4((kCorners[corner] + vec2(2 * stripe, 0)) / 4.0 - 1.0, stripe == 1 ? 0.75 : 0.25, 1.0);
})"},
                      {"tint.frag", "void main() { many = vec4(1.0, 0.5, 0.25, 0.0); }"},
                      {"pack.comp",
                       "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); vec4 c = texelFetch(one, at, 0);\n"
                       "  imageStore(seen, at, uvec4(packUnorm4x8(c * 0.5))); }"},
                      {"show.comp", kShowShader}};

TEST(Folding, TexelsAreThoseOfPassesOfTheirOwn) {
  compiler::PlanOptions apart;
  apart.fold = false;
  EXPECT_EQ(compile_files(kFrame).folded.size(), 2u);
  EXPECT_EQ(compile_files(kFrame).graphs[0].plans[0].plan.passes.size() + 2, compile_files(kFrame, apart).graphs[0].plans[0].plan.passes.size());
  const auto with = run(kFrame, 2, true), without = run(kFrame, 2, true, {}, apart);
  if (!with || !without) GTEST_SKIP() << "no device";
  EXPECT_EQ(*with, *without);
  ASSERT_EQ(with->size(), 64u);
  EXPECT_EQ((*with)[1], 0x80604020u) << "the clear alone";
  EXPECT_EQ((*with)[2], (*with)[3]) << "depth keeps the second stripe away";
  EXPECT_NE((*with)[0], (*with)[1]) << "the first stripe is drawn";
}

}  // namespace
}  // namespace rg::test
