#include "compiler/queue_timeline.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace rg::compiler {
namespace {

struct Links {  // successors as flat lists, and how many predecessors each node has
  std::vector<uint32_t> first, after, pending;
};

Links links_of(const QueueProblem& problem) {
  const size_t n = problem.nodes.size();
  Links links{std::vector<uint32_t>(n + 1), std::vector<uint32_t>(problem.edges.size()), std::vector<uint32_t>(n)};
  for (const auto& edge : problem.edges) ++links.first[edge.before + 1], ++links.pending[edge.after];
  std::partial_sum(links.first.begin(), links.first.end(), links.first.begin());
  std::vector<uint32_t> next(links.first.begin(), links.first.end() - 1);
  for (const auto& edge : problem.edges) links.after[next[edge.before]++] = edge.after;
  return links;
}

class Simulator {
 public:
  Simulator(const QueueProblem& problem, const QueueOf& queue_of)
      : problem_(problem), queue_of_(queue_of), links_(links_of(problem)), lanes_(problem.queues), ready_(problem.nodes.size()) {
    timeline_.start.assign(problem.nodes.size(), 0);
    started_.assign(problem.nodes.size(), false), released_ = started_;
    for (uint32_t node = 0; node < problem.nodes.size(); ++node) lanes_[queue_of[node]].nodes.push_back(node);
    if (!problem.rank.empty())
      for (Lane& lane : lanes_)
        std::sort(lane.nodes.begin(), lane.nodes.end(), [&](uint32_t a, uint32_t b) { return problem.rank[a] < problem.rank[b]; });
    for (Lane& lane : lanes_) release(lane);
  }

  QueueTimeline run() {
    while (timeline_.order.size() < problem_.nodes.size()) {
      Lane* first = nullptr;
      for (Lane& lane : lanes_)
        if (const double at = next_start(lane); at < kNever && (!first || at < next_start(*first))) first = &lane;
      start(*first, next_start(*first));
    }
    return std::move(timeline_);
  }

 private:
  static constexpr double kNever = 1e300;
  using Later = std::pair<double, uint32_t>;
  using Ranked = std::pair<uint32_t, uint32_t>;  // with the node
  struct Lane {
    std::vector<uint32_t> nodes;  // in the given order
    size_t lowest = 0, released = 0;
    double free = 0;
    std::priority_queue<Ranked, std::vector<Ranked>, std::greater<>> now;  // may run as soon as the lane is free
    std::priority_queue<Later, std::vector<Later>, std::greater<>> soon;       // by the time their inputs are there
  };

  double next_start(const Lane& lane) const {
    if (!lane.now.empty()) return lane.free;
    return lane.soon.empty() ? kNever : std::max(lane.free, lane.soon.top().first);
  }

  // Nodes within the window of the lowest that has not started.
  void release(Lane& lane) {
    while (lane.lowest < lane.nodes.size() && started_[lane.nodes[lane.lowest]]) ++lane.lowest;
    const size_t limit = std::min(lane.nodes.size(), lane.lowest + std::min<size_t>(problem_.window, lane.nodes.size()) + 1);
    for (; lane.released < limit; ++lane.released) {
      const uint32_t node = lane.nodes[lane.released];
      released_[node] = true;
      if (links_.pending[node] == 0) lane.soon.push({ready_[node], node});
    }
  }

  void start(Lane& lane, double at) {
    while (!lane.soon.empty() && lane.soon.top().first <= at) lane.now.push({problem_.rank_of(lane.soon.top().second), lane.soon.top().second}), lane.soon.pop();
    const uint32_t node = lane.now.top().second;
    lane.now.pop();
    timeline_.start[node] = at, timeline_.order.push_back(node);
    started_[node] = true;
    lane.free = at + problem_.nodes[node].cost;
    timeline_.end = std::max(timeline_.end, lane.free);
    for (uint32_t i = links_.first[node]; i < links_.first[node + 1]; ++i) finish(node, links_.after[i], lane.free);
    release(lane);
  }

  void finish(uint32_t node, uint32_t after, double at) {
    ready_[after] = std::max(ready_[after], at + (queue_of_[node] == queue_of_[after] ? 0 : problem_.wait));
    if (--links_.pending[after] == 0 && released_[after]) lanes_[queue_of_[after]].soon.push({ready_[after], after});
  }

