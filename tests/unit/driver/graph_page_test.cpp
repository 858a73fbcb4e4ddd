#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "compiler/commands/command.h"
#include "compiler/pages/pages.h"

namespace rg::commands {
namespace {

using Json = nlohmann::ordered_json;

// What the script of a page reads.
Json data_of(const std::string& page) {
  const std::string open = R"(<script type="application/json" id="data">)";
  const size_t begin = page.find(open) + open.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

std::string page_of(const std::string& source) {
  const std::string path = testing::TempDir() + "graph_page.rg";
  std::ofstream(path) << source;
  testing::internal::CaptureStdout();
  const int code = show_graph({.file = path, .html = true, .compile = {}});
  const std::string page = testing::internal::GetCapturedStdout();
  std::remove(path.c_str());
  EXPECT_EQ(code, exit_done);
  return page;
}

TEST(Page, TextCannotEndTheScript) {
  const Json hostile = {{"name", "</script><script>alert(1)//"}, {"other", "<!-- \u2028 & \" \\"}};
  const std::string page = pages::fill(pages::graph(), hostile);
  EXPECT_EQ(data_of(page), hostile);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("@RGC_PAGE_DATA@"), std::string::npos);
}

TEST(GraphPage, HoldsPlanFiguresAndReasons) {
  const Json plans = data_of(page_of(R"(module two
extent view = runtime(64, 64) max(128, 128)
graph frame(surface backbuffer: rgba8 view after copy_src) {
  image hdr : rgba16f view
  image lost : rgba16f view
  pass paint  : raster  { color hdr clear 0  draw host {} }
  pass unseen : raster  { color lost clear 0  draw host {} }
  pass show   : raster  { read hdr as sampled in fragment  color backbuffer clear 0  draw host {} }
}
)"));
  ASSERT_EQ(plans.size(), 1u);
  const Json& plan = plans[0];
  EXPECT_EQ(plan["schema"], "rgc-plan-1");
  EXPECT_EQ(plan["passes"].size(), 2u);
  EXPECT_EQ(plan["passes"][0]["line"], 6);
  EXPECT_EQ(plan["culled"][0]["pass"], "unseen");
  EXPECT_EQ(plan["figures"]["heap_bytes"], 65536);
  EXPECT_EQ(plan["figures"]["lower_bound_bytes"], 65536);
  const auto reasons = [&](const char* subject) {
    return std::count_if(plan["decisions"].begin(), plan["decisions"].end(), [&](const Json& row) { return row["subject"] == subject; });
  };
  EXPECT_GE(reasons("paint"), 1);
  EXPECT_GE(reasons("hdr"), 1);
  EXPECT_GE(reasons("unseen"), 1);
}

TEST(GraphPage, TellsWhichPassesAreOneRendering) {
  const Json plans = data_of(page_of(R"(module one
extent view = runtime(64, 64) max(128, 128)
graph frame(surface backbuffer: rgba8 view after copy_src) {
  image shadow : d32f view
  pass cast : raster { depth shadow clear 0.0  draw host {} }
  pass sky  : raster { read shadow as sampled in fragment  color backbuffer clear 0  draw host {} }
  pass land : raster { color backbuffer  draw host {} }
}
)"));
  ASSERT_EQ(plans[0]["passes"].size(), 3u);
  const Json& shared = plans[0]["shared_renderings"];
  ASSERT_EQ(shared.size(), 3u);
  EXPECT_TRUE(shared[0].is_null());
  EXPECT_TRUE(shared[1].is_number());
  EXPECT_EQ(shared[1], shared[2]);
}

}  // namespace
}  // namespace rg::commands
