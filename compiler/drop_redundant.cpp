#include <algorithm>
#include <bit>

#include "compiler/access_table.h"
#include "compiler/happens_before.h"
#include "compiler/obligations.h"
#include "compiler/synchronise.h"

namespace rg::compiler {
namespace {

// Every fact rests on one derivation. An atom on which none rests goes; of the others, one goes if each fact that rests on it has another derivation
// without it. Facts only lose derivations, so one look at each atom leaves none that could go.
class Dropper {
 public:
  Dropper(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, SyncPlan& sync)
      : frame_(frame),
        schedule_(schedule),
        sync_(sync),
        order_(frame, schedule, sync),
        signals_on_(schedule.queues.size()),
        watches_of_(order_.scopes.size()) {
    Obligations found = find_obligations(frame, schedule, lines, sync, order_);
    facts_ = std::move(found.facts), without_ = std::move(found.without), last_uses_ = std::move(found.last_uses);
    rests_on_.resize(facts_.size());
    atoms_.reserve(3 * facts_.size()), watches_.reserve(3 * facts_.size());
    for (uint32_t fact = 0; fact < facts_.size(); ++fact) {
      if (order_.derive(facts_[fact], found_))
        rest(fact, found_);
      else
        sync.unproved += !facts_[fact].optional;
    }
    for (uint32_t s = 0; s < order_.scopes.size(); ++s)
      if (order_.scopes[s].kind == SyncKind::signal) signals_on_[order_.scopes[s].queue].push_back(s);
    for (uint32_t segment = 0; segment < schedule.segments; ++segment)
      if (segment == 0 || schedule.batch_of[segment - 1] != schedule.batch_of[segment]) first_slots_.push_back(schedule.slot_before(segment));
  }

  void run(const std::vector<Line>& lines) {
    // Waits cost most, those for the frame before keep frames apart.
    for (const bool before : {true, false})
      for (uint32_t s = 0; s < order_.scopes.size(); ++s)
        if (order_.scopes[s].kind == SyncKind::wait && (order_.scopes[s].number < 0) == before) drop(s, {s, AtomField::whole, 0});
    for (uint32_t s = 0; s < order_.scopes.size(); ++s)
      if (order_.scopes[s].kind == SyncKind::signal && !order_.scopes[s].everything) drop(s, {s, AtomField::whole, 0});
    for (uint32_t s = 0; s < order_.scopes.size(); ++s)
      while (wait_earlier(s)) continue;
    for (uint32_t s = 0; s < order_.scopes.size(); ++s)
      if (order_.scopes[s].kind == SyncKind::signal && !order_.scopes[s].everything) drop(s, {s, AtomField::whole, 0});
    rest_on_memory(lines);
    for (uint32_t s = 0; s < order_.scopes.size(); ++s)
      if (order_.scopes[s].kind == SyncKind::barrier) order_.scopes[s].changes ? drop_discard(s) : drop(s, {s, AtomField::whole, 0});
    for (uint32_t s = 0; s < order_.scopes.size(); ++s) drop_bits(s);
    sync_.releases = trimmed_releases(lines);
    note_over();
    if (frame_.program->split_barriers) find_set_slots();
    write_back();
  }

 private:
  struct Watch {
    AtomField field;
    uint8_t bit;
    uint32_t fact, next;
  };
  struct Watches {
    uint32_t first = UINT32_MAX, last = UINT32_MAX;
  };
  struct Atoms {
    uint32_t first = 0, count = 0;
  };

  // What a fact rests on, and who watches a scope, lie in two pools: there are many of both, and most are never looked at.
  void rest(uint32_t fact, std::span<const SyncAtom> atoms) {
    rests_on_[fact] = {static_cast<uint32_t>(atoms_.size()), static_cast<uint32_t>(atoms.size())};
    atoms_.insert(atoms_.end(), atoms.begin(), atoms.end());
    for (const SyncAtom& atom : atoms) {
      const auto watch = static_cast<uint32_t>(watches_.size());
      watches_.push_back({atom.field, atom.bit, fact, UINT32_MAX});
      Watches& of = watches_of_[atom.scope];
      (of.last == UINT32_MAX ? of.first : watches_[of.last].next) = watch;
      of.last = watch;
    }
  }

