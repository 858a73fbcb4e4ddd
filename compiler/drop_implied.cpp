#include <algorithm>
#include <bit>
#include <span>

#include "compiler/synchronise.h"

namespace rg::compiler {
namespace {

struct Scopes {  // of one barrier, completed: the first with logically earlier stages, the second with later ones
  Stages first = 0, second = 0;
  friend bool operator==(const Scopes&, const Scopes&) = default;
};
Scopes scopes_of(const CellBarrier& b) { return {with_earlier(b.src_stages), with_later(b.dst_stages)}; }

// Another queue waited for batch `from` of this one, and batch `to` of this one waited for that: commands before the end of the first come before
// those of the second, as a barrier would order them.
struct RoundTrip {
  uint32_t from = 0, to = 0;     // groups of this queue: the first after the one batch, the first of the other; from 0: the frame before
  Stages first = 0, second = 0;  // completed, as in Scopes
  Stages available = 0;          // whose writes the signal made available
  Stages exact_second = 0;       // as the wait names them: what sees the writes
};

// Those that end before `group`; `trips` are sorted by that.
std::span<const RoundTrip> trips_to(const std::vector<RoundTrip>& trips, uint32_t group) {
  const auto [first, last] =
      std::equal_range(trips.begin(), trips.end(), RoundTrip{0, group}, [](const RoundTrip& a, const RoundTrip& b) { return a.to < b.to; });
  return {first, last};
}

// How execution scopes chain over the groups of one queue: a stage is reached where its later commands come after the event. What happened in the
// frame before counts from the start of this one: the boundary state promises no more.
class Chains {
 public:
  Chains(const std::vector<std::vector<CellBarrier>*>& groups, const std::vector<RoundTrip>& trips)
      : groups_(groups), trips_(trips), distinct_(groups.size()) {
    for (uint32_t g = 0; g < groups.size(); ++g) refresh(g);
  }

  // After barriers of the group were dropped or narrowed.
  void refresh(uint32_t group) {
    distinct_[group].clear();
    for (const CellBarrier& b : *groups_[group]) {
      if (b.src_queue != b.dst_queue) continue;  // half a change of owner orders nothing else, and is not even recorded within one family
      const Scopes scopes = scopes_of(b);
      if (std::find(distinct_[group].begin(), distinct_[group].end(), scopes) == distinct_[group].end()) distinct_[group].push_back(scopes);
    }
  }

  // True if stages that are reached before group `first` lead to one of `wanted` before group `end`.
  bool leads(Stages reach, uint32_t first, uint32_t end, Stages wanted) const {
    for (uint32_t g = first; g < end && (reach & wanted) == 0; ++g) {
      const Stages before = reach;
      for (const Scopes& scopes : distinct_[g])
        if (scopes.first & before) reach |= scopes.second;
    }
    return (reach & wanted) != 0;
  }

  // True if, once the groups [first, end) have been recorded, all of `wanted` come after `stage` of an earlier command.
  bool reaches(Stages stage, uint32_t first, uint32_t end, Stages wanted, bool over_trips) const {
    Stages reach = 0;
    std::vector<Stages> reached;  // before each group, from `first`
    for (uint32_t g = first; g < end && (reach & wanted) != wanted; ++g) {
      if (over_trips) reached.push_back(reach);
      for (const RoundTrip& trip : over_trips ? trips_to(trips_, g) : std::span<const RoundTrip>())
        if (trip.from >= first && (trip.first & (stage | reached[std::min<size_t>(trip.from - first, reached.size() - 1)]))) reach |= trip.second;
      const Stages before = stage | reach;  // barriers of one group do not chain
      for (const Scopes& scopes : distinct_[g])
        if (scopes.first & before) reach |= scopes.second;
    }
    return (reach & wanted) == wanted;
  }

