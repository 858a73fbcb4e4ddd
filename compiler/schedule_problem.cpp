#include "compiler/schedule_problem.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

using Edges = std::vector<SegmentProblem::Edge>;

// One edge a pair, hard if one of its dependencies is; those within a rendering need none.
Edges edges_between(const Graph& graph, const std::vector<uint32_t>& leader_of) {
  Edges edges;
  for (const Dependency& d : graph.dependencies) {
    const SegmentProblem::Edge edge{leader_of[d.before], leader_of[d.after], d.kind != DependencyKind::order};
    if (edge.before == edge.after) continue;
    if (!edges.empty() && edges.back().before == edge.before && edges.back().after == edge.after)
      edges.back().hard = edges.back().hard || edge.hard;
    else
      edges.push_back(edge);
  }
  return edges;
}

// Every pass in between stands in for those beyond it, so that a pass needs edges only to the fixed one before it and from the one after it.
void fix_places(const Frame& frame, const std::vector<bool>& live, const std::vector<uint32_t>& leader_of, const std::set<std::string>& fixed,
                Edges& edges) {
  if (fixed.empty()) return;
  uint32_t last = UINT32_MAX;
  std::vector<uint32_t> since;
  for (uint32_t pass = 0; pass < live.size(); ++pass) {
    if (!live[pass]) continue;
    if (last != UINT32_MAX && leader_of[last] != leader_of[pass]) edges.push_back({leader_of[last], leader_of[pass], false});
    if (fixed.contains(frame.pass(pass).name)) {
      for (const uint32_t before : since)
        if (leader_of[before] != leader_of[pass]) edges.push_back({leader_of[before], leader_of[pass], false});
      last = pass;
      since.clear();
    }
    since.push_back(pass);
  }
}

void join_parallel(Edges& edges) {
  const auto key = [](const SegmentProblem::Edge& e) { return std::tuple(e.after, e.before, !e.hard); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const auto same = [](const auto& a, const auto& b) { return a.before == b.before && a.after == b.after; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
}

// Leaders in a legal order, the earliest that can be first (Kahn 1962).
std::vector<uint32_t> legal_order(const std::vector<bool>& live, const std::vector<uint32_t>& leader_of, const Edges& edges) {
  std::vector<uint32_t> waits(live.size());
  std::vector<std::vector<uint32_t>> after(live.size());
  for (const auto& edge : edges) ++waits[edge.after], after[edge.before].push_back(edge.after);
  std::priority_queue<uint32_t, std::vector<uint32_t>, std::greater<>> ready;
  size_t count = 0;
  for (uint32_t pass = 0; pass < live.size(); ++pass) {
    if (!live[pass] || leader_of[pass] != pass) continue;
    ++count;
    if (waits[pass] == 0) ready.push(pass);
  }
  std::vector<uint32_t> order;
  while (!ready.empty()) {
    order.push_back(ready.top());
    ready.pop();
    for (const uint32_t next : after[order.back()])
      if (--waits[next] == 0) ready.push(next);
  }
  RG_CHECK(order.size() == count, "renderings do not wait for each other in a circle");
  return order;
}

// Resources whose memory the order decides about.
std::vector<SegmentProblem::Item> items_of(const Frame& frame, const std::vector<uint32_t>& node_of, const PlanOptions& options) {
  std::vector<SegmentProblem::Item> by_resource(frame.graph->resources.size());
  for (const Use& use : frame.uses) {
    const uint32_t node = node_of[use.pass];
    if (node == UINT32_MAX) continue;
    const dsl::Resource& resource = frame.resource_of(use.cell);
    if (resource.lifetime != dsl::Lifetime::transient || resource.no_alias || resource.is_output) continue;
    SegmentProblem::Item& item = by_resource[frame.cells[use.cell].resource];
    item.bytes = frame.bytes[frame.cells[use.cell].resource];
    item.alignment = resource.kind == dsl::ResourceKind::image ? options.image_alignment : options.buffer_alignment;
    if (item.users.empty() || item.users.back() != node) item.users.push_back(node);
  }
  std::erase_if(by_resource, [](const SegmentProblem::Item& item) { return item.users.empty(); });
  return by_resource;
}

}  // namespace

ScheduleProblem make_problem(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const std::vector<uint32_t>& leader_of,
                             const PlanOptions& options) {
  ScheduleProblem problem;
  Edges edges = edges_between(graph, leader_of);
  fix_places(frame, live, leader_of, options.no_reorder, edges);
  bool merged = !options.no_reorder.empty();
  for (uint32_t pass = 0; pass < live.size(); ++pass) merged = merged || leader_of[pass] != pass;
  if (merged) join_parallel(edges);
  const std::vector<uint32_t> order = legal_order(live, leader_of, edges);
  problem.node_of.assign(live.size(), UINT32_MAX);
  for (uint32_t node = 0; node < order.size(); ++node) problem.node_of[order[node]] = node;
  problem.passes.resize(order.size());
  for (uint32_t pass = 0; pass < live.size(); ++pass) {
    if (!live[pass]) continue;
    problem.node_of[pass] = problem.node_of[leader_of[pass]];
    problem.passes[problem.node_of[pass]].push_back(pass);
  }
  for (auto& edge : edges) edge.before = problem.node_of[edge.before], edge.after = problem.node_of[edge.after];
  problem.segments = {static_cast<uint32_t>(order.size()), std::move(edges), items_of(frame, problem.node_of, options)};
  return problem;
}

}  // namespace rg::compiler
