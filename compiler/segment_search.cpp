#include "compiler/segment_search.h"

#include <algorithm>
#include <cmath>

#include "compiler/segment_graph.h"

namespace rg::compiler {
namespace {

template <class Key, class Other>
SegmentLinks adjacency(const SegmentProblem& problem, Key key, Other other) {
  SegmentLinks result;
  result.first.assign(problem.nodes + 1, 0);
  for (const auto& edge : problem.edges) ++result.first[key(edge) + 1];
  for (uint32_t i = 0; i < problem.nodes; ++i) result.first[i + 1] += result.first[i];
  result.links.resize(problem.edges.size());
  std::vector<uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (const auto& edge : problem.edges) result.links[next[key(edge)]++] = {other(edge), edge.hard ? 1u : 0u};
  return result;
}

uint32_t count_of(const Segments& segments) { return segments.empty() ? 0 : *std::max_element(segments.begin(), segments.end()) + 1; }

}  // namespace

SegmentLinks predecessors(const SegmentProblem& problem) {
  return adjacency(
      problem, [](const auto& e) { return e.after; }, [](const auto& e) { return e.before; });
}
SegmentLinks successors(const SegmentProblem& problem) {
  return adjacency(
      problem, [](const auto& e) { return e.before; }, [](const auto& e) { return e.after; });
}

SegmentInterval interval_of(const SegmentProblem::Item& item, const Segments& segments) {
  SegmentInterval interval;
  for (const uint32_t user : item.users)
    interval.begin = std::min(interval.begin, segments[user]), interval.end = std::max(interval.end, segments[user]);
  return interval;
}

SegmentCost cost_of(const SegmentProblem& problem, const Segments& segments) {
  SegmentCost cost{count_of(segments), 0};
  std::vector<int64_t> change(cost.segments + 1);
  for (const auto& item : problem.items) {
    const SegmentInterval interval = interval_of(item, segments);
    change[interval.begin] += static_cast<int64_t>(item.bytes);
    change[interval.end + 1] -= static_cast<int64_t>(item.bytes);
  }
  int64_t live = 0;
  for (const int64_t step : change) {
    live += step;
    cost.peak = std::max(cost.peak, static_cast<uint64_t>(live));
  }
  return cost;
}

double score(const SegmentCost& cost) {
  const double bytes = static_cast<double>(std::max<uint64_t>(cost.peak, 1));
  return static_cast<double>(cost.segments) * bytes * std::sqrt(bytes);
}

Segments program_order_segments(const SegmentProblem& problem) {
  const SegmentLinks before = predecessors(problem);
  Segments segments(problem.nodes);
  uint32_t current = 0;
  for (uint32_t node = 0; node < problem.nodes; ++node) {
    for (const auto& link : before.of(node)) current = std::max(current, segments[link.node] + link.gap);
    segments[node] = current;
  }
  return segments;
}

Segments earliest_segments(const SegmentProblem& problem) {
  const SegmentLinks before = predecessors(problem);
  Segments segments(problem.nodes);
  for (uint32_t node = 0; node < problem.nodes; ++node)
    for (const auto& link : before.of(node)) segments[node] = std::max(segments[node], segments[link.node] + link.gap);
  return segments;
}

Segments latest_segments(const SegmentProblem& problem, uint32_t count) {
  const SegmentLinks after = successors(problem);
  Segments segments(problem.nodes, count - 1);
  for (uint32_t node = problem.nodes; node-- > 0;)
    for (const auto& link : after.of(node)) segments[node] = std::min(segments[node], segments[link.node] - link.gap);
  return segments;
}

Segments spread_segments(const SegmentProblem& problem, uint32_t count) {
  const SegmentLinks before = predecessors(problem);
  const Segments latest = latest_segments(problem, count);
  Segments segments(problem.nodes);
  for (uint32_t node = 0; node < problem.nodes; ++node) {
    segments[node] = std::min(latest[node], static_cast<uint32_t>(uint64_t{node} * count / problem.nodes));
    for (const auto& link : before.of(node)) segments[node] = std::max(segments[node], segments[link.node] + link.gap);
  }
  return segments;
}

Segments compact_segments(const SegmentProblem& problem, const Segments& segments) {
  const uint32_t count = count_of(segments);
  std::vector<std::vector<uint32_t>> nodes(count);
  for (uint32_t node = 0; node < problem.nodes; ++node) nodes[segments[node]].push_back(node);
  const SegmentLinks before = predecessors(problem);
  Segments result(problem.nodes);
  uint32_t current = 0;
  for (const auto& segment : nodes) {
    for (const uint32_t node : segment)
      for (const auto& link : before.of(node))
        if (link.gap == 1 && result[link.node] == current) {
          current = current + 1;
          break;
        }
    for (const uint32_t node : segment) result[node] = current;
  }
  return result;
}

namespace {

// Numbers of segments worth a search: the least, and up to 6 % or 8 more, never more than program order takes.
std::vector<uint32_t> counts_to_try(uint32_t least, uint32_t program) {
  const uint32_t most = std::max(least, std::min(program, std::max(least + 8, least + least * 6 / 100)));
  std::vector<uint32_t> counts;
  for (uint32_t i = 0; i <= 4; ++i) counts.push_back(least + (most - least) * i / 4);
  for (uint32_t near = least; near <= std::min(most, least + 2); ++near) counts.push_back(near);
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

// Moves in all: enough for small graphs to search from several seeds, and few enough for 10,000 nodes to take about a second.
uint64_t total_evaluations(uint64_t nodes) {
  if (nodes <= 400) return std::min<uint64_t>(1600 * nodes, 160'000);
  return nodes <= 1000 ? 400 * nodes : 400'000 + 60 * (nodes - 1000);
}

// The best so far, and what is found for each number of segments.
struct Search {
  const SegmentProblem& problem;
  Segments best;

  double consider(const Segments& candidate) {
    Segments compact = compact_segments(problem, candidate);
    const double found = score(cost_of(problem, compact));
    if (found < score(cost_of(problem, best))) best = std::move(compact);
    return found;
  }
};

}  // namespace

Segments search_segments(const SegmentProblem& problem) {
  Search search{problem, program_order_segments(problem)};
  if (problem.nodes < 2) return search.best;
  const Segments earliest = earliest_segments(problem);
  const std::vector<uint32_t> counts = counts_to_try(count_of(earliest), count_of(search.best));
  search.consider(earliest);

  // Half of the effort on every number of segments, the other half on the most promising.
  const uint64_t half = total_evaluations(problem.nodes) / 2;
  std::vector<std::pair<double, uint32_t>> ranking;
  for (const uint32_t count : counts) {
    const Segments spread = spread_segments(problem, count);
    search.consider(latest_segments(problem, count));
    search.consider(spread);
    ranking.emplace_back(search.consider(anneal_segments(problem, spread, count, half / counts.size(), 1)), count);
  }
  std::sort(ranking.begin(), ranking.end());
  ranking.resize(std::min<size_t>(ranking.size(), 3));
  const uint64_t seeds = std::max<uint64_t>(1, half / (ranking.size() * 100 * problem.nodes));
  for (uint64_t seed = 2; seed < 2 + seeds; ++seed)
    for (const auto& [found, count] : ranking)
      search.consider(anneal_segments(problem, spread_segments(problem, count), count, half / (ranking.size() * seeds), seed));
  return search.best;
}

}  // namespace rg::compiler