 private:
  const std::vector<std::vector<CellBarrier>*>& groups_;
  const std::vector<RoundTrip>& trips_;
  std::vector<std::vector<Scopes>> distinct_;  // by group
};

// An order that no barrier of its own realises any more, so that others must keep doing it.
struct Claim {
  Stages stage = 0;             // of a command before group `first`
  uint32_t first = 0, end = 0;  // groups that may order it
  Stages wanted = 0;
  bool all = true;         // all of `wanted` must come after it; or any
  bool over_trips = true;  // round trips count
};

bool holds(const Chains& chains, const Claim& claim) {
  if (claim.all) return chains.reaches(claim.stage, claim.first, claim.end, claim.wanted, claim.over_trips);
  if (claim.stage & claim.wanted) return true;
  for (Stages rest = claim.wanted; rest; rest &= rest - 1)
    if (chains.reaches(claim.stage, claim.first, claim.end, rest & ~(rest - 1), claim.over_trips)) return true;
  return false;
}

bool execution_only(const CellBarrier& b) { return !b.foreign && b.src_accesses == 0 && b.dst_accesses == 0 && b.old_layout == b.new_layout; }

// Works on one queue: barriers of others order nothing here, and those that go on after a wait stay as they are.
class Dropper {
 public:
  Dropper(std::vector<std::vector<CellBarrier>*> groups, std::vector<RoundTrip> trips, const std::vector<uint32_t>& group_of_slot,
          const Schedule& schedule)
      : groups_(std::move(groups)), trips_(std::move(trips)), group_of_slot_(group_of_slot), schedule_(schedule), chains_(groups_, trips_) {}

  void run() {
    if (!trips_.empty()) drop_available(), drop_reached();
    for (uint32_t g = 0; g < groups_.size(); ++g) {
      for (CellBarrier& b : *groups_[g])
        if (execution_only(b) && !b.sources.empty()) narrow(b, g, 0);
      std::erase_if(*groups_[g], [](const CellBarrier& b) { return execution_only(b) && b.src_stages == 0; });
      for (CellBarrier& b : *groups_[g])
        for (Stages bits = b.src_stages; bits; bits &= bits - 1)
          if (may_narrow(b, b.src_stages & ~(bits & ~(bits - 1)))) narrow(b, g, b.src_stages & ~(bits & ~(bits - 1)));
    }
  }

 private:
  // Claims are checked again at each later change, which is what bounds their number.
  static constexpr size_t kMostClaims = 2000;

  uint32_t first_after(const Event& event) const { return event.earlier_frame ? 0 : group_of_slot_[schedule_.slot_before(event.segment)] + 1; }

  // Writes that a round trip has made available need not be named again.
  void drop_available() {
    for (uint32_t g = 0; g < groups_.size(); ++g)
      for (CellBarrier& b : *groups_[g])
        if (b.within_frame && b.src_accesses != 0 && b.src_queue == b.dst_queue) drop_available(b, g);
    for (uint32_t g = 0; g < groups_.size(); ++g) chains_.refresh(g);
  }
  void drop_available(CellBarrier& b, uint32_t group) const {
    Accesses open = 0;
    Stages stages = b.foreign ? b.src_stages & b.dst_stages : 0;
    for (const Event& event : b.sources) {
      const bool available = std::any_of(trips_.begin(), trips_.end(), [&](const RoundTrip& trip) {
        return trip.to <= group && trip.from >= first_after(event) && (event.effect.write_stages & ~trip.available) == 0 &&
               chains_.leads(trip.second, trip.to, group, with_earlier(latest_stages(event.effect.stages())));
      });
      if (!available) open |= event.effect.writes;
      stages |= available ? latest_stages(event.effect.stages()) : event.effect.stages();
    }
    if (open != b.src_accesses) b.src_accesses = open, b.src_stages = stages;
  }

