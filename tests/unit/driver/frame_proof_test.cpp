// passes.rg is proved: at a thousand sizes, and against every damaged element of its plan.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

#include "compiler/compile.h"
#include "compiler/machine/machine.h"
#include "compiler/verify/mutate.h"

namespace rg::compiler {
namespace {

const CompileResult& frame() {
  static const CompileResult result = [] {
    const dsl::ReadSource read = [](const std::string& path, std::string& why) -> std::optional<std::string> {
      std::ifstream file(path);
      if (!file) return why = "no such file", std::nullopt;
      std::stringstream text;
      text << file.rdbuf();
      return text.str();
    };
    CompileOptions options;
    options.until = Until::plans;
    dsl::Diagnostics diagnostics;
    CompileResult compiled = compile(std::string(RGC_SOURCE_DIR) + "/passes.rg", read, options, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, compiled.sources, false);
    return compiled;
  }();
  return result;
}

const FramePlan& plan() { return frame().graphs.at(0).plans.at(0); }

std::string all_text(const std::vector<verify::Finding>& findings) {
  std::string text;
  for (const verify::Finding& finding : findings) text += std::string(verify::name(finding.hazard)) + ": " + finding.text + "\n";
  return text;
}

TEST(FrameProof, HoldsAtAThousandRandomSizes) {
  std::mt19937 random(1);
  verify::VerifyOptions options;
  for (int i = 0; i < 1000; ++i) {
    std::vector<int64_t> extents = dsl::maximum_extents(frame().program);
    for (int64_t& value : extents) value = 1 + static_cast<int64_t>(random() % static_cast<uint32_t>(value));
    options.extents.push_back(extents);
  }
  const auto findings = verify::verify(frame().program, frame().graphs[0].graph, plan().configuration, plan().plan.view(), plan().plan.program_pass,
                                       plan().plan.program_resource, options);
  EXPECT_EQ(all_text(findings), "");
}

// The abstract machine as second opinion, conditions all off and all on.
bool misbehaves(const Plan& mutant) {
  machine::MachineOptions options;
  options.max_divergences = 1;
  for (const Resource& resource : mutant.resources) {
    const bool shares = resource.lifetime == Lifetime::transient && !resource.no_alias;
    options.placement.push_back(shares ? machine::Placement{resource.estimated_offset, resource.estimated_bytes} : machine::Placement{});
  }
  for (const uint64_t conditions : {uint64_t{0}, ~uint64_t{0}}) {
    options.conditions = {conditions};
    if (!machine::run_adversarially(frame().program, frame().graphs[0].graph, plan().configuration, mutant, plan().plan.program_pass,
                                    plan().plan.program_resource, options)
             .empty())
      return true;
  }
  return false;
}

// How many passes may change places is the order's business. Of all other damage few elements change nothing, and in those the machine sees nothing
// either (--long).
TEST(FrameProof, EveryDamagedElementIsNoticed) {
  verify::MutateOptions options;
  if (std::getenv("RGC_LONG")) options.misbehaves = misbehaves;  // a minute
  const verify::MutationReport report = verify::mutate(frame().program, frame().graphs[0].graph, plan().configuration, plan().plan.view(),
                                                       plan().plan.program_pass, plan().plan.program_resource, options);
  EXPECT_GT(report.mutants, 400u);
  size_t equivalent = 0;
  for (const auto& [name, count] : report.equivalent) equivalent += count;
  EXPECT_EQ(report.killed + equivalent, report.mutants);
  const auto exchanged = report.equivalent.find("exchanged passes that do not depend on each other");
  const size_t free = exchanged == report.equivalent.end() ? 0 : exchanged->second;
  EXPECT_GT(report.killed * 100, (report.mutants - free) * 95);
  for (const std::string& survivor : report.survivors) ADD_FAILURE() << "not noticed: " << survivor;
}

TEST(FrameProof, MemoryIsWithinTwoPercentOfTheBoundAndBarriersAreExact) {
  EXPECT_LE(static_cast<double>(plan().heap_bytes), static_cast<double>(plan().lower_bound_bytes) * 1.02);
  const Stages fat_stages = stage::all_commands | stage::all_graphics;
  const Accesses fat_accesses = access::memory_read | access::memory_write;
  const Plan view = plan().plan.view();
  const auto is_exact = [&](const auto& barrier) {
    return ((barrier.src_stages | barrier.dst_stages) & fat_stages) == 0 && ((barrier.src_accesses | barrier.dst_accesses) & fat_accesses) == 0;
  };
  for (const MemoryBarrier& barrier : view.memory_barriers) EXPECT_TRUE(is_exact(barrier));
  for (const ImageBarrier& barrier : view.image_barriers) EXPECT_TRUE(is_exact(barrier)) << view.resources[barrier.image.resource].name;
  for (const BufferBarrier& barrier : view.buffer_barriers) EXPECT_TRUE(is_exact(barrier)) << view.resources[barrier.buffer.resource].name;
  EXPECT_GE(view.passes.size(), 16u);
}

}  // namespace
}  // namespace rg::compiler
