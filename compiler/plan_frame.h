// The planner: one graph of a checked program, in one feature configuration, becomes a plan.
//
// Pre-condition: `program` has no errors and every Access::stages is filled (see shaders/resolve_stages.h).
// Cannot fail on user input; a broken expectation is our fault and stops in RG_CHECK.
#pragma once

#include <string>
#include <vector>

#include "compiler/plan_data.h"
#include "dsl/program.h"

namespace rg::compiler {

using Configuration = std::vector<uint32_t>;  // one value a FeatureId

// What may be switched off, each a driver work-around with its own flag on the command line.
struct PlanOptions {
  bool aliasing = true, reorder = true, merge = true, discard = true;
  uint64_t image_alignment = 65536, buffer_alignment = 256;  // of the device profile used for estimates
};

// Why something is as it is: the record that reports and `rgc explain` read.
struct Decision {
  std::string subject;  // pass, resource or barrier group name
  std::string what;     // "culled", "placed", "barrier", "merged", ...
  std::string reason;
  friend bool operator==(const Decision&, const Decision&) = default;
};
using Decisions = std::vector<Decision>;

struct FramePlan {
  Configuration configuration;
  PlanData plan;        // without pipelines, bindings and shaders: see codegen/bind.h
  Decisions decisions;
  uint64_t heap_bytes = 0, unaliased_bytes = 0, lower_bound_bytes = 0;  // at the initial extents
  std::vector<std::pair<std::string, double>> phase_ms;
};

FramePlan plan_frame(const dsl::Program& program, dsl::GraphId graph, const Configuration& configuration, const PlanOptions& options);

}  // namespace rg::compiler
