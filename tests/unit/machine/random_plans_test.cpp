// The planner's plans of random programs: legal as they are, broken by taking away almost any single thing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>

#include "compiler/machine/machine.h"
#include "compiler/plan_frame.h"
#include "dsl/front_end.h"
#include "random_program.h"

namespace rg::test {
namespace {

using machine::Divergence;
using machine::MachineOptions;

struct Planned {
  dsl::Program program;
  compiler::FramePlan frame;
};

// Nothing where the program reads what a skipped pass may have left unwritten: the front end refuses it.
std::optional<Planned> plan_random(uint64_t seed) {
  const std::string source = make_random_program(seed, 4 + static_cast<uint32_t>(seed % 17));
  dsl::Diagnostics diagnostics;
  dsl::FrontEndResult front = dsl::load_program(
      "random.rg", [&](const std::string&, std::string&) { return std::optional(source); }, diagnostics);
  for (const dsl::Diagnostic& each : diagnostics.rows())
    if (row(each.kind).severity == dsl::Severity::error && row(each.kind).code != "RG0301" && row(each.kind).code != "RG0305" &&
        row(each.kind).code != "RG0390")
      ADD_FAILURE() << "seed " << seed << ": " << print(diagnostics, front.files, false);
  if (diagnostics.has_errors()) return std::nullopt;
  Planned planned{std::move(front.program), {}};
  planned.frame = compiler::plan_frame(planned.program, dsl::GraphId{0}, {}, {});
  return planned;
}

// The conditions of three frames: never, always, in turn.
const std::vector<std::vector<uint64_t>> kOutcomes = {{0}, {1}, {0, 1, 0}, {1, 0, 1}};

std::vector<Divergence> run(const Planned& planned, const PlanData& plan, const MachineOptions& options) {
  return machine::run_adversarially(planned.program, dsl::GraphId{0}, {}, plan.view(), plan.program_pass, plan.program_resource, options);
}

std::vector<machine::Placement> estimated_placement(const PlanData& plan) {
  std::vector<machine::Placement> placement;
  for (const Resource& resource : plan.resources) {
    const bool shares = resource.lifetime == Lifetime::transient && !resource.no_alias;
    placement.push_back(shares ? machine::Placement{resource.estimated_offset, resource.estimated_bytes} : machine::Placement{});
  }
  return placement;
}

TEST(RandomPlans, AgreeWithProgramOrder) {
  int checked = 0;
  for (uint64_t seed = 1; seed <= 80; ++seed) {
    const std::optional<Planned> accepted = plan_random(seed);
    if (!accepted) continue;
    const Planned& planned = *accepted;
    ++checked;
    for (const bool aliased : {false, true})
      for (const std::vector<uint64_t>& conditions : kOutcomes) {
        MachineOptions options;
        options.conditions = conditions;
        if (aliased) options.placement = estimated_placement(planned.frame.plan);
        for (const Divergence& each : run(planned, planned.frame.plan, options))
          ADD_FAILURE() << "seed " << seed << (aliased ? ", aliased: " : ": ") << text(each);
      }
    if (HasFailure()) return;
  }
  EXPECT_GE(checked, 60);
}

// ---- taking things away ----

constexpr Accesses kReads = access::indirect_command_read | access::index_read | access::vertex_attribute_read | access::uniform_read |
                            access::color_attachment_read | access::shader_sampled_read | access::shader_storage_read | access::transfer_read |
                            access::host_read;

struct Mutant {
  PlanData plan;
  std::string what;
  bool carries_contents = false;  // the piece lets a read find what a write left: no other barrier can stand in for it
};

bool keeps_contents(const ImageBarrier& barrier) { return barrier.old_layout != Layout::undefined; }
bool keeps_contents(const BufferBarrier&) { return true; }
bool keeps_contents(const MemoryBarrier&) { return true; }

// Without the whole barrier, and without each bit of it.
template <class Barrier>
void add_mutants(const PlanData& plan, std::vector<Barrier> PlanData::*table, std::vector<Mutant>& mutants) {
  for (size_t i = 0; i < (plan.*table).size(); ++i) {
    const Barrier& original = (plan.*table)[i];
    const auto with = [&](const std::string& what, auto change) {
      Mutant mutant{plan, fmt::format("{} of barrier {}", what, i), false};
      Barrier& barrier = (mutant.plan.*table)[i];
      change(barrier);
      const bool lost_read = ((original.dst_accesses & ~barrier.dst_accesses) & kReads) != 0;
      const bool lost_write = barrier.src_accesses != original.src_accesses && (original.dst_accesses & kReads) != 0;
      mutant.carries_contents = original.src_accesses != 0 && keeps_contents(original) && (lost_read || lost_write);
      mutants.push_back(std::move(mutant));
    };
    with("everything", [](Barrier& b) { b.src_stages = b.dst_stages = 0, b.src_accesses = b.dst_accesses = 0; });
    for (auto field : {&Barrier::src_stages, &Barrier::dst_stages, &Barrier::src_accesses, &Barrier::dst_accesses})
      for (uint64_t bits = (plan.*table)[i].*field; bits; bits &= bits - 1)
        with(fmt::format("bit {:#x}", bits & ~(bits - 1)), [&](Barrier& b) { b.*field &= ~(bits & ~(bits - 1)); });
  }
}

bool caught(const Planned& planned, const PlanData& plan) {
  for (const std::vector<uint64_t>& conditions : kOutcomes) {
    MachineOptions options;
    options.conditions = conditions;
    options.max_divergences = 1;
    if (!run(planned, plan, options).empty()) return true;
  }
  return false;
}

template <class Barrier>
bool differs(const Barrier& a, const Barrier& b, Stages src, Stages dst, Accesses src_access, Accesses dst_access) {
  return (a.src_stages & ~b.src_stages) == src && (a.dst_stages & ~b.dst_stages) == dst && (a.src_accesses & ~b.src_accesses) == src_access &&
         (a.dst_accesses & ~b.dst_accesses) == dst_access;
}

// What the machine cannot tell apart, by design: late tests complete what early tests began, and a test that reads its own clear needs nothing.
bool is_equivalent(const PlanData& original, const PlanData& mutant) {
  for (size_t i = 0; i < original.image_barriers.size(); ++i) {
    const ImageBarrier &a = original.image_barriers[i], &b = mutant.image_barriers[i];
    if (a == b) continue;
    if (differs(a, b, stage::early_fragment_tests, 0, 0, 0) && (b.src_stages & stage::late_fragment_tests)) return true;
    if (differs(a, b, 0, 0, 0, access::depth_stencil_attachment_read) && (b.dst_accesses & access::depth_stencil_attachment_write)) return true;
  }
  return false;
}

// The rest of what is not found changes nothing that can be read: contents that nobody reads, imports that never change, execution that another
// barrier of the plan orders as well.
TEST(RandomPlans, MissingPiecesAreFound) {
  size_t found = 0, not_found = 0;
  std::vector<std::string> missed;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const std::optional<Planned> accepted = plan_random(seed);
    if (!accepted) continue;
    const Planned& planned = *accepted;
    std::vector<Mutant> mutants;
    add_mutants(planned.frame.plan, &PlanData::image_barriers, mutants);
    add_mutants(planned.frame.plan, &PlanData::buffer_barriers, mutants);
    add_mutants(planned.frame.plan, &PlanData::memory_barriers, mutants);
    for (const Mutant& mutant : mutants) {
      if (caught(planned, mutant.plan)) {
        ++found;
        continue;
      }
      if (is_equivalent(planned.frame.plan, mutant.plan)) continue;
      ++not_found;
      if (mutant.carries_contents) missed.push_back(fmt::format("seed {}: {}", seed, mutant.what));
    }
  }
  EXPECT_GT(found, 300u);
  EXPECT_LT(not_found * 4, found) << found << " found, " << not_found << " not";
  EXPECT_TRUE(missed.empty()) << fmt::format("{}", fmt::join(missed, "\n"));
}

}  // namespace
}  // namespace rg::test
