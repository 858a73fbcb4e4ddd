// Which passes that clear and resolve become part of renderings, and what that leaves of the plan.
#include "compiler/fold_transfers.h"

#include <bit>

#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

std::vector<std::string> pass_names(const dsl::Program& program) {
  std::vector<std::string> names;
  for (const dsl::Pass& pass : program.graphs.rows[0].passes) names.push_back(pass.name);
  return names;
}
// "wipe: draw clears many", or why not: "wipe: no pass ...".
std::string outcome(const FoldResult& result) {
  std::string text;
  for (const Fold& fold : result.folds)
    for (const Fold::Part& part : fold.parts)
      text +=
          fold.pass + ": " + part.into + (part.target.empty() ? " clears " + part.image : " resolves " + part.image + " to " + part.target) + "\n";
  for (const FoldRefusal& refusal : result.refusals) text += refusal.pass + ": " + refusal.reason + "\n";
  return text;
}
std::string outcome_of(const std::string& body, const PlanOptions& options = {}) { return outcome(fold_transfers(program_of(body), options)); }

const std::string kShown = "pass show : raster { read one as sampled in fragment  color backbuffer covers  draw host {} }\n";
std::string multisampled(const std::string& draw = "color many", const std::string& between = "") {
  return "image many : rgba8 view samples 4\n image one : rgba8 view\n image other : rgba8 view\n"
         "pass wipe : transfer { clear many 0.5 }\n" +
         between + "pass draw : raster { " + draw +
         "  draw host {} }\n"
         "pass flatten : transfer { resolve many -> one }\n" +
         kShown;
}

TEST(FoldTransfers, ARenderingClearsAndResolves) {
  const dsl::Program program = program_of(multisampled());
  const FoldResult folded = fold_transfers(program, {});
  EXPECT_EQ(outcome(folded), "wipe: draw clears many\nflatten: draw resolves many to one\n");
  EXPECT_EQ(pass_names(folded.program), (std::vector<std::string>{"draw", "show"}));
  const FramePlan apart = plan_of(program), together = plan_of(folded.program);
  EXPECT_EQ(order_text(apart.plan), "| wipe | draw | flatten | show | ");
  EXPECT_EQ(order_text(together.plan), "| draw | show | ");
  const Attachment& many = attachment_of(together.plan, "draw", "many");
  EXPECT_EQ(many.load, LoadOp::clear);
  EXPECT_EQ(many.store, StoreOp::dont_care);
  EXPECT_EQ(many.clear.word[0], std::bit_cast<uint32_t>(0.5f));
  EXPECT_EQ(many.resolve.resource, resource_named(together.plan, "one"));
}

TEST(FoldTransfers, TheSamePlanAsWithBothDeclared) {
  const std::string declared =
      "image many : rgba8 view samples 4\n image one : rgba8 view\n image other : rgba8 view\n"
      "pass draw : raster { color many clear 0.5  resolve many -> one  draw host {} }\n" +
      kShown;
  EXPECT_EQ(schedule_text(plan_of(fold_transfers(program_of(multisampled()), {}).program).plan), schedule_text(plan_of(declared).plan));
}

TEST(FoldTransfers, OnePassClearsForSeveral) {
  EXPECT_EQ(outcome_of("image one : rgba8 view\n image depth : d32f_s8 view\n"
                       "pass wipe : transfer { clear one 0  clear depth (1, 0) }\n"
                       "pass draw : raster { color one  draw host {} }\n"
                       "pass solid : raster { depth depth  stencil depth  color one  draw host {} }\n" +
                       kShown),
            "wipe: draw clears one\nwipe: solid clears depth\n");
}

TEST(FoldTransfers, LayersAndInstancesOneByOne) {
  EXPECT_EQ(outcome_of("image maps : d32f 64x64 layers 2\n image one : rgba8 view\n"
                       "for i in 0..2 {\n pass wipe[i] : transfer { clear maps.layer(i) 1.0 }\n"
                       " pass draw[i] : raster { depth maps.layer(i)  draw host {} } }\n"
                       "pass light : compute { read maps as sampled  write one as storage }\n" +
                       kShown),
            "wipe[0]: draw[0] clears maps\nwipe[1]: draw[1] clears maps\n");
}

