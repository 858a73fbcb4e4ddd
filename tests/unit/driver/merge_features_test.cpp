// Features that only remove passes: conditions of one plan, which runs what the plan of each value would have run.
#include "compiler/merge_features.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "compiler/build_graph.h"
#include "compiler/compile.h"
#include "compiler/configurations.h"
#include "compiler/cull.h"
#include "compiler/verify/verify.h"
#include "dsl/front_end.h"

namespace rg::compiler {
namespace {

const std::string kHead = "module frame\nextent view = runtime(64, 64) max(64, 64)\n";

dsl::Program load(const std::string& text) {
  const dsl::ReadSource read = [&](const std::string&, std::string&) { return std::optional(kHead + text); };
  dsl::Diagnostics diagnostics;
  dsl::FrontEndResult front = dsl::load_program("frame.rg", read, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, front.files, false);
  return std::move(front.program);
}

std::vector<Configuration> plans_of(const dsl::Program& program) {
  dsl::Diagnostics diagnostics;
  return expand_configurations(program, dsl::GraphId{0}, {}, 4096, diagnostics);
}

std::set<std::string> live(const dsl::Program& program, const Configuration& configuration) {
  const Frame frame = expand(program, dsl::GraphId{0}, configuration, {});
  const Liveness liveness = cull(frame, build_graph(frame, std::vector<bool>(frame.passes.size(), true)));
  std::set<std::string> names;
  for (uint32_t i = 0; i < frame.passes.size(); ++i)
    if (liveness.live[i]) names.insert(frame.pass(i).name);
  return names;
}

// The passes that a frame runs which has these feature values, in the plan that fits them.
std::set<std::string> run_with(const dsl::Program& merged, const Configuration& plan, const Configuration& values) {
  const Frame frame = expand(merged, dsl::GraphId{0}, plan, {});
  std::set<std::string> names;
  const std::set<std::string> all = live(merged, plan);
  for (uint32_t i = 0; i < frame.passes.size(); ++i) {
    bool runs = all.contains(frame.pass(i).name);
    for (const dsl::ConditionId id : frame.pass(i).conditions) {
      const dsl::Condition& condition = merged.conditions[id];
      if (condition.feature.valid() &&
          std::find(condition.values.begin(), condition.values.end(), values[condition.feature.value]) == condition.values.end())
        runs = false;
    }
    if (runs) names.insert(frame.pass(i).name);
  }
  return names;
}

// Every feasible combination of values, by its own plan and by the merged one that it falls to. Returns how many plans are left.
size_t expect_same_frames(const std::string& text) {
  const dsl::Program program = load(text), merged = merge_features(program, dsl::GraphId{0}, {});
  const std::vector<Configuration> left = plans_of(merged);
  for (const Configuration& values : plans_of(program)) {
    size_t fitting = 0;
    for (const Configuration& plan : left) {
      bool fits = true;
      for (size_t f = 0; f < plan.size(); ++f) fits = fits && (plan[f] == kFreeFeature || plan[f] == values[f]);
      if (!fits) continue;
      ++fitting;
      EXPECT_EQ(run_with(merged, plan, values), live(program, values)) << configuration_name(program, values);
    }
    EXPECT_EQ(fitting, 1u) << configuration_name(program, values);
  }
  return left.size();
}

const std::string kBloom =
    "graph frame(surface back: rgba8 view after copy_src) {\n"
    "  image lit : rgba16f view\n  image glow : rgba16f view\n"
    "  pass light : raster { fullscreen \"a.frag\"  color lit clear 0 }\n";
const std::string kShow = "  pass show : raster { fullscreen \"b.frag\"  read lit as sampled  color back }\n}\n";

TEST(MergeFeatures, WhatOnlyRemovesPassesIsOnePlan) {
  const std::string text = "feature bloom : bool\n" + kBloom +
                           "  when bloom {\n    pass down : raster { fullscreen \"c.frag\"  read lit as sampled  color glow clear 0 }\n"
                           "    pass up : raster { fullscreen \"d.frag\"  read glow as sampled  color lit }\n  }\n" +
                           kShow;
  EXPECT_EQ(expect_same_frames(text), 1u);
  const dsl::Program merged = merge_features(load(text), dsl::GraphId{0}, {});
  ASSERT_EQ(merged.conditions.size(), 1u);
  EXPECT_EQ(merged.conditions.rows[0].name, "bloom=on");
  EXPECT_EQ(merged.conditions.rows[0].values, std::vector<uint32_t>{1});
}

TEST(MergeFeatures, WhatOnlyFeedsSkippedPassesIsSkippedToo) {
  const std::string text = "feature bloom : bool\n" + kBloom +
                           "  pass down : raster { fullscreen \"c.frag\"  read lit as sampled  color glow clear 0 }\n"
                           "  when bloom { pass up : raster { fullscreen \"d.frag\"  read glow as sampled  color lit } }\n" +
                           kShow;
  EXPECT_EQ(expect_same_frames(text), 1u);
  const dsl::Program merged = merge_features(load(text), dsl::GraphId{0}, {});
  size_t conditional = 0;
  for (const dsl::Pass& pass : merged.graphs.rows[0].passes) conditional += pass.conditions.size();
  EXPECT_EQ(conditional, 2u);
}

TEST(MergeFeatures, WhatSwapsPassesKeepsItsPlans) {
  const std::string text = "feature fast : bool\n" + kBloom +
                           "  when fast { pass x : raster { fullscreen \"c.frag\"  color lit blend add(one, one) } }\n"
                           "  else { pass y : raster { fullscreen \"d.frag\"  color lit blend add(one, one) } }\n" +
                           kShow;
  EXPECT_EQ(expect_same_frames(text), 2u);
}

TEST(MergeFeatures, WhatMakesOtherPassesSuperfluousKeepsItsPlans) {
  // With `wipe`, what `light` draws is overwritten, and `light` is culled.
  const std::string text =
      "feature wipe : bool\n" + kBloom + "  when wipe { pass x : raster { fullscreen \"c.frag\"  color lit clear 0 } }\n" + kShow;
  EXPECT_EQ(expect_same_frames(text), 2u);
}

TEST(MergeFeatures, ValuesThatRunTheSamePassesShareACondition) {
  const std::string text = "feature glow_of : { none, low, high }\n" + kBloom +
                           "  when glow_of != none { pass x : raster { fullscreen \"c.frag\"  color lit blend add(one, one) } }\n"
                           "  when glow_of == high { pass y : raster { fullscreen \"d.frag\"  color lit blend add(one, one) } }\n" +
                           kShow;
  EXPECT_EQ(expect_same_frames(text), 1u);
  const dsl::Program merged = merge_features(load(text), dsl::GraphId{0}, {});
  ASSERT_EQ(merged.conditions.size(), 2u);
  EXPECT_EQ(merged.conditions.rows[0].name, "glow_of=low|high");
  EXPECT_EQ(merged.conditions.rows[1].name, "glow_of=high");
}

TEST(MergeFeatures, RulesAndOtherPlansAreKept) {
  const std::string text = "feature fast : bool\nfeature haze : bool requires fast\n" + kBloom +
                           "  when fast { pass x : raster { fullscreen \"c.frag\"  color lit blend add(one, one) } }\n"
                           "  else { pass y : raster { fullscreen \"d.frag\"  color lit blend add(one, one) } }\n"
                           "  when haze { pass z : raster { fullscreen \"e.frag\"  color lit blend add(one, one) } }\n" +
                           kShow;
  EXPECT_EQ(expect_same_frames(text), 2u);
}

TEST(MergeFeatures, WhatIsFixedOnTheCommandLineIsNoCondition) {
  const dsl::Program program =
      load("feature haze : bool\n" + kBloom + "  when haze { pass z : raster { fullscreen \"e.frag\"  color lit blend add(one, one) } }\n" + kShow);
  EXPECT_EQ(merge_features(program, dsl::GraphId{0}, {"haze=off"}), program);
}

std::string many_features(size_t removing, size_t swapping) {
  std::string head, body;
  for (size_t i = 0; i < removing + swapping; ++i) {
    const std::string n = std::to_string(i);
    head += "feature f" + n + " : bool\n";
    body += "  when f" + n + " { pass on" + n + " : raster { fullscreen \"c.frag\"  color lit blend add(one, one) } }\n";
    if (i >= removing) body += "  else { pass off" + n + " : raster { fullscreen \"c.frag\"  color lit blend add(one, one) } }\n";
  }
  return head + kBloom + body + kShow;
}

TEST(MergeFeatures, EightThatRemovePassesAreOnePlan) { EXPECT_EQ(expect_same_frames(many_features(8, 0)), 1u); }
TEST(MergeFeatures, OnlyThoseThatSwapPassesMultiply) { EXPECT_EQ(expect_same_frames(many_features(3, 2)), 4u); }

TEST(MergeFeatures, ThePlanIsProvedForEveryOutcome) {
  const std::string text = kHead + many_features(4, 1);
  const dsl::ReadSource read = [&](const std::string& path, std::string& why) -> std::optional<std::string> {
    if (path == "frame.rg") return text;
    if (path == "b.frag") return "void main() { back = texelFetch(lit, ivec2(gl_FragCoord.xy), 0); }\n";
    if (path.ends_with(".frag")) return "void main() { lit = vec4(0.5); }\n";
    why = "no such file";
    return std::nullopt;
  };
  dsl::Diagnostics diagnostics;
  CompileOptions options;
  options.until = Until::plans;
  const CompileResult result = compile("frame.rg", read, options, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.sources, false);
  ASSERT_EQ(result.graphs[0].plans.size(), 2u);
  for (const FramePlan& frame : result.graphs[0].plans) {
    EXPECT_EQ(frame.plan.feature_conditions.size(), 4u);
    for (const verify::Finding& finding : verify::verify(result.program, dsl::GraphId{0}, frame.configuration, frame.plan.view(),
                                                         frame.plan.program_pass, frame.plan.program_resource))
      ADD_FAILURE() << verify::name(finding.hazard) << ": " << finding.text;
  }
}

}  // namespace
}  // namespace rg::compiler
