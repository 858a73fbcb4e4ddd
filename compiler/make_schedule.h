// In which order passes run, and where barriers separate them.
//
// A schedule is a row of segments: passes of one segment have no barrier between them and overlap on the GPU; a barrier group stands before each.
// So a dependency always crosses a segment boundary, memory is counted per segment, and the two costs of an order are
//   groups   the number of segments
//   bytes    the greatest sum of transient bytes live in one segment
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "compiler/build_graph.h"
#include "compiler/frame.h"
#include "compiler/renderings.h"
#include "compiler/segment_search.h"

namespace rg::compiler {

// On several queues segments are numbered in a legal serial order. Runs of segments of one queue form batches; other queues wait for the end of a
// batch, and a batch waits before its first segment. Barriers have slots: one before each segment, one at the end of each batch.
//
//   batch      0 (graphics)       1 (compute)      2 (graphics)
//   segment    0       1          2                3
//   slot       0       1     2    3           4    5          6
struct Schedule {
  std::vector<uint32_t> order;       // live passes as they are recorded, in the serial order
  std::vector<uint32_t> segment_of;  // by pass of the frame; UINT32_MAX: culled
  std::vector<uint32_t> leader_of;   // by pass of the frame: the first of its rendering, see Renderings; those of one follow each other in `order`
  uint32_t segments = 0;
  std::vector<dsl::QueueKind> queues = {dsl::QueueKind::graphics};
  std::vector<uint32_t> queue_of, batch_of;  // by segment; every batch has a segment, unless there is none at all
  uint32_t batches = 1;
  uint64_t peak_bytes = 0;  // live transient bytes in the serial order
  std::string chosen_because;
  std::vector<SegmentCost> frontier;  // orders for one queue that were tried and not beaten in both costs
  uint64_t evaluations = 0;
  const char* method = "";
  double score = 0;               // of the order on one queue; less is better, 0 where nothing was searched
  std::vector<uint32_t> crowded;  // passes that continue a rendering which holds something where the most is live, ascending

  bool one_rendering(uint32_t a, uint32_t b) const { return leader_of[a] == leader_of[b]; }
  uint32_t slots() const { return segments + batches; }
  uint32_t slot_before(uint32_t segment) const { return segment + batch_of[segment]; }
  uint32_t closing_slot(uint32_t batch) const {
    const auto next = std::upper_bound(batch_of.begin(), batch_of.end(), batch);
    return static_cast<uint32_t>(next - batch_of.begin()) + batch;
  }
  uint32_t queue_of_pass(uint32_t pass) const { return queue_of[segment_of[pass]]; }
  std::vector<uint32_t> queues_of_slots() const {
    std::vector<uint32_t> queues(slots());
    for (uint32_t segment = 0; segment < segments; ++segment) queues[slot_before(segment)] = queues[slot_before(segment) + 1] = queue_of[segment];
    return queues;
  }
};

// Legal for every dependency. Program order, cut greedily, is always among the candidates; the best has the least groups * bytes.
// `reorder` false keeps program order, `merge` false gives each pass a segment of its own.
// Search effort is counted in evaluations and shrinks with size: O(n log n) per candidate. Deterministic.
Schedule make_schedule(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const Renderings& renderings,
                       const PlanOptions& options);

}  // namespace rg::compiler