  const QueueProblem& problem_;
  const QueueOf& queue_of_;
  Links links_;
  std::vector<Lane> lanes_;
  std::vector<double> ready_;
  std::vector<bool> started_, released_;
  QueueTimeline timeline_;
};

QueueGain bounds_of(const QueueProblem& problem) {
  QueueGain gain;
  std::vector<double> chain(problem.nodes.size()), fixed(problem.queues);
  const Links links = links_of(problem);
  for (uint32_t node = 0; node < problem.nodes.size(); ++node) {
    const auto& row = problem.nodes[node];
    gain.serial += row.cost;
    if (row.away == UINT32_MAX) fixed[row.home] += row.cost;
    chain[node] += row.cost;
    gain.critical_path = std::max(gain.critical_path, chain[node]);
    for (uint32_t i = links.first[node]; i < links.first[node + 1]; ++i) chain[links.after[i]] = std::max(chain[links.after[i]], chain[node]);
  }
  gain.bound = std::max({gain.critical_path, gain.serial / problem.queues, *std::max_element(fixed.begin(), fixed.end())});
  return gain;
}

class Chooser {
 public:
  Chooser(const QueueProblem& problem, double threshold, uint64_t effort) : problem_(problem), threshold_(threshold), effort_(effort) {
    choice_.gain = bounds_of(problem);
    choice_.worth.assign(problem.nodes.size(), 0);
    for (const auto& node : problem.nodes) home_.push_back(node.home), choice_.queue_of.push_back(node.away == UINT32_MAX ? node.home : node.away);
    for (uint32_t node = 0; node < problem.nodes.size(); ++node)
      if (problem.nodes[node].away != UINT32_MAX) members_[problem.nodes[node].group].push_back(node);
    for (uint32_t group = 0; group < problem.groups; ++group)  // then one by one
      if (members_[group].size() > 1)
        for (const uint32_t node : std::vector<uint32_t>(members_[group])) members_.push_back({node});
  }

  QueueChoice run() {
    double end = end_of(choice_.queue_of);
    for (bool changed = true; changed && choice_.complete;) {
      changed = false;
      for (const auto& members : members_) changed = send_home(members, end) || changed;
    }
    const double alone = end_of(home_);
    choice_.gain.end = end;
    if (alone - end < threshold_) choice_.queue_of = home_, choice_.gain.end = alone;
    return std::move(choice_);
  }

 private:
  double end_of(const QueueOf& queue_of) {
    ++choice_.simulations;
    return simulate(problem_, queue_of).end;
  }

  bool send_home(const std::vector<uint32_t>& members, double& end) {
    if (members.empty() || choice_.queue_of[members.front()] == home_[members.front()]) return false;
    if (choice_.simulations * problem_.nodes.size() > effort_) {
      choice_.complete = false;
      return false;
    }
    QueueOf queue_of = choice_.queue_of;
    for (const uint32_t node : members) queue_of[node] = home_[node];
    const double without = end_of(queue_of);
    double own = problem_.wait;
    for (const uint32_t node : members) {
      if (choice_.queue_of[node] != home_[node]) choice_.worth[node] = without - end;
      own += 0.1 * problem_.nodes[node].cost;
    }
    if (without - end >= own) return false;
    choice_.queue_of = std::move(queue_of);
    end = without;
    return true;
  }

  const QueueProblem& problem_;
  double threshold_;
  uint64_t effort_;
  QueueOf home_;
  std::vector<std::vector<uint32_t>> members_ = std::vector<std::vector<uint32_t>>(problem_.groups);
  QueueChoice choice_;
};

}  // namespace

QueueTimeline simulate(const QueueProblem& problem, const QueueOf& queue_of) {
  if (problem.queues > 1) return Simulator(problem, queue_of).run();
  QueueTimeline timeline;  // the given order is legal, and nothing can be gained by another
  for (uint32_t node = 0; node < problem.nodes.size(); ++node) {
    timeline.start.push_back(timeline.end), timeline.order.push_back(node);
    timeline.end += problem.nodes[node].cost;
  }
  return timeline;
}

QueueChoice choose_queues(const QueueProblem& problem, double threshold, uint64_t effort) { return Chooser(problem, threshold, effort).run(); }

}  // namespace rg::compiler
