// A frame that nobody watches is recorded from packed rows, with timestamps or without; what it records is what a frame with statistics records, but
// for those.
#include <algorithm>

#include "runtime/functions.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using test::TestPlan;

void draw(void*, Recording& recording) { recording.vk.CmdDraw(recording.commands, 3, 1, 0, static_cast<uint32_t>(recording.pass.name.size())); }
constexpr RecordFunction kCallbacks[] = {draw, draw, draw, draw};

// `count` passes in one rendering of `scene`, those of `guarded` under condition 0, each with a label of its own and some in modules; then one
// without attachments.
TestPlan shared(uint32_t count, uint32_t guarded) {
  TestPlan p;
  p.extents.push_back({"view", 2, {8, 8, 1}, {64, 64, 1}});
  const Index width = p.extent_axis(0), height = p.extent_axis(1);
  const Index scene = p.image("scene", test::kRgba8, width, height, test::kColorAttachment);
  p.conditions = {"some"};
  p.barriers({test::discard(scene, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment)});
  const Index rendering = test::one_color_rendering(p, scene, width, height, LoadOp::clear, {});
  constexpr std::string_view kNames[] = {"a", "bb", "ccc"}, kModules[] = {"", "m", "m"};
  for (uint32_t i = 0; i < count; ++i) {
    Pass pass;
    pass.name = kNames[i], pass.module = kModules[i], pass.kind = PassKind::raster, pass.work.kind = WorkKind::host, pass.host_slot = i;
    pass.rendering = rendering, pass.guard = guarded >> i & 1;
    p.pass(pass, {test::touches({scene, 0}, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment, true)});
  }
  p.barriers({}, {}, {{stage::color_attachment_output, access::color_attachment_write, stage::compute_shader, access::shader_sampled_read}});
  Pass last;
  last.name = "last", last.kind = PassKind::compute, last.work.kind = WorkKind::host, last.host_slot = 3, last.guard = guarded >> 3 & 1;
  p.pass(last);
  return p;
}

// Two renderings of two passes each, into transients that acquire their bytes right before.
TestPlan acquired() {
  TestPlan p;
  const Index side = p.constant(8);
  constexpr std::string_view kNames[] = {"a", "bb", "ccc", "dddd"};
  for (Index group = 0; group < 2; ++group) {
    const Index image = p.image(group == 0 ? "first" : "second", test::kRgba8, side, side, test::kColorAttachment);
    const Index barrier = static_cast<Index>(p.image_barriers.size());
    p.barriers({test::discard(image, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment,
                              stage::color_attachment_output)});
    p.acquires.push_back({image, group, barrier, 1, stage::color_attachment_output, access::color_attachment_write, 0, group,
                          static_cast<Index>(p.alias_clocks.size())});
    p.alias_clocks.insert(p.alias_clocks.end(), {group, 2});
    p.releases.push_back({image, stage::color_attachment_output, access::color_attachment_write, 0, group + 1});
    const Index rendering = test::one_color_rendering(p, image, side, side, LoadOp::clear, {});
    for (Index i = 2 * group; i < 2 * group + 2; ++i) {
      Pass pass;
      pass.name = kNames[i], pass.kind = PassKind::raster, pass.work.kind = WorkKind::host, pass.host_slot = i, pass.rendering = rendering;
      p.pass(pass, {test::touches({image, 0}, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment, true)});
    }
  }
  return p;
}

struct Shape {
  std::string name;
  TestPlan plan;
};
std::vector<Shape> shapes() {
  std::vector<Shape> all = {{"clear and copy", test::clear_and_copy().plan},
                            {"counter", test::counter().plan},
                            {"tint", test::tint().plan},
                            {"relay", test::relay().plan},
                            {"mips", test::mips().plan},
                            {"aliased", test::aliased().plan},
                            {"acquired", acquired()}};
  for (const uint32_t guarded : {0u, 2u, 4u, 6u, 8u}) {
    all.push_back({"shared, guarded " + std::to_string(guarded), shared(3, guarded)});
    all.push_back({"alone, guarded " + std::to_string(guarded), shared(1, guarded & 8)});
  }
  return all;
}

bool is_instrument(const std::string& line) { return line.starts_with("vkCmdBeginQuery") || line.starts_with("vkCmdEndQuery"); }

