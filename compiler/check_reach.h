// Passes that no plan of a graph runs.
#pragma once

#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/diagnostics.h"

namespace rg::compiler {

// One warning a graph, at the first of them that none of the others wanted anything of; the others are its notes. `plans` are those of all
// configurations: a pass that one of them runs is meant. O(passes + accesses log).
void check_reach(const dsl::Program& program, dsl::GraphId graph, const std::vector<FramePlan>& plans, dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
