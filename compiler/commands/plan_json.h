// A plan as JSON, nested by what belongs together; docs/cli.md documents the schema "rgc-plan-1".
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compiler/compile.h"

namespace rg::commands {

nlohmann::ordered_json plan_json(const PlanData& plan);
// The same with `file` and `line` of every declaration, which the planner does not know.
nlohmann::ordered_json plan_json(const compiler::CompileResult& result, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan);
// "ceil(view.x / 8)"; "1" for kNone. Names are those of the plan's extents.
std::string expression_text(const PlanData& plan, Index expr);

}  // namespace rg::commands
