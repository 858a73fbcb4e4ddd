// The planner under two witnesses: random programs of the whole language are planned for one to four queues in every configuration, proved by the
// checker and run by the abstract machine. A failure is shrunk to a small `.rg` text; those found so far are kept in tests/golden/planner and run
// again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "compiler/fold_transfers.h"
#include "compiler/machine/machine.h"
#include "compiler/plan_frame.h"
#include "compiler/verify/folding.h"
#include "compiler/verify/verify.h"
#include "dsl/front_end.h"
#include "wide_program.h"

namespace rg::test {
namespace {

using Kind = dsl::QueueKind;
const std::vector<std::vector<Kind>> kQueues = {{Kind::graphics},
                                                {Kind::graphics, Kind::compute},
                                                {Kind::graphics, Kind::compute, Kind::transfer},
                                                {Kind::graphics, Kind::compute, Kind::compute, Kind::transfer}};
constexpr dsl::GraphId kGraph{size_t{0}};

// Nothing where the front end refuses the text.
std::optional<dsl::Program> load(const std::string& text, std::string* why = nullptr) {
  dsl::Diagnostics diagnostics;
  dsl::FrontEndResult front = dsl::load_program(
      "fuzz.rg", [&](const std::string&, std::string&) { return std::optional(text); }, diagnostics);
  if (why) *why = print(diagnostics, front.files, false);
  if (diagnostics.has_errors() || front.program.graphs.empty()) return std::nullopt;
  return std::move(front.program);
}

struct Question {
  std::vector<Kind> queues;
  bool irredundancy = false, run = false;
  bool fold = true;    // renderings clear and resolve where they can
  bool split = false;  // barriers with events
};

std::string first_divergence(const dsl::Program& program, const std::vector<uint32_t>& configuration, const PlanData& plan) {
  machine::MachineOptions options;
  options.max_divergences = 1;
  for (const Resource& resource : plan.resources) {
    const bool shares = resource.lifetime == Lifetime::transient && !resource.no_alias;
    options.placement.push_back(shares ? machine::Placement{resource.estimated_offset, resource.estimated_bytes} : machine::Placement{});
  }
  for (const std::vector<uint64_t>& conditions : {std::vector<uint64_t>{0}, {3}, {1, 2, 0}}) {
    options.conditions = conditions;
    const auto found = machine::run_adversarially(program, kGraph, configuration, plan.view(), plan.program_pass, plan.program_resource, options);
    if (!found.empty()) return "machine: " + machine::text(found.front());
  }
  return {};
}

// What is wrong with the plans of the program; empty: nothing.
std::string judge(const dsl::Program& written, const Question& question) {
  compiler::PlanOptions folding;
  folding.fold = question.fold;
  dsl::Program program = compiler::fold_transfers(written, folding).program;
  program.split_barriers = question.split;
  for (const uint32_t rich : {0u, 1u}) {
    if (rich != 0 && program.features.empty()) continue;
    const std::vector<uint32_t> configuration(program.features.size(), rich);
    compiler::PlanOptions options;
    options.queues = question.queues;
    for (const verify::Finding& finding : verify::verify_folding(written, program, kGraph, configuration))
      return fmt::format("{}: {}", verify::name(finding.hazard), finding.text);
    const PlanData plan = compiler::plan_frame(program, kGraph, configuration, options).plan;
    verify::VerifyOptions verify_options;
    verify_options.irredundancy = question.irredundancy;
    verify_options.max_findings = 1;
    for (const verify::Finding& finding :
         verify::verify(program, kGraph, configuration, plan.view(), plan.program_pass, plan.program_resource, verify_options))
      return fmt::format("{}: {}", verify::name(finding.hazard), finding.text);
    const std::string diverges = question.run ? first_divergence(program, configuration, plan) : std::string();
    if (!diverges.empty()) return diverges;
  }
  return {};
}

std::string kind_of(const std::string& failure) { return failure.substr(0, failure.find(':')); }

std::string shrunk(const std::string& text, const Question& question, const std::string& failure) {
  return shrink(text, [&](const std::string& less) {
    const auto program = load(less);
    return program && kind_of(judge(*program, question)) == kind_of(failure);
  });
}

TEST(PlannerFuzz, WideProgramsAreProvedAndRun) {
  const bool is_long = std::getenv("RGC_LONG") != nullptr;
  size_t accepted = 0;
  const uint64_t count = is_long ? 20000 : 240;
  const char* from = std::getenv("RGC_FIRST_SEED");  // for programs that no run before has seen
  const uint64_t first = from ? std::strtoull(from, nullptr, 10) : 1;
  for (uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) {
    const std::string text = make_wide_program(seed, 3 + static_cast<uint32_t>(seed % 12));
    std::string why;
    const auto program = load(text, &why);
    if (!program) {
      EXPECT_NE(why.find("RG03"), std::string::npos) << "seed " << seed << "\n" << why;  // what a skipped pass leaves undefined
      continue;
    }
    ++accepted;
    const Question question{kQueues[seed % 4], true, seed % 4 == 1 || is_long, seed % 3 != 0, seed / 4 % 2 == 1};
    const std::string failure = judge(*program, question);
    if (!failure.empty())
      ADD_FAILURE() << "seed " << seed << ", " << question.queues.size() << " queues: " << failure << "\n" << shrunk(text, question, failure);
  }
  EXPECT_GT(accepted * 10, count * 5);
}

TEST(PlannerFuzz, ShrunkProgramsStayRight) {
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(RGC_SOURCE_DIR) + "/tests/golden/planner")) {
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    const auto program = load(text.str());
    ASSERT_TRUE(program) << entry.path();
    ++files;
    for (const std::vector<Kind>& queues : kQueues)
      for (const bool split : {false, true})
        EXPECT_EQ(judge(*program, {queues, true, true, true, split}), "")
            << entry.path() << ", " << queues.size() << " queues" << (split ? ", split" : "");
  }
  EXPECT_GT(files, 0u);
}

