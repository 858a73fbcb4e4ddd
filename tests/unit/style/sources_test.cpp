// What holds for every source file.
#include <gtest/gtest.h>

#include "tests/unit/style/tree.h"

namespace rg::style {
namespace {

std::vector<File> sources() {
  std::vector<File> all;
  for (const char* room : {"dsl", "compiler", "runtime", "examples", "tests", "bench"})
    for (File& file : files_below(room, {".h", ".cpp", ".def"})) all.push_back(std::move(file));
  return all;
}

TEST(Sources, FilesAreShortEnough) {
  for (const File& file : sources()) EXPECT_LE(lines_of(file.text).size(), 500u) << file.path;
}

// Flat tables may be wider: one row a line.
TEST(Sources, LinesAreNarrowEnough) {
  std::string text;
  for (const File& file : sources()) {
    const auto lines = lines_of(file.text);
    for (size_t i = 0; i < lines.size(); ++i)
      if (lines[i].size() > 180) text += file.path + ":" + std::to_string(i + 1) + "\n";
  }
  EXPECT_EQ(text, "");
}

TEST(Sources, NothingIsLeftForLater) {
  const std::string marks[] = {std::string("TO") + "DO", std::string("FIX") + "ME", std::string("XX") + "X"};
  for (const File& file : sources())
    for (const std::string& mark : marks) EXPECT_EQ(file.text.find(mark), std::string::npos) << file.path << " has a " << mark;
}

TEST(Sources, HeadersGuardThemselvesAndSayWhatTheyAre) {
  for (const File& file : sources()) {
    if (!file.path.ends_with(".h")) continue;
    EXPECT_NE(file.text.find("#pragma once"), std::string::npos) << file.path;
    EXPECT_TRUE(file.text.starts_with("//")) << file.path << " begins without a comment";
  }
}

TEST(Sources, NoTabsAndNoTrailingBlanks) {
  for (const File& file : sources()) {
    const auto lines = lines_of(file.text);
    for (size_t i = 0; i < lines.size(); ++i) {
      EXPECT_EQ(lines[i].find('\t'), std::string::npos) << file.path << ":" << i + 1;
      EXPECT_FALSE(lines[i].ends_with(' ')) << file.path << ":" << i + 1;
    }
  }
}

}  // namespace
}  // namespace rg::style
