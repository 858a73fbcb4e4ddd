// Damaged inputs: never a crash or a hang, and few, well-placed messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "dsl/format.h"
#include "golden.h"
#include "mutate.h"

namespace rg::dsl {
namespace {

std::string frame_path() { return std::string(RGC_SOURCE_DIR) + "/passes.rg"; }

std::vector<std::string> all_inputs() {
  std::vector<std::string> all = {frame_path()};
  for (const char* folder : {"lex", "parse", "check", "format"})
    for (std::string& path : golden::inputs(folder)) all.push_back(std::move(path));
  return all;
}

TEST(Mutation, DamagedInputsNeitherCrashNorHang) {
  constexpr uint64_t kRounds = 40;  // of every input
  size_t failed = 0, count = 0;
  for (const std::string& path : all_inputs()) {
    const std::string text = golden::read_text(path);
    for (uint64_t seed = 0; seed < kRounds; ++seed) {
      Random random(seed * 7919 + text.size());
      const std::string damaged = mutate(text, random);
      const golden::Loaded loaded = golden::load(path, {{path, damaged}});
      EXPECT_FALSE(print(loaded.diagnostics, loaded.result.files, true).empty() && loaded.diagnostics.has_errors());
      Diagnostics ignored;
      const auto formatted = format(FileId{size_t{0}}, damaged, ignored);
      if (formatted) {
        EXPECT_EQ(format(FileId{size_t{0}}, *formatted, ignored), formatted) << path << " seed " << seed;
      }
      failed += loaded.diagnostics.has_errors();
      ++count;
    }
  }
  EXPECT_GT(count, 1000u);
  EXPECT_GT(failed, count / 2);  // the damage is real
}

struct Sample {
  size_t messages = 0;
  bool on_line = false;
  std::string shown;
};

// One damaged token in the demo's frame; nothing if the result is still correct.
std::optional<Sample> sample(const std::string& text, uint64_t seed) {
  Random random(seed);
  const TokenMutation mutation = mutate_token(text, random);
  const golden::Loaded loaded = golden::load(frame_path(), {{frame_path(), mutation.text}});
  if (!loaded.diagnostics.has_errors()) return std::nullopt;
  Sample result;
  for (const Diagnostic& diagnostic : loaded.diagnostics.rows()) {
    if (row(diagnostic.kind).severity != Severity::error) continue;
    const uint32_t line = diagnostic.span.file.valid() && diagnostic.span.file.value == 0
                              ? loaded.result.files[diagnostic.span.file].position(diagnostic.span.begin).line
                              : 0;
    if (result.messages++ == 0) result.on_line = line == mutation.line;
  }
  result.shown = "seed " + std::to_string(seed) + " line " + std::to_string(mutation.line) + ": " + mutation.what + "\n" +
                 print(loaded.diagnostics, loaded.result.files, false);
  return result;
}

TEST(Mutation, OneMistakeGivesOneMessageOnItsLine) {
  constexpr uint64_t kMutations = 1000;
  const std::string text = golden::read_text(frame_path());
  std::vector<size_t> messages;
  size_t on_line = 0;
  for (uint64_t seed = 0; seed < kMutations; ++seed) {
    const auto result = sample(text, seed);
    if (!result) continue;
    messages.push_back(result->messages);
    on_line += result->on_line;
    if (std::getenv("RGC_SHOW_MUTATIONS") && (result->messages > 1 || !result->on_line))
      std::printf("== %zu messages, %s\n%s\n", result->messages, result->on_line ? "placed" : "MISPLACED", result->shown.c_str());
  }
  std::sort(messages.begin(), messages.end());
  ASSERT_GT(messages.size(), kMutations / 2);
  const double placed = static_cast<double>(on_line) / static_cast<double>(messages.size());
  RecordProperty("median", static_cast<int>(messages[messages.size() / 2]));
  std::printf("%zu of %zu mutations are errors; messages: median %zu, 90 %% at most %zu, most %zu; first on the line: %.1f %%\n", messages.size(),
              size_t{kMutations}, messages[messages.size() / 2], messages[messages.size() * 9 / 10], messages.back(), 100 * placed);
  EXPECT_EQ(messages[messages.size() / 2], 1u);
  EXPECT_LE(messages[messages.size() * 9 / 10], 2u);
  EXPECT_GT(placed, 0.9);
}

}  // namespace
}  // namespace rg::dsl
