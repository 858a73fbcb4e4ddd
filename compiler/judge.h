// Judges what a program asserts about its own plans: budgets and facts, for every feature configuration.
//
//   assert memory(1920x1080) <= 170 MiB      heap bytes of the worst plan, at these values of the first extent
//   assert barriers <= 40                    barriers of the worst plan;  also: submits, passes, variants
//   assert order(light_cull, shade)          the first runs before the second, in every plan that has both
//   assert overlaps(ssao, shadows)           no barrier separates the two, in every plan that has both
#pragma once

#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/diagnostics.h"

namespace rg::compiler {

void judge(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, const PlanOptions& options,
           dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
