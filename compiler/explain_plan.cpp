#include "compiler/explain_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "dsl/print.h"
#include "runtime/alias.h"

namespace rg::compiler {
namespace {

// How far a pass could move: groups between which its dependencies leave it free, and what binds it at either end.
struct Slack {
  uint32_t first = 0, last = UINT32_MAX;
  const Dependency *before = nullptr, *after = nullptr;
};

std::vector<Slack> find_slack(const Graph& graph, const Schedule& schedule) {
  std::vector<Slack> all(schedule.segment_of.size());
  for (const Dependency& d : graph.dependencies) {
    if (schedule.one_rendering(d.before, d.after)) continue;
    const uint32_t gap = d.kind != DependencyKind::order, earlier = schedule.segment_of[d.before], later = schedule.segment_of[d.after];
    Slack &to = all[d.after], &from = all[d.before];
    if (!to.before || earlier + gap > to.first) to.first = earlier + gap, to.before = &d;
    if (!from.after || later - gap < from.last) from.last = later - gap, from.after = &d;
  }
  return all;
}

std::string cell_name(const Frame& frame, const Dependency& d) {
  return d.cell == UINT32_MAX ? "`after`" : "`" + frame.resource_of(d.cell).name + "`";
}

std::string bound_text(const Frame& frame, const Dependency& d, uint32_t other) {
  return fmt::format("{} on {} with `{}`", name(d.kind), cell_name(frame, d), frame.pass(other).name);
}

// Where it stands, why not elsewhere, what would let it move.
std::string place_text(const PlanParts& parts, uint32_t pass, const Slack& slack) {
  const Schedule& schedule = parts.schedule;
  const uint32_t here = schedule.segment_of[pass], last = std::min(slack.last, schedule.segments - 1);
  std::string text = fmt::format("after group {}", here);
  if (slack.before && slack.first == here)
    text += fmt::format(", as early as it can: {} just before; without that access it could run earlier",
                        bound_text(parts.frame, *slack.before, slack.before->before));
  else if (slack.first < here)
    text += fmt::format(", though group {} would do; here memory peaks lower or fewer groups are needed", slack.first);
  if (slack.after && last == here)
    text += fmt::format("; not later: {}", bound_text(parts.frame, *slack.after, slack.after->after));
  else if (last > here)
    text += fmt::format("; group {} would do as well", last);
  return text;
}

void explain_passes(const PlanParts& parts, const Graph& graph, Decisions& out) {
  const Frame& frame = parts.frame;
  const std::vector<Slack> slack = find_slack(graph, parts.schedule);
  out.push_back({"schedule", "chosen", parts.schedule.chosen_because});
  for (uint32_t pass = 0; pass < frame.passes.size(); ++pass) {
    const std::string& name = frame.pass(pass).name;
    const bool live = parts.liveness.live[pass];
    out.push_back({name, live ? "kept" : "culled", parts.liveness.reasons[pass] + (live ? "" : "; `keep` would make it run")});
    if (live) out.push_back({name, "scheduled", place_text(parts, pass, slack[pass])});
  }
}

// Who had which bytes last, while transients come in the order they are acquired.
class Owners {
 public:
  // The owner that was last, of those whose bytes these are; they are the newcomer's from now on.
  Index take(Index owner, uint64_t begin, uint64_t end, const std::vector<alias::GroupInterval>& intervals, bool forward) {
    split(begin), split(end);
    Index last = kNone;
    for (auto at = parts_.lower_bound(begin); at != parts_.end() && at->first < end; at = parts_.erase(at)) {
      const Index other = at->second.owner;
      const auto later = [&] { return forward ? intervals[other].end > intervals[last].end : intervals[other].begin < intervals[last].begin; };
      if (last == kNone || later()) last = other;
    }
    parts_[begin] = {end, owner};
    return last;
  }

 private:
  struct Part {
    uint64_t end = 0;
    Index owner = kNone;
  };
  void split(uint64_t at) {
    auto part = parts_.upper_bound(at);
    if (part == parts_.begin() || (--part)->first == at || part->second.end <= at) return;
    parts_[at] = part->second;
    part->second.end = at;
  }
  std::map<uint64_t, Part> parts_;  // by first byte
};

struct Neighbours {
  std::vector<Index> before, after;  // by plan resource: who had the bytes of a transient before it, and who gets them
};
// O(transients log).
Neighbours find_neighbours(const PlanData& plan, const std::vector<alias::GroupInterval>& intervals) {
  std::vector<Index> order;
  for (Index r = 0; r < plan.resources.size(); ++r)
    if (plan.resources[r].lifetime == Lifetime::transient && intervals[r].used()) order.push_back(r);
  Neighbours result{std::vector<Index>(plan.resources.size(), kNone), std::vector<Index>(plan.resources.size(), kNone)};
  const auto pass = [&](std::vector<Index>& found, bool forward) {
    Owners owners;
    for (const Index r : order)
      found[r] = owners.take(r, plan.resources[r].estimated_offset, plan.resources[r].estimated_offset + plan.resources[r].estimated_bytes, intervals,
                             forward);
  };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return intervals[a].begin < intervals[b].begin; });
  pass(result.before, true);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return intervals[a].end > intervals[b].end; });
  pass(result.after, false);
  return result;
}

