// The registry of diagnostics: stable codes, one style of message, and each code shown by a test.
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <set>

#include "tests/unit/style/tree.h"

namespace rg::style {
namespace {

struct Row {
  std::string name, code, severity, message;
};

constexpr const char* const kRegistry[][4] = {
#define RG_DIAGNOSTIC(name, code, severity, message) {#name, code, #severity, message},
#include "dsl/diagnostic_kind.def"
#undef RG_DIAGNOSTIC
};

std::vector<Row> rows() {
  std::vector<Row> all;
  for (const auto& row : kRegistry) all.push_back({row[0], row[1], row[2], row[3]});
  return all;
}

// What is wrong with a message, or nothing.
std::string fault(const std::string& message) {
  if (message.empty()) return "empty";
  if (std::isupper(static_cast<unsigned char>(message.front()))) return "starts with a capital";
  if (message.back() == '.' || message.back() == '!') return "ends like a sentence";
  if (std::count(message.begin(), message.end(), '`') % 2) return "has an unpaired backtick";
  if (message.find("  ") != std::string::npos) return "has two blanks";
  if (message.find('"') != std::string::npos || message.find('\'') != std::string::npos) return "quotes without backticks";
  for (const char* word : {"please", "Please", "invalid", "illegal", "sorry"})
    if (message.find(word) != std::string::npos) return std::string("says ") + word;
  return "";
}

TEST(Diagnostics, FaultsAreSeen) {
  EXPECT_EQ(fault("`{0}` is read before it is written"), "");
  EXPECT_EQ(fault("Unknown name"), "starts with a capital");
  EXPECT_EQ(fault("unknown name."), "ends like a sentence");
  EXPECT_EQ(fault("unknown name `{0}"), "has an unpaired backtick");
}

TEST(Diagnostics, MessagesFollowTheHouseStyle) {
  for (const Row& row : rows()) EXPECT_EQ(fault(row.message), "") << row.code << " " << row.name << ": " << row.message;
}

TEST(Diagnostics, CodesAndNamesAreUnique) {
  std::set<std::string> codes, names;
  for (const Row& row : rows()) {
    EXPECT_TRUE(codes.insert(row.code).second) << row.code << " is used twice";
    EXPECT_TRUE(names.insert(row.name).second) << row.name << " is used twice";
  }
}

TEST(Diagnostics, CodesLieInTheirRanges) {
  for (const Row& row : rows()) {
    ASSERT_EQ(row.code.size(), 6u) << row.code;
    EXPECT_EQ(row.code.substr(0, 3), "RG0") << row.code;
    EXPECT_TRUE(row.code[3] >= '0' && row.code[3] <= '7') << row.code;
  }
}

// A golden file shows the code; a unit test names the code or its enumerator.
TEST(Diagnostics, EveryCodeIsShownByATest) {
  std::string all;
  for (const File& file : files_below("tests", {"expected", ".rg", ".cpp", ".txt", ".json"}))
    if (!file.path.starts_with("tests/unit/style/")) all += file.text;
  for (const Row& row : rows())
    EXPECT_TRUE(all.find(row.code) != std::string::npos || all.find("DiagnosticKind::" + row.name) != std::string::npos)
        << row.code << " " << row.name << " appears in no test";
}

std::string page() {
  std::string text =
      "# Diagnostics\n\nEvery code, with its message; `{0}`, `{1}` stand for what was found. Codes are stable and never reused. `rgc explain CODE` "
      "prints one.\n"
      "Tests under `tests/` show each with an input that causes it.\n\n"
      "RG00 files and imports, RG01 text, RG02 names and types, RG03 meaning of passes and accesses, RG04 shaders (from RG0480 on passes and "
      "resources "
      "again), RG05 judged facts, RG06 the "
      "command line\n"
      "and the world, RG07 variants.\n\n| code | severity | name | message |\n|---|---|---|---|\n";
  std::vector<Row> all = rows();
  std::sort(all.begin(), all.end(), [](const Row& a, const Row& b) { return a.code < b.code; });
  for (const Row& row : all) {
    std::string message;
    for (const char c : row.message) message += c == '|' ? std::string("\\|") : std::string(1, c);
    text += "| " + row.code + " | " + row.severity + " | " + row.name + " | " + message + " |\n";
  }
  return text;
}

// ./x update writes the page anew.
TEST(Diagnostics, ThePageListsEveryCode) {
  const std::filesystem::path path = std::filesystem::path(RGC_SOURCE_DIR) / "docs/diagnostics.md";
  if (std::getenv("RGC_UPDATE")) std::ofstream(path) << page();
  EXPECT_EQ(read(path), page()) << "rewrite it with ./x update";
}

}  // namespace
}  // namespace rg::style
