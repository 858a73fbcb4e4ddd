// What a program asks of queues, judged before there are plans; and the measured times it brings along.
#pragma once

#include <string>
#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/diagnostics.h"

namespace rg::compiler {

// Reports passes with `queue KIND`, without `may`, that no such queue can run; each once.
void check_queues(const dsl::Program& program, dsl::GraphId graph, const std::vector<Configuration>& configurations, dsl::Diagnostics& diagnostics);

// Reports the first pass that has to run on the first of `options.queues`, where that is of a kind that cannot run it.
void check_first_queue(const dsl::Program& program, dsl::GraphId graph, const std::vector<Configuration>& configurations, const PlanOptions& options,
                       dsl::Diagnostics& diagnostics);

// The times of a cost profile `text` (see pass_cost.h) for `graph`, by pass. Warns about one that cannot be used, and about passes that do not exist.
// Empty for another graph of the program.
std::map<std::string, double> measured_times(const dsl::Program& program, dsl::GraphId graph, const std::string& path, const std::string& text,
                                             dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
