// What is kept, what goes, and why.
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

std::string culled_text(const std::string& body) {
  std::string text;
  for (const Culled& culled : plan_of(body).plan.culled) text += std::string(culled.pass) + ": " + std::string(culled.reason) + "\n";
  return text;
}

constexpr char kShow[] = "pass show : raster { color backbuffer covers }\n";

TEST(Cull, IsTransitive) {
  EXPECT_EQ(culled_text(std::string("buffer a : u32[4]\n buffer b : u32[4]\n"
                                    "pass one : compute { write a as storage }\n"
                                    "pass two : compute { read a as storage  write b as storage }\n") +
                        kShow),
            "one: nothing observable depends on `a`\n"
            "two: nothing observable depends on `b`\n");
}

TEST(Cull, OverwrittenVersionsAreNotNeeded) {
  EXPECT_EQ(culled_text("image hdr : rgba16f view\n"
                        "pass lost : raster { color hdr clear 0 }\n"
                        "pass kept : raster { color hdr clear 0 }\n"
                        "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n"),
            "lost: nothing observable depends on `hdr`\n");
}

TEST(Cull, UpdatesNeedWhatTheyUpdate) {
  EXPECT_EQ(culled_text("image hdr : rgba16f view\n"
                        "pass base : raster { color hdr clear 0 }\n"
                        "pass more : raster { color hdr }\n"
                        "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n"),
            "");
}

TEST(Cull, WhatASkippedPassWouldHaveReplacedIsNeeded) {
  EXPECT_EQ(culled_text("image hdr : rgba16f view\n"
                        "pass base : raster { color hdr clear 0 }\n"
                        "if host sometimes { pass patch : raster { color hdr clear 1 } }\n"
                        "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n"),
            "");
}

TEST(Cull, OutputsReadBackHistoryAndKeepAreRoots) {
  EXPECT_EQ(
      culled_text(std::string("buffer o : u32[4] output\n buffer r : u32[4] readback\n buffer h : u32[4] history 1 init clear 0\n buffer k : u32[4]\n"
                              "pass po : compute { write o as storage }\n"
                              "pass pr : compute { write r as storage }\n"
                              "pass ph : compute { write h as storage }\n"
                              "pass pk : compute { write k as storage  keep }\n") +
                  kShow),
      "");
}

TEST(Cull, ResourcesOfCulledPassesLeaveThePlan) {
  const FramePlan frame = plan_of(std::string("buffer a : u32[4]\n pass one : compute { write a as storage }\n") + kShow);
  ASSERT_EQ(frame.plan.resources.size(), 1u);
  EXPECT_EQ(frame.plan.resources[0].name, "backbuffer");
  ASSERT_EQ(frame.plan.program_pass.size(), 1u);
  EXPECT_EQ(frame.plan.passes[0].name, "show");
}

}  // namespace
}  // namespace rg::compiler
