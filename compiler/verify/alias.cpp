#include "compiler/verify/alias.h"

#include <algorithm>
#include <tuple>

namespace rg::verify {
namespace {

struct Hand {  // of one plan resource
  std::vector<const Release*> releases;
  const Acquire* acquire = nullptr;
  uint32_t acquire_step = kNone;
  bool shares = false;
};

struct Aliases {
  const Model& model;
  const SyncResult& sync;
  Report& report;
  std::vector<Hand> hands;              // by plan resource
  std::vector<uint32_t> step_of_group;  // by plan group: in Model::steps
  std::vector<bool> used;               // by cell of the model, copy 0
};

const Plan& plan_of(const Aliases& aliases) { return aliases.model.input->plan; }
uint32_t source_of(const Aliases& aliases, uint32_t plan_resource) { return aliases.model.input->program_resource[plan_resource]; }

void report_alias(Aliases& aliases, uint32_t plan_resource, const std::string& text) {
  const std::string name(plan_of(aliases).resources[plan_resource].name);
  aliases.report.add({Hazard::alias_race, name, "", "", "memory of `" + name + "`: " + text});
}

void find_steps(Aliases& aliases) {
  aliases.step_of_group.assign(plan_of(aliases).groups.size(), kNone);
  const auto& steps = aliases.model.steps;
  for (uint32_t s = 0; s < steps.size(); ++s)
    if (!steps[s].is_pass && aliases.model.groups[steps[s].index].plan_group != kNone)
      aliases.step_of_group[aliases.model.groups[steps[s].index].plan_group] = s;
}

void find_hands(Aliases& aliases) {
  const Plan& plan = plan_of(aliases);
  aliases.hands.resize(plan.resources.size());
  for (const Release& release : plan.releases) aliases.hands[release.resource].releases.push_back(&release);
  for (const Acquire& acquire : plan.acquires) {
    Hand& hand = aliases.hands[acquire.resource];
    hand.acquire = &acquire;
    hand.acquire_step = acquire.group == kNone ? kNone : aliases.step_of_group[acquire.group];
  }
  const std::vector<bool> shares = may_share(plan);
  for (uint32_t r = 0; r < aliases.hands.size(); ++r) aliases.hands[r].shares = shares[r];
}

void find_used(Aliases& aliases) {
  aliases.used.assign(aliases.model.cell_count, false);
  for (const PassNode& node : aliases.model.passes)
    for (const Use& use : node.uses)
      for (const uint32_t cell : use.cells) aliases.used[aliases.model.cell(use.resource, 0, cell)] = true;
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

// ---- places -----------------------------------------------------------------------------------------------------

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

bool may_meet(const Aliases& aliases, uint32_t a, uint32_t b) {
  if (!aliases.hands[a].shares || !aliases.hands[b].shares) return false;
  return (is_over(aliases, a, b, false) && is_over(aliases, b, a, true)) || (is_over(aliases, b, a, false) && is_over(aliases, a, b, true));
}

// Estimated places share bytes only where both hand-offs are in order, in the frame and into the next.
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
      if (!may_meet(aliases, order[i], order[j]))
        report_alias(aliases, order[i], "it shares bytes with `" + std::string(plan.resources[order[j]].name) + "`, which nothing allows");
  }
}

Aliases make_aliases(const Model& model, const SyncResult& sync, Report& report) {
  Aliases aliases{model, sync, report, {}, {}, {}};
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

void check_aliases(const Model& model, const SyncResult& sync, Report& report) {
  Aliases aliases = make_aliases(model, sync, report);
  for (uint32_t r = 0; r < aliases.hands.size() && !report.full(); ++r) {
    const dsl::Resource& resource = model.resource(source_of(aliases, r));
    if (aliases.hands[r].shares && (resource.lifetime != dsl::Lifetime::transient || resource.no_alias))
      report_alias(aliases, r, "it may not share memory, but its acquire has a clock");
    if (aliases.hands[r].shares && resource.is_output)
      report_alias(aliases, r, "its contents are observable at the end of the frame, but its acquire has a clock");
    if (aliases.hands[r].shares) check_acquire(aliases, r);
  }
  check_places(aliases);
}

}  // namespace rg::verify
