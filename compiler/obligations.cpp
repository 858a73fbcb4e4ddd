#include "compiler/obligations.h"

#include <algorithm>
#include <set>
#include <span>

#include "compiler/access_table.h"

namespace rg::compiler {
namespace {

constexpr Accesses kWrites = access::shader_write | access::shader_storage_write | access::color_attachment_write |
                             access::depth_stencil_attachment_write | access::transfer_write | access::host_write;

template <class Visit>
void each_bit(uint64_t mask, Visit visit) {
  for (; mask; mask &= mask - 1) visit(mask & ~(mask - 1));
}

struct Visible {
  uint32_t queue = 0;
  Stages stages = 0;
  Accesses accesses = 0;
};
// What later accesses have to wait for.
struct Pending {
  uint32_t source = 0, queue = 0;
  Stages stage = 0;
  Accesses access = 0;  // of a write
  uint32_t segment = UINT32_MAX, pass = UINT32_MAX;
  const Epoch* epoch = nullptr;
  bool read_since = false;            // of a write: by a pass that always runs
  uint32_t read_in = UINT32_MAX;      // by one of this segment, at first
  const Epoch* read_by = nullptr;     // and of this run of uses that commute
  bool carried = false;               // a write of an earlier frame that rows say no more of
  std::vector<Visible> visible = {};  // of a write, from the start
};
struct CellState {
  std::vector<Pending> reads, writes;
};

using Rows = std::span<const CellBoundary>;

// Facts about a write that an earlier frame has left, and what of it is left at the end of this one.
struct Carried {
  std::vector<uint32_t> facts;    // indices
  std::vector<uint32_t> sources;  // at the end: of the writes that nobody has read
  uint32_t settled = UINT32_MAX;  // the source at the start
};

class CellWalk {
 public:
  CellWalk(const Frame& frame, const Schedule& schedule, uint32_t cell, HappensBefore& order, Obligations& found, std::set<uint32_t>& needed,
           bool shared)
      : frame_(frame), schedule_(schedule), cell_(cell), order_(order), found_(found), needed_(needed), shared_(shared) {}

  // `unread`: the readers that the rows name may all have been skipped.
  void enter(Rows rows, bool signalled, bool unread) {
    Pending settled{add_source({SyncSource::Kind::settled, cell_, 0, 0, 0, 0, 0, signalled, {}}),
                    0,
                    0,
                    0,
                    UINT32_MAX,
                    UINT32_MAX,
                    nullptr,
                    !unread,
                    UINT32_MAX,
                    nullptr,
                    unread,
                    {}};
    if (!rows.empty()) layout_ = rows.front().row.layout, owner_ = rows.front().row.discard ? kNone : rows.front().row.queue;
    bool writes = false, any = false;
    for (const auto& named : rows) {
      const auto& row = named.row;  // a binding is not for lambdas, before clang 16
      if (row.stages == 0) continue;
      any = true;
      order_.sources[settled.source].reached.emplace_back(row.queue, row.stages);
      order_.sources[settled.source].queue = row.queue;
      settled.visible.push_back({row.queue, row.stages, row.accesses & ~kWrites});
      each_bit(row.stages, [&](Stages stage) {
        add_read(state_, row.queue, stage, 0, signalled);
        each_bit(row.accesses & kWrites & supported_accesses(stage), [&](Accesses access) {
          add_write(state_, row.queue, stage, access, 0, signalled);
          writes = true;
        });
      });
    }
    if (any && !writes) {
      if (unread) carried_.settled = settled.source;
      state_.writes.push_back(std::move(settled));
    }
  }

  // Memory that an acquire takes over holds a write before the first users.
  void hand_over(const Acquire& acquire, uint32_t queue) {
    const uint32_t point = order_.point_of_slot(acquire.group) + 1;
    Pending write{add_source({SyncSource::Kind::settled, cell_, queue, point, 0, 0, 0, false, {{queue, with_later(acquire.stages)}}}), queue, 0, 0};
    write.visible = {{queue, acquire.stages, acquire.accesses}};
    state_.writes.push_back(std::move(write));
  }

  void use(const Event& event, const Epoch& epoch) {
    const uint32_t point = order_.point_of_slot(schedule_.slot_before(event.segment)) + 1;
    owner_ = event.queue;
    check(state_, event, epoch, point, found_.facts);
    record(state_, event, epoch, point);
    if (skipping_ == UINT32_MAX) return;
    check(without_, event, epoch, point, found_.without[skipping_]);
    record(without_, event, epoch, point);
    if (event.effect.writes && epoch.share == Share::none && !may_skip(frame_, event.pass, frame_.cells[cell_])) skipping_ = UINT32_MAX;
  }

