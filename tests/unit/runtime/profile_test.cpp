// What a frame took, as files for other programs.
#include "runtime/profile.h"

#include "runtime/json_text.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

constexpr uint32_t kStep = 1;
constexpr uint32_t kData[64] = {};
const std::span<const std::byte> kUpdates[] = {std::as_bytes(std::span(kData))};
const std::span<const std::byte> kParams[] = {std::as_bytes(std::span(&kStep, 1))};

FrameInputs inputs() {
  FrameInputs in;
  in.params = kParams, in.updates = kUpdates;
  return in;
}

constexpr NullOptions three_queues() {
  NullOptions options;
  options.compute_queues = options.transfer_queues = 1;
  return options;
}

class Profile : public test::NullTest {
 protected:
  Profile() { device = Device::null(&log, three_queues()); }
};

// The null device's clock ticks a microsecond a query: a pass takes one, and begins two after the pass before it.
TEST_F(Profile, HoldsTheMicrosecondsOfEveryPass) {
  test::Relay t = test::relay();
  GraphInstance graph = make(t.plan);
  EXPECT_EQ(profile_json(graph), "{\n  \"schema\": \"rgc-profile-1\",\n  \"graph\": \"test\",\n  \"passes_us\": {\n  }\n}\n")
      << "before the first frame";
  frame(graph, inputs());
  EXPECT_EQ(profile_json(graph),
            "{\n  \"schema\": \"rgc-profile-1\",\n  \"graph\": \"test\",\n  \"passes_us\": {\n"
            "    \"upload\": 1.000,\n    \"add\": 1.000,\n    \"clear\": 1.000,\n    \"copy\": 1.000\n  }\n}\n");
}

TEST_F(Profile, TraceHasATrackAQueueAndASliceAPass) {
  test::Relay t = test::relay();
  t.plan.passes[1].module = "sums";
  GraphInstance graph = make(t.plan);
  frame(graph, inputs());
  ChromeTrace trace;
  trace.add(graph);
  const std::vector<std::string> lines = test::lines(trace.json());
  const auto has = [&](const std::string& line) { return std::ranges::count_if(lines, [&](const std::string& l) { return l.starts_with(line); }); };
  const std::string track = "{\"ph\": \"M\", \"pid\": 1, \"tid\": ", slice = "{\"ph\": \"X\", \"pid\": 1, \"tid\": ";
  const std::string nothing =
      ", \"args\": {\"vertices\": 0, \"vertex_invocations\": 0, \"primitives\": 0, \"fragment_invocations\": 0, "
      "\"compute_invocations\": 0}}";
  EXPECT_EQ(lines.front(), "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [");
  EXPECT_EQ(lines.back(), "]}");
  EXPECT_EQ(has(track + "1, \"name\": \"thread_name\", \"args\": {\"name\": \"queue 0 graphics\"}},"), 1);
  EXPECT_EQ(has(track + "2, \"name\": \"thread_name\", \"args\": {\"name\": \"queue 1 compute\"}},"), 1);
  EXPECT_EQ(has(track + "3, \"name\": \"thread_name\", \"args\": {\"name\": \"queue 2 transfer\"}},"), 1);
  EXPECT_EQ(has(slice + "3, \"name\": \"upload\", \"cat\": \"pass\", \"ts\": 0.000, \"dur\": 1.000" + nothing), 1);
  EXPECT_EQ(has(slice + "2, \"name\": \"add\", \"cat\": \"sums\", \"ts\": 2.000, \"dur\": 1.000" + nothing), 1);
  EXPECT_EQ(has(slice + "2, \"name\": \"clear\", \"cat\": \"pass\", \"ts\": 4.000, \"dur\": 1.000" + nothing), 1);
  EXPECT_EQ(has(slice + "1, \"name\": \"copy\", \"cat\": \"pass\", \"ts\": 6.000, \"dur\": 1.000" + nothing), 1);
  EXPECT_EQ(has(slice + "0, \"name\": \"frame 0\", \"ts\": 0.000, \"dur\": 7.000"), 1);
  EXPECT_EQ(lines.size(), 2u + 5 + 1 + 4);
}

TEST_F(Profile, FramesOfATraceLieOneAfterTheOther) {
  test::Relay t = test::relay();
  GraphInstance graph = make(t.plan);
  ChromeTrace trace;
  for (int i = 0; i < 3; ++i) {
    frame(graph, inputs());
    trace.add(graph);
  }
  const std::string text = trace.json();
  EXPECT_NE(text.find("\"name\": \"frame 2\", \"ts\": 14.000, \"dur\": 7.000}"), std::string::npos) << text;
  EXPECT_NE(text.find("\"name\": \"copy\", \"cat\": \"pass\", \"ts\": 20.000, \"dur\": 1.000"), std::string::npos) << text;
}

TEST_F(Profile, TraceCarriesStatisticsWhereTheyWereAskedFor) {
  test::Counter t = test::counter();
  GraphOptions options;
  options.statistics = true;
  GraphInstance graph = make(t.plan, options);
  frame(graph, inputs());
  ChromeTrace trace;
  trace.add(graph);
  const std::vector<PassStatistics> statistics = graph.pass_statistics();
  ASSERT_FALSE(statistics.empty());
  EXPECT_NE(trace.json().find("\"compute_invocations\": " + std::to_string(statistics[0].compute_invocations) + "}"), std::string::npos);
}

TEST(ProfileText, IsQuotedAsJsonWants) { EXPECT_EQ(json_quoted("a\"b\\c\nd"), "\"a\\\"b\\\\c\\u000ad\""); }

}  // namespace
}  // namespace rg
