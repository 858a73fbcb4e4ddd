#include "compiler/queue_timeline.h"

#include <algorithm>
#include <cstddef>
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
    std::priority_queue<Later, std::vector<Later>, std::greater<>> soon;   // by the time their inputs are there
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
    while (!lane.soon.empty() && lane.soon.top().first <= at)
      lane.now.push({problem_.rank_of(lane.soon.top().second), lane.soon.top().second}), lane.soon.pop();
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

// Work of one queue: `head` is what comes before it on whatever queue, `tail` what comes after it.
struct Job {
  double head = 0, cost = 0, tail = 0;
};

// No queue that runs all of them is done, tails included, any earlier: Jackson's preemptive schedule (Carlier 1982), which gives the greatest
// least head + costs + least tail of any part of them. O(n log n).
double jobs_bound(std::vector<Job> jobs) {
  std::sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.head < b.head; });
  std::priority_queue<std::pair<double, double>> ready;  // tail, what is left of the cost
  double now = 0, bound = 0;
  for (size_t next = 0; next < jobs.size() || !ready.empty();) {
    if (ready.empty()) now = std::max(now, jobs[next].head);
    for (; next < jobs.size() && jobs[next].head <= now; ++next) ready.emplace(jobs[next].tail, jobs[next].cost);
    const auto [tail, left] = ready.top();
    ready.pop();
    const double until = next < jobs.size() ? std::min(now + left, jobs[next].head) : now + left;
    if (now + left > until)
      ready.emplace(tail, now + left - until);
    else
      bound = std::max(bound, until + tail);
    now = until;
  }
  return bound;
}

QueueGain bounds_of(const QueueProblem& problem) {
  QueueGain gain;
  const size_t n = problem.nodes.size();
  std::vector<double> head(n), tail(n);
  std::vector<std::vector<Job>> fixed(problem.queues);
  const Links links = links_of(problem);
  const auto each_after = [&](uint32_t node, auto visit) {
    for (uint32_t i = links.first[node]; i < links.first[node + 1]; ++i) visit(links.after[i]);
  };
  for (uint32_t node = 0; node < n; ++node) {
    gain.serial += problem.nodes[node].cost;
    each_after(node, [&](uint32_t after) { head[after] = std::max(head[after], head[node] + problem.nodes[node].cost); });
  }
  for (auto node = static_cast<uint32_t>(n); node-- > 0;) {
    const auto& row = problem.nodes[node];
    each_after(node, [&](uint32_t after) { tail[node] = std::max(tail[node], tail[after] + problem.nodes[after].cost); });
    gain.critical_path = std::max(gain.critical_path, head[node] + row.cost + tail[node]);
    if (row.away == UINT32_MAX) fixed[row.home].push_back({head[node], row.cost, tail[node]});
  }
  gain.bound = std::max(gain.critical_path, gain.serial / problem.queues);
  for (std::vector<Job>& jobs : fixed) gain.bound = std::max(gain.bound, jobs_bound(std::move(jobs)));
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
    find_companies();
  }

  QueueChoice run() {
    double end = settle(QueueOf(choice_.queue_of));
    const QueueOf from_away = choice_.queue_of;
    const double alone = end_of(home_);
    // What cannot be away together hides what could: so once more from everything at home, where much is left to gain.
    if (end > choice_.gain.bound + kLittle * (choice_.gain.serial - choice_.gain.bound)) {
      const double other = settle(home_);
      end = other < end ? other : settle(from_away);
    }
    choice_.gain.end = end;
    if (alone - end < threshold_) choice_.queue_of = home_, choice_.gain.end = alone;
    return std::move(choice_);
  }

 private:
  // Nodes that may go together: one alone, and with the nearest one, three, seven and fifteen movable ones that it needs, or that need it.
  void find_companies() {
    constexpr size_t kMost = 16;
    const size_t n = problem_.nodes.size();
    std::vector<std::vector<uint32_t>> neighbours[2] = {std::vector<std::vector<uint32_t>>(n), std::vector<std::vector<uint32_t>>(n)};
    const auto movable = [&](uint32_t node) { return problem_.nodes[node].away != UINT32_MAX; };
    for (const auto& edge : problem_.edges)
      if (movable(edge.before) && movable(edge.after))
        neighbours[0][edge.before].push_back(edge.after), neighbours[1][edge.after].push_back(edge.before);
    for (uint32_t node = 0; node < n; ++node) {
      if (!movable(node)) continue;
      companies_.push_back({node});
      for (const auto& links : neighbours) {
        std::vector<uint32_t> company{node};
        for (size_t next = 0; next < company.size() && company.size() < kMost; ++next)
          for (const uint32_t other : links[company[next]])
            if (company.size() < kMost && std::find(company.begin(), company.end(), other) == company.end()) company.push_back(other);
        for (size_t size = 2; size < 2 * company.size(); size *= 2)
          companies_.emplace_back(company.begin(), company.begin() + static_cast<std::ptrdiff_t>(std::min(size, company.size())));
      }
    }
  }

  // Sends home and away until neither helps; gives the end.
  double settle(const QueueOf& from) {
    choice_.queue_of = from;
    double end = end_of(from);
    for (bool changed = true; changed && choice_.complete;) {
      changed = false;
      for (const auto& members : members_) changed = send_home(members, end) || changed;
      for (const auto& company : companies_) changed = send_away(company, end) || changed;
    }
    return end;
  }

  bool spent() {
    if (choice_.simulations * problem_.nodes.size() > effort_) choice_.complete = false;
    return !choice_.complete;
  }

  bool send_away(const std::vector<uint32_t>& company, double& end) {
    QueueOf queue_of = choice_.queue_of;
    double own = 0;
    for (const uint32_t node : company)
      if (queue_of[node] == home_[node]) queue_of[node] = problem_.nodes[node].away, own += 0.1 * problem_.nodes[node].cost;
    if (own == 0 || spent()) return false;
    const double with = end_of(queue_of);
    if (end - with <= own + problem_.wait) return false;
    choice_.queue_of = std::move(queue_of), end = with;
    return true;
  }

  double end_of(const QueueOf& queue_of) {
    ++choice_.simulations;
    return simulate(problem_, queue_of).end;
  }

  bool send_home(const std::vector<uint32_t>& members, double& end) {
    if (members.empty() || choice_.queue_of[members.front()] == home_[members.front()]) return false;
    if (spent()) return false;
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

  static constexpr double kLittle = 0.05;  // of what can be gained
  const QueueProblem& problem_;
  double threshold_;
  uint64_t effort_;
  QueueOf home_;
  std::vector<std::vector<uint32_t>> companies_;
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