  // A change of layout or owner.
  void change(uint32_t scope) {
    const SyncScope& row = order_.scopes[scope];
    feed(state_, scope, found_.facts);
    if (skipping_ != UINT32_MAX) feed(without_, scope, found_.without[skipping_]);
    skipping_ = UINT32_MAX;
    const bool keeps_owner = shared_ || owner_ == row.queue;
    if (!row.transfers && row.old_layout == Layout::undefined && row.new_layout == layout_ && keeps_owner) {
      skipping_ = scope, without_ = state_;
      found_.without.try_emplace(scope);
    } else {
      needed_.insert(scope);
    }
    layout_ = row.new_layout, owner_ = row.queue;
    if (row.transfers && !giving_) {
      before_release_ = state_, giving_ = true;
    } else if (row.transfers) {
      feed(before_release_, scope, found_.facts);
      giving_ = false;
    }
    state_ = {};
    state_.writes.push_back({add_source({SyncSource::Kind::transition, cell_, row.queue, row.point + 1, 0, 0, scope, false, {}}), row.queue});
  }

  void leave(Rows rows) {
    leave(state_, rows, found_.facts);
    if (skipping_ != UINT32_MAX) leave(without_, rows, found_.without[skipping_]);
    for (const Pending& write : state_.writes)
      if (!write.read_since) carried_.sources.push_back(write.source);
    if (frame_.resource_of(cell_).lifetime != dsl::Lifetime::transient) return;
    for (const Pending& read : state_.reads) found_.last_uses.push_back(read.source);
    for (const Pending& write : state_.writes) found_.last_uses.push_back(write.source);
  }
  void show_host() {
    for (const Pending& write : state_.writes)
      found_.facts.push_back({SyncFact::Kind::host, write.source, order_.end(), 0, stage::host, access::host_read, 0, UINT32_MAX});
  }
  const Carried& carried() const { return carried_; }

 private:
  uint32_t add_source(SyncSource source) {
    order_.sources.push_back(std::move(source));
    return static_cast<uint32_t>(order_.sources.size()) - 1;
  }
  Pending& add_read(CellState& state, uint32_t queue, Stages stage, uint32_t after, bool signalled) {
    if (state.reads.capacity() == 0) state.reads.reserve(4);
    state.reads.push_back({add_source({SyncSource::Kind::read, cell_, queue, after, stage, 0, 0, signalled, {}}), queue, stage});
    return state.reads.back();
  }
  Pending& add_write(CellState& state, uint32_t queue, Stages stage, Accesses access, uint32_t after, bool signalled) {
    if (state.writes.capacity() == 0) state.writes.reserve(4);
    state.writes.push_back({add_source({SyncSource::Kind::write, cell_, queue, after, stage, access, 0, signalled, {}}), queue, stage, access});
    return state.writes.back();
  }

  // Passes between which no barrier stands need none: they commute, or draw into one rendering.
  static bool together(const Pending& pending, const Event& event, const Epoch& epoch) {
    return pending.segment == event.segment || (epoch.share != Share::none && pending.epoch == &epoch);
  }
  static bool sees_already(const Pending& write, uint32_t queue, Stages stage, Accesses access) {
    return std::any_of(write.visible.begin(), write.visible.end(),
                       [&](const Visible& v) { return v.queue == queue && (v.stages & stage) && (v.accesses & access); });
  }

  void check(const CellState& state, const Event& event, const Epoch& epoch, uint32_t point, std::vector<SyncFact>& facts) {
    const Effect& effect = event.effect;
    each_bit(effect.stages(), [&](Stages stage) {
      const Accesses reads = effect.read_stages & stage ? effect.reads & supported_accesses(stage) : 0;
      const Accesses writes = effect.write_stages & stage ? effect.writes & supported_accesses(stage) : 0;
      for (const Pending& write : state.writes) {
        if (together(write, event, epoch)) continue;
        // The readers of the same rendering are not waited for, nor those that commute.
        const bool waits_for_readers = write.read_since && write.read_by != &epoch && write.read_in != event.segment;
        each_bit(reads | (waits_for_readers ? 0 : writes), [&](Accesses access) {
          if (sees_already(write, event.queue, stage, access)) return;
          if (write.carried && (access & kWrites) && &facts == &found_.facts) carried_.facts.push_back(static_cast<uint32_t>(facts.size()));
          // Tests behind a clear read what the clear wrote; that they see it comes with the clear's own barrier or not at all.
          const bool optional = epoch.writes && !epoch.needs && (access & kWrites) == 0;
          facts.push_back({SyncFact::Kind::sees, write.source, point, event.queue, stage, access, 0, UINT32_MAX, optional});
        });
      }
      for (const Pending& read : state.reads)
        if (writes && !together(read, event, epoch))
          facts.push_back({SyncFact::Kind::follows, read.source, point, event.queue, stage, 0, 0, UINT32_MAX});
    });
  }

