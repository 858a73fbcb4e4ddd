#include "compiler/configurations.h"

#include <gtest/gtest.h>

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

// fog: off on; quality: low mid high. The graph uses both unless told otherwise.
dsl::Program two_features(bool use_quality = true) {
  dsl::Program program;
  program.features.add({"fog", {"off", "on"}, 1, {}, {}});
  program.features.add({"quality", {"low", "mid", "high"}, 2, {}, {}});
  dsl::Graph graph;
  graph.name = "frame";
  dsl::Pass fog, detail;
  fog.guard.terms.push_back({dsl::FeatureId{0}, 1, false});
  detail.guard.terms.push_back({dsl::FeatureId{1}, 2, true});
  graph.passes.add(fog);
  if (use_quality) graph.passes.add(detail);
  program.graphs.add(graph);
  return program;
}

std::vector<Configuration> expand(const dsl::Program& program, const std::vector<std::string>& fixed = {}, size_t limit = 64) {
  dsl::Diagnostics diagnostics;
  const auto all = expand_configurations(program, dsl::GraphId{0}, fixed, limit, diagnostics);
  EXPECT_TRUE(diagnostics.rows().empty());
  return all;
}

TEST(Configurations, OneWithoutFeatures) {
  dsl::Program program;
  program.graphs.add({});
  EXPECT_EQ(expand(program), std::vector<Configuration>{{}});
}

TEST(Configurations, CountUpWithTheFirstFeatureSlowest) {
  const std::vector<Configuration> expected = {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}};
  EXPECT_EQ(expand(two_features()), expected);
}

TEST(Configurations, UnusedFeaturesKeepTheirInitialValue) {
  const std::vector<Configuration> expected = {{0, 2}, {1, 2}};
  EXPECT_EQ(expand(two_features(false)), expected);
}

TEST(Configurations, FixedFeaturesDoNotVary) {
  const std::vector<Configuration> expected = {{0, 1}, {1, 1}};
  EXPECT_EQ(expand(two_features(), {"quality=mid"}), expected);
}

TEST(Configurations, RulesLeaveCombinationsOut) {
  dsl::Program program = two_features();
  program.features.rows[0].rules.push_back({1, {dsl::FeatureId{1}, 2, false}, {}});  // fog requires quality == high
  const std::vector<Configuration> expected = {{0, 0}, {0, 1}, {0, 2}, {1, 2}};
  EXPECT_EQ(expand(program), expected);
  EXPECT_EQ(expand(program, {"fog=on"}), std::vector<Configuration>({{1, 2}}));
  EXPECT_EQ(expand(program, {"quality=low"}), std::vector<Configuration>({{0, 0}}));
}

TEST(Configurations, FeaturesTheGraphDoesNotUseFollowTheRules) {
  dsl::Program program = two_features(false);
  program.features.rows[0].rules.push_back({1, {dsl::FeatureId{1}, 2, true}, {}});  // fog excludes quality == high, the initial value
  const std::vector<Configuration> expected = {{0, 2}, {1, 0}};
  EXPECT_EQ(expand(program), expected);
}

TEST(Configurations, WhatIsFixedMayContradictTheRules) {
  dsl::Program program = two_features();
  program.features.rows[0].rules.push_back({1, {dsl::FeatureId{1}, 2, false}, {}});
  dsl::Diagnostics diagnostics;
  EXPECT_TRUE(expand_configurations(program, dsl::GraphId{0}, {"fog=on", "quality=low"}, 64, diagnostics).empty());
  ASSERT_EQ(diagnostics.rows().size(), 1u);
  EXPECT_EQ(diagnostics.rows()[0].kind, DiagnosticKind::NoConfiguration);
}

TEST(Configurations, TheErrorNamesTheFeaturesThatMultiply) {
  dsl::Diagnostics diagnostics;
  EXPECT_TRUE(expand_configurations(two_features(), dsl::GraphId{0}, {}, 5, diagnostics).empty());
  ASSERT_EQ(diagnostics.rows().size(), 1u);
  EXPECT_EQ(diagnostics.rows()[0].message(), "graph `frame` has 6 feature configurations; the limit is 5");
  ASSERT_EQ(diagnostics.rows()[0].notes.size(), 2u);
  EXPECT_EQ(diagnostics.rows()[0].notes[1].kind, DiagnosticKind::FeatureMultiplies);
  EXPECT_EQ(diagnostics.rows()[0].notes[1].message(), "feature `quality` multiplies them by up to 3");
}

