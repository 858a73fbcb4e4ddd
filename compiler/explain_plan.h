// Why everything is as it is, for reports and `rgc explain`.
#pragma once

#include "compiler/emit_plan.h"
#include "compiler/plan_frame.h"

namespace rg::compiler {

// Subjects: passes ("kept", "culled", "scheduled"), resources ("placed"), barrier groups "group 3" ("barrier"), and "schedule".
Decisions explain_plan(const PlanParts& parts, const Graph& graph, const PlanData& plan);

}  // namespace rg::compiler
