#include "compiler/assign_queues.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <set>

#include "compiler/pass_cost.h"

namespace rg::compiler {
namespace {

constexpr double kThreshold = 0.005;  // of the frame's serial time: less is not worth a second queue
// Nodes simulated in all.
uint64_t effort_for(size_t nodes, Effort effort) { return std::max<uint64_t>(1'000'000, 500 * nodes) / (effort == Effort::fast ? 20 : 1); }
constexpr double kEnough = 0.95, kWorthwhile = 0.01;  // of what overlap can gain: look no further; take another order

std::string_view kind_name(dsl::QueueKind kind) {
  constexpr std::string_view names[] = {"graphics", "compute", "transfer"};
  return names[static_cast<size_t>(kind)];
}

// Stages that a queue of the kind has.
Stages stages_of(dsl::QueueKind kind) {
  constexpr Stages transfers = stage::copy | stage::clear | stage::all_transfer | stage::host;
  if (kind == dsl::QueueKind::transfer) return transfers;
  if (kind == dsl::QueueKind::compute) return transfers | stage::compute_shader | stage::draw_indirect;
  return ~Stages{0};
}

bool clears_depth(const Frame& frame, const dsl::Pass& pass) {
  return std::any_of(pass.accesses.begin(), pass.accesses.end(), [&](const dsl::Access& access) {
    return access.role == dsl::Role::clear_dst &&
           (frame.cells[frame.grids[access.resource.value].first_cell].range.aspects & ~uint32_t{aspect_color});
  });
}

// The engine hands the image over in the layout in which everybody uses it, and takes it back so.
bool keeps_layout(const Frame& frame, const std::vector<const Use*>& uses) {
  const Cell& cell = frame.cells[uses.front()->cell];
  const dsl::Resource& image = frame.graph->resources.rows[cell.resource];
  if (image.lifetime != dsl::Lifetime::imported || image.before.role == dsl::Role::undefined) return false;
  const Layout layout = effect_of(image.before, cell.range.aspects).layout;
  if (image.after.role != dsl::Role::undefined && effect_of(image.after, cell.range.aspects).layout != layout) return false;
  return std::all_of(uses.begin(), uses.end(), [&](const Use* each) { return each->effect.layout == layout; });
}

class Eligibility {
 public:
  Eligibility(const Frame& frame, const Schedule& one_queue, const PlanOptions& options)
      : frame_(frame), options_(options), uses_(frame.cells.size()) {
    for (const uint32_t pass : one_queue.order)
      for (const Use& use : frame.uses_of(pass)) uses_[use.cell].push_back(&use);
  }

  // Empty, or why the pass has to stay at home.
  std::string why_not(uint32_t pass) const {
    const dsl::Pass& row = frame_.pass(pass);
    if (options_.no_async.contains(row.name)) return "kept by `--no-async=" + row.name + "`";
    if (clears_depth(frame_, row)) return "only a graphics queue clears depth";
    for (const Use& use : frame_.uses_of(pass)) {
      const dsl::Resource& resource = frame_.resource_of(use.cell);
      if (use.effect.stages() & ~stages_of(row.queue)) return fmt::format("a {} queue has not the stages it runs in", kind_name(row.queue));
      if (use.share != Share::none && sharers(use.cell) > 1) return fmt::format("others share its writes to `{}` without order", resource.name);
      if (resource.lifetime == dsl::Lifetime::imported && !is_ready(use))
        return fmt::format("`{}` is the engine's at the frame's ends", resource.name);
    }
    return {};
  }

 private:
  size_t sharers(uint32_t cell) const {
    return static_cast<size_t>(std::count_if(uses_[cell].begin(), uses_[cell].end(), [](const Use* use) { return use->share != Share::none; }));
  }
  // Read where it is ready to be read, and written by nobody.
  bool is_ready(const Use& use) const {
    const dsl::Resource& resource = frame_.resource_of(use.cell);
    if (resource.before.role == dsl::Role::undefined) return false;
    const Effect before = effect_of(resource.before, 0), after = effect_of(resource.after, 0);
    const auto& all = uses_[use.cell];
    if (resource.kind == dsl::ResourceKind::image && !keeps_layout(frame_, all)) return false;
    if (before.writes || after.writes || std::any_of(all.begin(), all.end(), [](const Use* each) { return each->writes(); })) return false;
    const bool left_so = resource.after.role == dsl::Role::undefined || (use.effect.stages() & ~with_earlier(after.stages())) == 0;
    return left_so && (use.effect.reads & ~before.reads) == 0 && (use.effect.read_stages & ~before.read_stages) == 0;
  }