  // Users that a round trip brings behind the barrier need not be in its second scope, as long as that leads to the trip.
  void drop_reached() {
    for (uint32_t g = 0; g < groups_.size(); ++g) {
      std::erase_if(*groups_[g], [&](const CellBarrier& b) { return b.within_frame && !reaches_host(b) && is_replaced(b); });
      for (CellBarrier& b : *groups_[g])
        if (b.within_frame && !b.targets.empty() && !reaches_host(b)) drop_reached(b, g);
    }
    for (uint32_t g = 0; g < groups_.size(); ++g) chains_.refresh(g);
  }
  void drop_reached(CellBarrier& b, uint32_t group) const {
    for (Stages bits = b.dst_stages; bits; bits &= bits - 1) {
      const Stages stage = bits & ~(bits - 1), rest = b.dst_stages & ~stage;
      const bool reached = std::all_of(b.targets.begin(), b.targets.end(), [&](const Event& event) {
        return (event.effect.stages() & stage) == 0 || comes_after_trip(event, stage, group, rest ? rest : b.dst_stages);
      });
      if (reached && rest) b.dst_stages = rest;
    }
    Accesses open = 0;
    for (const Event& event : b.targets)
      for (Stages bits = event.effect.stages(); bits; bits &= bits - 1) {
        const Stages stage = bits & ~(bits - 1);
        if (!comes_after_trip(event, stage, group, b.dst_stages)) open |= (event.effect.reads | event.effect.writes) & supported_accesses(stage);
      }
    b.dst_accesses &= open;
  }
  static bool reaches_host(const CellBarrier& b) { return (b.dst_stages & stage::host) != 0; }
  // Round trips alone bring every user behind every source.
  bool is_replaced(const CellBarrier& b) const {
    if (b.old_layout != b.new_layout || b.src_queue != b.dst_queue || b.foreign || b.targets.empty() || b.sources.empty()) return false;
    return std::all_of(b.sources.begin(), b.sources.end(), [&](const Event& source) {
      return std::all_of(b.targets.begin(), b.targets.end(), [&](const Event& target) { return is_brought(source, target); });
    });
  }
  bool is_brought(const Event& source, const Event& target) const {
    const uint32_t user = group_of_slot_[schedule_.slot_before(target.segment)];
    return std::any_of(trips_.begin(), trips_.end(), [&](const RoundTrip& trip) {
      return trip.from >= first_after(source) && trip.to <= user && (source.effect.stages() & ~trip.first) == 0 &&
             (source.effect.write_stages & ~trip.available) == 0 && (target.effect.stages() & ~trip.exact_second) == 0;
    });
  }
  // A trip that begins behind the barrier, by way of one of `through`, and ends before the event.
  bool comes_after_trip(const Event& event, Stages stage, uint32_t group, Stages through) const {
    const uint32_t user = group_of_slot_[schedule_.slot_before(event.segment)];
    return std::any_of(trips_.begin(), trips_.end(), [&](const RoundTrip& trip) {
      return trip.from > group && trip.to <= user && (trip.first & through) != 0 && (trip.exact_second & stage) != 0;
    });
  }

  static bool may_narrow(const CellBarrier& b, Stages src) {
    if (b.src_accesses != 0 || b.sources.empty() || src == 0 || b.src_queue != b.dst_queue) return false;
    if (b.after_wait) return b.within_frame && (with_earlier(src) & b.after_wait) != 0;
    return !b.foreign;
  }

