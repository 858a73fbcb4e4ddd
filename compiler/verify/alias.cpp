#include "compiler/verify/alias.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "compiler/verify/boundary.h"

namespace rg::verify {
namespace {

struct Hand {  // of one plan resource
  const Release* release = nullptr;
  std::vector<const Release*> releases;
  const Acquire* acquire = nullptr;
  uint32_t acquire_step = kNone;
  bool gives = false, takes = false;
};

struct Aliases {
  const Model& model;
  const SyncResult& sync;
  Report& report;
  std::vector<Hand> hands;                               // by plan resource
  std::set<std::tuple<uint32_t, uint32_t, bool>> pairs;  // before, after, wraps
  std::vector<uint32_t> step_of_group;                   // by plan group
  std::vector<bool> used;                                // by cell of the model, copy 0
};

const Plan& plan_of(const Aliases& aliases) { return aliases.model.input->plan; }
uint32_t source_of(const Aliases& aliases, uint32_t plan_resource) { return aliases.model.input->program_resource[plan_resource]; }

bool uses_clocks(const Plan& plan) { return !plan.alias_clocks.empty(); }

void report_alias(Aliases& aliases, uint32_t plan_resource, const std::string& text) {
  const std::string name(plan_of(aliases).resources[plan_resource].name);
  aliases.report.add({Hazard::alias_race, name, "", "", "memory of `" + name + "`: " + text});
}

void find_steps(Aliases& aliases) {
  aliases.step_of_group.assign(plan_of(aliases).groups.size(), kNone);
  uint32_t position = 0;
  for (const Batch& batch : plan_of(aliases).batches)
    for (uint32_t s = batch.first_step; s < batch.first_step + batch.step_count; ++s, ++position) {
      const Step& step = plan_of(aliases).steps[s];
      if (step.kind == StepKind::barriers) aliases.step_of_group[step.index] = position;
    }
}

void find_hands(Aliases& aliases) {
  const Plan& plan = plan_of(aliases);
  aliases.hands.resize(plan.resources.size());
  for (const Release& release : plan.releases) {
    aliases.hands[release.resource].release = &release;
    aliases.hands[release.resource].releases.push_back(&release);
  }
  for (const Acquire& acquire : plan.acquires) {
    Hand& hand = aliases.hands[acquire.resource];
    hand.acquire = &acquire;
    hand.acquire_step = acquire.group == kNone ? kNone : aliases.step_of_group[acquire.group];
  }
  if (uses_clocks(plan)) {
    const std::vector<bool> shares = may_share(plan);
    for (uint32_t r = 0; r < aliases.hands.size(); ++r) aliases.hands[r].takes = shares[r];
  }
  for (const AliasPair& pair : plan.alias_pairs) {
    aliases.pairs.emplace(pair.before, pair.after, pair.wraps);
    aliases.hands[pair.before].gives = true;
    aliases.hands[pair.after].takes = true;
  }
}

void find_used(Aliases& aliases) {
  aliases.used.assign(aliases.model.cell_count, false);
  for (const PassNode& node : aliases.model.passes)
    for (const Use& use : node.uses)
      for (const uint32_t cell : use.cells) aliases.used[aliases.model.cell(use.resource, 0, cell)] = true;
}

// ---- releases ---------------------------------------------------------------------------------------------------

PendingOn pending_of_release(const Release& release) {
  PendingOn on;
  on.stages = expand_stages(release.stages);
  const AccessSet accesses = expand_accesses(release.accesses);
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (on.stages & stage_bit(s)) on.accesses[s] = accesses & supported(s);
  return on;
}

void check_release(Aliases& aliases, uint32_t plan_resource) {
  const Release* release = aliases.hands[plan_resource].release;
  if (!release) {
    report_alias(aliases, plan_resource, "it may be given away but has no release");
    return;
  }
  const uint32_t r = source_of(aliases, plan_resource);
  const ResourceNode& node = aliases.model.resources[r];
  const PendingOn on = pending_of_release(*release);
  for (uint32_t c = 0; c < node.partition.cell_count(); ++c) {
    CellState state = aliases.sync.last[aliases.model.cell(r, 0, c)];
    // What comes after waits for the release's stages; writes that are available chain from any of them.
    for (const ReadRecord& read : state.reads)
      if (!((read.reach().stages(read.queue) | stage_bit(read.stage)) & with_earlier(on.stages)))
        report_alias(aliases, plan_resource, "the release does not wait for reads in " + stage_name(read.stage));
    for (const WriteRecord& write : state.writes) {
      const bool named = write.stage < kStageCount && (on.accesses[write.stage] & access_bit(write.access));
      const bool chained = write.available && (write.reach.stages(write.queue) & with_earlier(on.stages));
      if (!named && !chained) report_alias(aliases, plan_resource, "the release does not make a write in " + stage_name(write.stage) + " available");
    }
  }
}

// A release bit that no last use needs makes the next owner wait for nothing.
void check_release_exact(Aliases& aliases, uint32_t plan_resource) {
  const Release* release = aliases.hands[plan_resource].release;
  if (!release) return;
  const uint32_t r = source_of(aliases, plan_resource);
  const ResourceNode& node = aliases.model.resources[r];
  StageSet stages = 0;
  AccessSet accesses = 0;
  for (uint32_t c = 0; c < node.partition.cell_count(); ++c) {
    const CellState& state = aliases.sync.last[aliases.model.cell(r, 0, c)];
    for (const ReadRecord& read : state.reads) stages |= stage_bit(read.stage) | read.reach().stages(read.queue);
    for (const WriteRecord& write : state.writes) {
      if (write.stage < kStageCount) stages |= stage_bit(write.stage), accesses |= access_bit(write.access);
      stages |= write.reach.stages(write.queue);
    }
  }
  const std::string name(plan_of(aliases).resources[plan_resource].name);
  const StageSet more = expand_stages(release->stages) & ~stages;
  if (more)
    aliases.report.add({Hazard::redundant, name, "", "", "the release of `" + name + "` names " + stages_text(more) + ", where nothing uses it"});
  if (expand_accesses(release->accesses) & ~accesses)
    aliases.report.add({Hazard::redundant, name, "", "", "the release of `" + name + "` names accesses that are no writes of its last users"});
}

// ---- acquires ---------------------------------------------------------------------------------------------------

// Every cell of an image leaves `undefined` in the acquire's barriers.
void check_discards(Aliases& aliases, uint32_t plan_resource, const Acquire& acquire) {
  const uint32_t r = source_of(aliases, plan_resource);
  std::vector<bool> covered(aliases.model.resources[r].partition.cell_count());
  for (const Scope& scope : aliases.model.scopes) {
    if (scope.kind != ScopeKind::image || scope.resource != r || scope.group != acquire.group) continue;
    if (scope.index < acquire.image_barrier || scope.index >= acquire.image_barrier + acquire.image_barriers) continue;
    if (scope.old_layout != Layout::undefined) report_alias(aliases, plan_resource, "the acquire's barrier keeps contents that are not there");
    for (const uint32_t cell : scope.cells) covered[cell] = true;
  }
  for (uint32_t c = 0; c < covered.size(); ++c)
    if (!covered[c] && aliases.used[aliases.model.cell(r, 0, c)])
      report_alias(aliases, plan_resource, "the acquire's barriers do not cover " + aliases.model.place(r, c));
}

void check_acquire(Aliases& aliases, uint32_t plan_resource) {
  const Hand& hand = aliases.hands[plan_resource];
  const uint32_t r = source_of(aliases, plan_resource);
  if (!hand.acquire || hand.acquire_step == kNone) {
    report_alias(aliases, plan_resource, "it may be taken over but has no acquire");
    return;
  }
  if (hand.acquire_step > aliases.sync.first_use[r]) report_alias(aliases, plan_resource, "it is used before its acquire");
  // First users of buffers are checked by the replay, which finds the hand-over as a write before them.
  if (aliases.model.resources[r].partition.shape.image) check_discards(aliases, plan_resource, *hand.acquire);
}

// ---- pairs ------------------------------------------------------------------------------------------------------

bool may_share(const dsl::Resource& resource) { return resource.lifetime == dsl::Lifetime::transient && !resource.no_alias; }

void check_pair(Aliases& aliases, const AliasPair& pair) {
  const Hand& after = aliases.hands[pair.after];
  const uint32_t before = source_of(aliases, pair.before);
  for (const uint32_t resource : {pair.before, pair.after})
    if (!may_share(aliases.model.resource(source_of(aliases, resource))))
      report_alias(aliases, resource, "it may not share memory, but a pair names it");
  if (pair.wraps || after.acquire_step == kNone) return;
  if (aliases.sync.last_use[before] != kNone && aliases.sync.last_use[before] > after.acquire_step)
    report_alias(aliases, pair.before, "`" + std::string(plan_of(aliases).resources[pair.after].name) + "` may take it over before its last use");
}

// The last users of `before` are over when `after` is acquired, in the same frame or in the next one.
bool is_over(const Aliases& aliases, uint32_t before, uint32_t after, bool next_frame) {
  const Plan& plan = plan_of(aliases);
  const Hand& taker = aliases.hands[after];
  const size_t clocks = taker.acquire->first_clock + (next_frame ? plan.queues.size() : 0);
  const auto& releases = aliases.hands[before].releases;
  return std::all_of(releases.begin(), releases.end(), [&](const Release* release) {
    const Index clock = plan.alias_clocks[clocks + release->queue];
    return clock != kNone && clock >= release->point;
  });
}

bool pair_allowed(const Aliases& aliases, uint32_t a, uint32_t b) {
  if (uses_clocks(plan_of(aliases)))
    return aliases.hands[a].takes && aliases.hands[b].takes &&
           ((is_over(aliases, a, b, false) && is_over(aliases, b, a, true)) || (is_over(aliases, b, a, false) && is_over(aliases, a, b, true)));
  const auto has = [&](uint32_t before, uint32_t after, bool wraps) { return aliases.pairs.contains({before, after, wraps}); };
  return (has(a, b, false) && has(b, a, true)) || (has(b, a, false) && has(a, b, true));
}

// Estimated places share bytes only where both hand-offs, in the frame and into the next, are allowed.
void check_places(Aliases& aliases) {
  const Plan& plan = plan_of(aliases);
  std::vector<uint32_t> order;
  for (uint32_t r = 0; r < plan.resources.size(); ++r)
    if (plan.resources[r].lifetime == Lifetime::transient && plan.resources[r].estimated_bytes != 0 &&
        aliases.sync.first_use[source_of(aliases, r)] != kNone)
      order.push_back(r);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::tie(plan.resources[a].estimated_offset, a) < std::tie(plan.resources[b].estimated_offset, b);
  });
  for (size_t i = 0; i < order.size(); ++i) {
    const Resource& first = plan.resources[order[i]];
    if (first.estimated_alignment != 0 && first.estimated_offset % first.estimated_alignment != 0)
      report_alias(aliases, order[i], "its estimated offset is not aligned");
    for (size_t j = i + 1; j < order.size() && plan.resources[order[j]].estimated_offset < first.estimated_offset + first.estimated_bytes; ++j)
      if (!pair_allowed(aliases, order[i], order[j]))
        report_alias(aliases, order[i], "it shares bytes with `" + std::string(plan.resources[order[j]].name) + "`, which nothing allows");
  }
}

}  // namespace

