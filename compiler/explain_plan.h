// Why everything is as it is, for reports and `rgc explain`.
#pragma once

#include "compiler/emit_plan.h"
#include "compiler/plan_frame.h"

namespace rg::compiler {

// Subjects: passes ("kept", "culled", "scheduled"), resources ("placed", "shared", "barrier"), barrier groups "group 3" ("barrier"), "wait 0" and
// "schedule". Each says why, what else was possible, and what change of the program would undo it.
Decisions explain_plan(const PlanParts& parts, const Graph& graph, const PlanData& plan);

}  // namespace rg::compiler
