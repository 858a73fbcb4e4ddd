// Techniques as their shaders see them.
#include <gtest/gtest.h>

#include <map>

#include "compiler/compile.h"
#include "tests/unit/in_memory.h"

namespace rg::compiler {
namespace {

constexpr const char* kTwoCameras = R"(
struct Camera { exposure: f32 }
technique seen(out image target: r32f, params camera: Camera) {
  pass draw : compute { shader "draw.comp" group 8 8 1  params camera  write target as storage  dispatch over target }
}
graph frame(params left: Camera, params right: Camera)
{
  image a : r32f 8x8 output
  image b : r32f 8x8 output
  use eye_a = seen(a, left)
  use eye_b = seen(b, right)
}
)";

// A shader calls parameter blocks as the technique does, so that all instances share it; each still reads the block that it was given.
TEST(Techniques, InstancesWithOtherBlocksShareTheShader) {
  const std::map<std::string, std::string> files = {
      {"frame.rg", kTwoCameras}, {"draw.comp", "void main() { imageStore(target, ivec2(gl_GlobalInvocationID.xy), vec4(camera.exposure)); }\n"}};
  CompileOptions options;
  options.until = Until::plans;
  dsl::Diagnostics diagnostics;
  const CompileResult result = compile("frame.rg", test::reader_of(files), options, diagnostics);
  ASSERT_TRUE(diagnostics.rows().empty()) << dsl::print(diagnostics, result.sources, false);
  EXPECT_EQ(result.graphs[0].shaders.shaders.size(), 1u);
  const PlanData& plan = result.graphs[0].plans[0].plan;
  ASSERT_EQ(plan.pass_params.size(), 2u);
  EXPECT_EQ(plan.params[plan.pass_params[0]].name, "left");
  EXPECT_EQ(plan.params[plan.pass_params[1]].name, "right");
}

}  // namespace
}  // namespace rg::compiler