namespace {

Aliases make_aliases(const Model& model, const SyncResult& sync, Report& report) {
  Aliases aliases{model, sync, report, {}, {}, {}, {}};
  find_steps(aliases);
  find_hands(aliases);
  find_used(aliases);
  return aliases;
}

}  // namespace

std::vector<bool> may_share(const Plan& plan) {
  std::vector<bool> released(plan.resources.size()), shares(plan.resources.size());
  for (const Release& release : plan.releases) released[release.resource] = true;
  for (const Acquire& acquire : plan.acquires)
    shares[acquire.resource] = acquire.first_clock != kNone && released[acquire.resource] && !plan.resources[acquire.resource].no_alias;
  return shares;
}

void check_release_redundancy(const Model& model, const SyncResult& sync, Report& report) {
  Aliases aliases = make_aliases(model, sync, report);
  for (uint32_t r = 0; r < aliases.hands.size() && !report.full(); ++r)
    if (aliases.hands[r].gives) check_release_exact(aliases, r);
}

void check_aliases(const Model& model, const SyncResult& sync, Report& report) {
  Aliases aliases = make_aliases(model, sync, report);
  for (uint32_t r = 0; r < aliases.hands.size() && !report.full(); ++r) {
    if (aliases.hands[r].gives) check_release(aliases, r);
    if (aliases.hands[r].takes) check_acquire(aliases, r);
  }
  for (const AliasPair& pair : plan_of(aliases).alias_pairs) check_pair(aliases, pair);
  check_places(aliases);
}

}  // namespace rg::verify
