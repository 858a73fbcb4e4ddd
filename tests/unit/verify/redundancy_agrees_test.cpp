// What the proofs call redundant is what can be removed: compared with removing every atom and verifying again, on random plans
// to which something has been added.
#include <gtest/gtest.h>

#include <set>

#include "compiler/plan_frame.h"
#include "compiler/verify/verify.h"
#include "tests/unit/verify/random_program.h"

namespace rg::verify {
namespace {

constexpr dsl::GraphId kGraph{size_t{0}};

struct Case {
  dsl::Program program;
  PlanData plan;
};

std::vector<Finding> check(const Case& c, const PlanData& plan, bool irredundancy) {
  VerifyOptions options;
  options.irredundancy = irredundancy;
  options.max_findings = irredundancy ? 10000 : 1;
  return verify(c.program, kGraph, {}, plan.view(), plan.program_pass, plan.program_resource, options);
}
bool holds(const Case& c, const PlanData& plan) { return check(c, plan, false).empty(); }

// An execution barrier from compute to blits at the start of every third group, and a stage that nobody uses in every fourth image barrier.
void add_useless(PlanData& plan) {
  for (size_t i = 0; i < plan.image_barriers.size(); i += 4) plan.image_barriers[i].src_stages |= stage::blit;
  for (size_t g = 0; g < plan.groups.size(); g += 3) {
    const BarrierGroup& group = plan.groups[g];
    plan.memory_barriers.insert(plan.memory_barriers.begin() + group.first_memory, {stage::compute_shader, 0, stage::blit, 0});
    for (size_t other = 0; other < plan.groups.size(); ++other) {
      if (other == g) ++plan.groups[other].memory_count;
      if (other > g) ++plan.groups[other].first_memory;
    }
  }
}

template <class Row>
void leave_out(std::vector<Row>& rows, std::vector<BarrierGroup>& groups, Index BarrierGroup::*first, Index BarrierGroup::*count, size_t at) {
  rows.erase(rows.begin() + static_cast<ptrdiff_t>(at));
  for (BarrierGroup& group : groups) {
    if (at >= group.*first && at < group.*first + group.*count) --(group.*count);
    if (group.*first > at) --(group.*first);
  }
}

// How many atoms of one table can be removed, one at a time; a barrier that can go counts once.
template <class Row>
size_t removable(const Case& c, std::vector<Row> PlanData::*table, Index BarrierGroup::*first, Index BarrierGroup::*count) {
  size_t result = 0;
  for (size_t i = 0; i < (c.plan.*table).size(); ++i) {
    PlanData without = c.plan;
    leave_out(without.*table, without.groups, first, count, i);
    if (holds(c, without)) {
      ++result;
      continue;
    }
    const auto try_bits = [&](auto Row::*mask) {
      for (uint64_t rest = (c.plan.*table)[i].*mask; rest != 0; rest &= rest - 1) {
        PlanData less = c.plan;
        (less.*table)[i].*mask &= ~(rest & ~(rest - 1));
        result += holds(c, less);
      }
    };
    try_bits(&Row::src_stages);
    try_bits(&Row::src_accesses);
    try_bits(&Row::dst_stages);
    try_bits(&Row::dst_accesses);
  }
  return result;
}

// A test behind a clear reads what the clear wrote: its read may be named, and need not.
size_t optional_reads(const Case& c) {
  size_t result = 0;
  for (size_t i = 0; i < c.plan.image_barriers.size(); ++i) {
    const Accesses read = access::depth_stencil_attachment_read, both = read | access::depth_stencil_attachment_write;
    if ((c.plan.image_barriers[i].dst_accesses & both) != both) continue;
    PlanData less = c.plan;
    less.image_barriers[i].dst_accesses &= ~read;
    result += holds(c, less);
  }
  return result;
}

bool is_of_barrier(const Finding& finding) { return finding.text.find(" barrier ") != std::string::npos; }

// `queues`: what the planner may use.
size_t compare_with_removal(const std::vector<dsl::QueueKind>& queues) {
  size_t total = 0;
  for (uint64_t seed = 3000; seed < 3060; ++seed) {
    Case c{make_random_program(seed, {.passes = 10 + static_cast<uint32_t>(seed % 30), .images = 5, .buffers = 3}), {}};
    compiler::PlanOptions options;
    options.aliasing = false;
    options.queues = queues;
    c.plan = compiler::plan_frame(c.program, kGraph, {}, options).plan;
    add_useless(c.plan);
    std::set<std::string> reported;
    for (const Finding& finding : check(c, c.plan, true)) {
      EXPECT_EQ(finding.hazard, Hazard::redundant) << finding.text;
      if (is_of_barrier(finding)) reported.insert(finding.text);
    }
    const size_t removed = removable(c, &PlanData::memory_barriers, &BarrierGroup::first_memory, &BarrierGroup::memory_count) +
                           removable(c, &PlanData::image_barriers, &BarrierGroup::first_image, &BarrierGroup::image_count) +
                           removable(c, &PlanData::buffer_barriers, &BarrierGroup::first_buffer, &BarrierGroup::buffer_count);
    EXPECT_EQ(reported.size(), removed - optional_reads(c)) << "seed " << seed;
    total += reported.size();
  }
  return total;
}

TEST(Redundancy, AgreesWithRemoval) { EXPECT_GT(compare_with_removal({dsl::QueueKind::graphics}), 150u); }
TEST(Redundancy, AgreesWithRemovalOnSeveralQueues) { EXPECT_GT(compare_with_removal({dsl::QueueKind::graphics, dsl::QueueKind::compute}), 150u); }

}  // namespace
}  // namespace rg::verify