// Whichever pool of queries it is: with statistics there are more of them.
std::string without_pool(std::string line) {
  if (const size_t at = line.find(" queries"); at != std::string::npos) line.erase(at + 8, line.find_first_not_of("0123456789", at + 8) - at - 8);
  return line;
}

// The calls of some frames at changing conditions and active extents, as text; `instruments`: how many were of statistics.
std::vector<std::string> calls_of(TestPlan& plan, GraphOptions options, bool statistics, size_t& instruments) {
  std::string log;
  Device device = Device::null(&log);
  options.statistics = statistics;
  Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), options);
  EXPECT_TRUE(graph) << graph.error().message;
  log.clear();
  const uint32_t step = 1, words[64] = {};
  const std::vector<std::span<const std::byte>> params(plan.params.size(), std::as_bytes(std::span(&step, 1)));
  const std::span<const std::byte> updates[] = {std::as_bytes(std::span(words))};
  for (uint32_t frame = 0; frame < 6; ++frame) {
    FrameInputs inputs;
    inputs.params = params, inputs.updates = updates, inputs.callbacks = kCallbacks, inputs.conditions = frame % 2;
    const int64_t side = frame < 3 ? 8 : 2, extents[] = {side, side < 4 ? side : 4, 1};
    if (!plan.extents.empty()) {
      EXPECT_TRUE(graph->set_active(extents));
    }
    const Status done = graph->execute(inputs);
    EXPECT_TRUE(done) << done.error().message;
  }
  std::vector<std::string> lines;
  for (const std::string& line : test::lines(log)) {
    if (is_instrument(line))
      ++instruments;
    else if (line.find("ResetQueryPool") == std::string::npos)
      lines.push_back(without_pool(line));
  }
  return lines;
}

void expect_same(const Shape& shape, const GraphOptions& options, const std::string& how) {
  TestPlan plan = shape.plan;
  size_t instruments = 0, none = 0;
  const auto watched = calls_of(plan, options, true, instruments), rows = calls_of(plan, options, false, none);
  EXPECT_EQ(rows, watched) << shape.name << ", " << how;
  EXPECT_GT(instruments, 0u) << shape.name;
  EXPECT_EQ(none, 0u) << shape.name;
  EXPECT_GT(rows.size(), 12u) << shape.name;
}

TEST(RecordRows, RecordWhatWatchedFramesRecord) {
  GraphOptions timed, untimed;
  untimed.timestamps = false;
  for (const Shape& shape : shapes()) expect_same(shape, timed, "with timestamps"), expect_same(shape, untimed, "without");
}

TEST(RecordRows, TakeTwoTimestampsAPass) {
  TestPlan plan = shared(3, 2);
  size_t none = 0;
  size_t stamps = 0;
  for (const std::string& line : calls_of(plan, {}, false, none)) stamps += line.find("vkCmdWriteTimestamp2") != std::string::npos;
  EXPECT_EQ(stamps, 6u * 2 * plan.passes.size());
}

TEST(RecordRows, AlsoWithPoisonWithoutAliasingAndOnOneQueue) {
  GraphOptions poisoned, apart, one;
  poisoned.poison = true, apart.aliasing = false, one.single_queue = true;
  for (const Shape& shape : shapes()) {
    expect_same(shape, poisoned, "poisoned");
    expect_same(shape, apart, "without aliasing");
    expect_same(shape, one, "on one queue");
  }
}

// Cut into several command buffers, a group may open the one in which its pass stands: nothing is lost or doubled.
TEST(RecordRows, LoseNothingWhereThreadsCutTheFrame) {
  GraphOptions options;
  options.threads = 3;
  for (const Shape& shape : shapes()) {
    TestPlan plan = shape.plan;
    size_t instruments = 0, none = 0;
    auto watched = calls_of(plan, options, true, instruments), rows = calls_of(plan, options, false, none);
    const auto by_call = [](std::vector<std::string>& lines) {
      std::erase_if(lines, [](const std::string& line) { return line.find("DebugUtilsLabel") != std::string::npos; });  // modules open anew in each
      for (std::string& line : lines)  // whichever command buffer it is in
        if (const size_t at = line.find(" commands"); at != std::string::npos) line.erase(at, line.find_first_not_of("0123456789", at + 9) - at);
      std::sort(lines.begin(), lines.end());
    };
    by_call(watched), by_call(rows);
    EXPECT_EQ(rows, watched) << shape.name;
  }
}

}  // namespace
}  // namespace rg
