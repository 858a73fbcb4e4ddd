// Draws, stencil, targets and views on a real driver: what a frame with each leaves in pixels.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "runtime/graph.h"
#include "tests/unit/e2e/run_frame.h"

namespace rg::test {
namespace {

// The 64 texels after a frame under validation; skips the test without a device.
#define RUN(words, ...)                         \
  const auto found = run(__VA_ARGS__, 1, true); \
  if (!found) GTEST_SKIP() << "no device";      \
  const Words& words = *found;                  \
  ASSERT_EQ(words.size(), 64u)

// What texels and vertices hold is made by a shader as words, and copied.
TEST(Drawing, PackedFieldsArriveAsNumbers) {
  RUN(words, {{"frame.rg", R"(
struct Point { at: vec2  tint: rgba8  normal: rgba8_snorm  uv: rg16f  turn: rgb10a2  size: rg16  slope: r16_snorm  bone: r8ui[2] }
state points { cull none  topology points }
graph frame() {
  image  seen   : r32ui 8x8
  buffer words  : u32[16]
  buffer points : Point[2]
  pass make : compute { shader "make.comp" group 1 1 1  write words as storage  dispatch groups 1 }
  pass load : transfer { copy words -> points }
  pass draw : raster { shader "draw.vert" "draw.frag"  state points  read points as vertex  color seen clear 9  draw 2 { vertex Point } })" +
                               kShow},
              {"make.comp",
               "void main() { for (uint i = 0u; i < 2u; ++i) { uint b = 8u * i;\n"
               "  words[b] = floatBitsToUint(i == 0u ? -0.875 : 0.125); words[b + 1u] = floatBitsToUint(-0.875);\n"
               "  words[b + 2u] = packUnorm4x8(vec4(1.0, 0.2, 0.0, float(i)));\n"
               "  words[b + 3u] = packSnorm4x8(vec4(-1.0, 1.0, 0.0, -float(i)));\n"
               "  words[b + 4u] = packHalf2x16(vec2(-2.5, float(i) + 0.25));\n"
               "  words[b + 5u] = 1023u | (341u << 10) | (i << 20) | (3u << 30);\n"
               "  words[b + 6u] = packUnorm2x16(vec2(0.5, float(i)));\n"
               "  words[b + 7u] = (packSnorm2x16(vec2(-0.5, 0.0)) & 0xFFFFu) | (7u << 16) | ((200u + i) << 24); } }"},
              {"draw.vert",
               "layout(location = 0) flat out uint bits;\n"
               "bool near(vec4 a, vec4 b) { return all(lessThan(abs(a - b), vec4(1e-4))); }\n"
               "void main() { float i = float(gl_VertexIndex); gl_PointSize = 1.0; gl_Position = vec4(at, 0.0, 1.0);\n"
               "  bits = uint(near(tint, vec4(1.0, 0.2, 0.0, i))) | uint(near(normal, vec4(-1.0, 1.0, 0.0, -i))) << 1\n"
               "       | uint(near(vec4(uv, 0.0, 0.0), vec4(-2.5, i + 0.25, 0.0, 0.0))) << 2\n"
               "       | uint(near(turn, vec4(1.0, 1.0 / 3.0, i / 1023.0, 1.0))) << 3\n"
               "       | uint(near(vec4(size, slope, 0.0), vec4(0.5, i, -0.5, 0.0))) << 4\n"
               "       | uint(bone[0] == 7u && bone[1] == 200u + uint(gl_VertexIndex)) << 5; }"},
              {"draw.frag", "layout(location = 0) flat in uint bits;\nvoid main() { seen = uvec4(bits); }"},
              {"show.comp", kShowShader}});
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(words[i], i == 0 || i == 4 ? 63u : 9u) << i;
}

// Vertices 4, 6 and 7 of twelve, once a row for two of the places.
void expect_indexed(const std::string& element, uint32_t width, const std::string& counted) {
  const std::string bytes = "(0, " + std::to_string(8 * width) + ")";
  RUN(words, {{"frame.rg", R"(
extent two = runtime(2) max(3)
struct Vertex { x: f32 }
struct Place { y: f32 }
state points { cull none  topology points }
graph frame() {
  image  seen     : r32ui 8x8
  buffer vertices : Vertex[12]
  buffer places   : Place[4]
  buffer args     : u32[5]
  buffer packed   : u32[)" + std::to_string(2 * width) +
                               R"(]
  buffer indices  : )" + element +
                               R"([8]
  pass make : compute { shader "make.comp" group 1 1 1  write vertices as storage  write places as storage  write packed as storage  write args as storage  dispatch groups 1 }
  pass load : transfer { copy packed -> indices }
  pass draw : raster {
    shader "draw.vert" "draw.frag"
    state  points
    read   vertices as vertex
    read   places.bytes(4, 12) as vertex
    read   indices.bytes)" + bytes +
                               R"( as index
    color  seen clear 99
    draw   )" + counted + R"( { vertex Vertex  instance Place }
  })" + kShow},
              {"make.comp", "const uint kIndices[6] = uint[](9u, 9u, 0u, 2u, 3u, 9u);\nconst uint WIDTH = " + std::to_string(width) + R"(u;
void main() {
  const uint kArguments[5] = uint[](3u, 2u, 2u, 4u, 0u);
  for (uint i = 0u; i < 5u; ++i) args[i] = kArguments[i];
  for (uint i = 0u; i < 12u; ++i) vertices[i].x = (float(i) + 0.5) / 4.0 - 1.0;
  for (uint i = 0u; i < 4u; ++i) places[i].y = (float(i) + 0.5) / 4.0 - 1.0;
  for (uint i = 0u; i < 2u * WIDTH; ++i) packed[i] = 9u;
  for (uint i = 0u; i < 6u; ++i)
    if (WIDTH == 4u || i % 2u == 0u) packed[WIDTH == 4u ? i : i / 2u] = kIndices[i] | (WIDTH == 2u ? kIndices[i + 1u] << 16 : 0u);
})"},
              {"draw.vert",
               "layout(location = 0) flat out uint number;\n"
               "void main() { number = uint(10 * gl_InstanceIndex + gl_VertexIndex); gl_PointSize = 1.0; gl_Position = vec4(x, y, 0.0, 1.0); }"},
              {"draw.frag", "layout(location = 0) flat in uint number;\nvoid main() { seen = uvec4(number); }"},
              {"show.comp", kShowShader}});
  for (uint32_t i = 0; i < 64; ++i) {
    const uint32_t x = i % 8, y = i / 8;
    const bool drawn = (x == 4 || x == 6 || x == 7) && (y == 1 || y == 2);
    EXPECT_EQ(words[i], drawn ? 10 * (y - 1) + x : 99u) << x << " " << y;
  }
}

TEST(Drawing, IndexedDrawsTakeWordsFromWhereTheyAreTold) { expect_indexed("u32", 4, "indexed two + 1 instances two first two - 0 offset 4"); }
TEST(Drawing, IndexedDrawsTakeHalvesOfWords) { expect_indexed("r16ui", 2, "indexed 3 instances 2 first 2 offset 4"); }

TEST(Drawing, IndirectDrawsTakeTheSameBuffers) { expect_indexed("u32", 4, "indexed indirect args"); }

TEST(Drawing, DrawsBeginAtTheirFirstVertex) {
  RUN(words, {{"frame.rg", R"(
state points { cull none  topology points }
graph frame() {
  image seen : r32ui 8x8
  pass draw : raster { shader "draw.vert" "draw.frag"  state points  color seen clear 0  draw 3 instances 2 first 5 })" +
                               kShow},
              {"draw.vert",
               "void main() { gl_PointSize = 1.0;\n"
               "  gl_Position = vec4((float(gl_VertexIndex) + 0.5) / 4.0 - 1.0, (float(gl_InstanceIndex) + 0.5) / 4.0 - 1.0, 0.0, 1.0); }"},
              {"draw.frag", "void main() { seen = uvec4(1); }"},
              {"show.comp", kShowShader}});
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(words[i], i % 8 >= 5 && i / 8 < 2 ? 1u : 0u) << i;
}

// Two triangles that face either way, over the left and the right half; `flip` swaps two corners.
const char* const kHalves =
    "void main() { const int corner = gl_VertexIndex % 3, half_ = gl_VertexIndex / 3;\n"
    "  vec2 at = vec2(half_ == 0 ? -1.0 : 0.0, -1.0) + (corner == 0 ? vec2(0.0) : (corner == 1) != (half_ == 1) ? vec2(0.0, 4.0) : vec2(1.0, 0.0));\n"
    "  gl_Position = vec4(at, 0.5, 1.0); }";

TEST(Drawing, AStencilMaskKeepsPixelsOut) {
  RUN(words, {{"frame.rg", R"(
state mark { cull none  stencil pass replace  stencil reference 3 }
state masked { stencil test equal  stencil reference 7  stencil read_mask 3 }
graph frame() {
  image seen : r32ui 8x8
  image mask : s8 8x8
  pass mark  : raster { fullscreen "mark.frag"  state mark  stencil mask clear 0 }
  pass paint : raster { fullscreen "paint.frag"  state masked  stencil mask readonly  color seen clear 1 })" +
                               kShow},
              {"mark.frag", "void main() { if ((int(gl_FragCoord.x) + int(gl_FragCoord.y)) % 3 != 0) discard; }"},
              {"paint.frag", "void main() { seen = uvec4(2); }"},
              {"show.comp", kShowShader}});
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(words[i], (i % 8 + i / 8) % 3 == 0 ? 2u : 1u) << i;
}

// Front faces count up, back faces down, where the depth test fails; the write mask keeps the upper bits.
TEST(Drawing, StencilTellsFrontFromBack) {
  RUN(words, {{"frame.rg", R"(
state count {
  cull none
  depth test less
  stencil write_mask 15
  stencil_front depth_fail increment_wrap
  stencil_back  depth_fail decrement_wrap
  stencil fail zero
}
graph frame() {
  image seen : r32ui 8x8
  image both : d32f_s8 8x8
  pass count : raster { shader "halves.vert" "none.frag"  state count  depth both clear 0.25  stencil both clear 32  draw 6 }
  pass look  : raster { fullscreen "look.frag"  read both.stencil as sampled  color seen })" +
                               kShow},
              {"halves.vert", kHalves},
              {"none.frag", "void main() {}"},
              {"look.frag", "void main() { seen = texelFetch(both_stencil, ivec2(gl_FragCoord.xy), 0); }"},
              {"show.comp", kShowShader}});
  // Corner 0 of both halves covers its lower left: what is drawn is 33 on one side, 32 + 15 on the other.
  std::map<uint32_t, uint32_t> left, right;
  for (uint32_t i = 0; i < 64; ++i) ++(i % 8 < 4 ? left : right)[words[i]];
  EXPECT_GT(left[33] + left[47], 8u);
  EXPECT_GT(right[33] + right[47], 8u);
  EXPECT_NE(left.contains(33) && left[33] > 0, right.contains(33) && right[33] > 0);
  for (const auto& side : {left, right})
    for (const auto& [value, count] : side) EXPECT_TRUE(count == 0 || value == 32 || value == 33 || value == 47) << value;
}

TEST(Drawing, AttachmentsAreSeenInOtherFormats) {
  RUN(words, {{"frame.rg", R"(
graph frame() {
  image seen : r32ui 8x8
  pass paint : raster { fullscreen "paint.frag"  color texel = seen.view(rgba8) })" +
                               kShow},
              {"paint.frag", "void main() { texel = vec4(floor(gl_FragCoord.x) / 255.0, 0.2, 0.0, 1.0); }"},
              {"show.comp", kShowShader}});
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(words[i], 0xFF003300u + i % 8) << i;
}

const char* const kShowVolume =
    "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); shown[8 * at.y + at.x] = texelFetch(volume, ivec3(at.x, at.y % 4, at.y / 4), 0).x; }";

// All slices together are the volume; those that are drawn later change no others.
TEST(Drawing, SlicesOfVolumesAreDrawnOneByOne) {
  RUN(words, {{"frame.rg", R"(
graph frame() {
  image  volume : r32ui 8x4x2
  buffer shown  : u32[64] readback
  pass near  : raster { fullscreen "near.frag"  color volume.slice(0) }
  pass far   : raster { fullscreen "far.frag"  color volume.slice(1) }
  pass again : raster { shader "one.vert" "one.frag"  state points  color volume.slice(1)  draw 1 }
  pass show  : compute { shader "show.comp" group 8 8 1  read volume as sampled  write shown as storage  dispatch over 8x8 }
}
state points { cull none  topology points }
)"},
              {"near.frag", "void main() { volume = uvec4(100 + int(gl_FragCoord.y)); }"},
              {"far.frag", "void main() { volume = uvec4(200 + int(gl_FragCoord.y)); }"},
              {"one.vert", "void main() { gl_PointSize = 1.0; gl_Position = vec4(-0.875, -0.75, 0.0, 1.0); }"},
              {"one.frag", "void main() { volume = uvec4(7); }"},
              {"show.comp", kShowVolume}});
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(words[i], i == 32 ? 7u : (i < 32 ? 100 : 200) + i / 8 % 4) << i;
}

// A clear of some slices leaves the others, and their mip.
TEST(Drawing, SlicesAreClearedApart) {
  RUN(words, {{"frame.rg", R"(
graph frame() {
  image  volume : r32ui 16x8x4 mips 2
  buffer shown  : u32[64] readback
  pass start : transfer { clear volume 5 }
  pass reset : raster { shader "none.vert" "none.frag"  color volume.mip(1).slices(1, 1) clear 6  draw 3 }
  pass both  : raster { shader "none.vert" "none.frag"  color volume.mip(0).slices(1, 2) clear 8  draw 3 }
  pass show  : compute { shader "show.comp" group 8 8 1  read volume as sampled  write shown as storage  dispatch over 8x8 }
}
)"},
              {"none.vert", "void main() { gl_Position = vec4(2.0, 2.0, 0.0, 1.0); }"},
              {"none.frag", "void main() { volume = uvec4(0); }"},
              {"show.comp",
               "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); int z = at.y / 2;\n"
               "  shown[8 * at.y + at.x] = texelFetch(volume, ivec3(at, z), 0).x + 10u * texelFetch(volume, ivec3(at.x, at.y % 4, z / 2), 1).x; }"}});
  for (uint32_t i = 0; i < 64; ++i) {
    const uint32_t z = i / 16;
    EXPECT_EQ(words[i], (z == 1 || z == 2 ? 8u : 5u) + 10 * (z / 2 == 1 ? 6 : 5)) << i;
  }
}

const Files kStereo = {
    {"frame.rg", R"(
struct Vertex { at: vec2 }
graph frame() {
  image  eyes  : r32ui 8x8 layers 3
  image  seen  : r32ui 8x8 layers 3
  buffer shown : u32[64] readback
  pass draw  : raster { multiview  fullscreen "draw.frag"  color eyes }
  pass twice : raster { multiview  fullscreen "twice.frag"  read eyes as input  color seen }
  pass show  : compute { shader "show.comp" group 8 8 1  read seen as sampled  write shown as storage  dispatch over 8x8 }
}
)"},
    {"draw.frag", "void main() { eyes = uvec4(100 * gl_ViewIndex + int(gl_FragCoord.x)); }"},
    {"twice.frag", "void main() { seen = eyes * 2u + uint(gl_ViewIndex); }"},
    {"show.comp",
     "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); shown[8 * at.y + at.x] = texelFetch(seen, ivec3(at, at.y % 3), 0).x; }"}};

TEST(Drawing, EveryViewIsDrawn) {
  auto device = Device::create({});
  if (device && !device->has(Capability::multiview))
    GTEST_SKIP() << "`" << device->name() << "` has no multiview; ./x test --driver backports brings one that has";
  RUN(words, kStereo);
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(words[i], 2 * (100 * (i / 8 % 3) + i % 8) + i / 8 % 3) << i;
}

TEST(Drawing, ViewsAreRefusedWithoutTheFeature) {
  const compiler::CompileResult result = compile_files(kStereo);
  ASSERT_FALSE(result.graphs.empty());
  expect_proved(result);
  const Plan plan = result.graphs[0].plans[0].plan.view();
  ASSERT_EQ(plan.renderings.size(), 2u);
  EXPECT_EQ(plan.renderings[0].view_mask, 7u);
  ASSERT_EQ(plan.needs.size(), 1u);
  EXPECT_EQ(plan.needs[0], Capability::multiview);
  DeviceOptions options;
  options.without = {Capability::multiview};
  auto device = Device::create(options);
  if (!device && !std::getenv("RGC_REQUIRE_GPU")) GTEST_SKIP() << device.error().message;
  ASSERT_TRUE(device) << device.error().message;
  const auto graph = GraphInstance::create(*device, plan, {});
  ASSERT_FALSE(graph);
  EXPECT_NE(graph.error().message.find("plan `frame` is for devices with multiview, which"), std::string::npos) << graph.error().message;
}

// Halves of a buffer whose length is chosen later: together they are all of it.
TEST(Drawing, RangesOfRuntimeLengthAddUp) {
  RUN(words, {{"frame.rg", R"(
extent n = runtime(64) min(2) max(1000)
graph frame() {
  buffer words : u32[n]
  buffer shown : u32[n] readback
  pass left  : compute { shader "left.comp" group 8 1 1  write part = words.bytes(0, n / 2 * 4) as storage  dispatch over n / 2 }
  pass right : compute { shader "right.comp" group 8 1 1  write part = words.bytes(n / 2 * 4, (n - n / 2) * 4) as storage  dispatch over n - n / 2 }
  pass show  : compute { shader "show.comp" group 8 1 1  read words as storage  write shown as storage  dispatch over n }
}
)"},
              {"left.comp", "void main() { part[gl_GlobalInvocationID.x] = 1u + gl_GlobalInvocationID.x; }"},
              {"right.comp", "void main() { part[gl_GlobalInvocationID.x] = 1000u + gl_GlobalInvocationID.x; }"},
              {"show.comp", "void main() { shown[gl_GlobalInvocationID.x] = words[gl_GlobalInvocationID.x]; }"}});
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(words[i], i < 32 ? 1 + i : 1000 + i - 32) << i;
}

}  // namespace
}  // namespace rg::test
