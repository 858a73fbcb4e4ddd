// The planner: one graph of a checked program, in one feature configuration, becomes a plan.
//
// Pre-condition: `program` has no errors and every Access::stages is filled (see shaders/resolve_stages.h).
// Cannot fail on user input; a broken expectation is our fault and stops in RG_CHECK.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "compiler/plan_data.h"
#include "dsl/program.h"

namespace rg::compiler {

using Configuration = std::vector<uint32_t>;  // one value a FeatureId

enum class Prefer : uint8_t { balance, time, memory, barriers, order };
enum class Effort : uint8_t { fast, normal, max };

// What may be switched off, for everything or for what is named: each a driver work-around with its own flag on the command line.
struct PlanOptions {
  bool aliasing = true;  // transients share memory
  bool async = true;     // several queues
  bool reorder = true;   // passes run in another order than the program's
  bool merge = true;     // passes without a barrier group between them, renderings of several passes
  bool discard = true;   // contents that nobody needs are not kept
  bool fold = true;      // renderings clear and resolve what passes of their own would, see fold_transfers.h
  bool split = true;     // barriers with events, for targets that ask for them, see split_barriers.h
  bool reasons =
      false;  // decisions for everything, pairs of OrderFacts: what reports and `rgc explain` ask for. Else decisions of queues and renderings
  std::set<std::string> no_aliasing = {}, no_discard = {}, no_split = {};             // graphs and resources
  std::set<std::string> no_async = {}, no_reorder = {}, no_merge = {}, no_fold = {};  // graphs and passes
  uint64_t image_alignment = 65536, buffer_alignment = 256;                           // of the device profile used for estimates
  Prefer prefer = Prefer::balance;
  Effort effort = Effort::normal;
  std::vector<dsl::QueueKind> queues = {dsl::QueueKind::graphics};  // what the plan may use; the first is where passes run that name none
  std::map<std::string, double> measured_us = {};                   // by pass name: measured times in place of estimates
};

// Why something is as it is: the record that reports and `rgc explain` read.
struct Decision {
  std::string subject;  // pass, resource or barrier group name
  std::string what;     // "culled", "placed", "barrier", "merged", ...
  std::string reason;
  friend bool operator==(const Decision&, const Decision&) = default;
};
using Decisions = std::vector<Decision>;

// What several queues are worth, in ns of the cost model; see compiler/queue_timeline.h.
struct Overlap {
  double serial = 0, critical_path = 0, bound = 0, end = 0;
  uint64_t simulations = 0;
  bool complete = true;
  size_t moved = 0, movable = 0;
  std::vector<double> work;  // by queue of the plan
};

// How the order was found, and what it is worth.
struct OrderFacts {
  std::string method;  // "program order", "list scheduling", "annealing"
  uint64_t evaluations = 0;
  struct Point {
    uint32_t groups = 0;
    uint64_t bytes = 0;
    friend bool operator==(const Point&, const Point&) = default;
  };
  std::vector<Point> frontier;                   // orders on one queue that were tried and not beaten in both
  uint64_t ordered_pairs = 0, needed_pairs = 0;  // of passes: one comes after the other on the GPU; the program needs that
};

struct FramePlan {
  Configuration configuration;
  PlanData plan;  // without pipelines, bindings and shaders: see codegen/bind.h
  Decisions decisions;
  uint64_t heap_bytes = 0, unaliased_bytes = 0, lower_bound_bytes = 0;  // at the initial extents
  uint64_t lazy_bytes = 0, heap_beside_lazy_bytes = 0;                  // as in MemoryPlan; the second only with PlanOptions::reasons
  Overlap overlap;
  OrderFacts order;
  uint32_t unproved = 0;  // facts that synchronisation has to achieve and does not, see obligations.h: 0, or the planner is wrong
  std::vector<std::pair<std::string, double>> phase_ms;
};

// Names in the switches that are graphs switch off the whole graph.
PlanOptions options_for(const PlanOptions& options, const std::string& graph);

FramePlan plan_frame(const dsl::Program& program, dsl::GraphId graph, const Configuration& configuration, const PlanOptions& options);

}  // namespace rg::compiler