  const Frame& frame_;
  const PlanOptions& options_;
  std::vector<std::vector<const Use*>> uses_;  // by cell, in order
};

// Uses of one cell that no barrier parts, with the queues they run on.
struct Run {
  Layout layout = Layout::undefined;
  bool writes = false;
  std::set<uint32_t> queues;
  std::vector<uint32_t> nodes;
};

// Finds images whose layout would have to change between two sets of queues, and sends their movable readers home.
class LayoutGuard {
 public:
  LayoutGuard(const Frame& frame, const Schedule& one_queue) : frame_(frame) {
    std::vector<std::vector<std::pair<uint32_t, const Use*>>> by_cell(frame.cells.size());
    std::vector<std::vector<const Use*>> uses(frame.cells.size());
    for (uint32_t node = 0; node < one_queue.order.size(); ++node)
      for (const Use& use : frame.uses_of(one_queue.order[node])) by_cell[use.cell].push_back({node, &use}), uses[use.cell].push_back(&use);
    for (uint32_t cell = 0; cell < frame.cells.size(); ++cell)
      if (frame.resource_of(cell).kind == dsl::ResourceKind::image && by_cell[cell].size() > 1 && !keeps_layout(frame, uses[cell]))
        cells_.push_back({cell, std::move(by_cell[cell])});
  }

  // True if somebody was sent home.
  bool enforce(QueueOf& queue_of, const std::vector<QueueProblem::Node>& nodes) const {
    bool changed = false;
    for (const auto& [cell, uses] : cells_)
      for (const uint32_t node : contested_nodes(cell, uses, queue_of))
        if (nodes[node].away != UINT32_MAX && queue_of[node] != nodes[node].home) queue_of[node] = nodes[node].home, changed = true;
    return changed;
  }
  // Resources of which that did not help, ascending.
  std::vector<uint32_t> contested(const QueueOf& queue_of) const {
    std::vector<uint32_t> resources;
    for (const auto& [cell, uses] : cells_)
      if (!contested_nodes(cell, uses, queue_of).empty()) resources.push_back(frame_.cells[cell].resource);
    resources.erase(std::unique(resources.begin(), resources.end()), resources.end());
    return resources;
  }

 private:
  // Users of a run on several queues that another layout comes before, on several queues or in the frame before.
  std::vector<uint32_t> contested_nodes(uint32_t cell, const std::vector<std::pair<uint32_t, const Use*>>& uses, const QueueOf& queue_of) const {
    const bool across_frames = frame_.resource_of(cell).lifetime != dsl::Lifetime::transient;
    const std::vector<Run> runs = runs_of(uses, queue_of);
    std::vector<uint32_t> nodes;
    const bool one_layout = std::all_of(uses.begin(), uses.end(), [&](const auto& use) { return use.second->effect.layout == Layout::general; });
    for (size_t i = 0; i < runs.size() && !one_layout; ++i) {
      if (runs[i].queues.size() < 2) continue;
      const bool from_many = i > 0 && runs[i - 1].queues.size() > 1 && runs[i - 1].layout != runs[i].layout;
      if (from_many || across_frames) nodes.insert(nodes.end(), runs[i].nodes.begin(), runs[i].nodes.end());
    }
    return nodes;
  }

  static std::vector<Run> runs_of(const std::vector<std::pair<uint32_t, const Use*>>& uses, const QueueOf& queue_of) {
    std::vector<Run> runs;
    for (const auto& [node, use] : uses) {
      if (runs.empty() || use->writes() || runs.back().writes || runs.back().layout != use->effect.layout)
        runs.push_back({use->effect.layout, use->writes(), {}, {}});
      runs.back().queues.insert(queue_of[node]), runs.back().nodes.push_back(node);
    }
    return runs;
  }

