// Dependencies run one way: dsl <- compiler <- rgc, runtime <- generated. Compiler and runtime share four headers, and the checker shares with the
// planner the plan's schema and nothing else.
#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/style/tree.h"

namespace rg::style {
namespace {

using Allowed = std::function<bool(const std::string& include)>;

bool starts_with_any(const std::string& text, std::initializer_list<const char*> prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const char* prefix) { return text.starts_with(prefix); });
}

bool is_any(const std::string& text, std::initializer_list<const char*> names) { return std::find(names.begin(), names.end(), text) != names.end(); }

std::string violations(const std::vector<File>& files, const Allowed& allowed) {
  std::string text;
  for (const File& file : files)
    for (const std::string& include : quoted_includes(file.text))
      if (!allowed(include)) text += file.path + " includes " + include + "\n";
  return text;
}

bool is_shared(const std::string& include) {
  return is_any(include, {"runtime/plan.h", "runtime/plan_fields.h", "runtime/packing.h", "runtime/alias.h"});
}

std::vector<File> compiler_files(bool verify) {
  std::vector<File> files = cpp_below("compiler");
  std::erase_if(files, [&](const File& file) { return file.path.starts_with("compiler/verify/") != verify; });
  return files;
}

TEST(Dependencies, IncludesAreFoundInText) {
  EXPECT_EQ(quoted_includes("#include <vector>\n#include \"dsl/ids.h\"\n  // #include \"no.h\"\n#  include \"x\"\n"),
            (std::vector<std::string>{"dsl/ids.h"}));
}

TEST(Dependencies, AViolationIsReported) {
  const std::vector<File> files = {{"dsl/a.h", "#include \"runtime/plan.h\"\n"}};
  EXPECT_EQ(violations(files, [](const std::string& include) { return include.starts_with("dsl/"); }), "dsl/a.h includes runtime/plan.h\n");
}

TEST(Dependencies, DslKnowsOnlyItself) {
  const auto files = cpp_below("dsl");
  ASSERT_GT(files.size(), 10u);
  EXPECT_EQ(violations(files, [](const std::string& include) { return include.starts_with("dsl/"); }), "");
}

TEST(Dependencies, CompilerSharesFourHeadersWithTheRuntime) {
  const auto files = compiler_files(false);
  ASSERT_GT(files.size(), 10u);
  EXPECT_EQ(violations(files, [](const std::string& include) { return starts_with_any(include, {"dsl/", "compiler/"}) || is_shared(include); }), "");
}

// Not the access tables, ranges, culling, format tables or packing of the planner: the checker would repeat their mistakes.
TEST(Dependencies, CheckerSharesOnlyTheSchema) {
  const auto files = compiler_files(true);
  ASSERT_GE(files.size(), 1u);
  EXPECT_EQ(violations(files,
                       [](const std::string& include) {
                         return include.starts_with("compiler/verify/") ||
                                is_any(include,
                                       {"dsl/program.h", "dsl/ids.h", "dsl/source.h", "dsl/check_macro.h", "compiler/plan_data.h", "runtime/plan.h"});
                       }),
            "");
}

TEST(Dependencies, OnlyTheDriverAndTheCommandsKnowAllPhases) {
  auto files = compiler_files(false);
  std::erase_if(files, [](const File& file) { return starts_with_any(file.path, {"compiler/commands/", "compiler/main.cpp", "compiler/compile."}); });
  EXPECT_EQ(violations(files,
                       [](const std::string& include) {
                         return !starts_with_any(include, {"compiler/verify/", "compiler/commands/", "compiler/compile.h"});
                       }),
            "");
}

TEST(Dependencies, RuntimeKnowsNoCompiler) {
  const auto files = cpp_below("runtime");
  ASSERT_GT(files.size(), 5u);
  EXPECT_EQ(violations(files, [](const std::string& include) { return include.starts_with("runtime/"); }), "");
}

TEST(Dependencies, GeneratedCodeNeedsTheRuntimeAlone) {
  EXPECT_EQ(violations(cpp_below("generated"),
                       [](const std::string& include) {
                         return !starts_with_any(include, {"dsl/", "compiler/", "examples/"});
                       }),
            "");
}

TEST(Dependencies, OnlyTheRuntimeIncludesVulkan) {
  std::string text;
  for (const char* room : {"dsl", "compiler"})
    for (const File& file : cpp_below(room))
      if (file.text.find("#include <vulkan/") != std::string::npos) text += file.path + "\n";
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace rg::style