  // Signals on which clocks count: each comes after all that its queue has released before it. What a release says is about its stages, whoever used
  // them, so a signal comes after it that names them or goes on after barriers behind it.
  void rest_on_memory(const std::vector<Line>& lines) {
    if (std::none_of(sync_.batches.begin(), sync_.batches.end(), [](const BatchSync& batch) { return batch.for_memory; })) return;
    for (const Release& release : trimmed_releases(lines)) {
      const uint32_t after = order_.point_of_slot(last_slot_.at({release.resource, release.queue})) + 1;
      const auto& signals = signals_on_[release.queue];
      const auto at = std::find_if(signals.begin(), signals.end(), [&](uint32_t s) {
        const SyncScope& signal = order_.scopes[s];
        return !signal.gone && signal.point >= after && sync_.batches[signal.slot].for_memory;
      });
      if (at != signals.end() && rest_on_signal(release, after, *at)) over_[{release.resource, release.queue}] = {release, order_.scopes[*at].slot};
    }
  }
  bool rest_on_signal(const Release& release, uint32_t after, uint32_t signal) {
    std::vector<SyncFact> facts;
    const auto add = [&](SyncSource::Kind kind, Stages stage, Accesses access) {
      facts.push_back(
          {SyncFact::Kind::feeds, static_cast<uint32_t>(order_.sources.size()), order_.scopes[signal].point, release.queue, 0, 0, signal});
      order_.sources.push_back({kind, kNone, release.queue, after, stage, access, 0, false, {}});
    };
    for (Stages stages = release.stages; stages; stages &= stages - 1) {
      const Stages stage = stages & ~(stages - 1);
      add(SyncSource::Kind::read, stage, 0);
      for (Accesses writes = release.accesses & supported_accesses(stage); writes; writes &= writes - 1)
        add(SyncSource::Kind::write, stage, writes & ~(writes - 1));
    }
    if (!std::all_of(facts.begin(), facts.end(), [&](const SyncFact& fact) { return order_.derive(fact, found_); })) return false;
    for (const SyncFact& fact : facts) {
      order_.derive(fact, found_);
      facts_.push_back(fact), rests_on_.emplace_back();
      rest(static_cast<uint32_t>(facts_.size()) - 1, found_);
    }
    return true;
  }
  // Of releases that are what they were when they were proved to be over.
  void note_over() {
    for (const Release& release : sync_.releases) {
      const auto found = over_.find({release.resource, release.queue});
      if (found == over_.end()) continue;
      const auto& [proved, batch] = found->second;
      if (release.stages == proved.stages && release.accesses == proved.accesses) sync_.over_at[found->first] = batch;
    }
  }

  // True if what `change` does to the scope leaves all facts standing; otherwise nothing has changed.
  template <class Change>
  bool attempt(uint32_t s, const SyncAtom& atom, Change change, const std::vector<SyncFact>& instead = {}) {
    const HappensBefore::Saved saved = order_.save(s);
    change(order_.scopes[s]);
    order_.refresh(s);
    derived_.clear(), derived_atoms_.clear();
    bool holds = true;
    const auto derive = [&](const SyncFact& fact, uint32_t number) {
      holds = holds && order_.derive(fact, found_);
      derived_.push_back({number, {static_cast<uint32_t>(derived_atoms_.size()), static_cast<uint32_t>(found_.size())}});
      derived_atoms_.insert(derived_atoms_.end(), found_.begin(), found_.end());
    };
    for (const SyncFact& fact : instead) derive(fact, static_cast<uint32_t>(facts_.size() + derived_.size()));
    for (uint32_t w = watches_of_[s].first; w != UINT32_MAX && holds; w = watches_[w].next) {
      const Watch& watch = watches_[w];
      if (watch.field != atom.field || watch.bit != atom.bit || !rests_on(watch.fact, atom) || is_about(watch.fact, order_.scopes[s], s)) continue;
      derive(facts_[watch.fact], watch.fact);
    }
    if (!holds) {
      order_.restore(s, saved);
      return false;
    }
    facts_.insert(facts_.end(), instead.begin(), instead.end());
    rests_on_.resize(facts_.size());
    for (const auto& [fact, on] : derived_) rest(fact, std::span(derived_atoms_).subspan(on.first, on.count));
    return true;
  }
  bool rests_on(uint32_t fact, const SyncAtom& atom) const {
    const auto first = atoms_.begin() + rests_on_[fact].first, last = first + rests_on_[fact].count;
    return std::find(first, last, atom) != last;
  }
  // The fact is gone with the transition.
  bool is_about(uint32_t fact, const SyncScope& scope, uint32_t s) const {
    if (!scope.gone || !scope.changes) return false;
    const SyncSource& source = order_.sources[facts_[fact].source];
    return (source.kind == SyncSource::Kind::transition && source.scope == s) ||
           (facts_[fact].kind == SyncFact::Kind::feeds && facts_[fact].scope == s);
  }
  void drop_discard(uint32_t s) {
    const auto found = without_.find(s);
    if (found == without_.end()) return;
    attempt(
        s, {s, AtomField::whole, 0}, [](SyncScope& scope) { scope.gone = true; }, found->second);
  }

  void drop(uint32_t s, const SyncAtom& atom) {
    attempt(s, atom, [](SyncScope& scope) { scope.gone = true; });
  }

