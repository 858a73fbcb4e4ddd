// Passes that share a rendering: begun once, ended once, unless each has to stand alone.
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

// `world`, then `props` if condition 0 holds, draw into one target; callbacks record both.
test::TestPlan two_passes() {
  test::TestPlan p;
  p.extents.push_back({"view", 2, {8, 4, 1}, {64, 64, 1}});
  const Index width = p.extent_axis(0), height = p.extent_axis(1);
  const Index scene = p.image("scene", test::kRgba8, width, height, test::kColorAttachment);
  p.conditions = {"with_props"};
  p.barriers({test::discard(scene, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment)});
  const Index rendering = test::one_color_rendering(p, scene, width, height, LoadOp::clear, {});
  for (const Index slot : {0u, 1u}) {
    Pass pass;
    pass.name = slot == 0 ? "world" : "props", pass.kind = PassKind::raster, pass.work.kind = WorkKind::host, pass.host_slot = slot;
    pass.rendering = rendering, pass.guard = slot;
    p.pass(pass, {test::touches({scene, 0}, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment, true)});
  }
  return p;
}

void record_nothing(void*, Recording&) {}
constexpr RecordFunction kCallbacks[] = {record_nothing, record_nothing};

class Renderings : public test::NullTest {
 protected:
  std::vector<std::string> renderings(const GraphOptions& options, uint64_t conditions = 1) {
    test::TestPlan plan = two_passes();
    GraphInstance graph = make(plan, options);
    FrameInputs in;
    in.callbacks = kCallbacks, in.conditions = conditions;
    std::vector<std::string> found;
    for (const std::string& line : test::lines(frame(graph, in)))
      if (line.find("Rendering") != std::string::npos) found.push_back(line.substr(line.find("vk")));
    return found;
  }
  static size_t count(const std::vector<std::string>& lines, std::string_view name) {
    return static_cast<size_t>(std::count_if(lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(name); }));
  }
};

TEST_F(Renderings, AreBegunAndEndedOnce) {
  for (const uint32_t threads : {1u, 4u}) {
    GraphOptions options;
    options.threads = threads;
    const auto lines = renderings(options);
    ASSERT_EQ(lines.size(), 2u) << threads;
    EXPECT_EQ(count(lines, "vkCmdBeginRendering"), 1u);
    EXPECT_EQ(count(lines, "vkCmdEndRendering"), 1u);
  }
}

TEST_F(Renderings, EndWhereTheLastPassIsSkipped) {
  const auto lines = renderings({}, 0);
  EXPECT_EQ(count(lines, "vkCmdBeginRendering"), 1u);
  EXPECT_EQ(count(lines, "vkCmdEndRendering"), 1u);
}

TEST_F(Renderings, AreCutWherePassesStandAlone) {
  GraphOptions serial, each;
  serial.serial = true, each.submit_per_pass = true;
  for (const GraphOptions& options : {serial, each}) {
    const auto lines = renderings(options);
    EXPECT_EQ(count(lines, "vkCmdBeginRendering"), 2u);
    EXPECT_EQ(count(lines, "vkCmdEndRendering"), 2u);
  }
}

TEST_F(Renderings, APlanThatBeginsThemInASkippedPassIsRefused) {
  test::TestPlan plan = two_passes();
  plan.passes[0].guard = 1, plan.passes[1].guard = 0;
  const Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), {});
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.error().message, "plan `test`: pass 1: may run where the first pass of its rendering is skipped");
}

TEST_F(Renderings, OwnCommandsEndBetweenThem) {
  test::TestPlan plan = two_passes();
  GraphInstance graph = make(plan);
  const auto handle = [](uintptr_t value) { return reinterpret_cast<VkCommandBuffer>(value); };
  const OwnCommands parts[] = {{handle(1), 0}, {handle(2), kNone}};
  const FrameDone done{reinterpret_cast<VkSemaphore>(uintptr_t{3}), 1};
  EXPECT_EQ(test::message(graph.use_commands(parts, done)),
            "graph `test`: own commands up to `world`, whose rendering the next pass continues; end the part after the last of them, or compile with "
            "`--no-merge=world`");
}

}  // namespace
}  // namespace rg
