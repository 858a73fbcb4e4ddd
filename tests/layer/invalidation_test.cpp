// Persistent contents that one queue writes and another reads start again between frames: right under every order that the waits allow, and silent.
#include <random>

#include "compiler/verify/verify.h"
#include "tests/layer/under_layer.h"
#include "tests/unit/device/fixture.h"
#include "tests/unit/e2e/compiled.h"

namespace rg {
namespace {

constexpr uint32_t kTotal = 7, kTrail = 3;  // initial values

// The compute queue counts up in a buffer and in an image that the graphics queue shows.
const test::Files kFiles = {{"frame.rg", R"(
graph frame() {
  buffer total : u32[64] persistent init clear 7
  image  trail : r32ui 8x8 persistent init clear 3
  buffer past  : u32[64] history 1 init clear 7
  buffer sums  : u32[192] readback
  pass grow : compute queue compute {
    shader "grow.comp" group 8 8 1
    update total as storage
    update trail as storage
    read   past.prev(1) as storage
    write  past as storage
    dispatch over trail
  }
  pass show : compute queue graphics {
    shader "show.comp" group 8 8 1
    read  total as storage
    read  trail as sampled
    read  past as storage
    write sums as storage
    dispatch over trail
  }
})"},
                            {"grow.comp", R"(void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  uint i = uint(8 * at.y + at.x);
  total[i] += 1u;
  imageStore(trail, at, uvec4(imageLoad(trail, at).x + 2u));
  past[i] = past_prev[i] + 3u;
})"},
                            {"show.comp", R"(void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  uint i = uint(8 * at.y + at.x);
  sums[i] = total[i];
  sums[64u + i] = texelFetch(trail, at, 0).x;
  sums[128u + i] = past[i];
})"}};

struct Planned {
  compiler::CompileResult result;
  Plan plan;
  Index total = kNone, trail = kNone, past = kNone, sums = kNone;
};

Planned make_plan() {
  compiler::CompileOptions options;
  options.until = compiler::Until::plans;
  options.plan.queues = {dsl::QueueKind::graphics, dsl::QueueKind::compute};
  dsl::Diagnostics diagnostics;
  Planned out{compiler::compile("frame.rg", test::reader_of(kFiles), options, diagnostics), {}};
  EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, out.result.sources, false);
  if (diagnostics.has_errors()) return out;
  const compiler::FramePlan& frame = out.result.graphs[0].plans[0];
  out.plan = frame.plan.view();
  for (const verify::Finding& finding : verify::verify(out.result.program, out.result.graphs[0].graph, frame.configuration, out.plan,
                                                       frame.plan.program_pass, frame.plan.program_resource))
    ADD_FAILURE() << finding.text;
  for (Index r = 0; r < out.plan.resources.size(); ++r) {
    const std::string_view name = out.plan.resources[r].name;
    Index* const found = name == "total"   ? &out.total
                         : name == "trail" ? &out.trail
                         : name == "past"  ? &out.past
                         : name == "sums"  ? &out.sums
                                           : nullptr;
    if (found != nullptr) *found = r;
  }
  EXPECT_EQ(out.plan.queues.size(), 2u);
  EXPECT_TRUE(out.total != kNone && out.trail != kNone && out.past != kNone && out.sums != kNone);
  return out;
}

// What the words have to be, by a count of frames since each last began.
struct Expected {
  uint32_t total = kTotal, trail = kTrail, past = kTotal;
  void step() { total += 1, trail += 2, past += 3; }
  std::vector<uint32_t> words() const {
    std::vector<uint32_t> all(64, total);
    all.insert(all.end(), 64, trail), all.insert(all.end(), 64, past);
    return all;
  }
};

void expect_words(GraphInstance& graph, const Planned& planned, const Expected& expected, const std::string& where) {
  const auto words = graph.readback(planned.sums);
  ASSERT_TRUE(words) << words.error().message;
  ASSERT_EQ(test::as<uint32_t>(*words), expected.words()) << where;
}

// Frames in a row; before some of them some resources start again. Results are looked at now and then: what nobody waits for overlaps.
void run(Device& device, const Planned& planned, uint32_t seed, const GraphOptions& options) {
  Result<GraphInstance> graph = GraphInstance::create(device, planned.plan, options);
  ASSERT_TRUE(graph) << graph.error().message;
  std::mt19937 random(seed);
  Expected expected;
  for (uint32_t frame = 0; frame < 24; ++frame) {
    const auto start_again = static_cast<uint32_t>(random() % 16);  // a bit each, and often none
    if ((start_again & 9) == 1) {
      RG_ASSERT_OK(graph->invalidate(planned.total));
      expected.total = kTotal;
    }
    if ((start_again & 10) == 2) {
      RG_ASSERT_OK(graph->invalidate(planned.trail));
      expected.trail = kTrail;
    }
    if ((start_again & 12) == 4) {
      RG_ASSERT_OK(graph->invalidate(planned.past));
      expected.past = kTotal;
    }
    RG_ASSERT_OK(graph->execute({}));
    expected.step();
    if (random() % 4 == 0) expect_words(*graph, planned, expected, "seed " + std::to_string(seed) + ", frame " + std::to_string(frame));
  }
  expect_words(*graph, planned, expected, "seed " + std::to_string(seed) + ", at the end");
}

class Invalidation : public test::DeviceTest {
 protected:
  std::optional<Device> open_layer(std::optional<int> seed, bool validate) {
    Result<Device> device =
        test::open_under_layer(RGC_LAYER_FOLDER, seed, validate, [this](bool, std::string_view message) { messages.emplace_back(message); });
    EXPECT_TRUE(device) << device.error().message;
    return device ? std::optional(std::move(*device)) : std::nullopt;
  }
};

TEST_F(Invalidation, IsRightAndSilentInTheOrderOfTheCalls) {
  const Planned planned = make_plan();
  ASSERT_FALSE(HasFailure());
  auto device = open_layer(std::nullopt, true);
  ASSERT_TRUE(device);
  GraphOptions options;
  options.frames_in_flight = 1;  // the validation layer misjudges frames of several queues that overlap
  for (uint32_t seed = 0; seed < 4; ++seed) run(*device, planned, seed, options);
  EXPECT_EQ(device->validation_messages(), 0u) << all_messages();
}

TEST_F(Invalidation, IsRightUnderEverySeed) {
  const Planned planned = make_plan();
  ASSERT_FALSE(HasFailure());
  for (int seed = 0; seed < test::seeds_to_run() && !HasFatalFailure(); ++seed) {
    auto device = open_layer(seed, false);
    ASSERT_TRUE(device);
    GraphOptions options;
    options.frames_in_flight = 1 + static_cast<uint32_t>(seed) % 4;
    options.threads = 1 + static_cast<uint32_t>(seed) % 3;
    run(*device, planned, static_cast<uint32_t>(seed), options);
  }
}

TEST_F(Invalidation, IsRightOnOneQueue) {
  const Planned planned = make_plan();
  ASSERT_FALSE(HasFailure());
  RG_OPEN_DEVICE(device, true);
  for (uint32_t seed = 0; seed < 4; ++seed) run(device, planned, seed, {});
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

}  // namespace
}  // namespace rg
