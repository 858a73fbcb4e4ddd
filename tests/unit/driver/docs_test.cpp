// Examples of the documentation: every page of docs/constructs compiles, and its plans are proved.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "compiler/compile.h"
#include "compiler/verify/verify.h"
#include "tests/unit/in_memory.h"

namespace rg::compiler {
namespace {

namespace fs = std::filesystem;
using test::Files;

// A block is a file: "```rg" the next root, "```rg tiles.rg", "```glsl show.frag" and "```json x.json" what stands beside it.
std::vector<Files> read_examples(const fs::path& page) {
  std::vector<Files> examples;
  std::ifstream stream(page);
  std::string* into = nullptr;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("```")) {
      if (into) *into += line + "\n";
      continue;
    }
    std::istringstream words(line.substr(3));
    std::string language, name;
    words >> language >> name;
    const bool known = language == "rg" || language == "glsl" || language == "json";
    if (into || !known) {
      into = nullptr;
      continue;
    }
    if (name.empty()) examples.emplace_back();
    if (!examples.empty()) into = &examples.back()[name.empty() ? "example.rg" : name];
  }
  return examples;
}

void expect_proved(const CompileResult& result) {
  for (const CompiledGraph& graph : result.graphs)
    for (const FramePlan& plan : graph.plans) {
      const auto findings =
          verify::verify(result.program, graph.graph, plan.configuration, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource);
      for (const verify::Finding& finding : findings) ADD_FAILURE() << finding.text;
    }
}

void expect_right(const Files& files, const std::string& page) {
  CompileOptions options;
  options.until = Until::plans;
  dsl::Diagnostics diagnostics;
  const CompileResult result = compile("example.rg", test::reader_of(files), options, diagnostics);
  EXPECT_EQ(dsl::print(diagnostics, result.sources, false), "") << page << "\n" << dsl::print(diagnostics, result.sources, false);
  expect_proved(result);
}

TEST(Docs, TheConstructsCompileAndAreProved) {
  size_t count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(RGC_SOURCE_DIR) / "docs/constructs")) {
    const std::vector<Files> examples = read_examples(entry.path());
    if (entry.path().filename() != "README.md") {
      EXPECT_FALSE(examples.empty()) << entry.path() << " has no example";
    }
    for (const Files& files : examples) expect_right(files, entry.path().string()), ++count;
  }
  EXPECT_GE(count, 16u);
}

TEST(Docs, TheComparisonCompiles) {
  const std::vector<Files> examples = read_examples(fs::path(RGC_SOURCE_DIR) / "docs/comparison.md");
  EXPECT_EQ(examples.size(), 3u);
  for (const Files& files : examples) expect_right(files, "docs/comparison.md");
}

}  // namespace
}  // namespace rg::compiler
