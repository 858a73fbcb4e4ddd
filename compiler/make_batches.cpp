#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "compiler/assign_queues.h"
#include "compiler/pass_cost.h"

namespace rg::compiler {
namespace {

struct Piece {                    // a segment, before segments are numbered in the serial order
  uint32_t queue = 0, index = 0;  // index: among the pieces of its queue
  double cost = 0;
  std::vector<uint32_t> passes;
  std::vector<uint32_t> waits;  // pieces of other queues
  bool signals = false;
};

// Cuts the timeline into pieces. A piece ends where a pass depends on another of the same piece, and where one has to wait for another queue anew.
class Cutter {
 public:
  Cutter(const Frame& frame, const Graph& graph, const Schedule& one_queue, const QueuePlan& plan, const std::vector<double>& costs,
         const PlanOptions& options)
      : frame_(frame),
        one_queue_(one_queue),
        plan_(plan),
        costs_(costs),
        options_(options),
        before_(frame.passes.size()),
        piece_of_(frame.passes.size(), UINT32_MAX) {
    for (const auto& [before, after] : plan.extra) extra_.push_back({before, after, DependencyKind::order, UINT32_MAX});
    for (const Dependency& d : graph.dependencies) before_[d.after].push_back(&d);
    for (const Dependency& d : extra_) before_[d.after].push_back(&d);
  }

  std::vector<Piece> run(size_t queues) {
    parted_.assign(queues, false), current_.assign(queues, UINT32_MAX), counts_.assign(queues, 0), now_.assign(queues, std::vector<uint32_t>(queues));
    std::vector<std::vector<uint32_t>> members(one_queue_.leader_of.size());
    for (const uint32_t pass : one_queue_.order) members[one_queue_.leader_of[pass]].push_back(pass);
    for (const uint32_t node : plan_.timeline.order)
      if (const uint32_t pass = one_queue_.order[node]; one_queue_.leader_of[pass] == pass) add(members[pass], plan_.queue_of[node]);
    return std::move(pieces_);
  }

 private:
  // One pass, or all of a rendering.
  void add(const std::vector<uint32_t>& passes, uint32_t queue) {
    const bool own = options_.no_merge.contains(frame_.pass(passes.front()).name);
    bool cut = current_[queue] == UINT32_MAX || !options_.merge || own || parted_[queue];
    parted_[queue] = own;
    std::vector<uint32_t> waits;
    for (const uint32_t pass : passes)
      for (const Dependency* d : before_[pass]) {
        if (one_queue_.leader_of[d->before] == one_queue_.leader_of[pass]) continue;
        const uint32_t from = piece_of_[d->before];
        if (pieces_[from].queue == queue)
          cut = cut || (from == current_[queue] && d->kind != DependencyKind::order);
        else if (now_[queue][pieces_[from].queue] <= pieces_[from].index)
          waits.push_back(from);
      }
    if (cut || !waits.empty()) open(queue);
    for (const uint32_t from : latest_only(std::move(waits), queue)) wait_for(from, queue);
    Piece& piece = pieces_[current_[queue]];
    for (const uint32_t pass : passes) {
      piece.passes.push_back(pass), piece.cost += costs_[pass];
      piece_of_[pass] = current_[queue];
    }
  }

  void open(uint32_t queue) {
    current_[queue] = static_cast<uint32_t>(pieces_.size());
    pieces_.push_back({queue, counts_[queue]++, 0, {}, {}, false});
    known_.push_back(now_[queue]);
  }

  // Without those that another of them, or what the queue knows, implies.
  std::vector<uint32_t> latest_only(std::vector<uint32_t> waits, uint32_t queue) const {
    std::sort(waits.begin(), waits.end(), std::greater<>());
    waits.erase(std::unique(waits.begin(), waits.end()), waits.end());
    std::vector<uint32_t> kept;
    for (const uint32_t wait : waits) {
      const Piece& piece = pieces_[wait];
      bool implied = now_[queue][piece.queue] > piece.index;
      for (const uint32_t other : waits)
        implied = implied || (other != wait &&
                              (pieces_[other].queue == piece.queue ? pieces_[other].index > piece.index : known_[other][piece.queue] > piece.index));
      if (!implied) kept.push_back(wait);
    }
    return kept;
  }

  void wait_for(uint32_t from, uint32_t queue) {
    pieces_[from].signals = true;
    pieces_[current_[queue]].waits.push_back(from);
    std::vector<uint32_t>& now = now_[queue];
    for (size_t q = 0; q < now.size(); ++q) now[q] = std::max(now[q], known_[from][q]);
    now[pieces_[from].queue] = std::max(now[pieces_[from].queue], pieces_[from].index + 1);
    known_[current_[queue]] = now;
  }

