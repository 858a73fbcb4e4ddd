// The combinatorial core of scheduling: assign passes to segments. Knows nodes, edges and shared items, nothing of graphics.
//
//   hard edges   before strictly earlier than after
//   soft edges   before not later than after
//   items        weigh `bytes` in every segment from their first to their last user
//
// Source of the method: list scheduling with slack (as soon, as late as possible) and simulated annealing on segment numbers (Kirkpatrick et al.
// 1983), first with a high power of each segment's live bytes as the energy, a smooth stand-in for their maximum, then with what lies above a target
// that falls whenever it is met. Moves that break an edge push the neighbours along; in the second part boundaries move from where nothing needs them
// to where the target is missed.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/plan_frame.h"

namespace rg::compiler {

struct SegmentProblem {
  struct Edge {
    uint32_t before = 0, after = 0;
    bool hard = true;
  };
  struct Item {
    uint64_t bytes = 0, alignment = 1;
    std::vector<uint32_t> users;
  };
  uint32_t nodes = 0;  // numbered in a legal order: before < after for every edge
  std::vector<Edge> edges;
  std::vector<Item> items;
};

using Segments = std::vector<uint32_t>;  // by node

struct SegmentCost {
  uint32_t segments = 0;
  uint64_t peak = 0;
};
SegmentCost cost_of(const SegmentProblem& problem, const Segments& segments);
// Less is better. A product of powers needs no unit. The balance is segments * bytes ^ 3: a group costs microseconds of a frame of milliseconds, the
// heap is kept all the time, so a hundredth of it is worth three hundredths of the groups; memory takes the 8th power of bytes, barriers and time the
// 4th of segments. 64 KiB are added, so that nothing is done for less.
double score(const SegmentCost& cost, Prefer prefer);

// Nodes in their order, a new segment wherever one depends on the current.
Segments program_order_segments(const SegmentProblem& problem);
// The least number of segments, every node as early as possible.
Segments earliest_segments(const SegmentProblem& problem);
// As late as possible within `count` segments. Pre-condition: count >= segments of earliest_segments.
Segments latest_segments(const SegmentProblem& problem, uint32_t count);

// In proportion to program order, so that what is written together stays together. Same pre-condition.
Segments spread_segments(const SegmentProblem& problem, uint32_t count);

// The least peak found from `start` within `evaluations` moves, using at most `count` segments. `warm`: `start` is good but for boundaries not yet
// used.
Segments anneal_segments(const SegmentProblem& problem, const Segments& start, uint32_t count, uint64_t evaluations, uint64_t seed,
                         bool warm = false);
// Another order within the peak of `start` and its number of segments, as far away as moves at random lead.
Segments drift_segments(const SegmentProblem& problem, const Segments& start, uint64_t evaluations, uint64_t seed);

// Joins neighbouring segments that no hard edge connects, as long as no more than `limit` bytes live in them together, and numbers them without gaps.
// A boundary that only memory needs is one of memory changing hands.
Segments compact_segments(const SegmentProblem& problem, const Segments& segments, uint64_t limit);

// What a heap for the items takes as far as `effort` finds out, see runtime/packing.h; the peak at least.
uint64_t packed_bytes(const SegmentProblem& problem, const Segments& segments, uint64_t effort);

struct SegmentResult {
  Segments best;
  std::vector<SegmentCost> frontier;  // of everything that was tried, by segments: none beats another in both
  uint64_t evaluations = 0;           // moves of the annealer
  const char* method = "";            // "program order", "list scheduling" or "annealing"
  double score = 0;                   // of the best, packed; see below
};
// All of the above: program order and the searched ones, the best by score once packed. `fast` tries constructed ones only, `max` anneals much
// longer.
SegmentResult search_segments(const SegmentProblem& problem, Effort effort, Prefer prefer);

}  // namespace rg::compiler
