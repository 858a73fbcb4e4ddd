#include <algorithm>
#include <bit>

#include "compiler/synchronise.h"

namespace rg::compiler {
namespace {

struct Scopes {  // of one barrier, completed: the first with logically earlier stages, the second with later ones
  Stages first = 0, second = 0;
  friend bool operator==(const Scopes&, const Scopes&) = default;
};
Scopes scopes_of(const CellBarrier& b) { return {with_earlier(b.src_stages), with_later(b.dst_stages)}; }

// How execution scopes chain over the groups of one queue: a stage is reached where its later commands come after the event. What happened in the frame
// before counts from the start of this one: the boundary state promises no more.
class Chains {
 public:
  explicit Chains(const std::vector<std::vector<CellBarrier>*>& groups) : groups_(groups), distinct_(groups.size()) {
    for (uint32_t g = 0; g < groups.size(); ++g) refresh(g);
  }

  // After barriers of the group were dropped or narrowed.
  void refresh(uint32_t group) {
    distinct_[group].clear();
    for (const CellBarrier& b : *groups_[group]) {
      const Scopes scopes = scopes_of(b);
      if (std::find(distinct_[group].begin(), distinct_[group].end(), scopes) == distinct_[group].end()) distinct_[group].push_back(scopes);
    }
  }

  // True if, once the groups [first, end) have been recorded, all of `wanted` come after `stage` of an earlier command.
  bool reaches(Stages stage, uint32_t first, uint32_t end, Stages wanted) const {
    Stages reach = 0;
    for (uint32_t g = first; g < end && (reach & wanted) != wanted; ++g) {
      const Stages before = stage | reach;  // barriers of one group do not chain
      for (const Scopes& scopes : distinct_[g])
        if (scopes.first & before) reach |= scopes.second;
    }
    return (reach & wanted) == wanted;
  }

 private:
  const std::vector<std::vector<CellBarrier>*>& groups_;
  std::vector<std::vector<Scopes>> distinct_;  // by group
};

// An order that no barrier of its own realises any more, so that others must keep doing it.
struct Claim {
  Stages stage = 0;             // of a command before group `first`
  uint32_t first = 0, end = 0;  // groups that may order it
  Stages wanted = 0;
  bool all = true;  // all of `wanted` must come after it; or any
};

bool holds(const Chains& chains, const Claim& claim) {
  if (claim.all) return chains.reaches(claim.stage, claim.first, claim.end, claim.wanted);
  if (claim.stage & claim.wanted) return true;
  for (Stages rest = claim.wanted; rest; rest &= rest - 1)
    if (chains.reaches(claim.stage, claim.first, claim.end, rest & ~(rest - 1))) return true;
  return false;
}

bool execution_only(const CellBarrier& b) { return !b.foreign && b.src_accesses == 0 && b.dst_accesses == 0 && b.old_layout == b.new_layout; }

// Works on one queue: barriers of others order nothing here, and those that go on after a wait stay as they are.
class Dropper {
 public:
  Dropper(std::vector<std::vector<CellBarrier>*> groups, const std::vector<uint32_t>& group_of_slot, const Schedule& schedule)
      : groups_(std::move(groups)), group_of_slot_(group_of_slot), schedule_(schedule), chains_(groups_) {}

  void run() {
    for (uint32_t g = 0; g < groups_.size(); ++g) {
      for (CellBarrier& b : *groups_[g])
        if (execution_only(b) && !b.sources.empty()) narrow(b, g, 0);
      std::erase_if(*groups_[g], [](const CellBarrier& b) { return execution_only(b) && b.src_stages == 0; });
      for (CellBarrier& b : *groups_[g])
        for (Stages bits = b.src_stages; bits; bits &= bits - 1)
          if (!b.foreign && b.src_accesses == 0 && !b.sources.empty() && std::popcount(b.src_stages) > 1)
            narrow(b, g, b.src_stages & ~(bits & ~(bits - 1)));
    }
  }

 private:
  // Claims are checked again at each later change, which is what bounds their number.
  static constexpr size_t kMostClaims = 2000;

  // What must hold for the barrier's sources, if the barrier is gone (`src` 0) or waits for `src` only. Barriers of its own group help where execution
  // alone counts; a transition needs its sources within its own first scope, which only earlier groups lead to.
  std::vector<Claim> claims_without(const CellBarrier& b, uint32_t group, Stages src) const {
    std::vector<Claim> claims;
    const bool transition = b.old_layout != b.new_layout;
    for (const Event& event : b.sources) {
      const uint32_t first = event.earlier_frame ? 0 : group_of_slot_[schedule_.slot_before(event.segment)] + 1;
      for (Stages rest = event.stages; rest; rest &= rest - 1) {
        const Stages stage = rest & ~(rest - 1);
        if (transition)
          claims.push_back({stage, first, group, with_earlier(src), false});
        else
          claims.push_back({stage, first, group_of_slot_[b.first_use] + 1, b.dst_stages, true});
      }
    }
    return claims;
  }

  void narrow(CellBarrier& b, uint32_t group, Stages src) {
    if (claims_.size() > kMostClaims) return;
    const Stages before = b.src_stages;
    const std::vector<Claim> claims = claims_without(b, group, src);
    b.src_stages = src;
    chains_.refresh(group);
    const auto touched = [&](const Claim& claim) { return claim.first > group || claim.end <= group || holds(chains_, claim); };
    const bool fine = std::all_of(claims.begin(), claims.end(), [&](const Claim& claim) { return holds(chains_, claim); }) &&
                      std::all_of(claims_.begin(), claims_.end(), touched);
    if (fine) {
      claims_.insert(claims_.end(), claims.begin(), claims.end());
      return;
    }
    b.src_stages = before;
    chains_.refresh(group);
  }

  std::vector<std::vector<CellBarrier>*> groups_;
  const std::vector<uint32_t>& group_of_slot_;
  const Schedule& schedule_;
  Chains chains_;
  std::vector<Claim> claims_;
};

}  // namespace

void drop_implied(SyncPlan& sync, const Schedule& schedule) {
  std::vector<std::vector<std::vector<CellBarrier>*>> groups(schedule.queues.size());
  std::vector<uint32_t> group_of_slot;
  const std::vector<uint32_t> queues = schedule.queues_of_slots();
  for (uint32_t slot = 0; slot < sync.groups.size(); ++slot) {
    std::vector<std::vector<CellBarrier>*>& mine = groups[queues[slot]];
    group_of_slot.push_back(static_cast<uint32_t>(mine.size()));
    mine.push_back(&sync.groups[slot]);
  }
  for (auto& mine : groups) Dropper(std::move(mine), group_of_slot, schedule).run();
}

}  // namespace rg::compiler
