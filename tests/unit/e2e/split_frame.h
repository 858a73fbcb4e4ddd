// A frame with a barrier that has an event: raster, compute and transfer; attachments, sampled and storage images, buffers, history, a read-back.
#pragma once

#include "tests/unit/e2e/run_frame.h"

namespace rg::test {

// In the order written, `tone`, `more`, which draws, and `twin` stand between `first` and `light`, which reads what it drew. After n frames
// word 8 y + x is 7 + n (256 x + x) + 65536 y.
inline const Files kSplitFrame = {
    {"frame.rg", R"(
target vulkan 1.3 with split_barriers
state flat { cull none }
graph frame() {
  image base   : rgba8 8x8
  image mask   : rgba8 8x8
  image extra  : rgba8 8x8
  buffer tones : u32[64]
  buffer twins : u32[64]
  image trail  : r32ui 8x8 history 1 init clear 7
  image seen   : r32ui 8x8
  pass first  : raster { shader "full.vert" "two.frag"  state flat  color base clear 0  color mask clear 0  draw 3 }
  pass tone   : compute { shader "tone.comp" group 8 8 1  read mask as sampled  write tones as storage  dispatch over 8x8 }
  pass more   : raster { shader "full.vert" "more.frag"  state flat  read mask as sampled in fragment  color extra clear 0  draw 3 }
  pass twin   : transfer { copy tones -> twins }
  pass light  : compute { shader "light.comp" group 8 8 1  read base as sampled  read twins as storage  read trail.prev(1) as sampled  write trail as storage  dispatch over 8x8 }
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
     "  imageStore(trail, at, uvec4(old + 256u * base_x + twins[8 * at.y + at.x])); }"},
    {"mix.comp",
     "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
     "  imageStore(seen, at, uvec4(texelFetch(trail, at, 0).x + 65536u * uint(255.0 * texelFetch(extra, at, 0).y + 0.5))); }"},
    {"show.comp", kShowShader}};

}  // namespace rg::test