  struct CellUses {
    uint32_t cell = 0;
    std::vector<std::pair<uint32_t, const Use*>> uses;
  };
  const Frame& frame_;
  std::vector<CellUses> cells_;
};

uint32_t queue_of_kind(const PlanOptions& options, dsl::QueueKind kind) {
  for (uint32_t q = 0; q < options.queues.size(); ++q)
    if (options.queues[q] == kind) return q;
  return UINT32_MAX;
}

class Assigner {
 public:
  Assigner(const Frame& frame, const Graph& graph, const Schedule& one_queue, const std::vector<double>& costs, const PlanOptions& options)
      : frame_(frame), one_queue_(one_queue), options_(options) {
    problem_.queues = static_cast<uint32_t>(options.queues.size());
    problem_.wait = kWaitNs;
    problem_.window = options.prefer == Prefer::time ? UINT32_MAX : options.prefer == Prefer::memory || options.prefer == Prefer::order ? 8 : 64;
    std::vector<uint32_t> node_of(frame.passes.size(), UINT32_MAX);
    for (uint32_t node = 0; node < one_queue.order.size(); ++node) node_of[one_queue.order[node]] = node;
    for (const uint32_t pass : one_queue.order) problem_.nodes.push_back({costs[pass], 0, UINT32_MAX, 0});
    for (const Dependency& d : graph.dependencies) {
      const QueueProblem::Edge edge{node_of[d.before], node_of[d.after]};
      if (problem_.edges.empty() || problem_.edges.back().before != edge.before || problem_.edges.back().after != edge.after)
        problem_.edges.push_back(edge);
    }
  }

  QueuePlan run() {
    find_homes();
    order_importers();
    keep_renderings_together();
    group_neighbours();
    QueueChoice choice = choose_order();
    if (problem_.queues > 1) {
      const LayoutGuard guard(frame_, one_queue_);
      for (bool changed = guard.enforce(choice.queue_of, problem_.nodes); changed;) changed = guard.enforce(choice.queue_of, problem_.nodes);
      plan_.contested = guard.contested(choice.queue_of);
    }
    plan_.timeline = simulate(problem_, choice.queue_of);
    plan_.gain = choice.gain, plan_.gain.end = plan_.timeline.end;
    plan_.simulations = choice.simulations, plan_.complete = choice.complete;
    explain(choice);
    plan_.queue_of = std::move(choice.queue_of);
    return std::move(plan_);
  }

 private:
  // The order for one queue may leave queues idle, because what they wait for comes late in it. Then others are tried that hurry what movable passes
  // need and put off what needs them, less before more: lives grow longer with the distance.
  QueueChoice choose_order() {
    const uint64_t effort = effort_for(problem_.nodes.size(), options_.effort);
    QueueChoice best = choose_queues(problem_, kThreshold * total(), effort / 4);
    const double possible = best.gain.serial - best.gain.bound;
    std::vector<uint32_t> rank;
    for (const uint32_t distance : {2u, 4u, 8u, 16u, 32u}) {
      const uint64_t spent = best.simulations * problem_.nodes.size();
      if (!may_reorder() || spent >= effort || distance > problem_.window || best.gain.serial - best.gain.end >= kEnough * possible) break;
      problem_.rank = urgent_order(distance);
      QueueChoice choice = choose_queues(problem_, kThreshold * total(), std::min(effort / 4, effort - spent));
      best.simulations = choice.simulations += best.simulations;
      if (best.gain.end - choice.gain.end < kWorthwhile * possible) continue;
      best = std::move(choice), rank = problem_.rank;
    }
    problem_.rank = std::move(rank);
    return best;
  }

  bool may_reorder() const { return problem_.queues > 1 && options_.reorder && options_.no_reorder.empty() && options_.prefer != Prefer::order; }

