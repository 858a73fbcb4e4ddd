// The combinatorial core of queue assignment: nodes that take time, queues that run one node after the other, and what waiting between queues costs.
// Knows nothing of graphics.
//
//   queue 0   | a | c     | d |   | f |        f waits for e; d does not, so it runs meanwhile
//   queue 1       | b   | e    |
//
// The model is ideal: queues do not slow each other down. So it bounds from above what overlap can gain, which is what a decision needs that must not
// move a pass for nothing.
//
// Source of the method: list scheduling (Graham 1966) that keeps a given order wherever that does not leave a queue idle; assignment by descent from
// "everything moved", since moving a chain pays only as a whole, and from "nothing moved" where that leaves much to gain.
#pragma once

#include <cstdint>
#include <vector>

namespace rg::compiler {

struct QueueProblem {
  struct Node {
    double cost = 0;
    uint32_t home = 0;           // queue
    uint32_t away = UINT32_MAX;  // queue it may move to; UINT32_MAX: none
    uint32_t group = 0;          // below `groups`; nodes of one are sent home together first, then one by one
  };
  struct Edge {
    uint32_t before = 0, after = 0;
  };
  uint32_t queues = 1, groups = 0;
  double wait = 0;               // extra time before a node that depends on another queue
  uint32_t window = UINT32_MAX;  // how far, in nodes of its queue, one may run ahead of the given order
  std::vector<Node> nodes;       // in a good order for one queue, legal for all edges
  std::vector<Edge> edges;
  std::vector<uint32_t> rank;  // by node, in another legal order to keep; empty: that of the nodes
  uint32_t rank_of(uint32_t node) const { return rank.empty() ? node : rank[node]; }
};

using QueueOf = std::vector<uint32_t>;  // by node

struct QueueTimeline {
  std::vector<double> start;    // by node
  std::vector<uint32_t> order;  // nodes by start
  double end = 0;
};
// O((nodes + edges) log nodes).
QueueTimeline simulate(const QueueProblem& problem, const QueueOf& queue_of);

struct QueueGain {
  double serial = 0;         // everything on one queue
  double critical_path = 0;  // longest chain, waits not counted
  double bound = 0;  // no assignment ends earlier: the longest chain, what only one queue may run with what comes before and after, work by queues
  double end = 0;    // of what was chosen
};
struct QueueChoice {
  QueueOf queue_of;
  QueueGain gain;
  std::vector<double> worth;  // by node that is away: how much later the frame would end without its move (its whole group's)
  uint64_t simulations = 0;
  bool complete = true;  // false: the search ended at its limit
};
// Moves what may move, then back each group and each node that is worth less than a wait and a tenth of its own time, and away again nodes with their
// neighbours that are worth more, until neither helps; nothing at all if the whole gain is below `threshold`. `effort` limits nodes simulated in all.
QueueChoice choose_queues(const QueueProblem& problem, double threshold, uint64_t effort);

}  // namespace rg::compiler
