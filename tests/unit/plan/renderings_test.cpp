// Which raster passes become one rendering, and what that does to their attachments and barriers.
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

// A world and what stands in it, drawn into the same targets, read by a light pass.
std::string world(const std::string& second, const std::string& between = "") {
  return "image albedo : rgba8 view\n image depth : d32f view\n image other : rgba8 view\n"
         "pass world : raster { color albedo clear 0  depth depth clear 0.0  draw host {} }\n" +
         between + "pass props : raster { " + second +
         "  draw host {} }\n"
         "pass light : raster { read albedo as sampled in fragment  color backbuffer covers  draw host {} }\n";
}
const std::string kSame = "color albedo  depth depth";

std::string decision(const FramePlan& plan, const std::string& pass, const std::string& what) {
  for (const Decision& d : plan.decisions)
    if (d.subject == pass && d.what == what) return d.reason;
  return "none";
}
bool merged(const FramePlan& plan) { return pass_named(plan.plan, "world").rendering == pass_named(plan.plan, "props").rendering; }

TEST(Renderings, EqualAttachmentsAreOneRendering) {
  const FramePlan plan = plan_of(world(kSame));
  EXPECT_TRUE(merged(plan));
  EXPECT_EQ(plan.plan.renderings.size(), 2u);
  EXPECT_EQ(order_text(plan.plan), "| world props | light | ");
  const Attachment& albedo = attachment_of(plan.plan, "props", "albedo");
  EXPECT_EQ(albedo.load, LoadOp::clear);
  EXPECT_EQ(albedo.store, StoreOp::store);
  EXPECT_EQ(attachment_of(plan.plan, "world", "depth").store, StoreOp::dont_care);
  EXPECT_NE(decision(plan, "props", "merged"), "none");
}

TEST(Renderings, DepthThatIsOnlyReadTakesTheLayoutOfItsWriters) {
  const FramePlan plan = plan_of(world("color albedo  depth depth readonly"));
  EXPECT_TRUE(merged(plan));
  EXPECT_EQ(attachment_of(plan.plan, "props", "depth").layout, Layout::depth_attachment);
}

TEST(Renderings, WhoeverComesBetweenIsMovedAway) {
  const FramePlan plan = plan_of(world(kSame, "pass side : compute { write other as storage }\n") +
                                 "pass show : raster { read other as sampled in fragment  color backbuffer  draw host {} }\n");
  EXPECT_TRUE(merged(plan));
}

struct Obstacle {
  const char* second;
  const char* between;
  const char* reason;
};
TEST(Renderings, ObstaclesAreNamed) {
  const Obstacle obstacles[] = {
      {"color albedo clear 0  depth depth", "", "it clears"},
      {"color albedo  depth depth  read other as sampled in fragment", "pass side : compute { read albedo as sampled  write other as storage }\n",
       "`side` has to run between them"},
      {"color albedo  depth depth readonly  read depth as sampled in fragment", "", "needs a barrier"},
  };
  for (const Obstacle& o : obstacles) {
    const FramePlan plan = plan_of(world(o.second, o.between));
    EXPECT_FALSE(merged(plan)) << o.reason;
    EXPECT_NE(decision(plan, "props", "not merged").find(o.reason), std::string::npos) << decision(plan, "props", "not merged");
  }
}

TEST(Renderings, NoneBeginsWhereItsFirstPassIsSkipped) {
  const auto text = [](const std::string& first, const std::string& second) {
    return "image albedo : rgba8 view\n"
           "pass base : raster { color albedo clear 0  draw host {} }\n"
           "pass probe : raster { read albedo as sampled in fragment  color backbuffer covers  draw host {} }\n" +
           first + second + "pass light : raster { read albedo as sampled in fragment  color backbuffer  draw host {} }\n";
  };
  const std::string one = "pass one : raster { color albedo  draw host {} }\n", two = "pass two : raster { color albedo  draw host {} }\n";
  const auto together = [](const FramePlan& plan) { return pass_named(plan.plan, "one").rendering == pass_named(plan.plan, "two").rendering; };
  EXPECT_TRUE(together(plan_of(text(one, "if host sometimes { " + two + "}\n"))));
  const FramePlan apart = plan_of(text("if host sometimes { " + one + "}\n", two));
  EXPECT_FALSE(together(apart));
  EXPECT_NE(decision(apart, "two", "not merged").find("skipped"), std::string::npos);
}

TEST(Renderings, TheLastPassResolves) {
  const FramePlan plan = plan_of(
      "image many : rgba8 view samples 4\n image one : rgba8 view\n"
      "pass opaque : raster { color many clear 0  draw host {} }\n"
      "pass glass : raster { color many  resolve many -> one  draw host {} }\n"
      "pass show : raster { read one as sampled in fragment  color backbuffer covers  draw host {} }\n");
  EXPECT_EQ(pass_named(plan.plan, "opaque").rendering, pass_named(plan.plan, "glass").rendering);
  EXPECT_EQ(attachment_of(plan.plan, "opaque", "many").resolve.resource, resource_named(plan.plan, "one"));
  EXPECT_EQ(attachment_of(plan.plan, "opaque", "many").store, StoreOp::dont_care);
}

TEST(Renderings, SwitchesKeepThemApart) {
  EXPECT_FALSE(merged(plan_of(world(kSame), {.merge = false})));
  EXPECT_FALSE(merged(plan_of(world(kSame), {.no_merge = {"props"}})));
  EXPECT_EQ(order_text(plan_of(world(kSame), {.no_merge = {"props"}}).plan), "| world | props | light | ");
}

// Each light needs a shadow map of its own: drawn together all would be live at once.
TEST(Renderings, AreNotPaidForWithMemory) {
  std::string text = "image lit : rgba8 view\n";
  for (int i = 0; i < 8; ++i) {
    const std::string n = std::to_string(i);
    text += "image map" + n + " : d32f view\n pass shadow" + n + " : raster { depth map" + n + " clear 0.0  draw host {} }\n pass light" + n +
            " : raster { read map" + n + " as sampled in fragment  color lit" + (i == 0 ? " clear 0" : "") + "  draw host {} }\n";
  }
  text += "pass show : raster { read lit as sampled in fragment  color backbuffer covers  draw host {} }\n";
  const FramePlan plan = plan_of(text), apart = plan_of(text, {.no_merge = {"frame"}});
  EXPECT_LE(plan.heap_bytes, 5u * 65536) << "of 9 images of 64 KiB";
  EXPECT_NE(decision(plan, "light7", "not merged").find("more memory"), std::string::npos);
  EXPECT_EQ(apart.plan.renderings.size(), 17u);
}

}  // namespace
}  // namespace rg::compiler
