// Features that only shaders see, on a real driver: each frame runs the variant of its values.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <map>

#include "compiler/compile.h"
#include "runtime/graph.h"

namespace rg::test {
namespace {

const std::map<std::string, std::string> kFiles = {{"frame.rg", R"(module frame
feature double_it : bool
feature path      : { low, mid, high }
graph frame() {
  buffer shown : u32[64] readback
  pass show : compute {
    shader "show.comp" group 64 1 1
    features double_it, path
    write  shown as storage
    dispatch over 64
  }
}
)"},
                                                   {"show.comp", R"(void main() {
  uint value = gl_GlobalInvocationID.x + 100u * path;
  if (double_it) value *= 2u;
#if FEATURE_path == 2
  value += 1u;
#endif
  shown[gl_GlobalInvocationID.x] = value;
}
)"}};

std::vector<uint32_t> words_of(GraphInstance& graph) {
  const auto bytes = graph.readback(0);
  EXPECT_TRUE(bytes);
  std::vector<uint32_t> words(bytes ? (*bytes).size() / 4 : 0);
  if (bytes) std::memcpy(words.data(), (*bytes).data(), words.size() * 4);
  return words;
}

TEST(Features, ChooseTheVariantOfEachFrame) {
  dsl::Diagnostics diagnostics;
  const dsl::ReadSource read = [](const std::string& path, std::string& why) -> std::optional<std::string> {
    const auto file = kFiles.find(path);
    if (file != kFiles.end()) return file->second;
    why = "no such file";
    return std::nullopt;
  };
  compiler::CompileOptions compile_options;
  compile_options.until = compiler::Until::plans;
  const compiler::CompileResult result = compiler::compile("frame.rg", read, compile_options, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.sources, false);
  ASSERT_EQ(result.graphs[0].plans.size(), 1u);
  auto device = Device::create({});
  if (!device && std::getenv("RGC_REQUIRE_GPU")) FAIL() << device.error().message;
  if (!device) GTEST_SKIP() << device.error().message;
  const Plan plan = result.graphs[0].plans[0].plan.view();
  auto graph = GraphInstance::create(*device, plan, {});
  ASSERT_TRUE(graph) << graph.error().message;
  for (uint32_t frame = 0; frame < 12; ++frame) {
    const uint32_t values[] = {frame % 2, frame % 3};
    FrameInputs inputs;
    inputs.features = values;
    const Status status = graph->execute(inputs);
    ASSERT_TRUE(status) << status.error().message;
    const std::vector<uint32_t> shown = words_of(*graph);
    ASSERT_EQ(shown.size(), 64u);
    for (uint32_t i = 0; i < 64; ++i)
      EXPECT_EQ(shown[i], (i + 100 * values[1]) * (values[0] ? 2 : 1) + (values[1] == 2 ? 1 : 0)) << "frame " << frame;
  }
  const uint32_t wrong[] = {0, 3};
  FrameInputs inputs;
  inputs.features = wrong;
  EXPECT_FALSE(graph->execute(inputs));
}

}  // namespace
}  // namespace rg::test