// Ranges that depend on extents: what could go is found where they lie alike at all extents, and not called so where others may need it.
TEST(Redundancy, IsJudgedOfRangesThatLieAlikeAtAllExtents) {
  const auto with_a_stage_too_many = [](const std::string& begin) {
    const auto program = load(
        "module m\nextent n = runtime(64) min(20) max(1000)\nextent m = runtime(8) max(16)\ngraph frame() {\n"
        " buffer words : u32[n]\n buffer all : u32[n] output\n"
        " pass left : compute { write words.bytes(0, n / 2 * 4) as storage }\n"
        " pass right : compute { write words.bytes(" +
        begin +
        ", 4) as storage }\n"
        " pass more : compute { read words.bytes(0, n / 2 * 4) as storage  write all as storage }\n}\n");
    EXPECT_TRUE(program);
    PlanData plan = compiler::plan_frame(*program, kGraph, {}, {}).plan;
    verify::VerifyOptions options;
    options.irredundancy = true;
    const auto findings = [&] { return verify::verify(*program, kGraph, {}, plan.view(), plan.program_pass, plan.program_resource, options); };
    EXPECT_TRUE(findings().empty());
    const auto reads =
        std::find_if(plan.buffer_barriers.begin(), plan.buffer_barriers.end(), [](const BufferBarrier& b) { return b.src_accesses != 0; });
    if (reads == plan.buffer_barriers.end()) return ADD_FAILURE() << "no barrier", size_t{0};
    reads->dst_stages |= stage::vertex_shader;
    return findings().size();
  };
  EXPECT_EQ(with_a_stage_too_many("n / 2 * 4"), 1u);
  EXPECT_EQ(with_a_stage_too_many("m * 4"), 0u);
}

// Writers that commute do not wait for each other, so what one of them reads orders only itself: a plan that orders nothing else before the other is
// wrong.
TEST(Commuting, ReadersOrderOnlyThemselves) {
  const auto program = load(
      "module m\ngraph frame(surface backbuffer: rgba8 64x64) {\n buffer words : u32[64]\n pass zero : transfer { fill words 0 }\n"
      " pass one : compute { update words as storage disjoint }\n"
      " pass two : raster { write words as storage in fragment disjoint  color backbuffer clear 0 }\n"
      " pass look : raster { read words as storage in fragment  color backbuffer clear 0 }\n}\n");
  ASSERT_TRUE(program);
  PlanData plan = compiler::plan_frame(*program, kGraph, {}, {}).plan;
  const auto findings = [&] { return verify::verify(*program, kGraph, {}, plan.view(), plan.program_pass, plan.program_resource, {}); };
  EXPECT_TRUE(findings().empty());
  const auto filled = std::find_if(plan.buffer_barriers.begin(), plan.buffer_barriers.end(),
                                   [](const BufferBarrier& b) { return b.src_accesses == access::transfer_write; });
  ASSERT_NE(filled, plan.buffer_barriers.end());
  ASSERT_NE(filled->dst_stages & stage::fragment_shader, 0u);
  filled->dst_stages &= ~stage::fragment_shader;
  EXPECT_FALSE(findings().empty());
}

// What an atomic returns depends on what it adds to, be the sum read or not: `append` before `zero` gives out other places of the list.
TEST(Commuting, WritersAddToWhatTheProgramSays) {
  const auto program = load(
      "module m\ngraph frame() {\n buffer counter : u32[4]\n buffer list : u32[64] output\n buffer seen : u32[4] output\n"
      " pass old : compute { write counter as storage }\n pass look : compute { read counter as storage  write seen as storage }\n"
      " pass zero : compute { write counter as storage }\n pass append : compute { atomic counter as storage  write list as storage }\n}\n");
  ASSERT_TRUE(program);
  PlanData plan = compiler::plan_frame(*program, kGraph, {}, {}).plan;
  const auto findings = [&] { return verify::verify(*program, kGraph, {}, plan.view(), plan.program_pass, plan.program_resource, {}); };
  EXPECT_TRUE(findings().empty());
  const auto step_of = [&](const char* name) {
    return std::find_if(plan.steps.begin(), plan.steps.end(),
                        [&](const Step& step) { return step.kind == StepKind::pass && plan.passes[step.index].name == name; });
  };
  std::iter_swap(step_of("zero"), step_of("append"));
  const auto found = findings();
  const auto wrong =
      std::find_if(found.begin(), found.end(), [](const verify::Finding& finding) { return finding.hazard == verify::Hazard::wrong_version; });
  ASSERT_NE(wrong, found.end());
  EXPECT_EQ(wrong->text, "`append` reads `counter`: it finds what `old` wrote in frame 0, program order gives what `zero` wrote in frame 0");
}

TEST(PlannerFuzz, ShrinkingKeepsTheFailure) {
  const std::string text = "a\nb\nc\nneedle\nd\n";
  EXPECT_EQ(shrink(text, [](const std::string& less) { return less.find("needle") != std::string::npos; }), "needle\n");
}

}  // namespace
}  // namespace rg::test