  // Ranks in a legal order (Kahn 1962): what a movable node needs is due `distance` before it, what needs one comes as much later.
  std::vector<uint32_t> urgent_order(uint32_t distance) const {
    const size_t n = problem_.nodes.size();
    std::vector<int64_t> due(n);
    std::vector<std::vector<uint32_t>> after(n);
    std::vector<uint32_t> waits(n), rank(n);
    for (size_t node = 0; node < n; ++node) due[node] = static_cast<int64_t>(node);
    for (const auto& edge : problem_.edges) after[edge.before].push_back(edge.after), ++waits[edge.after];
    for (size_t node = n; node-- > 0;)
      for (const uint32_t next : after[node]) {
        const bool movable = problem_.nodes[next].away != UINT32_MAX;
        due[node] = std::min(due[node], movable ? int64_t{next} - distance : due[next]);
      }
    for (const auto& edge : problem_.edges)
      if (problem_.nodes[edge.before].away != UINT32_MAX) due[edge.after] = std::max(due[edge.after], int64_t{edge.before} + distance);
    std::priority_queue<std::pair<int64_t, uint32_t>, std::vector<std::pair<int64_t, uint32_t>>, std::greater<>> ready;
    for (uint32_t node = 0; node < n; ++node)
      if (waits[node] == 0) ready.emplace(due[node], node);
    for (uint32_t next = 0; !ready.empty(); ++next) {
      const uint32_t node = ready.top().second;
      ready.pop();
      rank[node] = next;
      for (const uint32_t later : after[node])
        if (--waits[later] == 0) ready.emplace(due[later], later);
    }
    return rank;
  }

  double total() const {
    return std::accumulate(problem_.nodes.begin(), problem_.nodes.end(), 0.0, [](double sum, const auto& node) { return sum + node.cost; });
  }

  void find_homes() {
    std::optional<Eligibility> eligibility;  // of those that have a queue to go to
    const auto why_not = [&](uint32_t pass) {
      if (!eligibility) eligibility.emplace(frame_, one_queue_, options_);
      return eligibility->why_not(pass);
    };
    for (uint32_t node = 0; node < problem_.nodes.size(); ++node) {
      const dsl::Pass& pass = frame_.pass(one_queue_.order[node]);
      if (pass.queue == dsl::QueueKind::graphics) continue;
      const uint32_t queue = queue_of_kind(options_, pass.queue);
      std::string why = queue == UINT32_MAX ? fmt::format("there is no {} queue", kind_name(pass.queue)) : why_not(one_queue_.order[node]);
      if (why.empty() && pass.queue_may) problem_.nodes[node].away = queue;
      if (why.empty() && !pass.queue_may) problem_.nodes[node].home = queue;
      if (!why.empty()) plan_.decisions.push_back({one_queue_.order[node], false, "stays on the first queue: " + why});
    }
  }

  // Imported data is there when the first queue starts its frame, and is the engine's again when that queue ends it: others learn of the one by
  // waiting for something the first queue has run, and it waits for them before the last it runs.
  void order_importers() {
    const auto& nodes = problem_.nodes;
    const auto fixed = [](const auto& node) { return node.home == 0 && node.away == UINT32_MAX; };
    const auto first = static_cast<uint32_t>(std::find_if(nodes.begin(), nodes.end(), fixed) - nodes.begin());
    const auto end = static_cast<uint32_t>(nodes.rend() - std::find_if(nodes.rbegin(), nodes.rend(), fixed));  // behind the last
    for (uint32_t node = 0; node < nodes.size(); ++node) {
      const bool gives_back = is_given_back(one_queue_.order[node]);
      if (fixed(nodes[node]) || !(gives_back || imports(one_queue_.order[node]))) continue;
      if (node < first)
        keep_at_home(node, "nothing there runs before it, so nothing tells that imported data is there");
      else if (gives_back && node >= end)
        keep_at_home(node, "nothing there runs after it, so nothing tells the engine that its data is free again");
      else
        order(first, node);
      if (gives_back && !fixed(nodes[node])) order(node, end - 1);
    }
  }
  bool imports(uint32_t pass) const {
    const auto uses = frame_.uses_of(pass);
    return std::any_of(uses.begin(), uses.end(), [&](const Use& use) { return frame_.resource_of(use.cell).lifetime == dsl::Lifetime::imported; });
  }
  // Something the engine goes on to use.
  bool is_given_back(uint32_t pass) const {
    const auto uses = frame_.uses_of(pass);
    return std::any_of(uses.begin(), uses.end(), [&](const Use& use) {
      const dsl::Resource& resource = frame_.resource_of(use.cell);
      return resource.lifetime == dsl::Lifetime::imported && effect_of(resource.after, 0).stages() != 0;
    });
  }
  void keep_at_home(uint32_t node, const std::string& why) {
    problem_.nodes[node].away = UINT32_MAX, problem_.nodes[node].home = 0;
    plan_.decisions.push_back({one_queue_.order[node], false, "stays on the first queue: " + why});
  }
  void order(uint32_t before, uint32_t after) {
    problem_.edges.push_back({before, after});
    plan_.extra.emplace_back(one_queue_.order[before], one_queue_.order[after]);
  }

