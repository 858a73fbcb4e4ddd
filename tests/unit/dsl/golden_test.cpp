// One file:  test_dsl --gtest_filter='*fail_read_before_write*'      Update:  RGC_UPDATE=1 test_dsl --gtest_filter=...
#include "golden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "dsl/format.h"
#include "dsl/lexer.h"
#include "dsl/parser.h"
#include "dsl/print.h"

namespace rg::dsl {
namespace {

constexpr FileId kFile{size_t{0}};

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

// Compares with, or rewrites, `<input>.<stage>.expected`. Without that file only updating creates it.
void expect_text(const std::string& input, const std::string& stage, const std::string& actual) {
  const std::string path = input + "." + stage + ".expected";
  if (golden::updating()) return golden::write_text(path, actual);
  ASSERT_TRUE(std::filesystem::exists(path)) << path << " is missing; RGC_UPDATE=1 writes it";
  EXPECT_EQ(golden::read_text(path), actual) << path;
}

bool must_fail(const std::string& path) { return std::filesystem::path(path).filename().string().rfind("fail_", 0) == 0; }

class Lex : public ::testing::TestWithParam<std::string> {};
TEST_P(Lex, Tokens) {
  const std::string text = golden::read_text(GetParam());
  Diagnostics diagnostics;
  const Tokens tokens = lex(kFile, text, diagnostics);
  SourceFiles files;
  files.add({std::filesystem::path(GetParam()).filename().string(), text});
  EXPECT_EQ(diagnostics.has_errors(), must_fail(GetParam()));
  expect_text(GetParam(), "tokens", print_tokens(text, tokens) + print(diagnostics, files, false));
}
INSTANTIATE_TEST_SUITE_P(Golden, Lex, ::testing::ValuesIn(golden::inputs("lex")), test_name);

class Parse : public ::testing::TestWithParam<std::string> {};
TEST_P(Parse, Tree) {
  const std::string text = golden::read_text(GetParam());
  Diagnostics diagnostics;
  const ast::File tree = parse(kFile, text, lex(kFile, text, diagnostics), diagnostics);
  SourceFiles files;
  files.add({std::filesystem::path(GetParam()).filename().string(), text});
  EXPECT_EQ(diagnostics.has_errors(), must_fail(GetParam()));
  EXPECT_EQ(tree.has_error, must_fail(GetParam()));
  expect_text(GetParam(), "tree", print_tree(tree) + print(diagnostics, files, false));
}
INSTANTIATE_TEST_SUITE_P(Golden, Parse, ::testing::ValuesIn(golden::inputs("parse")), test_name);

class Format : public ::testing::TestWithParam<std::string> {};
TEST_P(Format, Text) {
  Diagnostics diagnostics;
  const auto formatted = format(kFile, golden::read_text(GetParam()), diagnostics);
  ASSERT_TRUE(formatted.has_value());
  EXPECT_EQ(format(kFile, *formatted, diagnostics), formatted);
  expect_text(GetParam(), "format", *formatted);
}
INSTANTIATE_TEST_SUITE_P(Golden, Format, ::testing::ValuesIn(golden::inputs("format")), test_name);

// ---- check: the diagnostics stand in the file -------------------------------------------------------------------

class Check : public ::testing::TestWithParam<std::string> {};

void update_annotations(const std::string& path) {
  std::map<std::string, std::string> bare;
  const golden::Loaded before = golden::load(path);
  for (const SourceFile& file : before.result.files) bare[file.path] = golden::without_expectations(file.text);
  const golden::Loaded loaded = golden::load(path, bare);
  std::vector<golden::Expectation> all = golden::found(loaded, false);
  for (const golden::Expectation& note : golden::found(loaded, true)) all.push_back(note);
  for (const auto& [file, text] : bare) {
    std::vector<golden::Expectation> own;
    std::copy_if(all.begin(), all.end(), std::back_inserter(own), [&, name = file](const golden::Expectation& each) { return each.file == name; });
    golden::write_text(file, golden::with_expectations(text, own));
  }
}

std::string listed(const std::vector<golden::Expectation>& all) {
  std::string text;
  for (const golden::Expectation& each : all)
    text += std::filesystem::path(each.file).filename().string() + ":" + std::to_string(each.line) + ": " + each.text + "\n";
  return text;
}

TEST_P(Check, Diagnostics) {
  if (golden::updating()) update_annotations(GetParam());
  const golden::Loaded loaded = golden::load(GetParam());
  std::vector<golden::Expectation> expected;
  for (const SourceFile& file : loaded.result.files)
    for (golden::Expectation& each : golden::expectations(file.path, file.text)) expected.push_back(std::move(each));
  std::vector<golden::Expectation> actual = golden::found(loaded, false);
  for (golden::Expectation& note : golden::found(loaded, true)) actual.push_back(std::move(note));
  std::sort(expected.begin(), expected.end());
  std::sort(actual.begin(), actual.end());
  EXPECT_EQ(listed(expected), listed(actual));
  EXPECT_EQ(loaded.diagnostics.has_errors(), must_fail(GetParam()));
  if (must_fail(GetParam())) return;
  EXPECT_EQ(print_program(loaded.result.program), print_program(golden::load(GetParam()).result.program));
  expect_text(GetParam(), "program", print_program(loaded.result.program));
}
INSTANTIATE_TEST_SUITE_P(Golden, Check, ::testing::ValuesIn(golden::inputs("check")), test_name);

// ---- the registry -----------------------------------------------------------------------------------------------

bool is_front_end(const DiagnosticRow& info) { return info.code >= "RG0000" && info.code < "RG0400"; }

// Reported only where no golden file can reach; the reason stands beside each.
const std::set<std::string_view> kWithoutGolden = {
    "ImportsTooDeep",  // takes 200 files; FrontEnd.ImportsTooDeep writes them in memory
};

TEST(Registry, EveryDiagnosticHasAGolden) {
  std::string all;
  for (const char* folder : {"lex", "parse", "check"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(golden::root() + "/" + folder))
      if (entry.is_regular_file()) all += golden::read_text(entry.path().string());
  for (const DiagnosticKind kind : all_diagnostic_kinds()) {
    const DiagnosticRow& info = row(kind);
    if (!is_front_end(info) || kWithoutGolden.count(info.name)) continue;
    EXPECT_NE(all.find("[" + std::string(info.code) + "]"), std::string::npos) << info.code << " " << info.name << " appears in no golden file";
  }
}

TEST(Registry, CodesAreUniqueAndAscendingNames) {
  std::set<std::string_view> codes, names;
  for (const DiagnosticKind kind : all_diagnostic_kinds()) {
    EXPECT_TRUE(codes.insert(row(kind).code).second) << row(kind).code;
    EXPECT_TRUE(names.insert(row(kind).name).second) << row(kind).name;
    EXPECT_EQ(row(kind).code.size(), 6u) << row(kind).code;
    EXPECT_EQ(row(kind).code.substr(0, 2), "RG");
  }
}

TEST(Registry, MessagesKeepHouseStyle) {
  for (const DiagnosticKind kind : all_diagnostic_kinds()) {
    const std::string_view message = row(kind).message;
    ASSERT_FALSE(message.empty());
    EXPECT_FALSE(std::isupper(static_cast<unsigned char>(message.front()))) << message;
    EXPECT_NE(message.back(), '.') << message;
    EXPECT_EQ(message.find("  "), std::string_view::npos) << message;
    EXPECT_EQ(std::count(message.begin(), message.end(), '`') % 2, 0) << message;
    EXPECT_EQ(message.find('\''), message.find("'s ") == std::string_view::npos ? std::string_view::npos : message.find("'s "))
        << "names stand in backticks: " << message;
  }
}

}  // namespace
}  // namespace rg::dsl