  bool wait_earlier(uint32_t s) {
    const SyncScope& wait = order_.scopes[s];
    if (wait.kind != SyncKind::wait || wait.gone || wait.number < 0)
      return false;  // the frame before: all of it, so that other plans may come before
    int64_t earlier = -1;
    const std::vector<uint32_t>& signals = signals_on_[wait.from_queue];
    auto at = std::partition_point(signals.begin(), signals.end(), [&](uint32_t signal) { return order_.scopes[signal].number < wait.number; });
    while (at != signals.begin() && earlier < 0)
      if (const SyncScope& signal = order_.scopes[*--at]; !signal.gone) earlier = signal.number;
    return attempt(s, {s, AtomField::value, 0}, [&](SyncScope& scope) { scope.number = earlier; });
  }

  void drop_bits(uint32_t s) {
    const SyncScope& scope = order_.scopes[s];
    if (scope.gone || scope.everything) return;
    const auto each = [&](AtomField field, auto member) {
      for (uint64_t rest = scope.*member; rest; rest &= rest - 1) {
        const uint64_t bit = rest & ~(rest - 1);
        if (scope.kind != SyncKind::barrier && scope.*member == bit) continue;
        attempt(s, {s, field, static_cast<uint8_t>(std::countr_zero(bit))}, [&](SyncScope& changed) { changed.*member &= ~bit; });
      }
    };
    each(AtomField::src_stage, &SyncScope::src), each(AtomField::src_access, &SyncScope::src_accesses);
    each(AtomField::dst_stage, &SyncScope::dst), each(AtomField::dst_access, &SyncScope::dst_accesses);
  }

  // ---- how early an event could be set ------------------------------------------------------------------------------

  // After all that comes before the barrier on the ways that facts and releases rest on.
  void find_set_slots() {
    // By scope: what has to be recorded, in halves of points. Point p is at 2 p, what follows it up to the next point at 2 p + 1.
    std::vector<uint32_t> recorded(order_.scopes.size());
    for (uint32_t fact = 0; fact < facts_.size(); ++fact)
      note_way(order_.sources[facts_[fact].source], std::span(atoms_).subspan(rests_on_[fact].first, rests_on_[fact].count), recorded);
    for (const auto& [source, way] : ways_of_releases_) note_way(order_.sources[source], way, recorded);
    for (uint32_t s = 0; s < order_.scopes.size(); ++s) {
      const SyncScope& scope = order_.scopes[s];
      if (scope.kind != SyncKind::barrier || scope.gone) continue;
      sync_.groups[scope.slot][scope.index].set = {scope.slot, false};
      const uint32_t place = std::max(recorded[s], 2 * order_.point_of_slot(first_slot_of_batch(scope.slot)));
      if (place < 2 * scope.point) sync_.groups[scope.slot][scope.index].set = {scope.slot - (scope.point - place / 2), place % 2 == 1};
    }
  }
  // Atoms of a way stand from its target to its source.
  void note_way(const SyncSource& source, std::span<const SyncAtom> way, std::vector<uint32_t>& recorded) const {
    for (size_t i = 0; i < way.size(); ++i) {
      const uint32_t scope = way[i].scope;
      if (i + 1 < way.size() && way[i + 1].scope == scope) continue;
      const bool is_source = source.kind == SyncSource::Kind::transition && source.scope == scope;
      if (i + 1 == way.size() && is_source) continue;
      const uint32_t place = i + 1 < way.size() ? 2 * order_.scopes[way[i + 1].scope].point + 1 : 2 * source.after;
      recorded[scope] = std::max(recorded[scope], place);
    }
  }
  uint32_t first_slot_of_batch(uint32_t slot) const {
    const auto batch = std::upper_bound(first_slots_.begin(), first_slots_.end(), slot);
    return *(batch - 1);
  }

  void write_back() {
    for (const SyncScope& scope : order_.scopes) {
      if (scope.kind == SyncKind::wait) {
        BatchWait& wait = sync_.batches[scope.slot].waits[scope.index];
        wait.stages = scope.gone ? 0 : scope.dst;
        wait.batch = scope.number < 0 ? kNone : static_cast<uint32_t>(scope.number);
      } else if (scope.kind == SyncKind::signal) {
        sync_.batches[scope.slot].signal = scope.gone ? 0 : scope.src;
      } else {
        CellBarrier& b = sync_.groups[scope.slot][scope.index];
        b.src_stages = scope.src, b.dst_stages = scope.dst, b.src_accesses = scope.src_accesses, b.dst_accesses = scope.dst_accesses;
        b.dropped = scope.gone;
      }
    }
    for (BatchSync& batch : sync_.batches) std::erase_if(batch.waits, [](const BatchWait& wait) { return wait.stages == 0; });
    for (std::vector<CellBarrier>& group : sync_.groups) std::erase_if(group, [](const CellBarrier& b) { return b.dropped; });
  }

