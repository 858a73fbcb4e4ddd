#include "compiler/segment_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/segment_graph.h"
#include "runtime/packing.h"

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

double score(const SegmentCost& cost, Prefer prefer) {
  const double bytes = static_cast<double>(cost.peak + (uint64_t{65536})), segments = cost.segments;
  switch (prefer) {
    case Prefer::memory:
      return segments * std::pow(bytes, 8);
    case Prefer::barriers:
    case Prefer::time:
      return std::pow(segments, 4) * bytes;
    default:
      return segments * std::pow(bytes, 3);
  }
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

namespace {

// What keeps neighbouring segments apart, by segment.
struct Seams {
  std::vector<uint64_t> live, begins;  // bytes that live in it, and of those what begins in it
  std::vector<uint32_t> after;         // one more than the last segment it has to come after; 0: none
};
Seams seams_of(const SegmentProblem& problem, const SegmentLinks& before, const Segments& segments) {
  const uint32_t count = count_of(segments);
  Seams seams{std::vector<uint64_t>(count), std::vector<uint64_t>(count), std::vector<uint32_t>(count)};
  std::vector<uint64_t> ends(count + 1);
  for (const auto& item : problem.items) {
    const SegmentInterval interval = interval_of(item, segments);
    seams.begins[interval.begin] += item.bytes, ends[interval.end + 1] += item.bytes;
  }
  uint64_t live = 0;
  for (uint32_t s = 0; s < count; ++s) seams.live[s] = live += seams.begins[s] - ends[s];
  for (uint32_t node = 0; node < problem.nodes; ++node)
    for (const auto& link : before.of(node))
      if (link.gap == 1) seams.after[segments[node]] = std::max(seams.after[segments[node]], segments[link.node] + 1);
  return seams;
}

struct Joined {
  std::vector<uint32_t> number_of;  // by segment
  SegmentCost cost;
};
Joined join(const Seams& seams, uint64_t limit) {
  Joined joined{std::vector<uint32_t>(seams.live.size()), {seams.live.empty() ? 0u : 1u, 0}};
  uint64_t live = 0;   // in the current one
  uint32_t first = 0;  // of those that are the current one
  for (uint32_t s = 0; s < seams.live.size(); ++s) {
    const bool cut = s > 0 && (live + seams.begins[s] > limit || seams.after[s] > first);
    live = cut || s == 0 ? seams.live[s] : live + seams.begins[s];
    if (cut) ++joined.cost.segments, first = s;
    joined.number_of[s] = joined.cost.segments - 1;
    joined.cost.peak = std::max(joined.cost.peak, live);
  }
  return joined;
}
Segments renumbered(const Segments& segments, const std::vector<uint32_t>& number_of) {
  Segments result(segments.size());
  for (size_t node = 0; node < segments.size(); ++node) result[node] = number_of[segments[node]];
  return result;
}

}  // namespace

Segments compact_segments(const SegmentProblem& problem, const Segments& segments, uint64_t limit) {
  return renumbered(segments, join(seams_of(problem, predecessors(problem), segments), limit).number_of);
}

namespace {

// Numbers of segments worth a search: the least, and up to a fifth more, or a quarter where nothing but construction finds orders.
std::vector<uint32_t> counts_to_try(uint32_t least, uint32_t nodes, Effort effort, Prefer prefer) {
  const uint32_t more = nodes > 400 ? least * 6 / 100 : effort == Effort::fast ? least / 4 : least / 5;
  const uint32_t most = std::min(nodes, least + (prefer == Prefer::barriers ? 1 : std::max(4u, more)));
  std::vector<uint32_t> counts;
  for (uint32_t i = 0; i <= 5; ++i) counts.push_back(least + (most - least) * i / 5);
  if (nodes <= 60) counts.push_back(std::min(most, least + 2));
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

// Moves in all: a few milliseconds for 40 nodes, about two seconds for 10,000; for the last effort up to three hundred times as many, and no more
// than a minute.
uint64_t total_evaluations(uint64_t nodes, Effort effort) {
  const uint64_t moves = nodes <= 400 ? 300 * nodes : nodes <= 1000 ? 120'000 + 30 * (nodes - 400) : 138'000 + 60 * (nodes - 1000);
  return effort == Effort::max ? moves * (nodes <= 400 ? 300 : nodes <= 2000 ? 100 : 40) : moves;
}

// For each order that is packed: conflicts looked at, and how many orders like it are tried instead where it does not pack.
struct PackingEffort {
  uint64_t effort = 0;
  uint32_t drifts = 0;
};
constexpr uint64_t kDriftMoves = 30;  // a node

PackingEffort packing_effort(const SegmentProblem& problem, Effort effort) {
  if (effort == Effort::max) return {std::min<uint64_t>(100'000 * problem.items.size(), 50'000'000), problem.nodes > 2000 ? 4u : 10u};
  return {1000 * problem.items.size(), 8};
}

// What was tried and not beaten, and what is found for each number of segments.
class Search {
 public:
  Search(const SegmentProblem& problem, Prefer prefer) : problem_(problem), before_(predecessors(problem)), prefer_(prefer) {}

  // Gives the score of the better of two ways to join segments.
  double consider(const Segments& candidate) {
    double found = std::numeric_limits<double>::max();
    const Seams seams = seams_of(problem_, before_, candidate);
    const uint64_t peak = seams.live.empty() ? 0 : *std::max_element(seams.live.begin(), seams.live.end());
    for (const uint64_t limit : {peak, UINT64_MAX}) {
      const Joined joined = join(seams, limit);
      found = std::min(found, score(joined.cost, prefer_));
      note(joined.cost, [&] { return renumbered(candidate, joined.number_of); });
    }
    return found;
  }

  // Most orders can be packed to their peak, tight ones often cannot, but some like them can: packs them, the most promising first, until none left
  // can be better. Without effort the peak is believed.
  SegmentResult choose(const PackingEffort& packing) && {
    std::vector<const Tried*> by_score;
    for (const Tried& tried : tried_) by_score.push_back(&tried), result.frontier.push_back(tried.cost);
    std::stable_sort(by_score.begin(), by_score.end(),
                     [&](const Tried* a, const Tried* b) { return score(a->cost, prefer_) < score(b->cost, prefer_); });
    double best = std::numeric_limits<double>::max();
    for (const Tried* tried : by_score) {
      if (score(tried->cost, prefer_) >= best) break;
      Segments segments = tried->segments;
      for (uint32_t drifts = 0;; segments = drift_segments(problem_, segments, kDriftMoves * problem_.nodes, ++drifts)) {
        const uint64_t bytes = packing.effort ? packed_bytes(problem_, segments, packing.effort) : tried->cost.peak;
        const double packed = score({tried->cost.segments, bytes}, prefer_);
        if (packed < best) result.score = best = packed, result.best = segments;
        if (bytes <= tried->cost.peak || drifts == packing.drifts) break;
      }
    }
    return std::move(result);
  }

  SegmentResult result;

 private:
  struct Tried {
    SegmentCost cost;
    Segments segments;
  };

  // Keeps those that no other beats in both.
  template <class Make>
  void note(const SegmentCost& cost, Make segments) {
    const auto beats = [](const SegmentCost& a, const SegmentCost& b) { return a.segments <= b.segments && a.peak <= b.peak; };
    if (std::any_of(tried_.begin(), tried_.end(), [&](const Tried& other) { return beats(other.cost, cost); })) return;
    std::erase_if(tried_, [&](const Tried& other) { return beats(cost, other.cost); });
    const auto place =
        std::lower_bound(tried_.begin(), tried_.end(), cost, [](const Tried& a, const SegmentCost& b) { return a.cost.segments < b.segments; });
    tried_.insert(place, {cost, segments()});
  }

  const SegmentProblem& problem_;
  SegmentLinks before_;
  Prefer prefer_;
  std::vector<Tried> tried_;  // by segments
};

}  // namespace

uint64_t packed_bytes(const SegmentProblem& problem, const Segments& segments, uint64_t effort) {
  std::vector<packing::Item> items;
  items.reserve(problem.items.size());
  for (const auto& item : problem.items) {
    const SegmentInterval interval = interval_of(item, segments);
    items.push_back({item.bytes, item.alignment, interval.begin, interval.end + 1});
  }
  return packing::pack(items, effort).heap_bytes;
}

SegmentResult search_segments(const SegmentProblem& problem, Effort effort, Prefer prefer) {
  if (effort == Effort::fast && prefer == Prefer::balance) prefer = Prefer::memory;  // constructed orders that save groups spend too much on it
  Search search(problem, prefer);
  const Segments program_order = program_order_segments(problem);
  search.consider(program_order);
  search.result.method = "program order";
  if (problem.nodes < 2) return std::move(search).choose({});
  const Segments earliest = earliest_segments(problem);
  const uint32_t least = count_of(earliest);
  search.result.method = "list scheduling";
  search.consider(earliest);
  const std::vector<uint32_t> counts = counts_to_try(least, problem.nodes, effort, prefer);
  // A chain has one order, and moves would only find that out again and again.
  if (counts.back() == least && latest_segments(problem, least) == earliest)
    return std::move(search).choose(effort == Effort::fast ? PackingEffort{} : PackingEffort{packing_effort(problem, effort).effort, 0});
  for (const uint32_t count : counts) {
    if (effort == Effort::fast && count != counts.front() && count != counts.back()) continue;
    search.consider(latest_segments(problem, count));
    search.consider(spread_segments(problem, count));
  }
  if (effort == Effort::fast) return std::move(search).choose({});

  // Half of the effort on every number of segments, each from what the one before has found, the other half on the most promising from nothing.
  search.result.method = "annealing";
  const uint64_t half = total_evaluations(problem.nodes, effort) / 2;
  std::vector<std::pair<double, uint32_t>> ranking;
  Segments found;
  for (const uint32_t count : counts) {
    const bool warm = !found.empty();
    found = anneal_segments(problem, warm ? found : spread_segments(problem, count), count, half / counts.size(), 1, warm);
    ranking.emplace_back(search.consider(found), count);
  }
  std::sort(ranking.begin(), ranking.end());
  ranking.resize(std::min<size_t>(ranking.size(), effort == Effort::max ? 3 : 2));
  const uint64_t seeds = std::clamp<uint64_t>(half / (ranking.size() * 100 * problem.nodes), 1, 40);
  for (uint64_t seed = 2; seed < 2 + seeds; ++seed)
    for (const auto& [found_score, count] : ranking)
      search.consider(anneal_segments(problem, spread_segments(problem, count), count, half / (ranking.size() * seeds), seed));
  search.result.evaluations = 2 * half;
  return std::move(search).choose(packing_effort(problem, effort));
}

}  // namespace rg::compiler