TEST(FoldTransfers, ConditionsAreShared) {
  const auto text = [](const std::string& wipe, const std::string& draw) {
    return "image one : rgba8 view\n pass base : raster { color one clear 0  draw host {} }\n pass look : compute { read one as sampled  write side "
           "as storage }\n"
           "image side : rgba8 view\n pass peek : raster { read side as sampled in fragment  color backbuffer covers  draw host {} }\n" +
           wipe + draw + kShown;
  };
  const std::string wipe = "pass wipe : transfer { clear one 0 }\n", draw = "pass draw : raster { color one  draw host {} }\n";
  EXPECT_EQ(outcome_of(text(wipe, draw)), "wipe: draw clears one\n");
  EXPECT_EQ(outcome_of(text("if host sometimes { " + wipe, draw + "}\n")), "wipe: draw clears one\n");
  EXPECT_EQ(outcome_of(text(wipe, "if host sometimes { " + draw + "}\n")), "wipe: `draw` runs under other conditions\n");
  EXPECT_EQ(outcome_of(text("if host sometimes { " + wipe + "}\n", draw)), "wipe: `draw` runs under other conditions\n");
}

struct Refused {
  std::string body, reason;
};
TEST(FoldTransfers, WhatForbidsItIsNamed) {
  const std::string one = "image one : rgba8 view\n", wipe = "pass wipe : transfer { clear one 0 }\n",
                    draw = "pass draw : raster { color one  draw host {} }\n";
  const std::string fill = "pass fill : raster { color one clear 0  draw host {} }\n";
  const std::string many = "image many : rgba8 view samples 4\n image one : rgba8 view\n image two : rgba8 view\n";
  const std::string flatten = "pass flatten : transfer { resolve many -> one }\n",
                    paint = "pass paint : raster { color many clear 0  draw host {} }\n";
  const Refused rows[] = {
      {one + wipe + "pass make : compute { update one as storage }\n" + kShown,
       "wipe: `make` writes `one` next, and only a rendering can begin so\n"},
      {one + "image side : rgba8 view\n" + wipe +
           "pass look : compute { read one as sampled  write side as storage }\n"
           "pass draw : raster { read side as sampled in fragment  color one  draw host {} }\n" +
           kShown,
       "wipe: `look` reads `one` next, and only a rendering can begin so\n"},
      {one + wipe + "pass draw : raster { color one clear 1  draw host {} }\n" + kShown, "wipe: `draw` defines all of `one` itself\n"},
      {one + wipe + "pass draw : raster { color one covers  draw host {} }\n" + kShown, "wipe: `draw` defines all of `one` itself\n"},
      {one + wipe + draw + "pass late : compute { update one as storage  after wipe }\n" + kShown, "wipe: `after` ties it to `late`\n"},
      {one + "pass wipe : transfer { clear one 0  keep }\n" + draw + kShown, "wipe: `keep` holds it\n"},
      {one + "pass wipe : transfer queue compute { clear one 0 }\n" + draw + kShown, "wipe: it names another queue than `draw`\n"},
      {"image one : rgba8 view mips 2\n pass wipe : transfer { clear one 0 }\n pass draw : raster { color one.mip(0)  draw host {} }\n" + kShown,
       "wipe: `draw` draws to another part of `one`\n"},
      {"image maps : d32f_s8 64x64\n image one : rgba8 view\n pass wipe : transfer { clear maps (1, 0) }\n pass draw : raster { depth maps  draw "
       "host {} }\n"
       "pass light : compute { read maps as sampled  write one as storage }\n" +
           kShown,
       "wipe: it clears aspects of `maps` that `draw` does not draw to\n"},
      {one + wipe + "pass draw : raster { color one.view(rgba8_srgb)  draw host {} }\n" + kShown, "wipe: `draw` sees `one` through another format\n"},
      {many + paint + "pass dots : raster { color many  resolve many -> two  draw host {} }\n" + flatten +
           "pass both : compute { read two as sampled  update one as storage }\n" + kShown,
       "flatten: `dots` resolves `many` already\n"},
      {many + fill + paint + "pass look : compute { read one as sampled  write two as storage }\n" + flatten +
           "pass both : compute { read two as sampled  update one as storage }\n" + kShown,
       "flatten: `look` reads `one` before it, and after `paint` it would be another\n"},
      {many + fill + paint + "pass over : raster { color one  draw host {} }\n pass look : compute { read one as sampled  write two as storage }\n" +
           flatten + "pass both : compute { read two as sampled  update one as storage }\n" + kShown,
       "flatten: `over` draws to `one` before it, and after `paint` it would be another\n"},
      {"image many : r32ui view samples 4\n image one : r32ui view\n pass paint : raster { color many clear 0  draw host {} }\n" + flatten + kShown,
       "flatten: which sample of `many` stays is not the same everywhere\n"},
      {"image many : rgba8 view samples 4\n pass paint : raster { color many clear 0  draw host {} }\n pass flatten : transfer { resolve many -> "
       "backbuffer }\n",
       "flatten: no pass draws to `backbuffer`, so that whoever brings it may not have made it an attachment\n"},
      {one + wipe + draw + kShown + "assert order(wipe, draw)\n", "wipe: `assert order(wipe, draw)` asks for it\n"},
  };
  for (const Refused& row : rows) EXPECT_EQ(outcome_of(row.body), row.reason) << row.body;
}

