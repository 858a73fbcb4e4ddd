// tests/golden/codegen/<case>/<case>.rg -> tests/golden/codegen/<case>/generated/. Updated by RGC_UPDATE=1; RGC_GOLDEN=<path> picks one case.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "compiler/codegen/bind.h"
#include "compiler/compile.h"

namespace rg::compiler {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> read_file(const std::string& path, std::string& why) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    why = "no such file";
    return std::nullopt;
  }
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::map<std::string, std::string> generate_case(const fs::path& folder) {
  dsl::Diagnostics diagnostics;
  CompileOptions options;
  options.command = "./x update";
  const std::string root = (folder / (folder.filename().string() + ".rg")).string();
  const CompileResult result = compile(root, read_file, options, diagnostics);
  EXPECT_EQ(print(diagnostics, result.sources, false), "");
  std::map<std::string, std::string> files;
  for (const GeneratedFile& file : result.files) files[file.path] = file.text;
  return files;
}

std::map<std::string, std::string> read_tree(const fs::path& folder) {
  std::map<std::string, std::string> files;
  if (!fs::exists(folder)) return files;
  std::string why;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(folder).generic_string()] = read_file(entry.path().string(), why).value_or("");
  return files;
}

void write_tree(const fs::path& folder, const std::map<std::string, std::string>& files) {
  fs::remove_all(folder);
  for (const auto& [path, text] : files) {
    fs::create_directories((folder / path).parent_path());
    std::ofstream(folder / path, std::ios::binary) << text;
  }
}

bool chosen(const fs::path& folder) {
  const char* only = std::getenv("RGC_GOLDEN");
  return only == nullptr || fs::path(only).lexically_normal().string().find(folder.filename().string()) != std::string::npos;
}

class Golden : public testing::TestWithParam<const char*> {};

TEST_P(Golden, GeneratedFiles) {
  const fs::path folder = fs::path(RGC_SOURCE_DIR) / "tests/golden/codegen" / GetParam();
  if (!chosen(folder)) GTEST_SKIP() << "not the case RGC_GOLDEN names";
  const auto generated = generate_case(folder);
  if (std::getenv("RGC_UPDATE") != nullptr) write_tree(folder / "generated", generated);
  const auto expected = read_tree(folder / "generated");
  for (const auto& [path, text] : generated) {
    const auto found = expected.find(path);
    ASSERT_NE(found, expected.end()) << path << " has no golden; run ./x update";
    EXPECT_EQ(found->second, text) << path << " differs; run ./x update " << GetParam();
  }
  EXPECT_EQ(expected.size(), generated.size());
}

INSTANTIATE_TEST_SUITE_P(Codegen, Golden, testing::Values("minimal", "recorders", "variants", "drawing", "devices"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Generate, TheSameInputGivesTheSameBytes) {
  const fs::path folder = fs::path(RGC_SOURCE_DIR) / "tests/golden/codegen/recorders";
  EXPECT_EQ(generate_case(folder), generate_case(folder));
}

// Tables are replaced, not appended to.
TEST(Attach, TwiceIsOnce) {
  dsl::Diagnostics diagnostics;
  const std::string root = std::string(RGC_SOURCE_DIR) + "/tests/golden/codegen/recorders/recorders.rg";
  CompileResult result = compile(root, read_file, {}, diagnostics);
  ASSERT_EQ(result.graphs.size(), 1u);
  CompiledGraph& graph = result.graphs[0];
  const auto text = [&] { return generate(result.program, {{graph.graph, &graph.plans}}, result.sources, "").at(1).text; };
  const std::string once = text();
  attach_shaders(graph.plans[0].plan, result.program, graph.graph, graph.shaders);
  EXPECT_EQ(text(), once);
}

// Nothing of where it was compiled may stay in the text.
TEST(Generate, TextHoldsNoPlace) {
  const fs::path folder = fs::path(RGC_SOURCE_DIR) / "tests/golden/codegen/recorders";
  for (const auto& [path, text] : generate_case(folder)) EXPECT_EQ(text.find(RGC_SOURCE_DIR), std::string::npos) << path;
}

}  // namespace
}  // namespace rg::compiler