  void record(CellState& state, const Event& event, const Epoch& epoch, uint32_t point) {
    const Effect& effect = event.effect;
    const bool skips = may_skip(frame_, event.pass, frame_.cells[cell_]), commutes = epoch.share != Share::none && effect.writes != 0;
    if (effect.read_stages && !skips)
      for (Pending& write : state.writes) {
        if (write.read_since || write.pass == event.pass || together(write, event, epoch)) continue;
        write.read_since = true, write.read_in = event.segment, write.read_by = epoch.share != Share::none ? &epoch : nullptr;
      }
    if (effect.writes && !skips && !commutes) state = {};
    each_bit(effect.read_stages, [&](Stages stage) {
      if ((effect.reads & supported_accesses(stage)) == 0) return;
      // Whoever waits for a write of the stage waits for what it reads, too.
      if ((effect.write_stages & stage) && (effect.writes & supported_accesses(stage))) return;
      // Who writes later in the same rendering waits for the earlier read, and not for this one.
      std::erase_if(state.reads, [&](const Pending& read) {
        return read.queue == event.queue && read.stage == stage && (!epoch.writes || together(read, event, epoch));
      });
      note(add_read(state, event.queue, stage, point, false), event, epoch);
    });
    each_bit(effect.write_stages, [&](Stages stage) {
      each_bit(effect.writes & supported_accesses(stage), [&](Accesses access) {
        std::erase_if(state.writes, [&](const Pending& write) {
          return write.queue == event.queue && write.stage == stage && write.access == access && (!commutes || write.epoch == &epoch);
        });
        note(add_write(state, event.queue, stage, access, point, false), event, epoch);
      });
    });
  }
  static void note(Pending& pending, const Event& event, const Epoch& epoch) {
    pending.segment = event.segment, pending.pass = event.pass, pending.epoch = &epoch;
  }

  void feed(const CellState& state, uint32_t scope, std::vector<SyncFact>& facts) {
    const SyncFact fact{SyncFact::Kind::feeds, 0, order_.scopes[scope].point, order_.scopes[scope].queue, 0, 0, scope, UINT32_MAX};
    for (const Pending& read : state.reads) facts.push_back(fact), facts.back().source = read.source;
    for (const Pending& write : state.writes)
      if (!write.read_since) facts.push_back(fact), facts.back().source = write.source;
  }

  // ---- the frame's end --------------------------------------------------------------------------------------------

  void leave(const CellState& state, Rows rows, std::vector<SyncFact>& facts) {
    for (const Pending& read : state.reads) leave_read(read, rows, facts);
    for (const Pending& write : state.writes) leave_write(write, rows, facts);
  }

  void follow_one_of(uint32_t source, const std::vector<Visible>& stages, std::vector<SyncFact>& facts) {
    uint32_t next = UINT32_MAX;
    for (size_t i = stages.size(); i-- > 1;) {
      order_.alternatives.push_back({SyncFact::Kind::follows, source, order_.end(), stages[i].queue, stages[i].stages, 0, 0, next});
      next = static_cast<uint32_t>(order_.alternatives.size()) - 1;
    }
    if (!stages.empty()) facts.push_back({SyncFact::Kind::follows, source, order_.end(), stages[0].queue, stages[0].stages, 0, 0, next});
  }

  void leave_read(const Pending& read, Rows rows, std::vector<SyncFact>& facts) {
    std::vector<Visible> wanted;
    for (const auto& [cell, row] : rows) {
      wanted.push_back({row.queue, with_earlier(row.stages), 0});
      if (row.queue == read.queue && (wanted.back().stages & read.stage)) return;
    }
    follow_one_of(read.source, wanted, facts);
  }

