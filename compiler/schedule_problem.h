// Scheduling as a problem of segments: a node is a rendering with all its passes, or a pass that is none's.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/build_graph.h"
#include "compiler/frame.h"
#include "compiler/segment_search.h"

namespace rg::compiler {

struct ScheduleProblem {
  SegmentProblem segments;
  std::vector<uint32_t> node_of;              // by pass; UINT32_MAX: culled
  std::vector<std::vector<uint32_t>> passes;  // by node, ascending
};

// Passes of `options.no_reorder` keep their place: what the program has before them runs before or beside them, what it has after them after or
// beside them. Nodes are numbered in a legal order, those of earlier passes first. Pre-condition: dependencies between renderings have no cycle.
// O((uses + dependencies) log).
ScheduleProblem make_problem(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const std::vector<uint32_t>& leader_of,
                             const PlanOptions& options);

}  // namespace rg::compiler
