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

// How execution scopes chain over the groups of a frame: a stage is reached where its later commands come after the event. What happened in the frame
// before counts from the start of this one: the boundary state promises no more.
class Chains {
 public:
  explicit Chains(const SyncPlan& sync) : sync_(sync), distinct_(sync.groups.size()) {
    for (uint32_t g = 0; g < sync.groups.size(); ++g) refresh(g);
  }

  // After barriers of the group were dropped or narrowed.
  void refresh(uint32_t group) {
    distinct_[group].clear();
    for (const CellBarrier& b : sync_.groups[group]) {
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
  const SyncPlan& sync_;
  std::vector<std::vector<Scopes>> distinct_;  // by group
};

template <class Holds>
bool for_all_events(const CellBarrier& b, Holds holds) {
  return std::all_of(b.sources.begin(), b.sources.end(), [&](const Event& event) {
    for (Stages rest = event.stages; rest; rest &= rest - 1)
      if (!holds(rest & ~(rest - 1), event.earlier_frame ? 0 : event.segment + 1)) return false;
    return true;
  });
}

// Barriers of one group do not chain, so groups before `index` only.
bool reaches_any(const Chains& chains, Stages stage, uint32_t first, uint32_t index, Stages any_of) {
  if (stage & any_of) return true;
  for (Stages rest = any_of; rest; rest &= rest - 1)
    if (chains.reaches(stage, first, index, rest & ~(rest - 1))) return true;
  return false;
}

bool execution_only(const CellBarrier& b) { return b.src_accesses == 0 && b.dst_accesses == 0 && b.old_layout == b.new_layout; }

// Groups before the barrier's own, or another barrier of its group, order `stage` of a command before groups `first` and on before what the barrier does.
bool is_ordered_anyway(const Chains& chains, const std::vector<CellBarrier>& group, const CellBarrier& b, Stages stage, uint32_t first, uint32_t index) {
  if (chains.reaches(stage, first, index, b.dst_stages)) return true;
  return std::any_of(group.begin(), group.end(), [&](const CellBarrier& other) {
    const Scopes scopes = scopes_of(other);
    return &other != &b && (b.dst_stages & ~scopes.second) == 0 && reaches_any(chains, stage, first, index, scopes.first);
  });
}

bool is_implied(const Chains& chains, const std::vector<CellBarrier>& group, const CellBarrier& b, uint32_t index) {
  return !b.sources.empty() && for_all_events(b, [&](Stages stage, uint32_t first) { return is_ordered_anyway(chains, group, b, stage, first, index); });
}

// Everything the barrier waits for still reaches its first scope when `dropped` is taken out of it; or need not, where only the order counts.
bool holds_without(const Chains& chains, const std::vector<CellBarrier>& group, const CellBarrier& b, uint32_t index, Stages dropped) {
  const Stages rest = with_earlier(b.src_stages & ~dropped);
  const bool transition = b.old_layout != b.new_layout;
  return !b.sources.empty() && for_all_events(b, [&](Stages stage, uint32_t first) {
    return reaches_any(chains, stage, first, index, rest) || (!transition && is_ordered_anyway(chains, group, b, stage, first, index));
  });
}

}  // namespace

void drop_implied(SyncPlan& sync) {
  Chains chains(sync);
  for (uint32_t g = 0; g < sync.groups.size(); ++g) {
    std::vector<CellBarrier>& group = sync.groups[g];
    const size_t before = group.size();
    for (size_t i = group.size(); i-- > 0;)
      if (execution_only(group[i]) && is_implied(chains, group, group[i], g)) group.erase(group.begin() + static_cast<ptrdiff_t>(i));
    if (group.size() != before) chains.refresh(g);
    for (CellBarrier& b : group)
      for (Stages bits = b.src_stages; bits; bits &= bits - 1) {
        if (b.src_accesses != 0 || std::popcount(b.src_stages) < 2 || !holds_without(chains, group, b, g, bits & ~(bits - 1))) continue;
        b.src_stages &= ~(bits & ~(bits - 1));
        chains.refresh(g);
      }
  }
}

}  // namespace rg::compiler
