// Everything decided so far, written as the tables of a plan. Decides nothing itself.
#pragma once

#include "compiler/build_graph.h"
#include "compiler/contents.h"
#include "compiler/cull.h"
#include "compiler/expressions.h"
#include "compiler/frame.h"
#include "compiler/make_schedule.h"
#include "compiler/plan_data.h"
#include "compiler/synchronise.h"

namespace rg::compiler {

// The phases' results; every member outlives the call.
struct PlanParts {
  const Frame& frame;
  const Liveness& liveness;
  const Schedule& schedule;
  const ContentsOfUses& contents;
  const SyncPlan& sync;
  const PlanOptions& options;
};

// Without what shaders bring: pipelines, bindings, samplers, parameter offsets, push constants.
PlanData emit_plan(const PlanParts& parts);

// ---- the pieces, one a source file ----------------------------------------------------------------------------------

// Program index to plan index; kNone: the resource or pass is not in the plan.
struct PlanIndices {
  std::vector<Index> resource;     // by program resource
  std::vector<Index> pass;         // by program pass
  std::vector<Index> update_slot;  // by program pass: of its first `update` transfer
};

Range plan_range(const dsl::Resource& resource, const Range& exact);  // counts that reach the end become kRemaining
Ref plan_ref(const PlanIndices& indices, dsl::ResourceId resource, uint32_t age);
ClearValue plan_clear(const dsl::ClearValue& value, uint32_t aspects);

void emit_resources(const PlanParts& parts, const PlanIndices& indices, Expressions& exprs, PlanData& plan);
void emit_passes(const PlanParts& parts, const PlanIndices& indices, Expressions& exprs, PlanData& plan);
void emit_work(const PlanParts& parts, const PlanIndices& indices, uint32_t pass, Expressions& exprs, PlanData& plan, Pass& row);
// `position` of the pass in Schedule::order.
void emit_rendering(const PlanParts& parts, const PlanIndices& indices, size_t position, Expressions& exprs, PlanData& plan, Pass& row);
// By slot of the schedule: the plan's group; kNone: none. Split groups follow, in the order of SyncPlan::splits.
std::vector<Index> groups_of_slots(const PlanParts& parts);
Index first_split_group(const std::vector<Index>& groups_of_slots);
void emit_barriers(const PlanParts& parts, const PlanIndices& indices, Expressions& exprs, PlanData& plan);

}  // namespace rg::compiler