  // What must hold for the barrier's sources, if the barrier is gone (`src` 0) or waits for `src` only. Barriers of its own group help where
  // execution alone counts; a transition needs its sources within its own first scope, which only earlier groups lead to.
  std::vector<Claim> claims_without(const CellBarrier& b, uint32_t group, Stages src) const {
    std::vector<Claim> claims;
    // So does what becomes visible of writes that a round trip made available.
    const bool transition = b.old_layout != b.new_layout || (!trips_.empty() && b.dst_accesses != 0);
    for (const Event& event : b.sources) {
      const uint32_t first = first_after(event);
      for (Stages rest = event.stages; rest; rest &= rest - 1) {
        const Stages stage = rest & ~(rest - 1);
        if (transition)
          claims.push_back({stage, first, group, with_earlier(src), false, b.within_frame && !trips_.empty()});
        else
          claims.push_back({stage, first, group_of_slot_[b.first_use] + 1, b.dst_stages, true, b.within_frame && !trips_.empty()});
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
  std::vector<RoundTrip> trips_;
  const std::vector<uint32_t>& group_of_slot_;
  const Schedule& schedule_;
  Chains chains_;
  std::vector<Claim> claims_;
};

// By queue, sorted: what waits to and fro between two queues order. A signal comes after those before it on its queue, up to the end of the frame
// before, which signals everything; the last few are enough in practice.
class RoundTrips {
 public:
  RoundTrips(const SyncPlan& sync, const Schedule& schedule, const std::vector<uint32_t>& group_of_slot)
      : sync_(sync),
        schedule_(schedule),
        group_of_slot_(group_of_slot),
        queue_(schedule.batches),
        first_slot_(schedule.batches, UINT32_MAX),
        trips_(schedule.queues.size()) {
    for (uint32_t segment = 0; segment < schedule.segments; ++segment) {
      const uint32_t batch = schedule.batch_of[segment];
      queue_[batch] = schedule.queue_of[segment], first_slot_[batch] = std::min(first_slot_[batch], schedule.slot_before(segment));
    }
  }

  std::vector<std::vector<RoundTrip>> find() {
    for (uint32_t to = 0; to < schedule_.batches; ++to)
      for (const BatchWait& back : sync_.batches[to].waits)
        if (back.batch != kNone) add(to, back);
    for (auto& trips : trips_) std::stable_sort(trips.begin(), trips.end(), [](const RoundTrip& a, const RoundTrip& b) { return a.to < b.to; });
    return std::move(trips_);
  }

 private:
  static constexpr uint32_t kMostSignals = 16;

  void add(uint32_t to, const BatchWait& back) {
    bool met = false;
    uint32_t latest = kNone;  // batch of this queue that the other one has waited for
    for (uint32_t over = 0; over <= back.batch; ++over)
      for (const BatchWait& out : sync_.batches[over].waits) {
        if (queue_[over] != back.queue || out.queue != queue_[to] || (with_later(out.stages) & sync_.batches[back.batch].signal) == 0) continue;
        met = true;
        if (out.batch != kNone) latest = latest == kNone ? out.batch : std::max(latest, out.batch);
      }
    if (!met) return;
    const uint32_t end = group_of_slot_[first_slot_[to]];
    const Stages second = with_later(back.stages);
    std::vector<RoundTrip>& trips = trips_[queue_[to]];
    trips.push_back({0, end, ~Stages{0}, second, ~Stages{0}, back.stages});
    uint32_t signals = 0;
    for (uint32_t batch = latest; batch != kNone && signals < kMostSignals; batch = batch == 0 ? kNone : batch - 1) {
      const Stages signal = sync_.batches[batch].signal;
      if (queue_[batch] != queue_[to] || signal == 0) continue;
      trips.push_back({group_of_slot_[schedule_.closing_slot(batch)] + 1, end, with_earlier(signal), second, signal, back.stages});
      ++signals;
    }
  }

  const SyncPlan& sync_;
  const Schedule& schedule_;
  const std::vector<uint32_t>& group_of_slot_;
  std::vector<uint32_t> queue_, first_slot_;  // by batch
  std::vector<std::vector<RoundTrip>> trips_;
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
  std::vector<std::vector<RoundTrip>> trips = RoundTrips(sync, schedule, group_of_slot).find();
  for (size_t queue = 0; queue < groups.size(); ++queue) Dropper(std::move(groups[queue]), std::move(trips[queue]), group_of_slot, schedule).run();
}

}  // namespace rg::compiler
