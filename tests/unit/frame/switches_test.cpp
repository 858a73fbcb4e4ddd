// passes.rg, for a target that wants split barriers, planned with each combination of the planner's switches, on two queues, loaded as a plan file
// and drawn: the pictures are the same to the bit.
#include <bit>
#include <cstdlib>
#include <set>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "lab.h"

namespace rg::test {
namespace {

constexpr uint32_t kSwitches = 6, kPictures = 3;

compiler::PlanOptions options_of(uint32_t thrown) {
  compiler::PlanOptions options;
  options.aliasing = (thrown & 1) == 0, options.async = (thrown & 2) == 0, options.reorder = (thrown & 4) == 0;
  options.merge = (thrown & 8) == 0, options.discard = (thrown & 16) == 0;
  options.split = (thrown & 32) == 0;
  options.queues = {dsl::QueueKind::graphics, dsl::QueueKind::compute};
  return options;
}

std::string names_of(uint32_t thrown) {
  const char* const names[kSwitches] = {"--no-aliasing ", "--no-async ", "--no-reorder ", "--no-merge ", "--no-discard ", "--no-split "};
  std::string text;
  for (uint32_t i = 0; i < kSwitches; ++i) text += thrown >> i & 1 ? names[i] : "";
  return text.empty() ? "no switch" : text;
}

dsl::ReadSource with_split_barriers(const std::string& root) {
  return [read = commands::reader_for(root)](const std::string& path, std::string& reason) {
    std::optional<std::string> text = read(path, reason);
    const std::string target = "target vulkan 1.3";
    if (const size_t at = text ? text->find(target) : std::string::npos; at != std::string::npos)
      text->insert(at + target.size(), " with split_barriers");
    return text;
  };
}

// The plan as the bytes of a file. Shaders are compiled for the first and found in the cache for the others.
std::string planned(uint32_t thrown) {
  const std::string root = std::string(RGC_SOURCE_DIR) + "/passes.rg";
  compiler::CompileOptions options;
  options.until = compiler::Until::plans;
  options.plan = options_of(thrown);
  options.cache_folder = std::string(RGC_BINARY_DIR) + "/tests/switches_cache";
  dsl::Diagnostics diagnostics;
  const compiler::CompileResult result = compiler::compile(root, with_split_barriers(root), options, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.sources, false);
  return commands::plan_file({}, result).text;
}

// Frames of the plan, which a new renderer takes over before its first.
std::vector<demo::Picture> draw(const std::string& bytes) {
  const auto file = PlanFile::parse(std::as_bytes(std::span(bytes)), "switches");
  EXPECT_TRUE(file) << file.error().message;
  auto renderer = demo::Renderer::create(device(), plaza(), {.width = 96, .height = 54});
  EXPECT_TRUE(renderer) << renderer.error().message;
  std::vector<demo::Picture> pictures;
  if (!file || !renderer) return pictures;
  const Status loaded = renderer->reload(*file);
  EXPECT_TRUE(loaded) << loaded.error().message;
  for (uint32_t number = 0; loaded && number < kPictures; ++number) {
    FrameSettings settings;
    settings.width = 96, settings.height = 54, settings.number = number;
    const Status rendered = renderer->render(demo::make_frame(plaza(), plaza().cameras.at(0), settings));
    EXPECT_TRUE(rendered) << rendered.error().message;
    auto picture = renderer->picture();
    EXPECT_TRUE(picture) << picture.error().message;
    if (picture) pictures.push_back(std::move(*picture));
  }
  return pictures;
}

// None, each alone and all; with RGC_LONG every combination.
TEST(Switches, PicturesDoNotDependOnThem) {
  const bool is_long = std::getenv("RGC_LONG") != nullptr;
  const std::vector<demo::Picture> plain = draw(planned(0));
  ASSERT_EQ(plain.size(), kPictures);
  std::set<uint8_t> shades(plain[0].texels.begin(), plain[0].texels.end());
  EXPECT_GT(shades.size(), 64u) << "a picture of nothing would be the same with every plan";
  std::set<std::string> plans;
  for (uint32_t thrown = 0; thrown < 1u << kSwitches; ++thrown) {
    const int count = std::popcount(thrown);
    if (!is_long && count != 1 && count != static_cast<int>(kSwitches)) continue;
    const std::string bytes = planned(thrown);
    plans.insert(bytes);
    const std::vector<demo::Picture> pictures = draw(bytes);
    ASSERT_EQ(pictures.size(), kPictures) << names_of(thrown);
    for (uint32_t i = 0; i < kPictures; ++i) EXPECT_TRUE(pictures[i].texels == plain[i].texels) << names_of(thrown) << ", frame " << i;
  }
  // On one queue a group for every pass is program order already: there `--no-merge` is the same plan with `--no-reorder` and without, four times.
  EXPECT_EQ(plans.size(), is_long ? 44u : 7u) << "switches that change no plan test nothing";
}

}  // namespace
}  // namespace rg::test