  void leave_write(const Pending& write, Rows rows, std::vector<SyncFact>& facts) {
    std::vector<Visible> wanted;
    for (const auto& named : rows) {
      const auto& row = named.row;  // a binding is not for lambdas, before clang 16
      if (write.stage && row.queue == write.queue && (row.stages & write.stage) && (row.accesses & write.access)) return;
      Stages writers = 0;
      each_bit(row.stages, [&](Stages stage) { writers |= row.accesses & kWrites & supported_accesses(stage) ? stage : 0; });
      if (writers) wanted.push_back({row.queue, with_earlier(writers), 0});
    }
    if (!wanted.empty()) return follow_one_of(write.source, wanted, facts);
    for (const auto& [cell, row] : rows)
      each_bit(row.stages, [&, &row = row](Stages stage) {
        follow_one_of(write.source, {{row.queue, with_earlier(stage), 0}}, facts);
        if (!row.discard)
          each_bit(row.accesses & ~kWrites & supported_accesses(stage), [&](Accesses access) {
            if (!sees_already(write, row.queue, stage, access))
              facts.push_back({SyncFact::Kind::sees, write.source, order_.end(), row.queue, stage, access, 0, UINT32_MAX});
          });
      });
  }

  const Frame& frame_;
  const Schedule& schedule_;
  uint32_t cell_;
  HappensBefore& order_;
  Obligations& found_;
  std::set<uint32_t>& needed_;  // transitions that some cell cannot be without
  CellState state_, before_release_;
  bool giving_ = false;
  bool shared_ = false;  // by all families
  Layout layout_ = Layout::undefined;
  uint32_t owner_ = kNone;          // queue
  uint32_t skipping_ = UINT32_MAX;  // the transition that `without_` leaves out
  CellState without_;
  Carried carried_;
};

class Finder {
 public:
  Finder(const Frame& frame, const Schedule& schedule, const SyncPlan& sync, HappensBefore& order)
      : frame_(frame),
        schedule_(schedule),
        order_(order),
        concurrent_(sync.concurrent),
        entry_(frame.cells.size()),
        exit_(entry_),
        acquire_of_(frame.graph->resources.size()),
        queue_of_slot_(schedule.queues_of_slots()) {
    index(sync.entry, entry_), index(sync.exit, exit_);
    for (const Acquire& acquire : sync.acquires)
      if (!frame.graph->resources.rows[acquire.resource].no_alias) acquire_of_[acquire.resource] = &acquire;
  }

  Obligations run(const std::vector<Line>& lines) {
    for (const Line& line : lines) {
      const Grid& grid = frame_.grids[frame_.cells[line.cell].resource];
      const auto each_age = [&](auto visit) {
        size_t next = 0;
        for (uint32_t age = 0; age < grid.ages; ++age) {
          const size_t first = next;
          while (next < line.epochs.size() && line.epochs[next].age == age) ++next;
          visit(line.cell + age * grid.cells_per_age(), std::span<const Epoch>{line.epochs.data() + first, next - first});
        }
      };
      bool unread = false;  // since the copy was written last
      each_age([&](uint32_t cell, std::span<const Epoch> epochs) { unread = stays_unread(cell, epochs, unread); });
      std::vector<Carried> by_age;
      each_age([&](uint32_t cell, std::span<const Epoch> epochs) {
        by_age.push_back(walk(cell, epochs, unread));
        unread = stays_unread(cell, epochs, unread);
      });
      for (size_t age = 0; age < by_age.size(); ++age) link_frames(by_age, age);
    }
    for (const uint32_t scope : needed_) found_.without.erase(scope);
    add_declared_order();
    return std::move(found_);
  }

 private:
  static void index(const std::vector<CellBoundary>& rows, std::vector<Rows>& by_cell) {
    for (size_t i = 0; i < rows.size();) {
      size_t end = i;
      while (end < rows.size() && rows[end].cell == rows[i].cell) ++end;
      by_cell[rows[i].cell] = {rows.data() + i, end - i};
      i = end;
    }
  }

  // Calls `change` and `use` in the order of the frame.
  void in_order(uint32_t cell, std::span<const Epoch> epochs, auto change, auto use) const {
    const std::span<const uint32_t> scopes = order_.on_cell(cell);
    size_t next = 0;
    const auto change_until = [&](uint32_t point) {
      for (; next < scopes.size() && order_.scopes[scopes[next]].point <= point; ++next)
        if (order_.scopes[scopes[next]].changes) change(scopes[next]);
    };
    for (const Epoch& epoch : epochs)
      for (const Event& event : epoch.events) {
        change_until(order_.point_of_slot(schedule_.slot_before(event.segment)));
        use(event, epoch);
      }
    change_until(order_.end());
  }