  // A rendering begins when all its passes can run.
  void keep_renderings_together() {
    std::vector<uint32_t> node_of(frame_.passes.size(), UINT32_MAX);
    for (uint32_t node = 0; node < one_queue_.order.size(); ++node) node_of[one_queue_.order[node]] = node;
    const auto leader = [&](uint32_t node) { return node_of[one_queue_.leader_of[one_queue_.order[node]]]; };
    for (size_t i = 0, count = problem_.edges.size(); i < count; ++i) {
      const QueueProblem::Edge edge = problem_.edges[i];
      if (leader(edge.after) != edge.after && leader(edge.before) != leader(edge.after)) problem_.edges.push_back({edge.before, leader(edge.after)});
    }
  }

  // Movable passes that depend on each other.
  void group_neighbours() {
    std::vector<uint32_t> root(problem_.nodes.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](uint32_t node) {
      while (root[node] != node) node = root[node] = root[root[node]];
      return node;
    };
    for (const auto& edge : problem_.edges)
      if (problem_.nodes[edge.before].away != UINT32_MAX && problem_.nodes[edge.after].away != UINT32_MAX) root[find(edge.after)] = find(edge.before);
    std::map<uint32_t, uint32_t> number;
    for (uint32_t node = 0; node < problem_.nodes.size(); ++node)
      if (problem_.nodes[node].away != UINT32_MAX)
        problem_.nodes[node].group = number.try_emplace(find(node), static_cast<uint32_t>(number.size())).first->second;
    problem_.groups = static_cast<uint32_t>(number.size());
  }

  void explain(const QueueChoice& choice) {
    for (uint32_t node = 0; node < problem_.nodes.size(); ++node) {
      const auto& row = problem_.nodes[node];
      const uint32_t pass = one_queue_.order[node];
      if (row.away == UINT32_MAX && row.home == 0) continue;
      const bool moved = choice.queue_of[node] != 0;
      std::string reason =
          row.away == UINT32_MAX ? fmt::format("on queue {} by `queue`", row.home)
          : moved ? fmt::format("moved to queue {}: without that the frame would take {:.1f} us longer", row.away, choice.worth[node] / 1000)
                  : fmt::format("stays on the first queue: moving it would save {:.1f} us, less than a wait and a tenth of its own time",
                                std::max(0.0, choice.worth[node]) / 1000);
      plan_.decisions.push_back({pass, moved, std::move(reason)});
    }
  }

  const Frame& frame_;
  const Schedule& one_queue_;
  const PlanOptions& options_;
  QueueProblem problem_;
  QueuePlan plan_;
};

}  // namespace

bool runs_at_home(const Frame& frame, uint32_t pass, const PlanOptions& options) {
  const dsl::Pass& row = frame.pass(pass);
  const bool elsewhere = row.queue != dsl::QueueKind::graphics && !row.queue_may && queue_of_kind(options, row.queue) != UINT32_MAX;
  if (elsewhere || options.queues.empty() || options.queues.front() == dsl::QueueKind::graphics) return true;
  const Stages has = stages_of(options.queues.front());
  const auto& uses = frame.uses_of(pass);
  return !clears_depth(frame, row) && std::none_of(uses.begin(), uses.end(), [&](const Use& use) { return (use.effect.stages() & ~has) != 0; });
}

std::string why_not_on_queue(const Frame& frame, uint32_t pass) {
  Schedule all;
  all.order.resize(frame.passes.size());
  std::iota(all.order.begin(), all.order.end(), 0u);
  const PlanOptions options;
  return Eligibility(frame, all, options).why_not(pass);
}

QueuePlan assign_queues(const Frame& frame, const Graph& graph, const Schedule& one_queue, const std::vector<double>& costs,
                        const PlanOptions& options) {
  return Assigner(frame, graph, one_queue, costs, options).run();
}

}  // namespace rg::compiler