// Every pair of rules over three small features, against trying all 12 combinations one by one.
TEST(Configurations, SearchAgreesWithTryingAll) {
  size_t forbidden = 0;
  for (uint32_t seed = 0; seed < 400; ++seed) {
    dsl::Program program = two_features();
    program.features.add({"rain", {"off", "on"}, 0, {}, {}});
    dsl::Pass wet;
    wet.guard.terms.push_back({dsl::FeatureId{2}, 1, false});
    program.graphs[dsl::GraphId{0}].passes.add(wet);
    for (uint32_t rule = 0, rest = seed; rule < 2; ++rule, rest /= 20) {
      const uint32_t from = rest % 3, to = (from + 1 + rest / 3 % 2) % 3;
      const auto count = static_cast<uint32_t>(program.features.rows[to].values.size());
      program.features.rows[from].rules.push_back({rest / 6 % 2, {dsl::FeatureId{to}, rest % count, rest / 12 % 2 == 1}, {}});
    }
    std::vector<Configuration> expected;
    for (uint32_t fog = 0; fog < 2; ++fog)
      for (uint32_t quality = 0; quality < 3; ++quality)
        for (uint32_t rain = 0; rain < 2; ++rain) {
          const Configuration values = {fog, quality, rain};
          bool fits = true;
          for (uint32_t f = 0; f < 3; ++f)
            for (const dsl::Feature::Rule& rule : program.features.rows[f].rules)
              fits = fits && (values[f] != rule.value || (values[rule.needs.feature.value] == rule.needs.value) != rule.needs.negated);
          if (fits) expected.push_back(values);
        }
    EXPECT_EQ(expand(program), expected) << "seed " << seed;
    forbidden += 12 - expected.size();
  }
  EXPECT_GT(forbidden, 400u);
}

TEST(Configurations, UnknownFeatureOrValueIsReported) {
  struct Case {
    std::vector<std::string> fixed;
    DiagnosticKind kind;
    std::vector<std::string> arguments;
  };
  const Case cases[] = {{{"dew=on"}, DiagnosticKind::UnknownName, {"feature", "dew"}},
                        {{"fog=maybe"}, DiagnosticKind::UnknownSettingValue, {"maybe", "fog", "`off`, `on`"}},
                        {{"fog"}, DiagnosticKind::UnknownFeatureValue, {"fog"}},
                        {{"fog=on", "fog=off"}, DiagnosticKind::RepeatedSetting, {"fog"}}};
  for (const Case& each : cases) {
    dsl::Diagnostics diagnostics;
    expand_configurations(two_features(), dsl::GraphId{0}, each.fixed, 64, diagnostics);
    ASSERT_EQ(diagnostics.rows().size(), 1u) << each.fixed[0];
    EXPECT_EQ(diagnostics.rows()[0].kind, each.kind) << each.fixed[0];
    EXPECT_EQ(diagnostics.rows()[0].arguments, each.arguments);
  }
}

TEST(Configurations, TooManyPlansAreReportedWithTheirNumber) {
  dsl::Diagnostics diagnostics;
  EXPECT_TRUE(expand_configurations(two_features(), dsl::GraphId{0}, {}, 5, diagnostics).empty());
  ASSERT_EQ(diagnostics.rows().size(), 1u);
  EXPECT_EQ(diagnostics.rows()[0].kind, DiagnosticKind::TooManyPlans);
  EXPECT_EQ(diagnostics.rows()[0].arguments, (std::vector<std::string>{"frame", "6", "5"}));
}

TEST(Configurations, NamesListAllFeatures) {
  EXPECT_EQ(configuration_name(two_features(), {1, 0}), "fog=on quality=low");
  EXPECT_EQ(configuration_name({}, {}), "");
}

}  // namespace
}  // namespace rg::compiler