  const Frame& frame_;
  const Schedule& one_queue_;
  const QueuePlan& plan_;
  const std::vector<double>& costs_;
  const PlanOptions& options_;
  std::vector<bool> parted_;  // by queue: its piece in hand takes nobody else
  std::vector<Dependency> extra_;
  std::vector<std::vector<const Dependency*>> before_;
  std::vector<uint32_t> piece_of_, current_, counts_;
  std::vector<std::vector<uint32_t>> known_, now_;  // by piece, by queue: for each queue, how many of its pieces have completed
  std::vector<Piece> pieces_;
};

struct Joined {
  std::vector<uint32_t> batch_of;  // by piece
  std::vector<uint32_t> serial;    // batches in the order they start
  double end = 0;
  bool legal = true;
};

// Batches run one after the other on their queue, each after those its pieces wait for.
class Joiner {
 public:
  Joiner(const std::vector<Piece>& pieces, size_t queues) : pieces_(pieces), by_queue_(queues), starts_(pieces.size()) {
    for (uint32_t p = 0; p < pieces.size(); ++p) by_queue_[pieces[p].queue].push_back(p);
    for (const auto& row : by_queue_)
      for (size_t i = 0; i < row.size(); ++i) starts_[row[i]] = i == 0 || !pieces[row[i]].waits.empty() || pieces[row[i - 1]].signals;
  }

  // Joins neighbours wherever the frame ends at most `slack` later for all of them together.
  Joined run(double slack) {
    Joined best = simulate_batches();
    const double limit = best.end + slack;
    for (uint32_t p = 0; p < pieces_.size(); ++p) {
      if (!starts_[p] || pieces_[p].index == 0) continue;
      starts_[p] = false;
      Joined joined = simulate_batches();
      if (joined.legal && joined.end <= limit)
        best = std::move(joined);
      else
        starts_[p] = true;
    }
    return best;
  }

 private:
  Joined simulate_batches() const {
    Joined joined{std::vector<uint32_t>(pieces_.size()), {}, 0, true};
    std::vector<std::vector<uint32_t>> batches;
    std::vector<std::vector<uint32_t>> lanes(by_queue_.size());
    for (size_t q = 0; q < by_queue_.size(); ++q)
      for (const uint32_t p : by_queue_[q]) {
        if (starts_[p]) lanes[q].push_back(static_cast<uint32_t>(batches.size())), batches.emplace_back();
        batches.back().push_back(p);
        joined.batch_of[p] = static_cast<uint32_t>(batches.size()) - 1;
      }
    run_lanes(batches, lanes, joined);
    return joined;
  }

  void run_lanes(const std::vector<std::vector<uint32_t>>& batches, const std::vector<std::vector<uint32_t>>& lanes, Joined& joined) const {
    std::vector<double> finish(batches.size(), -1), free(lanes.size());
    std::vector<size_t> next(lanes.size());
    while (joined.serial.size() < batches.size()) {
      double least = 1e300;
      size_t lane = lanes.size();
      for (size_t q = 0; q < lanes.size(); ++q) {
        if (next[q] == lanes[q].size()) continue;
        const double start = start_of(batches[lanes[q][next[q]]], free[q], finish, joined);
        if (start < least) least = start, lane = q;
      }
      if (lane == lanes.size()) {
        joined.legal = false;
        return;
      }
      const uint32_t batch = lanes[lane][next[lane]++];
      double end = least;
      for (const uint32_t p : batches[batch]) end += pieces_[p].cost;
      finish[batch] = free[lane] = end;
      joined.end = std::max(joined.end, end);
      joined.serial.push_back(batch);
    }
  }

  double start_of(const std::vector<uint32_t>& batch, double free, const std::vector<double>& finish, const Joined& joined) const {
    double start = free;
    for (const uint32_t p : batch)
      for (const uint32_t wait : pieces_[p].waits) {
        const double at = finish[joined.batch_of[wait]];
        if (at < 0) return 1e300;
        start = std::max(start, at + kWaitNs);
      }
    return start;
  }

  const std::vector<Piece>& pieces_;
  std::vector<std::vector<uint32_t>> by_queue_;
  std::vector<bool> starts_;  // by piece: a batch begins with it
};

}  // namespace

Schedule make_batches(const Frame& frame, const Graph& graph, const Schedule& one_queue, const QueuePlan& plan, const std::vector<double>& costs,
                      const PlanOptions& options) {
  const std::vector<Piece> pieces = Cutter(frame, graph, one_queue, plan, costs, options).run(options.queues.size());
  const Joined joined = Joiner(pieces, options.queues.size()).run(0.01 * std::max(0.0, plan.gain.serial - plan.timeline.end));
  Schedule schedule;
  schedule.queues = options.queues;
  schedule.leader_of = one_queue.leader_of;
  schedule.segment_of.assign(frame.passes.size(), UINT32_MAX);
  std::vector<std::vector<uint32_t>> pieces_of(joined.serial.size());
  for (uint32_t p = 0; p < pieces.size(); ++p) pieces_of[joined.batch_of[p]].push_back(p);
  for (uint32_t b = 0; b < joined.serial.size(); ++b)
    for (const uint32_t p : pieces_of[joined.serial[b]]) {
      for (const uint32_t pass : pieces[p].passes) schedule.order.push_back(pass), schedule.segment_of[pass] = schedule.segments;
      schedule.queue_of.push_back(pieces[p].queue), schedule.batch_of.push_back(b);
      ++schedule.segments;
    }
  schedule.batches = static_cast<uint32_t>(joined.serial.size());
  schedule.peak_bytes = one_queue.peak_bytes;
  schedule.chosen_because =
      fmt::format("{}; on {} queues in {} batches the model takes {:.1f} us instead of {:.1f}, at least {:.1f}", one_queue.chosen_because,
                  options.queues.size(), schedule.batches, joined.end / 1000, plan.gain.serial / 1000, plan.gain.bound / 1000);
  return schedule;
}

}  // namespace rg::compiler