  bool stays_unread(uint32_t cell, std::span<const Epoch> epochs, bool unread) const {
    in_order(
        cell, epochs, [&](uint32_t) { unread = true; },
        [&](const Event& event, const Epoch&) {
          if (event.effect.read_stages && !may_skip(frame_, event.pass, frame_.cells[cell])) unread = false;
          if (event.effect.writes) unread = true;
        });
    return unread;
  }

  // Rows do not say all of a write that nobody may have read since: what sees it may do so by way of the frames in between. `back`: how many.
  void link_frames(const std::vector<Carried>& by_age, size_t age) {
    std::vector<std::pair<uint32_t, uint32_t>> sources;  // with `back`
    const auto collect = [&](const auto& self, uint32_t back) -> void {
      const Carried& before = by_age[(age + 2 * by_age.size() - back) % by_age.size()];
      for (const uint32_t source : before.sources) {
        if (source != before.settled)
          sources.emplace_back(source, back);
        else if (back < by_age.size())
          self(self, back + 1);
      }
    };
    collect(collect, 1);
    for (const uint32_t fact : by_age[age].facts) {
      const SyncFact from_rows = found_.facts[fact];
      for (size_t i = 0; i < sources.size(); ++i) {
        SyncFact earlier = from_rows;
        earlier.source = sources[i].first, earlier.before += sources[i].second * order_.end();
        order_.alternatives.push_back(earlier);
        if (i > 0) found_.facts.push_back(from_rows);
        (i > 0 ? found_.facts.back() : found_.facts[fact]).also = static_cast<uint32_t>(order_.alternatives.size()) - 1;
      }
    }
  }

  Carried walk(uint32_t cell, std::span<const Epoch> epochs, bool unread) {
    const dsl::Resource& resource = frame_.resource_of(cell);
    const bool imported = resource.lifetime == dsl::Lifetime::imported, readback = resource.lifetime == dsl::Lifetime::readback;
    CellWalk walk(frame_, schedule_, cell, order_, found_, needed_, concurrent_[frame_.cells[cell].resource]);
    if (!readback) walk.enter(entry_[cell], !imported, unread && !imported);
    const Acquire* acquire = resource.kind == dsl::ResourceKind::buffer ? acquire_of_[frame_.cells[cell].resource] : nullptr;
    if (acquire && !epochs.empty()) walk.hand_over(*acquire, queue_of_slot_[acquire->group]);
    in_order(
        cell, epochs, [&](uint32_t scope) { walk.change(scope); }, [&](const Event& event, const Epoch& epoch) { walk.use(event, epoch); });
    if (readback)
      walk.show_host();
    else
      walk.leave(exit_[cell]);
    return walk.carried();
  }

  // `after` across queues: a chain of waits, in whatever stages.
  void add_declared_order() {
    std::vector<uint32_t> position(frame_.graph->passes.size(), UINT32_MAX);
    for (const uint32_t pass : schedule_.order) position[frame_.passes[pass]] = pass;
    for (const uint32_t pass : schedule_.order)
      for (const dsl::PassId id : frame_.pass(pass).after) {
        const uint32_t before = position[id.value];
        if (before == UINT32_MAX || schedule_.queue_of_pass(before) == schedule_.queue_of_pass(pass)) continue;
        const auto point = [&](uint32_t of) { return order_.point_of_slot(schedule_.slot_before(schedule_.segment_of[of])); };
        order_.sources.push_back({SyncSource::Kind::batch, 0, schedule_.queue_of_pass(before), point(before) + 1, 0, 0, 0, false, {}});
        found_.facts.push_back({SyncFact::Kind::follows, static_cast<uint32_t>(order_.sources.size()) - 1, point(pass), schedule_.queue_of_pass(pass),
                                1, 0, 0, UINT32_MAX});
      }
  }

  const Frame& frame_;
  const Schedule& schedule_;
  HappensBefore& order_;
  const std::vector<bool>& concurrent_;     // by program resource
  std::vector<Rows> entry_, exit_;          // by cell
  std::vector<const Acquire*> acquire_of_;  // by program resource
  std::vector<uint32_t> queue_of_slot_;
  std::set<uint32_t> needed_;
  Obligations found_;
};

}  // namespace

Obligations find_obligations(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, const SyncPlan& sync,
                             HappensBefore& order) {
  return Finder(frame, schedule, sync, order).run(lines);
}

}  // namespace rg::compiler
