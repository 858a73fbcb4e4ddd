#include "compiler/make_schedule.h"

#include <algorithm>
#include <numeric>

#include "compiler/schedule_problem.h"
#include "compiler/segment_graph.h"

namespace rg::compiler {
namespace {

Segments one_each(uint32_t nodes) {
  Segments segments(nodes);
  std::iota(segments.begin(), segments.end(), 0u);
  return segments;
}

// A segment of its own for one node: after those of its segment with smaller numbers, before the others.
void part(uint32_t node, Segments& segments) {
  const auto rank = [&](uint32_t other) { return segments[other] != segments[node] || other == node ? 1u : other < node ? 0u : 2u; };
  std::vector<uint32_t> keys(segments.size());
  for (uint32_t other = 0; other < segments.size(); ++other) keys[other] = 3 * segments[other] + rank(other);
  std::vector<uint32_t> sorted = keys;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (uint32_t other = 0; other < segments.size(); ++other)
    segments[other] = static_cast<uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), keys[other]) - sorted.begin());
}

// Passes that continue a rendering, of those which hold something in a segment where the most is live: what they hold apart might not meet.
std::vector<uint32_t> crowded_passes(const ScheduleProblem& problem, const Segments& segments, const SegmentCost& cost) {
  std::vector<uint64_t> begins(cost.segments + 1), ends(cost.segments + 1);
  for (const auto& item : problem.segments.items) {
    const SegmentInterval interval = interval_of(item, segments);
    begins[interval.begin] += item.bytes, ends[interval.end + 1] += item.bytes;
  }
  std::vector<uint32_t> full(cost.segments + 1);  // segments where the most is live, so far
  uint64_t live = 0;
  for (uint32_t s = 0; s < cost.segments; ++s) {
    live += begins[s] - ends[s];
    full[s + 1] = full[s] + (live == cost.peak);
  }
  std::vector<uint32_t> passes;
  for (const auto& item : problem.segments.items) {
    const SegmentInterval interval = interval_of(item, segments);
    if (full[interval.end + 1] == full[interval.begin]) continue;
    for (const uint32_t node : item.users) passes.insert(passes.end(), problem.passes[node].begin() + 1, problem.passes[node].end());
  }
  std::sort(passes.begin(), passes.end());
  passes.erase(std::unique(passes.begin(), passes.end()), passes.end());
  return passes;
}

}  // namespace

Schedule make_schedule(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const Renderings& renderings,
                       const PlanOptions& options) {
  const ScheduleProblem all = make_problem(frame, graph, live, renderings.leader_of, options);
  const SegmentProblem& problem = all.segments;
  const Segments program_order = program_order_segments(problem);
  SegmentResult found{program_order, {}, 0, "program order", 0};
  if (!options.merge)
    found.best = one_each(problem.nodes);
  else if (options.reorder && options.prefer != Prefer::order)
    found = search_segments(problem, options.effort, options.prefer);
  for (uint32_t node = 0; node < problem.nodes && !options.no_merge.empty(); ++node)
    if (options.no_merge.contains(frame.pass(all.passes[node].front()).name)) part(node, found.best);
  const Segments& segments = found.best;

  Schedule schedule;
  schedule.leader_of = renderings.leader_of;
  schedule.segment_of.assign(live.size(), UINT32_MAX);
  for (uint32_t pass = 0; pass < live.size(); ++pass)
    if (live[pass]) schedule.segment_of[pass] = segments[all.node_of[pass]];
  std::vector<uint32_t> nodes(problem.nodes);
  std::iota(nodes.begin(), nodes.end(), 0u);
  std::stable_sort(nodes.begin(), nodes.end(), [&](uint32_t a, uint32_t b) { return segments[a] < segments[b]; });
  for (const uint32_t node : nodes) schedule.order.insert(schedule.order.end(), all.passes[node].begin(), all.passes[node].end());
  const SegmentCost cost = cost_of(problem, segments), before = cost_of(problem, program_order);
  schedule.segments = cost.segments;
  schedule.queue_of.assign(cost.segments, 0), schedule.batch_of.assign(cost.segments, 0);
  schedule.peak_bytes = cost.peak;
  schedule.frontier = found.frontier, schedule.evaluations = found.evaluations, schedule.method = found.method, schedule.score = found.score;
  if (options.effort != Effort::fast) schedule.crowded = crowded_passes(all, segments, cost);  // who searches asks
  schedule.chosen_because = std::to_string(cost.segments) + " groups and " + std::to_string(cost.peak) + " bytes; program order has " +
                            std::to_string(before.segments) + " groups and " + std::to_string(before.peak) + " bytes";
  return schedule;
}

}  // namespace rg::compiler
