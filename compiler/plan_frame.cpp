#include "compiler/plan_frame.h"

#include <algorithm>
#include <bit>
#include <ctime>

#include "compiler/alias_clocks.h"
#include "compiler/assign_queues.h"
#include "compiler/build_graph.h"
#include "compiler/contents.h"
#include "compiler/cull.h"
#include "compiler/emit_plan.h"
#include "compiler/epochs.h"
#include "compiler/explain_plan.h"
#include "compiler/make_schedule.h"
#include "compiler/pass_cost.h"
#include "compiler/plan_memory.h"
#include "compiler/renderings.h"
#include "compiler/synchronise.h"

namespace rg::compiler {
namespace {

class Stopwatch {
 public:
  // Runs `phase` and notes how much processor time it took, which others on the machine do not change.
  template <class Phase>
  auto time(const char* name, Phase phase) {
    const std::clock_t start = std::clock();
    auto result = phase();
    phases.emplace_back(name, 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    return result;
  }
  std::vector<std::pair<std::string, double>> phases;
};

struct Queues {
  Schedule schedule;
  Overlap overlap;
  Decisions decisions;
  std::vector<uint32_t> contested;
};

// One layout for all uses of the images, so that it never has to change between queues.
void use_general_layout(Frame& frame, const std::vector<uint32_t>& resources) {
  for (Use& use : frame.uses)
    if (std::find(resources.begin(), resources.end(), frame.cells[use.cell].resource) != resources.end()) use.effect.layout = Layout::general;
}

// Passes with their renderings, in the order for one queue.
struct Arrangement {
  Frame frame;
  Graph graph;
  Renderings renderings;
  Schedule one_queue;
  std::vector<uint32_t> apart;  // passes that continue no rendering, though they could
};

// Passes that read depth use it in the layout of those of their rendering that write it.
void merge_passes(Arrangement& of, const std::vector<bool>& live, const PlanOptions& options) {
  of.renderings = find_renderings(of.frame, of.graph, live, options, of.apart);
  if (of.renderings.layouts.empty()) return;
  for (const auto& [use, layout] : of.renderings.layouts) of.frame.uses[use].effect.layout = layout;
  of.graph = build_graph(of.frame, live);
  of.renderings = find_renderings(of.frame, of.graph, live, options, of.apart);
}

Arrangement arrange(Frame frame, const std::vector<bool>& live, const PlanOptions& options, std::vector<uint32_t> apart, Stopwatch& watch) {
  Arrangement of{std::move(frame), {}, {}, {}, std::move(apart)};
  of.graph = watch.time("build_graph", [&] { return build_graph(of.frame, live); });
  watch.time("find_renderings", [&] { return merge_passes(of, live, options), 0; });
  of.one_queue = watch.time("make_schedule", [&] { return make_schedule(of.frame, of.graph, live, of.renderings, options); });
  return of;
}

// Orders that neither has an equal of in both costs.
std::vector<SegmentCost> join_frontiers(std::vector<SegmentCost> all, const std::vector<SegmentCost>& more) {
  all.insert(all.end(), more.begin(), more.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const SegmentCost& a, const SegmentCost& b) { return std::pair(a.segments, a.peak) < std::pair(b.segments, b.peak); });
  std::vector<SegmentCost> kept;
  for (const SegmentCost& cost : all)
    if (kept.empty() || cost.peak < kept.back().peak) kept.push_back(cost);
  return kept;
}

Arrangement better_of(Arrangement a, Arrangement b) {
  const bool takes_b = b.one_queue.score < a.one_queue.score;
  Schedule &taken = takes_b ? b.one_queue : a.one_queue, &other = takes_b ? a.one_queue : b.one_queue;
  taken.evaluations += other.evaluations;
  taken.frontier = join_frontiers(std::move(taken.frontier), other.frontier);
  return takes_b ? std::move(b) : std::move(a);
}

// A rendering of several passes saves barriers and holds at once whatever they use. So where one stands in the fullest place of the order, another
// order is looked for with its passes apart, and the better of the two by score is taken.
Arrangement arrange_freely(Frame frame, const std::vector<bool>& live, const PlanOptions& options, Stopwatch& watch) {
  const bool weighs_memory = options.effort != Effort::fast && (options.prefer == Prefer::balance || options.prefer == Prefer::memory);
  if (!weighs_memory || !options.merge || !options.reorder) return arrange(std::move(frame), live, options, {}, watch);
  Arrangement merged = arrange(frame, live, options, {}, watch);
  if (merged.one_queue.crowded.empty()) return merged;
  return watch.time("part_renderings", [&] {
    Stopwatch within;
    std::vector<uint32_t> apart = merged.one_queue.crowded;
    return better_of(std::move(merged), arrange(std::move(frame), live, options, std::move(apart), within));
  });
}

Arrangement arrange_best(Frame frame, const std::vector<bool>& live, const PlanOptions& options, Stopwatch& watch) {
  if (options.effort != Effort::max) return arrange_freely(std::move(frame), live, options, watch);
  // The long search goes other ways than the short one, and is not to end up behind it.
  PlanOptions short_options = options;
  short_options.effort = Effort::normal;
  Stopwatch within;
  Arrangement found = watch.time("short_search", [&] { return arrange_freely(frame, live, short_options, within); });
  return better_of(std::move(found), arrange_freely(std::move(frame), live, options, watch));
}

Overlap overlap_of(const QueuePlan& plan, const Schedule& one_queue, const std::vector<double>& costs, size_t queues) {
  Overlap overlap{
      plan.gain.serial, plan.gain.critical_path, plan.gain.bound, plan.gain.end, plan.simulations, plan.complete, 0, plan.decisions.size(), {}};
  overlap.work.assign(queues, 0);
  for (size_t node = 0; node < plan.queue_of.size(); ++node) overlap.work[plan.queue_of[node]] += costs[one_queue.order[node]];
  for (const uint32_t queue : plan.queue_of) overlap.moved += queue != 0;
  return overlap;
}

// Pairs of which one comes before the other over `edges`, which are sorted by their later node; a node stands for `size` of them, none given: one.
// O(edges * nodes / 64).
uint64_t weigh_pairs(size_t nodes, const std::vector<std::pair<uint32_t, uint32_t>>& edges, const std::vector<uint64_t>& size) {
  const size_t words = (nodes + 63) / 64;
  std::vector<uint64_t> before(nodes * words);
  for (const auto& [from, to] : edges) {
    for (size_t w = 0; w < words; ++w) before[to * words + w] |= before[from * words + w];
    before[to * words + from / 64] |= uint64_t{1} << (from % 64);
  }
  uint64_t pairs = 0;
  for (size_t node = 0; node < nodes; ++node)
    for (size_t w = 0; w < words && size.empty(); ++w) pairs += static_cast<uint64_t>(std::popcount(before[node * words + w]));
  for (size_t node = 0; node < nodes && !size.empty(); ++node)
    for (size_t w = 0; w < words; ++w)
      for (uint64_t word = before[node * words + w]; word; word &= word - 1)
        pairs += size[node] * size[w * 64 + static_cast<size_t>(std::countr_zero(word))];
  return pairs;
}

OrderFacts order_facts(const Schedule& one_queue) {
  OrderFacts facts{one_queue.method, one_queue.evaluations, {}, 0, 0};
  for (const SegmentCost& cost : one_queue.frontier) facts.frontier.push_back({cost.segments, cost.peak});
  return facts;
}

// Pairs of passes. O(dependencies * passes / 64).
void count_pairs(const Frame& frame, const Graph& graph, const Schedule& schedule, const SyncPlan& sync, OrderFacts& facts) {
  const size_t nodes = schedule.order.size();
  std::vector<uint32_t> node_of(frame.passes.size());
  for (uint32_t node = 0; node < nodes; ++node) node_of[schedule.order[node]] = node;
  std::vector<std::pair<uint32_t, uint32_t>> needed;
  for (const Dependency& d : graph.dependencies)
    if (d.kind != DependencyKind::order && !schedule.one_rendering(d.before, d.after)) needed.emplace_back(node_of[d.before], node_of[d.after]);
  std::sort(needed.begin(), needed.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  facts.needed_pairs = weigh_pairs(nodes, needed, {});
  std::vector<uint64_t> size(schedule.segments);
  for (const uint32_t pass : schedule.order) ++size[schedule.segment_of[pass]];
  if (schedule.batches == 1) {  // all but those of one segment
    facts.ordered_pairs = nodes * (nodes - 1) / 2;
    for (const uint64_t passes : size) facts.ordered_pairs -= passes * (passes - 1) / 2;
    return;
  }
  // On the GPU: segments of a queue one after the other, batches after those they wait for.
  std::vector<std::pair<uint32_t, uint32_t>> steps;
  for (uint32_t s = 0; s < schedule.segments; ++s) {
    for (uint32_t t = s; t-- > 0;)
      if (schedule.queue_of[t] == schedule.queue_of[s]) {
        steps.emplace_back(t, s);
        break;
      }
    if (s > 0 && schedule.batch_of[s - 1] == schedule.batch_of[s]) continue;
    for (const BatchWait& wait : sync.batches[schedule.batch_of[s]].waits)
      if (wait.batch != kNone) steps.emplace_back(schedule.closing_slot(wait.batch) - wait.batch - 1, s);
  }
  facts.ordered_pairs = weigh_pairs(schedule.segments, steps, size);
}

// Without queues that nothing runs on; the first stays.
void drop_idle(QueuePlan& plan, PlanOptions& options) {
  std::vector<bool> busy(options.queues.size());
  busy[0] = true;
  for (const uint32_t queue : plan.queue_of) busy[queue] = true;
  std::vector<uint32_t> renamed(options.queues.size());
  std::vector<dsl::QueueKind> kept;
  for (uint32_t queue = 0; queue < options.queues.size(); ++queue) {
    renamed[queue] = static_cast<uint32_t>(kept.size());
    if (busy[queue]) kept.push_back(options.queues[queue]);
  }
  for (uint32_t& queue : plan.queue_of) queue = renamed[queue];
  options.queues = std::move(kept);
}

// The plan for one queue, unless several are there and worth it.
Queues use_queues(const Frame& frame, const Graph& graph, const Schedule& one_queue, const PlanOptions& options) {
  const std::vector<double> costs = pass_costs(frame, options.measured_us);
  PlanOptions used = options;
  if (!used.async) used.queues.resize(1);
  QueuePlan plan = assign_queues(frame, graph, one_queue, costs, used);
  drop_idle(plan, used);
  Queues queues{one_queue, overlap_of(plan, one_queue, costs, used.queues.size()), {}, plan.contested};
  for (const QueueDecision& decision : plan.decisions) queues.decisions.push_back({frame.pass(decision.pass).name, "queue", decision.reason});
  if (queues.overlap.moved > 0 && plan.contested.empty()) queues.schedule = make_batches(frame, graph, one_queue, plan, costs, used);
  return queues;
}

// What the plan is, and where its memory lies.
struct Placed {
  PlanData plan;
  MemoryPlan memory;
};
Placed emit_and_place(const PlanParts& parts, Stopwatch& watch) {
  Placed placed{watch.time("emit_plan", [&] { return emit_plan(parts); }), {}};
  placed.memory = watch.time("plan_memory", [&] {
    find_alias_clocks(placed.plan, parts.sync.over_at);
    return place_transients(placed.plan, parts.options.effort, parts.options.reasons);
  });
  return placed;
}

// On several queues: signals that name more stages, where memory can change hands for it and takes less.
void signal_for_memory(const std::vector<Line>& lines, const PlanParts& parts, SyncPlan& sync, Placed& placed) {
  constexpr double kWorthwhile = 0.99;
  if (placed.plan.queues.size() == 1 || !parts.options.aliasing) return;
  const std::vector<MemorySignal> signals = memory_signals(placed.plan);
  if (signals.empty()) return;
  SyncPlan other_sync = synchronise(parts.frame, parts.schedule, lines, parts.options, signals);
  Stopwatch within;
  Placed other = emit_and_place({parts.frame, parts.liveness, parts.schedule, parts.contents, other_sync, parts.options}, within);
  if (static_cast<double>(other.memory.heap_bytes) > kWorthwhile * static_cast<double>(placed.memory.heap_bytes)) return;
  sync = std::move(other_sync), placed = std::move(other);
}

}  // namespace

PlanOptions options_for(const PlanOptions& options, const std::string& graph) {
  PlanOptions result = options;
  result.aliasing = result.aliasing && !options.no_aliasing.contains(graph);
  result.async = result.async && !options.no_async.contains(graph);
  result.reorder = result.reorder && !options.no_reorder.contains(graph);
  result.merge = result.merge && !options.no_merge.contains(graph);
  result.discard = result.discard && !options.no_discard.contains(graph);
  result.fold = result.fold && !options.no_fold.contains(graph);
  result.split = result.split && !options.no_split.contains(graph);
  return result;
}

// The planner, top to bottom. Each line consumes only what is above it.
FramePlan plan_frame(const dsl::Program& program, dsl::GraphId graph_id, const Configuration& configuration, const PlanOptions& all_options) {
  const PlanOptions options = options_for(all_options, program.graphs[graph_id].name);
  Stopwatch watch;

  // What this configuration is made of, down to the subresource.
  Frame frame = watch.time("expand", [&] { return expand(program, graph_id, configuration, options); });

  // What nobody needs goes, and with it its hazards.
  const std::vector<bool> all(frame.passes.size(), true);
  const Liveness liveness = watch.time("cull", [&] { return cull(frame, build_graph(frame, all)); });
  keep_contents(frame, options);

  // Passes that are one rendering from here on move as one. Order, and where barriers stand: beyond this point both are fixed.
  Arrangement arranged = arrange_best(std::move(frame), liveness.live, options, watch);
  Queues queues = watch.time("assign_queues", [&] { return use_queues(arranged.frame, arranged.graph, arranged.one_queue, options); });
  if (!queues.contested.empty()) {
    use_general_layout(arranged.frame, queues.contested);
    arranged.graph = build_graph(arranged.frame, liveness.live);
    arranged.renderings = find_renderings(arranged.frame, arranged.graph, liveness.live, options, arranged.apart);
    arranged.one_queue = make_schedule(arranged.frame, arranged.graph, liveness.live, arranged.renderings, options);
    queues = use_queues(arranged.frame, arranged.graph, arranged.one_queue, options);
  }
  const Schedule& schedule = queues.schedule;
  const std::vector<Line> lines = watch.time("find_epochs", [&] { return find_epochs(arranged.frame, schedule); });

  // Barriers do not depend on the placement: what it adds is patched in by runtime/alias.h.
  SyncPlan sync = watch.time("synchronise", [&] { return synchronise(arranged.frame, schedule, lines, options); });

  FramePlan result;
  result.configuration = configuration;
  const ContentsOfUses contents = find_contents(arranged.frame, lines);
  const PlanParts parts{arranged.frame, liveness, schedule, contents, sync, options};

  // Memory, estimated; the runtime places again with real sizes, within what the clocks allow.
  Placed placed = emit_and_place(parts, watch);
  watch.time("signal_for_memory", [&] { return signal_for_memory(lines, parts, sync, placed), 0; });
  result.plan = std::move(placed.plan);
  const MemoryPlan memory = placed.memory;

  result.decisions = watch.time("explain", [&] { return options.reasons ? explain_plan(parts, arranged.graph, result.plan) : Decisions(); });
  result.overlap = queues.overlap, result.unproved = sync.unproved;
  result.order = order_facts(arranged.one_queue);
  if (options.reasons) count_pairs(arranged.frame, arranged.graph, schedule, sync, result.order);
  result.decisions.insert(result.decisions.end(), arranged.renderings.decisions.begin(), arranged.renderings.decisions.end());
  result.decisions.insert(result.decisions.end(), queues.decisions.begin(), queues.decisions.end());
  result.heap_bytes = memory.heap_bytes, result.unaliased_bytes = memory.unaliased_bytes, result.lower_bound_bytes = memory.lower_bound_bytes;
  result.lazy_bytes = memory.lazy_bytes, result.heap_beside_lazy_bytes = memory.heap_beside_lazy_bytes;
  result.phase_ms = std::move(watch.phases);
  return result;
}

}  // namespace rg::compiler