// A resolve that one of the plans has no use for stays a pass, so that this plan has not to make it.
TEST(FoldTransfers, NoPlanResolvesInVain) {
  const auto text = [](const std::string& rest) {
    return "module test\nextent view = runtime(64, 64) max(128, 128)\nfeature glow: bool\n"
           "graph frame(surface backbuffer: rgba8 view after copy_src) {\n image many : rgba8 view samples 4\n image one : rgba8 view\n"
           "pass paint : raster { color many clear 0  draw host {} }\n pass flatten : transfer { resolve many -> one }\n" +
           rest + "}\n";
  };
  const std::string look = "pass look : raster { read many as sampled in fragment  color backbuffer covers  draw host {} }\n";
  EXPECT_EQ(
      outcome(fold_transfers(
          program_of_text(text(look + "when glow { pass shine : raster { read one as sampled in fragment  color backbuffer  draw host {} } }\n")),
          {})),
      "flatten: there are plans that need `paint` and not `one`\n");
  EXPECT_EQ(outcome(fold_transfers(
                program_of_text(text(look + "pass shine : raster { read one as sampled in fragment  color backbuffer  draw host {} }\n")), {})),
            "flatten: paint resolves many to one\n");
}

TEST(FoldTransfers, SwitchesKeepThemApart) {
  EXPECT_EQ(outcome_of(multisampled(), {.fold = false}), "");
  EXPECT_EQ(outcome_of(multisampled(), {.no_fold = {"frame"}}), "");
  EXPECT_EQ(outcome_of(multisampled(), {.no_fold = {"wipe"}}), "flatten: draw resolves many to one\nwipe: `--no-fold=wipe`\n");
  EXPECT_EQ(outcome_of(multisampled(), {.no_fold = {"draw"}}), "wipe: `--no-fold=draw`\nflatten: `--no-fold=draw`\n");
}

TEST(FoldTransfers, DecisionsSayWhatBecameOfThem) {
  const FoldResult folded = fold_transfers(program_of(multisampled()), {.no_fold = {"flatten"}});
  const Decisions decisions = fold_decisions(folded.folds, folded.refusals, dsl::GraphId{size_t{0}});
  ASSERT_EQ(decisions.size(), 3u);
  EXPECT_EQ(decisions[0].subject + " " + decisions[0].what, "wipe folded");
  EXPECT_EQ(decisions[0].reason,
            "`draw` begins with `many` cleared: no pass, barrier, load or store of its own; with `--no-fold=wipe` it would be one");
  EXPECT_EQ(decisions[1].subject + " " + decisions[1].what + ": " + decisions[1].reason, "draw clears: `many`, in place of pass `wipe`");
  EXPECT_EQ(decisions[2].subject + " " + decisions[2].what + ": " + decisions[2].reason, "flatten not folded: `--no-fold=flatten`");
}

}  // namespace
}  // namespace rg::compiler
