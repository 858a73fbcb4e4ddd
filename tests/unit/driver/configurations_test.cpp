#include "compiler/configurations.h"

#include <gtest/gtest.h>

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

// fog: off on; quality: low mid high. The graph uses both unless told otherwise.
dsl::Program two_features(bool use_quality = true) {
  dsl::Program program;
  program.features.add({"fog", {"off", "on"}, 1, {}});
  program.features.add({"quality", {"low", "mid", "high"}, 2, {}});
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

TEST(Configurations, UnknownFeatureOrValueIsReported) {
  for (const char* text : {"dew=on", "fog=maybe", "fog"}) {
    dsl::Diagnostics diagnostics;
    expand_configurations(two_features(), dsl::GraphId{0}, {text}, 64, diagnostics);
    ASSERT_EQ(diagnostics.rows().size(), 1u) << text;
    EXPECT_EQ(diagnostics.rows()[0].kind, DiagnosticKind::UnknownFeatureValue);
    EXPECT_EQ(diagnostics.rows()[0].arguments, std::vector<std::string>{text});
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
