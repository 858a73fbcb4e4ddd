// The plan as constexpr tables.
#pragma once

#include <string>

#include "compiler/codegen/plan_values.h"
#include "compiler/plan_data.h"

namespace rg::compiler {

// What the tables need to know of the files around them.
struct PlanText {
  const dsl::SourceFiles& files;
  const PlanNames& names;
  std::vector<dsl::Span> passes, resources;  // where each row of the plan is declared
  std::vector<std::string> shader_symbols;   // of Plan::shaders, qualified
};
// Tables in the order of plan.h, then `constexpr rg::Plan kPlan`; to stand in an anonymous namespace with rg's names in sight.
std::string emit_plan(const Plan& plan, const PlanText& text);

}  // namespace rg::compiler
