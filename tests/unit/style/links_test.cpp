// Pages point at files that exist.
#include <gtest/gtest.h>

#include "tests/unit/style/tree.h"

namespace rg::style {
namespace {

// Targets of [text](target) and ![text](target), without web addresses and anchors.
std::vector<std::string> link_targets(const std::string& text) {
  std::vector<std::string> targets;
  for (size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
    const std::string target = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
    if (!target.empty() && target.find("://") == std::string::npos && target.find(' ') == std::string::npos) targets.push_back(target);
  }
  return targets;
}

TEST(Links, AreFoundInText) {
  EXPECT_EQ(link_targets("![a](b.png) [c](d/e.md#f) [g](https://h) [i](#j)"), (std::vector<std::string>{"b.png", "d/e.md"}));
}

TEST(Links, PointAtFiles) {
  namespace fs = std::filesystem;
  std::vector<File> pages = files_below("docs", {".md"});
  for (const char* page : {"README.md", "bench/README.md", "generated/README.md"})
    if (fs::exists(fs::path(RGC_SOURCE_DIR) / page)) pages.push_back({page, read(fs::path(RGC_SOURCE_DIR) / page)});
  ASSERT_GE(pages.size(), 5u);
  for (const File& page : pages)
    for (const std::string& target : link_targets(page.text))
      EXPECT_TRUE(fs::exists(fs::path(RGC_SOURCE_DIR) / fs::path(page.path).parent_path() / target)) << page.path << " -> " << target;
}

}  // namespace
}  // namespace rg::style
