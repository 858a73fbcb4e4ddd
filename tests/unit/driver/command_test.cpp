#include "compiler/commands/command.h"

#include <gtest/gtest.h>

#include "compiler/commands/apply_fixes.h"
#include "compiler/commands/facts.h"

namespace rg::commands {
namespace {

TEST(Command, CountsInWords) {
  EXPECT_EQ(counted(1, "pass", "passes"), "1 pass");
  EXPECT_EQ(counted(0, "pass", "passes"), "0 passes");
  EXPECT_EQ(counted(3, "barrier"), "3 barriers");
}

TEST(Command, NearestIsTheOneMeantOrNone) {
  const std::vector<std::string> names = {"tone_map", "light_cull", "bloom_down[0]"};
  EXPECT_EQ(nearest("tonemap", names), "tone_map");
  EXPECT_EQ(nearest("light_cul", names), "light_cull");
  EXPECT_EQ(nearest("shadow", names), std::nullopt);
  EXPECT_EQ(nearest("x", {}), std::nullopt);
}

TEST(Command, AFixThatChangesNothingIsNone) {
  dsl::SourceFiles files;
  files.add(dsl::SourceFile("a.rg", "one two\n"));
  dsl::Diagnostics diagnostics;
  const dsl::FileId file{size_t{0}};
  diagnostics.report(dsl::Diagnostic(dsl::DiagnosticKind::AxesApart, {file, 0, 3}, {"one"}).fix({file, 0, 3}, "one"));
  EXPECT_EQ(apply_fixes(diagnostics, files, file).count, 0u);
  diagnostics.report(dsl::Diagnostic(dsl::DiagnosticKind::AxesApart, {file, 4, 7}, {"2"}).fix({file, 4, 7}, "2"));
  const Fixed fixed = apply_fixes(diagnostics, files, file);
  EXPECT_EQ(fixed.count, 1u);
  EXPECT_EQ(fixed.text, "one 2\n");
}

TEST(Facts, NamesAreThoseOfVulkan) {
  EXPECT_EQ(stage_names(stage::compute_shader | stage::fragment_shader), "FRAGMENT_SHADER|COMPUTE_SHADER");
  EXPECT_EQ(stage_names(0), "NONE");
  EXPECT_EQ(access_names(access::shader_storage_write), "SHADER_STORAGE_WRITE");
  EXPECT_EQ(layout_name(Layout::depth_read_only), "DEPTH_READ_ONLY");
  EXPECT_EQ(tag_name(BarrierTag::alias_pair), "alias pair");
}

TEST(Facts, CountsWhatAPlanHolds) {
  dsl::Program program;
  program.graphs.add({});
  compiler::FramePlan frame;
  frame.plan.passes.resize(3);
  frame.plan.culled.resize(1);
  frame.plan.groups.resize(3);
  frame.plan.groups[0].image_count = 2;
  frame.plan.groups[2].memory_count = 1;
  frame.plan.image_barriers.resize(2);
  frame.plan.memory_barriers.push_back({stage::all_commands, 0, stage::host, access::host_read});
  frame.plan.batches.resize(1);
  frame.heap_bytes = 10, frame.unaliased_bytes = 20, frame.lower_bound_bytes = 9, frame.lazy_bytes = 4, frame.heap_beside_lazy_bytes = 7;
  frame.phase_ms = {{"cull", 1.5}, {"order", 2.5}};
  compiler::CompiledGraph graph;
  graph.graph = dsl::GraphId{0};
  graph.plans.push_back(frame);
  const nlohmann::ordered_json json = to_json(find_facts(program, graph, graph.plans[0]));
  EXPECT_EQ(json["passes"], (nlohmann::ordered_json{{"live", 3}, {"culled", 1}, {"raster", 0}, {"renderings", 0}}));
  EXPECT_EQ(json["memory"],
            (nlohmann::ordered_json{
                {"heap_bytes", 10}, {"unaliased_bytes", 20}, {"lower_bound_bytes", 9}, {"lazy_bytes", 4}, {"heap_beside_lazy_bytes", 7}}));
  EXPECT_EQ(json["barriers"]["calls"], 2);
  EXPECT_EQ(json["barriers"]["barriers"], 3);
  EXPECT_EQ(json["barriers"]["all_commands"], 1);
  EXPECT_EQ(json["barriers"]["stages"], 2);
  EXPECT_EQ(json["barriers"]["accesses"], 1);
  EXPECT_EQ(json["queues"]["submits"], 1);
  EXPECT_EQ(json["queues"]["waits"], 0);
  EXPECT_EQ(json["variants"], (nlohmann::ordered_json{{"plans", 1}, {"shaders", 0}}));
  EXPECT_EQ(json["time_ms"]["plan"], 4.0);
}

}  // namespace
}  // namespace rg::commands
