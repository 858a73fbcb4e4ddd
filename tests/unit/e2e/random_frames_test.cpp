// The whole way on a real driver: random programs, compiled, proved, executed, compared with program order.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "compiler/compile.h"
#include "compiler/verify/verify.h"
#include "random_frame.h"
#include "runtime/graph.h"
#include "tests/unit/in_memory.h"

namespace rg::test {
namespace {

constexpr uint32_t kFrames = 4;

compiler::CompileResult compile_frame(const RandomFrame& frame, const compiler::PlanOptions& plan, uint64_t seed) {
  dsl::Diagnostics diagnostics;
  compiler::CompileOptions options;
  options.until = compiler::Until::plans;
  options.plan = plan;
  compiler::CompileResult result = compiler::compile("random.rg", reader_of(frame.files), options, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << "seed " << seed << "\n" << dsl::print(diagnostics, result.sources, false) << frame.files.at("random.rg");
  return result;
}

Index resource_named(const Plan& plan, std::string_view name) {
  for (Index i = 0; i < plan.resources.size(); ++i)
    if (plan.resources[i].name == name) return i;
  return kNone;
}

std::vector<uint32_t> read_words(GraphInstance& graph, const Plan& plan, std::string_view name) {
  const auto bytes = graph.readback(resource_named(plan, name));
  EXPECT_TRUE(bytes) << (bytes ? "" : bytes.error().message);
  std::vector<uint32_t> words(bytes ? (*bytes).size() / 4 : 0);
  if (bytes) std::memcpy(words.data(), (*bytes).data(), words.size() * 4);
  return words;
}

void expect_numbers(const RandomFrame& frame, uint32_t at, const std::vector<uint32_t>& least, const std::vector<uint32_t>& greatest, uint64_t seed) {
  for (size_t i = 0; i < frame.probes.size(); ++i) {
    EXPECT_EQ(least.at(i), frame.expected[at][i]) << "seed " << seed << ", frame " << at << ", least of " << frame.probes[i];
    EXPECT_EQ(greatest.at(i), frame.expected[at][i]) << "seed " << seed << ", frame " << at << ", greatest of " << frame.probes[i];
  }
}

void execute(Device& device, const RandomFrame& frame, const compiler::CompileResult& result, const GraphOptions& options, uint64_t seed) {
  const Plan plan = result.graphs[0].plans[0].plan.view();
  auto graph = GraphInstance::create(device, plan, options);
  ASSERT_TRUE(graph) << graph.error().message;
  for (uint32_t at = 0; at < kFrames; ++at) {
    const Status status = graph->execute({});
    ASSERT_TRUE(status) << status.error().message;
    const std::vector<uint32_t> least = read_words(*graph, plan, "least_found");
    expect_numbers(frame, at, least, read_words(*graph, plan, "greatest_found"), seed);
    if (testing::Test::HasFailure()) return;
  }
}

std::string findings_text(const std::vector<verify::Finding>& findings) {
  std::string text;
  for (const verify::Finding& finding : findings) text += std::string(verify::name(finding.hazard)) + ": " + finding.text + "\n";
  return text;
}

void prove(const compiler::CompileResult& result, uint64_t seed) {
  const compiler::FramePlan& frame = result.graphs[0].plans[0];
  const auto findings =
      verify::verify(result.program, dsl::GraphId{0}, frame.configuration, frame.plan.view(), frame.plan.program_pass, frame.plan.program_resource);
  EXPECT_TRUE(findings.empty()) << "seed " << seed << "\n" << findings_text(findings);
}

struct RandomFrames : testing::Test {
  void open(bool validate) {
    DeviceOptions options;
    options.validate = validate;
    options.on_message = [this](bool, std::string_view message) { messages += std::string(message) + "\n"; };
    auto created = Device::create(options);
    if (created) device.emplace(std::move(*created));
    const bool required = std::getenv("RGC_REQUIRE_GPU") != nullptr;
    if (!device && required) FAIL() << created.error().message;
    if (!device) GTEST_SKIP() << created.error().message;
  }

  void run(uint64_t first, uint64_t count, uint32_t passes, const compiler::PlanOptions& plan, const GraphOptions& options) {
    for (uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
      RandomFrame frame = make_random_frame(seed, passes, kFrames);
      if (std::string& text = frame.files["random.rg"]; split) text.insert(text.find('\n') + 1, "target vulkan 1.3 with split_barriers\n");
      const compiler::CompileResult result = compile_frame(frame, plan, seed);
      if (HasFailure()) return;
      prove(result, seed);
      for (const BarrierGroup& group : result.graphs[0].plans[0].plan.groups) events += group.event != kNone;
      execute(*device, frame, result, options, seed);
      EXPECT_EQ(messages, "") << "seed " << seed << "\n" << frame.files.at("random.rg");
    }
  }

  uint64_t seeds() const {
    const char* text = std::getenv("RGC_RANDOM_FRAMES");
    return text ? std::strtoull(text, nullptr, 10) : 12;
  }

  std::string messages;
  std::optional<Device> device;
  bool split = false;  // barriers, with events
  size_t events = 0;
};

TEST_F(RandomFrames, MeanWhatProgramOrderSays) {
  open(false);
  if (device) run(1, seeds(), 14, {}, {});
}

TEST_F(RandomFrames, MeanTheSameWithoutAliasingAndReordering) {
  open(false);
  if (device) run(1, seeds() / 2, 14, {.aliasing = false, .reorder = false, .merge = false, .discard = false}, {.aliasing = false});
}

TEST_F(RandomFrames, ValidationStaysSilent) {
  open(true);
  if (device) run(1001, seeds() / 2, 14, {}, {});
}

TEST_F(RandomFrames, MeanTheSameWithSplitBarriers) {
  split = true;
  open(true);
  if (device) run(2001, seeds(), 24, {.reorder = false}, {});
  if (device) {
    EXPECT_GT(events, 0u);
  }
}

}  // namespace
}  // namespace rg::test
