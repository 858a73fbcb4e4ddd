#include "compiler/shaders/reflect.h"

#include <gtest/gtest.h>

#include "compiler/shaders/glslang_front_end.h"
#include "compiler/shaders/spirv_uses.h"

namespace rg::compiler {
namespace {

Words compile(const std::string& glsl, dsl::Stage stage = dsl::stage_compute) {
  ShaderSources sources([](const std::string&, std::string&) { return std::nullopt; });
  const FrontEndOutput output = compile_glsl(stage, "#version 460\n", "test", glsl, sources);
  EXPECT_TRUE(output.errors.empty()) << (output.errors.empty() ? "" : output.errors[0].text);
  return output.words;
}

const std::string kStructs =
    "layout(local_size_x = 1) in;\n"
    "struct Sun { vec3 direction; float intensity; };\n"
    "struct View { mat4 clip; vec3 camera; Sun sun; float weights[3]; };\n";

TEST(Reflect, OffsetsDependOnTheBlock) {
  const Reflection reflection = reflect(compile(kStructs + "layout(set = 1, binding = 0, std140) uniform rg_block_a { View a; };\n"
                                                           "layout(set = 1, binding = 1, std430) buffer rg_block_b { View b[]; };\n"
                                                           "void main() { b[0].weights[1] = a.weights[2] + a.sun.intensity; }\n"));
  const std::vector<ReflectedStruct> expected = {
      {"View", true, {0, 64, 80, 96}}, {"Sun", true, {0, 12}}, {"View", false, {0, 64, 80, 96}}, {"Sun", false, {0, 12}}};
  EXPECT_EQ(reflection.structs, expected);
}

TEST(Reflect, BindingsAndStaticUse) {
  const Reflection reflection =
      reflect(compile("layout(local_size_x = 1) in;\n"
                      "layout(set = 1, binding = 2, std430) buffer rg_block_b { uint b[]; };\n"
                      "layout(set = 1, binding = 0) uniform sampler2DArray layers;\n"
                      "layout(set = 1, binding = 1, rgba16f) uniform image3D volume;\n"
                      "void main() { b[0] = uint(texelFetch(layers, ivec3(0), 0).x); }\n"));
  const std::vector<ReflectedBinding> expected = {
      {"layers", 1, 0, BindingKind::combined_sampler, dsl::Dimension::d2, true, true},
      {"volume", 1, 1, BindingKind::storage_image, dsl::Dimension::d3, false, false},
      {"b", 1, 2, BindingKind::storage_buffer, dsl::Dimension::d2, false, true},
  };
  EXPECT_EQ(reflection.bindings, expected);
}

struct Flags {
  bool touched, reads, writes, atomics;
  friend bool operator==(const Flags&, const Flags&) = default;
};

Flags uses_of(const std::string& statement) {
  const Words words =
      optimise_spirv(compile("layout(local_size_x = 1) in;\n"
                             "layout(set = 1, binding = 0, std430) buffer B { uint b[]; };\n"
                             "layout(set = 1, binding = 1, std430) buffer Out { uint result; };\n"
                             "layout(set = 1, binding = 2, r32ui) uniform uimage2D i;\n"
                             "layout(set = 1, binding = 3) uniform sampler2D t;\n"
                             "uint through(uint at) { if (at > 3u) return b[at]; return 7u; }\n"
                             "void main() { uint v = gl_WorkGroupID.x; " +
                             statement + " }\n"));
  const ModuleUse use = find_uses(words).descriptors[{1, 0}], image = find_uses(words).descriptors[{1, 2}],
                  sampled = find_uses(words).descriptors[{1, 3}];
  return {use.touched || image.touched || sampled.touched, use.reads || image.reads || sampled.reads, use.writes || image.writes,
          use.atomics || image.atomics};
}

TEST(SpirvUses, EveryKindOfUse) {
  EXPECT_EQ(uses_of("result = v;"), (Flags{false, false, false, false}));
  EXPECT_EQ(uses_of("result = b[v];"), (Flags{true, true, false, false}));
  EXPECT_EQ(uses_of("b[v] = v;"), (Flags{true, false, true, false}));
  EXPECT_EQ(uses_of("b[v] += v;"), (Flags{true, true, true, false}));
  EXPECT_EQ(uses_of("atomicAdd(b[v], 1u);"), (Flags{true, false, false, true}));
  EXPECT_EQ(uses_of("result = uint(b.length());"), (Flags{true, false, false, false}));
  EXPECT_EQ(uses_of("result = through(v);"), (Flags{true, true, false, false}));
  EXPECT_EQ(uses_of("result = imageLoad(i, ivec2(v)).x;"), (Flags{true, true, false, false}));
  EXPECT_EQ(uses_of("imageStore(i, ivec2(v), uvec4(v));"), (Flags{true, false, true, false}));
  EXPECT_EQ(uses_of("imageAtomicOr(i, ivec2(v), 1u);"), (Flags{true, false, false, true}));
  EXPECT_EQ(uses_of("result = uint(imageSize(i).x);"), (Flags{true, false, false, false}));
  EXPECT_EQ(uses_of("result = uint(textureLod(t, vec2(v), 0.0).x);"), (Flags{true, true, false, false}));
}

// A branch that constants rule out is no use.
TEST(SpirvUses, DeadCodeIsNoUse) { EXPECT_EQ(uses_of("const bool off = false; if (off) b[v] = v;"), (Flags{false, false, false, false})); }

TEST(SpirvUses, OutputsByLocation) {
  const ModuleUses uses =
      find_uses(compile("layout(location = 0) out vec4 a;\nlayout(location = 1) out vec4 b;\nvoid main() { b = vec4(1); }\n", dsl::stage_fragment));
  EXPECT_FALSE(uses.outputs.at(0).writes);
  EXPECT_TRUE(uses.outputs.at(1).writes);
}

TEST(SpirvUses, StrippedModulesStayValid) {
  const Words words = strip_spirv(optimise_spirv(compile(kStructs + "void main() {}\n")));
  EXPECT_EQ(validate_spirv(words), "");
  EXPECT_NE(validate_spirv({0x07230203, 0x00010500, 0, 1, 0, 0}), "");
}

}  // namespace
}  // namespace rg::compiler
