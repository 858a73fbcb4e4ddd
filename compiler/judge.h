// Judges what a program asserts about its own plans: budgets and facts, for every feature configuration.
//
//   assert memory(1920x1080) <= 170 MiB      heap bytes of the worst plan, at these values of the first extent; memory(hdr): of one resource
//   assert barriers <= 40                    of the worst plan; barriers(shade): before that pass
//   assert order(light_cull, shade)          the first runs before the second, in every plan that has both
//   assert overlaps(ssao, shadows)           no barrier and no wait separates the two, in every plan that has both
//   assert aliases(ssao, bloom)              the two share bytes
// judge_facts.h lists them all. What fails shows its figure, the budget, the variant and the three greatest contributors. A name stands for all its
// indices.
#pragma once

#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/diagnostics.h"

namespace rg::compiler {

void judge(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, const PlanOptions& options,
           dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
