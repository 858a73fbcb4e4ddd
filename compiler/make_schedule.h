// In which order passes run, and where barriers separate them.
//
// A schedule is a row of segments: passes of one segment have no barrier between them and overlap on the GPU; a barrier group stands before each.
// So a dependency always crosses a segment boundary, memory is counted per segment, and the two costs of an order are
//   groups   the number of segments
//   bytes    the greatest sum of transient bytes live in one segment
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/build_graph.h"
#include "compiler/frame.h"

namespace rg::compiler {

struct Schedule {
  std::vector<uint32_t> order;       // live passes as they are recorded
  std::vector<uint32_t> segment_of;  // by pass of the frame; UINT32_MAX: culled
  uint32_t segments = 0;
  uint64_t peak_bytes = 0;  // live transient bytes
  std::string chosen_because;
};

// Legal for every dependency. Program order, cut greedily, is always among the candidates; the best has the least groups * bytes.
// `reorder` false keeps program order, `merge` false gives each pass a segment of its own.
// Search effort is counted in evaluations and shrinks with size: O(n log n) per candidate. Deterministic.
Schedule make_schedule(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const PlanOptions& options);

}  // namespace rg::compiler
