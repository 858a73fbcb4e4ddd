#include "compiler/make_schedule.h"

#include <algorithm>
#include <numeric>

#include "compiler/segment_search.h"

namespace rg::compiler {
namespace {

struct Numbering {
  std::vector<uint32_t> pass_of, node_of;  // node_of[pass] UINT32_MAX: culled
};

Numbering number(const std::vector<bool>& live) {
  Numbering n;
  n.node_of.assign(live.size(), UINT32_MAX);
  for (uint32_t pass = 0; pass < live.size(); ++pass) {
    if (!live[pass]) continue;
    n.node_of[pass] = static_cast<uint32_t>(n.pass_of.size());
    n.pass_of.push_back(pass);
  }
  return n;
}

std::vector<SegmentProblem::Edge> edges_of(const Graph& graph, const Numbering& n) {
  std::vector<SegmentProblem::Edge> edges;
  for (const Dependency& d : graph.dependencies) {
    const SegmentProblem::Edge edge{n.node_of[d.before], n.node_of[d.after], d.kind != DependencyKind::order};
    if (!edges.empty() && edges.back().before == edge.before && edges.back().after == edge.after)
      edges.back().hard = edges.back().hard || edge.hard;
    else
      edges.push_back(edge);
  }
  return edges;
}

// Resources whose memory the order decides about.
std::vector<SegmentProblem::Item> items_of(const Frame& frame, const Numbering& n) {
  std::vector<SegmentProblem::Item> by_resource(frame.graph->resources.size());
  for (const Use& use : frame.uses) {
    const dsl::Resource& resource = frame.resource_of(use.cell);
    const uint32_t node = n.node_of[use.pass];
    if (node == UINT32_MAX || resource.lifetime != dsl::Lifetime::transient || resource.no_alias || resource.is_output) continue;
    SegmentProblem::Item& item = by_resource[frame.cells[use.cell].resource];
    item.bytes = frame.bytes[frame.cells[use.cell].resource];
    if (item.users.empty() || item.users.back() != node) item.users.push_back(node);
  }
  std::erase_if(by_resource, [](const SegmentProblem::Item& item) { return item.users.empty(); });
  return by_resource;
}

Segments one_each(uint32_t nodes) {
  Segments segments(nodes);
  std::iota(segments.begin(), segments.end(), 0u);
  return segments;
}

}  // namespace

Schedule make_schedule(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const PlanOptions& options) {
  const Numbering numbering = number(live);
  const SegmentProblem problem{static_cast<uint32_t>(numbering.pass_of.size()), edges_of(graph, numbering), items_of(frame, numbering)};
  const Segments program_order = program_order_segments(problem);
  SegmentResult found{program_order, {}, 0, "program order"};
  if (!options.merge)
    found.best = one_each(problem.nodes);
  else if (options.reorder && options.prefer != Prefer::order)
    found = search_segments(problem, options.effort, options.prefer);
  const Segments& segments = found.best;

  Schedule schedule;
  schedule.segment_of.assign(live.size(), UINT32_MAX);
  for (uint32_t node = 0; node < problem.nodes; ++node) schedule.segment_of[numbering.pass_of[node]] = segments[node];
  schedule.order = numbering.pass_of;
  std::stable_sort(schedule.order.begin(), schedule.order.end(),
                   [&](uint32_t a, uint32_t b) { return schedule.segment_of[a] < schedule.segment_of[b]; });
  const SegmentCost cost = cost_of(problem, segments), before = cost_of(problem, program_order);
  schedule.segments = cost.segments;
  schedule.queue_of.assign(cost.segments, 0), schedule.batch_of.assign(cost.segments, 0);
  schedule.peak_bytes = cost.peak;
  schedule.frontier = found.frontier, schedule.evaluations = found.evaluations, schedule.method = found.method;
  schedule.chosen_because = std::to_string(cost.segments) + " groups and " + std::to_string(cost.peak) + " bytes; program order has " +
                            std::to_string(before.segments) + " groups and " + std::to_string(before.peak) + " bytes";
  return schedule;
}

}  // namespace rg::compiler