std::string neighbours_text(const PlanData& plan, Index before, Index after, Index r) {
  if (before == kNone && after == kNone) return "; nobody else uses these bytes";
  std::string text;
  if (before != kNone) text += fmt::format("; takes bytes over from `{}`", plan.resources[before].name);
  if (after != kNone) text += fmt::format("; hands bytes on to `{}`", plan.resources[after].name);
  return text + fmt::format("; with `no alias` it would keep its {} bytes to itself", plan.resources[r].estimated_bytes);
}

void explain_memory(const PlanData& plan, Decisions& out) {
  const std::vector<alias::GroupInterval> intervals = alias::group_intervals(plan.view());
  const Neighbours neighbours = find_neighbours(plan, intervals);
  for (Index r = 0; r < plan.resources.size(); ++r) {
    const Resource& resource = plan.resources[r];
    if (resource.concurrent)
      out.push_back({std::string(resource.name), "shared", "several queues use it at a time, or keep it over frames; so it has no owner"});
    if (resource.lifetime != Lifetime::transient || !intervals[r].used()) continue;
    std::string text = fmt::format("at {} with {} bytes, live between groups {} and {}", resource.estimated_offset, resource.estimated_bytes,
                                   intervals[r].begin, intervals[r].end + 1);
    if (resource.no_alias)
      text += "; its bytes are its own, because it says `no alias`, aliasing is off, or several queues use it first";
    else
      text += neighbours_text(plan, neighbours.before[r], neighbours.after[r], r);
    out.push_back({std::string(resource.name), "placed", std::move(text)});
    if (resource.lazy)
      out.push_back(
          {std::string(resource.name), "lazy",
           "no rendering loads or stores it and nothing else sees it: where a device has lazily allocated memory it takes none of the heap"});
  }
}

// What would make a barrier unnecessary.
std::string remedy(const CellBarrier& b, bool image) {
  if (b.src_queue != b.dst_queue) return "; on one queue it would not change hands";
  if (b.is_acquire && !image) return "; its bytes were in use before, by another resource or in the frame before";
  if (b.is_acquire) return "; a transition every frame: only a `persistent` or `history` image keeps its layout";
  if (b.reason == "layout") return "; `layout general` on the resource would spare it, at the price of slower reads";
  if (b.reason == kStateAfter) return "; who comes after the frame finds it in that state";
  if (b.reason.starts_with("read after write")) return "; gone if the reader did without, or read in the pass that writes";
  if (b.reason.starts_with("write after read")) return "; gone if the writer used a resource of its own";
  return "";
}

std::string barrier_reason(const CellBarrier& b, const dsl::Resource& resource) {
  const std::string reason = b.reason == kStateAfter ? fmt::format("for `after {}`", dsl::print_role(resource.after.role)) : std::string(b.reason);
  return fmt::format("{}{}{}", b.changes_queue ? "change of queue, " : "", reason, b.wraps ? ", against the frame before" : "");
}

void explain_barriers(const PlanParts& parts, Decisions& out) {
  const std::vector<Index> groups = groups_of_slots(parts);
  const auto add = [&](const CellBarrier& b, Index group, const std::string& halves) {
    const dsl::Resource& row = parts.frame.resource_of(b.cell);
    const std::string reason = barrier_reason(b, row), change = remedy(b, row.kind == dsl::ResourceKind::image) + halves;
    out.push_back({fmt::format("group {}", group), "barrier", fmt::format("`{}`: {}{}", row.name, reason, change)});
    out.push_back({row.name, "barrier", fmt::format("in group {}: {}{}", group, reason, change)});
  };
  for (size_t slot = 0; slot < parts.sync.groups.size(); ++slot)
    for (const CellBarrier& b : parts.sync.groups[slot]) add(b, groups[slot], b.whole.empty() ? "" : fmt::format("; not split, because {}", b.whole));
  const auto name = [&](uint32_t slot) { return groups[slot] == kNone ? "the end of its batch" : fmt::format("group {}", groups[slot]); };
  Index group = first_split_group(groups);
  for (const SplitGroup& split : parts.sync.splits) {
    for (const CellBarrier& b : split.barriers)
      add(b, group,
          fmt::format("; split, set {} {} and awaited at {}: what stands between is not waited for; `--no-split={}` would make it whole",
                      split.set.behind ? "behind" : "in front of", name(split.set.slot), name(split.wait_slot),
                      parts.frame.resource_of(b.cell).name));
    ++group;
  }
}

// Subjects "wait 0", "wait 1", ... as in the plan's table of waits.
void explain_waits(const PlanParts& parts, const PlanData& plan, Decisions& out) {
  for (const Batch& batch : plan.batches)
    for (Index w = batch.first_wait; w < batch.first_wait + batch.wait_count; ++w) {
      const BatchWait& wait = parts.sync.batches[static_cast<size_t>(&batch - plan.batches.data())].waits[w - batch.first_wait];
      const char* from = wait.batch == kNone ? "what it did in the frame before" : "a batch of this frame";
      out.push_back({fmt::format("wait {}", w), "wait",
                     fmt::format("queue {} waits for queue {}, {}: `{}` is used on both; gone if its users ran on one queue (`--no-async=PASS`)",
                                 batch.queue, wait.queue, from, parts.frame.resource_of(wait.cell).name)});
    }
}

}  // namespace

Decisions explain_plan(const PlanParts& parts, const Graph& graph, const PlanData& plan) {
  Decisions decisions;
  explain_passes(parts, graph, decisions);
  explain_memory(plan, decisions);
  explain_barriers(parts, decisions);
  explain_waits(parts, plan, decisions);
  return decisions;
}

}  // namespace rg::compiler
