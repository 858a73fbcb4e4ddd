// Positions in the generated API. They depend on the graph alone, not on what a configuration culls, so that all plans of a graph agree.
#pragma once

#include <vector>

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::compiler {

// True if a callback of the engine records the pass, wholly or inside its rendering.
bool is_host_recorded(const dsl::Pass& pass);

// By pass: position among the host-recorded passes in program order; kNone: not host-recorded.
std::vector<Index> host_slots(const dsl::Graph& graph);
// By resource: position among the imported resources in program order; kNone: not imported.
std::vector<Index> import_slots(const dsl::Graph& graph);
// By pass: number of `update` transfers in earlier passes, so that transfer i of a pass has slot first + updates before it.
std::vector<Index> first_update_slots(const dsl::Graph& graph);

}  // namespace rg::compiler