  // Releases of a resource wait for all its last users together: what waits to and fro have ordered before one of them need not be named again.
  std::vector<Release> trimmed_releases(const std::vector<Line>& lines) {
    if (schedule_.queues.size() == 1) return sync_.releases;
    ways_of_releases_.clear();
    find_last_slots(lines);
    std::map<uint32_t, std::vector<uint32_t>> uses;  // by resource
    for (const uint32_t use : last_uses_) uses[frame_.cells[order_.sources[use].cell].resource].push_back(use);
    std::vector<Release> trimmed;
    for (size_t i = 0; i < sync_.releases.size();) {
      std::vector<Release> rows;
      for (const uint32_t resource = sync_.releases[i].resource; i < sync_.releases.size() && sync_.releases[i].resource == resource; ++i)
        rows.push_back(sync_.releases[i]);
      trim(rows, uses[rows.front().resource]);
      if (frame_.program->split_barriers) note_releases(rows, uses[rows.front().resource]);
      trimmed.insert(trimmed.end(), rows.begin(), rows.end());
    }
    return trimmed;
  }
  void find_last_slots(const std::vector<Line>& lines) {
    for (const Line& line : lines)
      for (const Epoch& epoch : line.epochs)
        for (const Event& event : epoch.events) {
          uint32_t& last = last_slot_[{frame_.cells[line.cell].resource, event.queue}];
          last = std::max(last, schedule_.slot_before(event.segment));
        }
  }
  void trim(std::vector<Release>& rows, const std::vector<uint32_t>& uses) {
    for (size_t i = rows.size(); i-- > 0 && rows.size() > 1;) {
      std::vector<Release> fewer = rows;
      fewer.erase(fewer.begin() + static_cast<ptrdiff_t>(i));
      if (wait_for_all(fewer, uses)) rows = std::move(fewer);
    }
    for (size_t i = 0; i < rows.size(); ++i)
      for (const auto member : {&Release::accesses, &Release::stages})
        for (uint64_t rest = rows[i].*member; rest; rest &= rest - 1) {
          std::vector<Release> less = rows;
          less[i].*member &= ~(rest & ~(rest - 1));
          if (less[i].stages != 0 && wait_for_all(less, uses)) rows = std::move(less);
        }
  }
  void note_releases(const std::vector<Release>& rows, const std::vector<uint32_t>& uses) {
    for (const uint32_t use : uses)
      for (const Release& row : rows) {
        found_.clear();
        if (!waits_for(row, use)) continue;
        ways_of_releases_.emplace_back(use, found_);
        break;
      }
  }
  bool wait_for_all(const std::vector<Release>& rows, const std::vector<uint32_t>& uses) {
    return std::all_of(uses.begin(), uses.end(),
                       [&](uint32_t use) { return std::any_of(rows.begin(), rows.end(), [&](const Release& row) { return waits_for(row, use); }); });
  }
  bool waits_for(const Release& row, uint32_t use) {
    const SyncSource& source = order_.sources[use];
    const bool named = source.access ? (row.stages & source.stage) && (row.accesses & source.access) : (with_earlier(row.stages) & source.stage) != 0;
    if (row.queue == source.queue && named) return true;
    const uint32_t point = order_.point_of_slot(last_slot_.at({row.resource, row.queue}) + 1);
    return point >= source.after &&
           order_.derive({SyncFact::Kind::follows, use, point, row.queue, with_earlier(row.stages), 0, 0, UINT32_MAX}, found_);
  }

  const Frame& frame_;
  const Schedule& schedule_;
  SyncPlan& sync_;
  HappensBefore order_;
  std::vector<SyncFact> facts_;
  std::map<uint32_t, std::vector<SyncFact>> without_;
  std::vector<uint32_t> last_uses_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> last_slot_;               // of transients, by resource and queue
  std::vector<std::vector<uint32_t>> signals_on_;                             // by queue: scopes
  std::vector<std::pair<uint32_t, std::vector<SyncAtom>>> ways_of_releases_;  // by source
  std::vector<uint32_t> first_slots_;                                         // by batch
  std::vector<SyncAtom> atoms_;
  std::vector<Atoms> rests_on_;  // by fact
  std::vector<Watch> watches_;
  std::vector<Watches> watches_of_;                  // by scope
  std::vector<std::pair<uint32_t, Atoms>> derived_;  // of the attempt being made, by fact
  std::vector<SyncAtom> derived_atoms_, found_;
  std::map<std::pair<uint32_t, uint32_t>, std::pair<Release, uint32_t>> over_;  // by resource and queue: by the signal of which batch
};

}  // namespace

void drop_redundant(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, SyncPlan& sync) {
  Dropper(frame, schedule, lines, sync).run(lines);
}

}  // namespace rg::compiler
