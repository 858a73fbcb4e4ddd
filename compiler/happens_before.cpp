#include "compiler/happens_before.h"

#include <algorithm>
#include <bit>

#include "compiler/access_table.h"

namespace rg::compiler {
namespace {

uint8_t index_of_bit(uint64_t bit) { return static_cast<uint8_t>(std::countr_zero(bit)); }
constexpr Stages bit_of(uint8_t index) { return Stages{1} << index; }

// The bit of `mask` whose completion by `complete` holds `stage`, itself if it can be.
template <class Complete>
uint8_t bit_that_holds(Stages mask, Stages stage, Complete complete) {
  if (mask & stage) return index_of_bit(stage);
  for (Stages rest = mask; rest; rest &= rest - 1)
    if (complete(rest & ~(rest - 1)) & stage) return index_of_bit(rest & ~(rest - 1));
  return index_of_bit(stage);
}

bool contains(const Frame& frame, const CellBarrier& barrier, const Cell& cell) {
  const Cell& first = frame.cells[barrier.cell];
  if (cell.resource != first.resource || cell.age != first.age) return false;
  if (cell.range.aspects == 0) return cell.begin >= barrier.begin && cell.end <= barrier.end;
  const Range &whole = barrier.range, &part = cell.range;
  return part.aspects == whole.aspects && part.mip >= whole.mip && part.mip + part.mips <= whole.mip + whole.mips && part.layer >= whole.layer &&
         part.layer + part.layers <= whole.layer + whole.layers;
}

}  // namespace

void SyncScope::complete() { src_earlier = everything ? ~Stages{0} : with_earlier(src), dst_later = with_later(dst); }

HappensBefore::HappensBefore(const Frame& frame, const Schedule& schedule, const SyncPlan& sync)
    : point_of_slot_(schedule.slots()),
      on_cell_(frame.cells.size() + 1),
      next_cell_(frame.cells.size()),
      waits_on_(schedule.queues.size()),
      last_signal_(schedule.queues.size(), -1),
      lanes_(schedule.queues.size()),
      batches_(schedule.batches) {
  std::vector<uint32_t> last(schedule.queues.size(), kNone);
  for (uint32_t segment = 0; segment < schedule.segments; ++segment) last[schedule.queue_of[segment]] = schedule.batch_of[segment];
  for (uint32_t cell = 0; cell < frame.cells.size(); ++cell) {
    const Grid& grid = frame.grids[frame.cells[cell].resource];
    next_cell_[cell] = frame.cells[cell].age + 1 < grid.ages ? cell + grid.cells_per_age() : cell - frame.cells[cell].age * grid.cells_per_age();
  }
  const bool several = schedule.queues.size() > 1;
  for (uint32_t segment = 0; segment < schedule.segments; ++segment) {
    const uint32_t batch = schedule.batch_of[segment], queue = schedule.queue_of[segment], slot = schedule.slot_before(segment);
    if (several && (segment == 0 || schedule.batch_of[segment - 1] != batch)) {
      add_point(SyncKind::wait, queue);
      const std::vector<BatchWait>& waits = sync.batches[batch].waits;
      for (uint32_t i = 0; i < waits.size(); ++i) {
        SyncScope scope;
        scope.kind = SyncKind::wait, scope.dst = waits[i].stages, scope.from_queue = waits[i].queue;
        scope.number = waits[i].batch == kNone ? -1 : int64_t{waits[i].batch};
        scope.slot = batch, scope.index = i;
        waits_on_[queue].push_back(static_cast<uint32_t>(scopes.size()));
        add_scope(std::move(scope));
      }
    }
    add_point(SyncKind::barrier, queue);
    add_barriers(frame, slot, sync.groups[slot]);
    if (segment + 1 < schedule.segments && schedule.batch_of[segment + 1] == batch) continue;
    add_point(SyncKind::barrier, queue);
    add_barriers(frame, slot + 1, sync.groups[slot + 1]);
    if (!several || (sync.batches[batch].signal == 0 && last[queue] != batch)) continue;
    add_point(SyncKind::signal, queue);
    SyncScope scope;
    scope.kind = SyncKind::signal, scope.src = sync.batches[batch].signal, scope.everything = last[queue] == batch;
    scope.number = last_signal_[queue] = batch, scope.slot = batch;
    add_scope(std::move(scope));
  }
}

void HappensBefore::add_point(SyncKind kind, uint32_t queue) { points_.push_back({kind, queue, static_cast<uint32_t>(scopes.size()), 0, 0, 0}); }

void HappensBefore::add_scope(SyncScope scope) {
  Point& point = points_.back();
  scope.point = static_cast<uint32_t>(points_.size()) - 1, scope.queue = point.queue;
  scope.complete();
  ++point.count;
  point.src_earlier |= scope.src_earlier, point.dst_later |= scope.dst_later;
  scopes.push_back(std::move(scope));
}

void HappensBefore::add_barriers(const Frame& frame, uint32_t slot, const std::vector<CellBarrier>& group) {
  point_of_slot_[slot] = static_cast<uint32_t>(points_.size()) - 1;
  for (uint32_t i = 0; i < group.size(); ++i) {
    const CellBarrier& b = group[i];
    SyncScope scope;
    scope.src = b.src_stages, scope.dst = b.dst_stages, scope.src_accesses = b.src_accesses, scope.dst_accesses = b.dst_accesses;
    scope.transfers = b.src_queue != b.dst_queue, scope.changes = b.old_layout != b.new_layout || scope.transfers;
    scope.old_layout = b.old_layout, scope.new_layout = b.new_layout;
    scope.slot = slot, scope.index = i;
    note_cells(frame, b, static_cast<uint32_t>(scopes.size()));
    add_scope(std::move(scope));
  }
}

void HappensBefore::note_cells(const Frame& frame, const CellBarrier& barrier, uint32_t scope) {
  const Cell& first = frame.cells[barrier.cell];
  const Grid& grid = frame.grids[first.resource];
  const uint32_t begin = grid.first_cell + first.age * grid.cells_per_age();
  for (uint32_t cell = begin; cell < begin + grid.cells_per_age(); ++cell)
    if (contains(frame, barrier, frame.cells[cell])) on_cell_[cell].push_back(scope);
}

void HappensBefore::refresh(uint32_t index) {
  SyncScope& scope = scopes[index];
  scope.complete();
  Point& point = points_[scope.point];
  point.src_earlier = point.dst_later = 0;
  for (uint32_t s = point.first; s < point.first + point.count; ++s)
    if (!scopes[s].gone) point.src_earlier |= scopes[s].src_earlier, point.dst_later |= scopes[s].dst_later;
}

HappensBefore::Saved HappensBefore::save(uint32_t index) const {
  const Point& point = points_[scopes[index].point];
  return {scopes[index], point.src_earlier, point.dst_later};
}
void HappensBefore::restore(uint32_t index, const Saved& saved) {
  scopes[index] = saved.scope;
  Point& point = points_[saved.scope.point];
  point.src_earlier = saved.src_earlier, point.dst_later = saved.dst_later;
}

// ---- one source, forward ----------------------------------------------------------------------------------------

void HappensBefore::start(const SyncSource& source) {
  for (Lane& lane : lanes_) lane.reached = 0, lane.signalled = INT64_MAX;
  available_ = source.kind != SyncSource::Kind::write;
  if (source.kind == SyncSource::Kind::transition) reach(source.queue, scopes[source.scope].dst_later, {source.scope, kOwnScope});
  if (source.kind == SyncSource::Kind::batch) reach(source.queue, bit_of(0), {});
  for (const auto& [queue, stages] : source.reached) reach(queue, stages, {});
  if (source.signalled) {
    lanes_[source.queue].signalled = -1, lanes_[source.queue].signal = {};
    for (const auto& [queue, stages] : source.reached) lanes_[queue].signalled = -1, lanes_[queue].signal = {};
  }
  frame_ = 0;
  start_frame(source.cell, source.after);
}

std::span<const uint32_t> HappensBefore::on_cell_between(uint32_t cell, uint32_t first, uint32_t end) const {
  const std::vector<uint32_t>& all = on_cell_[std::min<size_t>(cell, on_cell_.size() - 1)];  // the last: no cell
  const auto at = [&](uint32_t point) {
    return std::lower_bound(all.begin(), all.end(), point, [&](uint32_t s, uint32_t p) { return scopes[s].point < p; });
  };
  return first < end ? std::span<const uint32_t>(at(first), at(end)) : std::span<const uint32_t>();
}

void HappensBefore::start_frame(uint32_t cell, uint32_t point) { local_ = on_cell_between(cell, point, UINT32_MAX); }

// Counted on through the frames.
int64_t HappensBefore::number_waited_for(const SyncScope& wait) const {
  if (wait.number >= 0) return frame_ * batches_ + wait.number;
  return frame_ == 0 ? -1 : (frame_ - 1) * batches_ + last_signal_[wait.from_queue];
}

void HappensBefore::reach(uint32_t queue, Stages stages, const Reason& reason) {
  Lane& lane = lanes_[queue];
  for (Stages rest = stages & ~lane.reached & (bit_of(kStages) - 1); rest; rest &= rest - 1) lane.reasons[index_of_bit(rest)] = reason;
  lane.reached |= stages;
}

bool HappensBefore::enters(const SyncScope& scope, bool covers, const SyncSource& source, uint8_t& from) const {
  const Lane& lane = lanes_[scope.queue];
  from = kSource;
  const bool here = source.queue == scope.queue;
  using Kind = SyncSource::Kind;
  if (here && source.kind == Kind::read && (scope.src_earlier & source.stage)) return true;
  if (here && source.kind == Kind::write && covers) {
    if (scope.everything) return true;
    if ((scope.src & source.stage) && (scope.kind == SyncKind::signal || (scope.src_accesses & source.access))) return true;
  }
  if (here && source.kind == Kind::transition && scope.everything) return true;
  if (source.kind == Kind::batch) return lane.reached != 0 && scope.kind != SyncKind::barrier;
  const Stages met = available_ ? lane.reached & scope.src_earlier : 0;
  if (met == 0) return false;
  const Stages exact = met & scope.src;
  from = index_of_bit(exact ? exact : met);
  return true;
}

bool HappensBefore::pass_barriers(const Point& point, const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms) {
  const auto index = static_cast<uint32_t>(&point - points_.data());
  while (!local_.empty() && scopes[local_.front()].point < index) local_ = local_.subspan(1);
  const bool local = !local_.empty() && scopes[local_.front()].point == index;
  const Stages own = source.kind == SyncSource::Kind::read && source.queue == point.queue ? source.stage : 0;
  const Stages reached = lanes_[point.queue].reached;
  if (!local && (((reached | own) & point.src_earlier) == 0 || (point.dst_later & ~reached) == 0)) return false;
  fresh_.clear();
  bool made_available = false;
  for (uint32_t s = point.first; s < point.first + point.count; ++s) {
    const bool covers = local && !local_.empty() && local_.front() == s;
    if (covers) local_ = local_.subspan(1);
    const SyncScope& scope = scopes[s];
    if (scope.gone || scope.transfers || (!covers && (scope.dst_later & ~reached) == 0)) continue;
    uint8_t from = kSource;
    if (!enters(scope, covers, source, from)) continue;
    const bool sees = fact.kind == SyncFact::Kind::sees && scope.queue == fact.queue && (scope.dst & fact.stages);
    const bool host = fact.kind == SyncFact::Kind::host && (scope.dst & stage::host);
    if ((sees || host) && covers && (scope.dst_accesses & fact.access)) {
      add_sink(s, fact, atoms);
      explain({s, from}, source, atoms);
      return true;
    }
    made_available = made_available || !available_;
    fresh_.push_back({scope.dst_later, {s, from}});
  }
  for (const Fresh& fresh : fresh_) reach(point.queue, fresh.stages, fresh.reason);
  available_ = available_ || made_available;
  return followed(fact, source, atoms);
}

bool HappensBefore::pass_waits(const Point& point, const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms) {
  fresh_.clear();
  for (uint32_t s = point.first; s < point.first + point.count; ++s) {
    const SyncScope& scope = scopes[s];
    if (scope.gone || lanes_[scope.from_queue].signalled > number_waited_for(scope)) continue;
    const Reason reason{s, kSignal};
    if (fact.kind == SyncFact::Kind::sees && scope.queue == fact.queue && (scope.dst & fact.stages)) {
      add_sink(s, fact, atoms);
      explain(reason, source, atoms);
      return true;
    }
    fresh_.push_back({source.kind == SyncSource::Kind::batch ? bit_of(0) : scope.dst_later, reason});
  }
  for (const Fresh& fresh : fresh_) reach(point.queue, fresh.stages, fresh.reason);
  available_ = available_ || !fresh_.empty();
  return !fresh_.empty() && followed(fact, source, atoms);
}

void HappensBefore::pass_signal(const Point& point, const SyncSource& source) {
  Lane& lane = lanes_[point.queue];
  const SyncScope& scope = scopes[point.first];
  uint8_t from = kSource;
  if (scope.gone || lane.signalled != INT64_MAX || !enters(scope, true, source, from)) return;
  lane.signalled = frame_ * batches_ + scope.number, lane.signal = {point.first, from};
  available_ = true;
}

bool HappensBefore::followed(const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms) const {
  const bool feeds = fact.kind == SyncFact::Kind::feeds;
  if ((fact.kind != SyncFact::Kind::follows && !feeds) || !available_) return false;
  // What has come that far goes on into the barrier.
  const Stages met = lanes_[fact.queue].reached & (feeds ? scopes[fact.scope].src_earlier : fact.stages);
  if (met && feeds) explain({fact.scope, index_of_bit(met & scopes[fact.scope].src ? met & scopes[fact.scope].src : met)}, source, atoms);
  if (met && !feeds) explain_stage(fact.queue, index_of_bit(met), source, atoms);
  return met != 0;
}

bool HappensBefore::fed(const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms) const {
  uint8_t from = kSource;
  if (!enters(scopes[fact.scope], true, source, from)) return false;
  explain({fact.scope, from}, source, atoms);
  return true;
}

// A quick look ahead: a write becomes available in barriers on its cell and signals.
bool HappensBefore::can_begin(const SyncFact& fact, const SyncSource& source) const {
  if (fact.kind == SyncFact::Kind::feeds && scopes[fact.scope].src_earlier == 0) return false;
  return source.kind != SyncSource::Kind::write || waits_on_.size() > 1 || fact.before > end() ||
         (!local_.empty() && scopes[local_.front()].point < fact.before);
}

// Nothing sees a write but barriers on its cell, waits, and its own transition.
bool HappensBefore::can_sink(const SyncFact& fact, const SyncSource& source) const {
  if (!waits_on_[fact.queue].empty() || fact.before > end()) return true;
  const auto between = on_cell_between(source.cell, source.after, fact.before);
  return std::any_of(between.begin(), between.end(),
                     [&](uint32_t s) {
                       const SyncScope& scope = scopes[s];
                       return !scope.gone && !scope.transfers && (scope.dst & fact.stages) && (scope.dst_accesses & fact.access);
                     }) ||
         source.kind == SyncSource::Kind::transition;
}

bool HappensBefore::derive(const SyncFact& fact, std::vector<SyncAtom>& atoms) {
  for (const SyncFact* one = &fact;; one = &alternatives[one->also]) {
    atoms.clear();
    if (derive_alone(*one, atoms)) return true;
    if (one->also == UINT32_MAX) return false;
  }
}

// The usual case: one barrier between the two.
bool HappensBefore::derive_directly(const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms) {
  using Kind = SyncSource::Kind;
  if (source.kind != Kind::read && source.kind != Kind::write) return false;
  const auto leads = [&](uint32_t s) {
    const SyncScope& scope = scopes[s];
    if (scope.gone || scope.queue != source.queue || scope.point < source.after || (scope.transfers && fact.kind != SyncFact::Kind::feeds))
      return false;
    if (source.kind == Kind::read) return (scope.src_earlier & source.stage) != 0;
    return (scope.src & source.stage) && (scope.src_accesses & source.access);
  };
  const auto found = [&](uint32_t s, Stages target) {
    if (target) atoms.push_back({s, AtomField::dst_stage, bit_that_holds(scopes[s].dst, target, with_later)});
    explain({s, kSource}, source, atoms);
    return true;
  };
  if (fact.kind == SyncFact::Kind::feeds) return leads(fact.scope) && found(fact.scope, 0);
  if (fact.queue != source.queue || fact.before > end()) return false;
  for (const uint32_t s : on_cell_between(source.cell, source.after, fact.before)) {
    const SyncScope& scope = scopes[s];
    if (!leads(s)) continue;
    if (fact.kind == SyncFact::Kind::sees && (scope.dst & fact.stages) && (scope.dst_accesses & fact.access)) {
      add_sink(s, fact, atoms);
      return found(s, 0);
    }
    if (fact.kind == SyncFact::Kind::follows && (scope.dst_later & fact.stages))
      return found(s, scope.dst_later & fact.stages & ~((scope.dst_later & fact.stages) - 1));
  }
  return false;
}

bool HappensBefore::derive_alone(const SyncFact& fact, std::vector<SyncAtom>& atoms) {
  const SyncSource& source = sources[fact.source];
  if (derive_directly(fact, source, atoms)) return true;
  start(source);
  const bool sees = fact.kind == SyncFact::Kind::sees;
  if (sees && source.kind == SyncSource::Kind::transition && source.queue == fact.queue && (scopes[source.scope].dst & fact.stages) &&
      (scopes[source.scope].dst_accesses & fact.access)) {
    add_sink(source.scope, fact, atoms);
    return true;
  }
  if (!can_begin(fact, source) || (sees && !can_sink(fact, source))) return false;
  if (followed(fact, source, atoms)) return true;
  uint32_t cell = source.cell;
  for (uint32_t p = source.after; p < fact.before; ++p) {
    if (p == (frame_ + 1) * end()) ++frame_, start_frame(cell = next_cell_[cell], 0);
    const Point& point = points_[p - frame_ * end()];
    if (point.count == 0) continue;
    if (point.kind == SyncKind::barrier && pass_barriers(point, fact, source, atoms)) return true;
    if (point.kind == SyncKind::wait && pass_waits(point, fact, source, atoms)) return true;
    if (point.kind == SyncKind::signal) pass_signal(point, source);
  }
  return fact.kind == SyncFact::Kind::feeds && fed(fact, source, atoms);
}

// ---- what a derivation rests on -----------------------------------------------------------------------------------

void HappensBefore::add_sink(uint32_t index, const SyncFact& fact, std::vector<SyncAtom>& atoms) const {
  const SyncScope& scope = scopes[index];
  const Stages stage = fact.kind == SyncFact::Kind::host ? stage::host : fact.stages;
  atoms.push_back({index, AtomField::whole, 0});
  atoms.push_back({index, AtomField::dst_stage, index_of_bit(stage)});
  if (scope.kind == SyncKind::barrier) atoms.push_back({index, AtomField::dst_access, index_of_bit(fact.access)});
}

void HappensBefore::explain(const Reason& reason, const SyncSource& source, std::vector<SyncAtom>& atoms) const {
  if (reason.scope == UINT32_MAX) return;
  const SyncScope& scope = scopes[reason.scope];
  atoms.push_back({reason.scope, AtomField::whole, 0});
  if (reason.from == kOwnScope) return;
  if (reason.from == kSignal) {
    atoms.push_back({reason.scope, AtomField::value, 0});
    return explain(lanes_[scope.from_queue].signal, source, atoms);
  }
  const Stages stage = reason.from == kSource ? source.stage : bit_of(reason.from);
  if (!scope.everything && source.kind != SyncSource::Kind::batch)
    atoms.push_back({reason.scope, AtomField::src_stage, bit_that_holds(scope.src, stage, with_earlier)});
  if (reason.from == kSource) {
    if (source.kind == SyncSource::Kind::write && scope.kind == SyncKind::barrier)
      atoms.push_back({reason.scope, AtomField::src_access, index_of_bit(source.access)});
    if (source.kind == SyncSource::Kind::transition) atoms.push_back({source.scope, AtomField::whole, 0});
    if (source.kind != SyncSource::Kind::batch) return;
  }
  explain_stage(scope.queue, source.kind == SyncSource::Kind::batch ? 0 : reason.from, source, atoms);
}

void HappensBefore::explain_stage(uint32_t queue, uint8_t stage, const SyncSource& source, std::vector<SyncAtom>& atoms) const {
  const Reason& reason = lanes_[queue].reasons[stage];
  if (reason.scope == UINT32_MAX) return;
  if (source.kind != SyncSource::Kind::batch)
    atoms.push_back({reason.scope, AtomField::dst_stage, bit_that_holds(scopes[reason.scope].dst, bit_of(stage), with_later)});
  explain(reason, source, atoms);
}

}  // namespace rg::compiler
