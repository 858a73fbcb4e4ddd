// Features that only shaders see, on a real driver: each frame runs the variant of its values.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "runtime/graph.h"
#include "tests/unit/e2e/compiled.h"

namespace rg::test {
namespace {

const Files kFiles = {{"frame.rg", R"(module frame
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
  const compiler::CompileResult result = compile_files(kFiles);
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

// Adds where `add` is on, and sums a row by what the device has.
const Files kDevice = {{"frame.rg", R"(module frame
feature add  : bool
feature sums : device subgroup_arithmetic
graph frame() {
  buffer shown : u32[65] readback
  pass show : compute {
    shader "show.comp" group 64 1 1
    features sums
    write  shown as storage
    dispatch groups 1
  }
  when add {
    pass more : compute {
      shader "more.comp" group 65 1 1
      update shown as storage
      dispatch groups 1
    }
  }
}
)"},
                       {"show.comp", R"(
#if FEATURE_sums
#extension GL_KHR_shader_subgroup_arithmetic : require
#endif
shared uint total;
void main() {
  uint i = gl_LocalInvocationIndex, value = i * i;
  if (i == 0u) total = 0u;
  barrier();
#if FEATURE_sums
  uint sum = subgroupAdd(value);
  if (subgroupElect()) atomicAdd(total, sum);
#else
  atomicAdd(total, value);
#endif
  barrier();
  shown[i] = i;
  if (i == 0u) shown[64] = total;
}
)"},
                       {"more.comp", "void main() { shown[gl_LocalInvocationIndex] += 1000u; }\n"}};

void expect_frames(Device& device, const Plan& plan) {
  auto graph = GraphInstance::create(device, plan, {});
  ASSERT_TRUE(graph) << graph.error().message;
  for (uint32_t frame = 0; frame < 6; ++frame) {
    const uint32_t values[] = {0, frame % 2};  // sums, which nobody asks; add
    FrameInputs inputs;
    inputs.features = values;
    const Status status = graph->execute(inputs);
    ASSERT_TRUE(status) << status.error().message;
    const std::vector<uint32_t> shown = words_of(*graph);
    ASSERT_EQ(shown.size(), 65u);
    const uint32_t more = frame % 2 == 0 ? 0 : 1000;
    EXPECT_EQ(shown[64], 85344u + more) << "frame " << frame;
    for (uint32_t i = 0; i < 64; ++i) ASSERT_EQ(shown[i], i + more) << "frame " << frame;
  }
}

TEST(Features, OfTheDeviceAndOfFramesGiveTheSameResult) {
  const compiler::CompileResult result = compile_files(kDevice);
  ASSERT_EQ(result.graphs[0].plans.size(), 1u);
  const Plan plan = result.graphs[0].plans[0].plan.view();
  ASSERT_EQ(plan.features.size(), 2u);
  EXPECT_EQ(plan.features[0].name, "sums");
  ASSERT_EQ(plan.feature_conditions.size(), 1u);
  auto device = Device::create({});
  if (!device && std::getenv("RGC_REQUIRE_GPU")) FAIL() << device.error().message;
  if (!device) GTEST_SKIP() << device.error().message;
  expect_frames(*device, plan);
  DeviceOptions without;
  without.without = {Capability::subgroup_arithmetic};
  auto plain = Device::create(without);
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_FALSE(plain->has(Capability::subgroup_arithmetic));
  expect_frames(*plain, plan);
}

// What does not fit the device is not created: a null device tells pipelines by the SPIR-V they are made of.
TEST(Features, PipelinesThatTheDeviceCannotRunAreNotCreated) {
  const compiler::CompileResult result = compile_files(kDevice);
  const Plan plan = result.graphs[0].plans[0].plan.view();
  const auto pipelines = [&](std::vector<Capability> has) {
    std::string log;
    NullOptions options;
    options.capabilities = std::move(has);
    Device device = Device::null(&log, options);
    auto graph = GraphInstance::create(device, plan, {});
    EXPECT_TRUE(graph);
    size_t count = 0;
    for (size_t at = log.find("vkCreateComputePipelines"); at != std::string::npos; at = log.find("vkCreateComputePipelines", at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(pipelines({}), 2u);
  EXPECT_EQ(pipelines({Capability::subgroup_arithmetic}), 2u);
}

// Where `when` asks for what the device can do there is a plan for each answer, and the one with it is not for devices without.
TEST(Features, PlansForDevicesThatCanAreRefusedByTheOthers) {
  const Files files = {{"frame.rg", R"(module frame
feature wide : device subgroup_size_64
graph frame() {
  buffer shown : u32[64] readback
  when wide {
    pass fast : compute { shader "show.comp" group 64 1 1  write shown as storage  dispatch over 64 }
  } else {
    pass slow : compute { shader "show.comp" group 32 1 1  write shown as storage  dispatch over 64 }
  }
}
)"},
                       {"show.comp", "void main() { shown[gl_GlobalInvocationID.x] = gl_LocalInvocationIndex; }\n"}};
  const compiler::CompileResult result = compile_files(files);
  ASSERT_EQ(result.graphs[0].plans.size(), 2u);
  const Plan without = result.graphs[0].plans[0].plan.view(), with = result.graphs[0].plans[1].plan.view();
  EXPECT_TRUE(without.needs.empty());
  ASSERT_EQ(with.needs.size(), 1u);
  EXPECT_EQ(with.needs[0], Capability::subgroup_size_64);
  Device plain = Device::null(nullptr);
  EXPECT_TRUE(GraphInstance::create(plain, without, {}));
  const auto refused = GraphInstance::create(plain, with, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_NE(refused.error().message.find("subgroup_size_64"), std::string::npos) << refused.error().message;
  NullOptions options;
  options.capabilities = {Capability::subgroup_size_64};
  Device able = Device::null(nullptr, options);
  EXPECT_TRUE(GraphInstance::create(able, with, {}));
}

}  // namespace
}  // namespace rg::test
