#include "compiler/synchronise.h"

#include <algorithm>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

// One side of a barrier: what happened, or what comes.
struct Side {
  Effect effect;
  bool writes = false;
  bool defined = true;  // holds contents
  bool needs = false;   // as the later side: depends on contents
  std::vector<Event> events;
  bool skippable = false;  // every use may be skipped, so that what came before meets what comes after
  Effect seen = {};        // as the later side: reads the contents are already visible to
};

const char* hazard_name(const Side& from, const Side& to, bool discards) {
  if (!from.defined && !from.writes && from.effect.reads == 0) return "first use";
  if (discards && !to.needs) return from.writes ? "write after write, contents discarded" : "write after read, contents discarded";
  if (from.writes) return to.needs ? "read after write" : "write after write";
  return to.writes ? "write after read" : "layout";
}

bool is_subset(uint64_t part, uint64_t whole) { return (part & ~whole) == 0; }

// Adds the stages and reads that `seen` lacks.
void add_unseen(Stages stages, Accesses accesses, const Effect& seen, Effect& unseen) {
  for (Stages rest = stages; rest; rest &= rest - 1) {
    const Stages stage = rest & ~(rest - 1);
    const Accesses reads = accesses & supported_accesses(stage) & ~((seen.read_stages & stage) ? seen.reads : 0);
    unseen.reads |= reads;
    if (reads) unseen.read_stages |= stage;
  }
}
// Use by use, because what two of them do together is more than what both do.
Effect not_seen(const Side& side) {
  Effect unseen;
  if (side.events.empty()) add_unseen(side.effect.read_stages, side.effect.reads, side.seen, unseen);
  for (const Event& event : side.events) add_unseen(event.read_stages, event.reads, side.seen, unseen);
  return unseen;
}

class Synchroniser {
 public:
  Synchroniser(const Frame& frame, const Schedule& schedule, const PlanOptions& options) : frame_(frame), schedule_(schedule), options_(options) {
    sync_.groups.resize(schedule.segments + 1);
  }

  SyncPlan run(const std::vector<Line>& lines) {
    find_first_segments(lines);
    for (const Line& line : lines) {
      switch (frame_.resource_of(line.cell).lifetime) {
        case dsl::Lifetime::transient:
          transient(line);
          break;
        case dsl::Lifetime::history:
        case dsl::Lifetime::persistent:
          circle(line);
          break;
        case dsl::Lifetime::imported:
          imported(line);
          break;
        case dsl::Lifetime::readback:
          readback(line);
          break;
      }
    }
    place_exits();
    return std::move(sync_);
  }

 private:
  Side side_of(uint32_t cell, const Epoch& epoch, bool defined) const {
    const bool skippable =
        std::all_of(epoch.events.begin(), epoch.events.end(), [&](const Event& event) { return may_skip(frame_, event.pass, frame_.cells[cell]); });
    return {epoch.covered, epoch.writes, defined, epoch.needs, epoch.events, skippable, {}};
  }

  bool is_image(uint32_t cell) const { return frame_.resource_of(cell).kind == dsl::ResourceKind::image; }
  uint32_t cell_at(const Line& line, uint32_t age) const { return line.cell + age * frame_.grids[frame_.cells[line.cell].resource].cells_per_age(); }

  void find_first_segments(const std::vector<Line>& lines) {
    first_segment_.assign(frame_.graph->resources.size(), UINT32_MAX);
    for (const Line& line : lines) {
      uint32_t& first = first_segment_[frame_.cells[line.cell].resource];
      for (const Epoch& epoch : line.epochs) first = std::min(first, epoch.first_segment);
    }
  }

  // ---- one barrier ------------------------------------------------------------------------------------------------

  CellBarrier connect(uint32_t cell, const Side& from, const Side& to) const {
    CellBarrier b;
    b.cell = cell, b.range = frame_.cells[cell].range, b.begin = frame_.cells[cell].begin, b.end = frame_.cells[cell].end;
    // Where readers of the same layout come before, execution alone is enough: a discard would make a transition of it.
    const bool worthwhile = from.writes || from.effect.layout != to.effect.layout;
    const bool discards = is_image(cell) && (!from.defined || (options_.discard && !to.needs && worthwhile));
    if (is_image(cell)) b.old_layout = discards ? Layout::undefined : from.effect.layout, b.new_layout = to.effect.layout;
    const bool new_layout = is_image(cell) && (b.old_layout != b.new_layout);
    const bool rewrites = to.writes || new_layout;  // waits for readers too

    b.src_accesses = from.effect.writes;
    b.src_stages = from.effect.write_stages;
    if (rewrites || !from.writes) b.src_stages |= latest_stages(from.effect.read_stages | from.effect.write_stages) & ~from.effect.write_stages;
    fill_second_scope(b, from, to, new_layout);
    b.sources = from.events;
    b.wraps = std::any_of(from.events.begin(), from.events.end(), [](const Event& event) { return event.earlier_frame; });
    b.reason = hazard_name(from, to, discards);
    return b;
  }

  static void fill_second_scope(CellBarrier& b, const Side& from, const Side& to, bool new_layout) {
    const Effect& e = to.effect;
    if (from.writes || new_layout) {
      b.dst_stages = e.stages(), b.dst_accesses = e.reads | e.writes;
      return;
    }
    // Contents made available before, not yet visible to all reads of this one.
    const Effect unseen = to.seen.reads ? not_seen(to) : e;
    const bool visible = unseen.reads == 0 || (is_subset(e.reads, from.effect.reads) && is_subset(e.read_stages, from.effect.read_stages));
    if (to.needs && from.defined && !visible)
      b.dst_stages = unseen.read_stages | earliest_stages(e.write_stages), b.dst_accesses = unseen.reads;
    else
      b.dst_stages = earliest_stages(to.writes ? e.write_stages : e.stages());
    // Without the readers in between this is a write after the write before them: made available by the barrier that serves them, not yet visible.
    if (from.skippable && to.writes) b.dst_stages |= e.write_stages, b.dst_accesses |= e.writes;
  }

  // Nothing to order and nothing to change.
  bool is_void(const CellBarrier& b) const { return b.src_stages == 0 && b.old_layout == b.new_layout; }

  void add(uint32_t group, CellBarrier barrier) {
    if (is_void(barrier)) return;
    barrier.first_use = std::max(barrier.first_use, group);
    sync_.groups[group].push_back(std::move(barrier));
  }

  // ---- within a frame -----------------------------------------------------------------------------------------------

  // Barriers between neighbouring epochs; gives whether contents are defined at the end. `seen`: what contents from before the frame are visible to,
  // as long as nothing has changed them.
  bool connect_within(const Line& line, bool defined, const Effect* seen = nullptr) {
    for (size_t i = 0; i < line.epochs.size(); ++i) {
      const Epoch& to = line.epochs[i];
      if (i > 0) {
        Side from = side_of(line.cell, line.epochs[i - 1], defined), next = side_of(line.cell, to, true);
        if (seen) from.skippable = false, next.seen = *seen;
        add(to.first_segment, connect(cell_at(line, to.age), from, next));
      }
      if (to.writes || to.effect.layout != line.epochs.front().effect.layout) seen = nullptr;
      defined = defined || to.writes;
    }
    return defined;
  }

  // ---- lifetimes ----------------------------------------------------------------------------------------------------

  void transient(const Line& line) {
    const uint32_t resource = frame_.cells[line.cell].resource, group = first_segment_[resource];
    Side last = side_of(line.cell, line.epochs.back(), false);
    for (Event& event : last.events) event.earlier_frame = true;
    CellBarrier acquire = connect(line.cell, last, side_of(line.cell, line.epochs.front(), true));
    acquire.is_acquire = true;
    acquire.first_use = line.epochs.front().first_segment;
    add(group, std::move(acquire));
    connect_within(line, false);
    note_hand_over(resource, group, line.epochs.front().effect, line.epochs.back().effect);
    boundary(sync_.entry, line.cell, last.effect, last.writes, Layout::undefined, true);
    boundary(sync_.exit, line.cell, last.effect, last.writes, last.effect.layout, true);
  }

  void note_hand_over(uint32_t resource, uint32_t group, const Effect& first, const Effect& last) {
    if (sync_.acquires.empty() || sync_.acquires.back().resource != resource) {
      sync_.acquires.push_back({resource, group, kNone, 0, 0, 0});
      sync_.releases.push_back({resource, 0, 0});
    }
    sync_.acquires.back().stages |= first.stages(), sync_.acquires.back().accesses |= first.reads | first.writes;
    sync_.releases.back().stages |= last.write_stages | latest_stages(last.stages());
    sync_.releases.back().accesses |= last.writes;
  }

  // History and persistent: the state at the end of one age is the state at the start of the next.
  void circle(const Line& line) {
    const auto& epochs = line.epochs;
    for (size_t i = 0; i < epochs.size(); ++i) {
      const Epoch &from = epochs[(i + epochs.size() - 1) % epochs.size()], &to = epochs[i];
      if (continues(from, to)) continue;
      Side before = with_continued_reads(line, i);
      before.defined = i > 0 || !is_dead_at_entry(line);
      add(to.first_segment, connect(cell_at(line, to.age), before, side_of(line.cell, to, true)));
    }
    state_circle(line);
  }

  // The oldest copy of a history becomes the current one, and nobody needs what is in it.
  bool is_dead_at_entry(const Line& line) const {
    const Epoch& first = line.epochs.front();
    return options_.discard && first.age == 0 && !first.needs && frame_.grids[frame_.cells[line.cell].resource].ages > 1;
  }

  // At each age's exit the last epoch so far with all reads it continues; that is the state at the entry of the next age.
  void state_circle(const Line& line) {
    const uint32_t ages = frame_.grids[frame_.cells[line.cell].resource].ages;
    const bool dead = is_dead_at_entry(line);
    Side state = with_continued_reads(line, 0);
    size_t next = 0;
    for (uint32_t age = 0; age < ages; ++age) {
      boundary(sync_.entry, cell_at(line, age), state.effect, state.writes, age == 0 && dead ? Layout::undefined : state.effect.layout,
               age == 0 && dead);
      for (; next < line.epochs.size() && line.epochs[next].age == age; ++next) state = with_continued_reads(line, next + 1);
      boundary(sync_.exit, cell_at(line, age), state.effect, state.writes, state.effect.layout, age + 1 == ages && dead);
    }
  }

  // The epoch before epochs[i] with the reads it continues over frame boundaries: whoever writes next waits for all of them.
  Side with_continued_reads(const Line& line, size_t i) const {
    const size_t n = line.epochs.size();
    const auto at = [&](size_t back) {
      const size_t from = (i + n - back) % n;
      Side side = side_of(line.cell, line.epochs[from], true);
      const bool earlier = i == n || from >= i || line.epochs[from].age != line.epochs[i].age;
      for (Event& event : side.events) event.earlier_frame = earlier;
      return side;
    };
    Side side = at(1);
    for (size_t back = 2; back <= n && continues(line.epochs[(i + n - back) % n], line.epochs[(i + n - back + 1) % n]); ++back) {
      const Side before = at(back);
      merge(side.effect, before.effect);
      side.events.insert(side.events.end(), before.events.begin(), before.events.end());
      side.skippable = side.skippable && before.skippable;
    }
    return side;
  }

  void imported(const Line& line) {
    const dsl::Resource& resource = frame_.resource_of(line.cell);
    const uint32_t aspect = frame_.cells[line.cell].range.aspects;
    const Side before = state_before(resource, aspect, line.epochs.front());
    const Effect after = effect_of(resource.after, aspect);
    Line whole = line;
    cover_after(whole, before, after);
    enter(whole, before);
    const bool defined = connect_within(whole, before.defined, settled(before, whole.epochs.front()) ? &before.effect : nullptr);
    const Epoch& last = whole.epochs.back();
    boundary(sync_.entry, line.cell, before.effect, before.writes, before.effect.layout, !before.defined);
    if (resource.after.role == dsl::Role::undefined) {
      boundary(sync_.exit, line.cell, last.effect, last.writes, last.effect.layout, true);
      return;
    }
    if (!continues_after(last, after)) leave(whole, before, after, defined);
    boundary(sync_.exit, line.cell, after, after.writes != 0, after.layout, false);
  }

  void enter(const Line& line, const Side& before) {
    const Epoch& first = line.epochs.front();
    if (is_visible(before, first)) return;
    Side to = side_of(line.cell, first, true);
    if (before.defined && !before.writes) to.seen = before.effect;
    add(first.first_segment, connect(line.cell, before, to));
  }

  void leave(const Line& line, const Side& before, const Effect& after, bool defined) {
    const Epoch& last = line.epochs.back();
    Side next{after, after.writes != 0, true, true, {}, false, {}};
    const bool untouched = std::all_of(line.epochs.begin(), line.epochs.end(), [&](const Epoch& epoch) { return settled(before, epoch); });
    if (untouched)
      next.seen = before.effect;
    else if (!last.writes && last.effect.layout == after.layout)
      next.seen = last.covered;
    exits_.push_back({last.last_segment + 1, connect(line.cell, unnamed(side_of(line.cell, last, defined), after), next)});
  }

  // The epoch leaves contents and layout as they came.
  static bool settled(const Side& before, const Epoch& epoch) {
    return before.defined && !before.writes && !epoch.writes && epoch.effect.layout == before.effect.layout;
  }

  // Contents of unknown state are worthless. A presented image is handed over by a semaphore, waited for at its first use; another one is ordered
  // after whatever `after` says was done with it.
  Side state_before(const dsl::Resource& resource, uint32_t aspect, const Epoch& first) const {
    Side side{effect_of(resource.before, aspect), false, true, true, {}, false, {}};
    side.writes = side.effect.writes != 0;
    side.events = {{0, side.effect.stages(), UINT32_MAX, 0, 0, true}};
    if (resource.before.role != dsl::Role::undefined) return side;
    side.defined = false;
    const Effect after = effect_of(resource.after, aspect);
    side.effect = {after.stages() ? after.stages() : first.effect.stages(), 0, 0, 0, Layout::undefined};
    side.events = {{0, side.effect.stages(), UINT32_MAX, 0, 0, true}};
    return side;
  }

  // Reads that the frame ends with and reads that come after it share a barrier: the one in front of them, if the frame has it.
  static void cover_after(Line& line, const Side& before, const Effect& after) {
    Epoch& last = line.epochs.back();
    const bool has_barrier = line.epochs.size() > 1 || !is_visible(before, last);
    if (!has_barrier || !continues_after(last, after)) return;
    merge(last.covered, after);
    last.events.push_back({last.last_segment, 0, last.events.back().pass, after.read_stages, after.reads});
  }
  // Whoever waits for the state after the frame waits for these reads, too.
  static bool continues_after(const Epoch& last, const Effect& after) {
    return !last.writes && after.writes == 0 && after.layout == last.effect.layout && is_subset(last.effect.stages(), with_earlier(after.stages()));
  }

  // Reads that the state after the frame names anyway need no barrier at its end.
  static Side unnamed(Side last, const Effect& after) {
    if (last.writes || after.writes || last.effect.layout != after.layout) return last;
    last.effect.read_stages &= ~with_earlier(after.stages());
    for (Event& event : last.events) event.stages &= ~with_earlier(after.stages());
    return last;
  }

  static bool is_visible(const Side& before, const Epoch& first) {
    const Effect &b = before.effect, &f = first.effect;
    return settled(before, first) && is_subset(f.reads, b.reads) && is_subset(f.read_stages, b.read_stages);
  }

  // The host is one more reader of the last version.
  void readback(const Line& line) {
    Effect host;
    host.read_stages = stage::host, host.reads = access::host_read;
    Line whole = line;
    Epoch& last = whole.epochs.back();
    const bool joins = !last.writes && whole.epochs.size() > 1;
    if (joins) merge(last.covered, host);
    connect_within(whole, false);
    if (!joins)
      exits_.push_back({last.last_segment + 1, connect(line.cell, side_of(line.cell, last, true), {host, false, true, true, {}, false, {}})});
    boundary(sync_.entry, line.cell, {}, false, Layout::undefined, true);
    boundary(sync_.exit, line.cell, host, false, Layout::undefined, false);
  }

  // ---- the frame's end ----------------------------------------------------------------------------------------------

  // Together in the closing group where one needs it, else in the last group there is.
  void place_exits() {
    const uint32_t end = schedule_.segments;
    const bool closes = std::any_of(exits_.begin(), exits_.end(), [&](const Exit& exit) { return exit.earliest_group == end; });
    for (Exit& exit : exits_) add(closes ? end : end - 1, std::move(exit.barrier));
  }

  static void boundary(std::vector<CellBoundary>& rows, uint32_t cell, const Effect& effect, bool writes, Layout layout, bool discard) {
    Boundary row;
    row.stages = effect.stages(), row.layout = layout, row.queue = 0, row.discard = discard;
    if (writes || !discard) row.accesses = writes ? effect.writes : effect.reads;
    rows.push_back({cell, row});
  }

  struct Exit {
    uint32_t earliest_group = 0;
    CellBarrier barrier;
  };
  const Frame& frame_;
  const Schedule& schedule_;
  const PlanOptions& options_;
  SyncPlan sync_;
  std::vector<uint32_t> first_segment_;  // by program resource
  std::vector<Exit> exits_;
};

}  // namespace

SyncPlan synchronise(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, const PlanOptions& options) {
  SyncPlan sync = Synchroniser(frame, schedule, options).run(lines);
  for (std::vector<CellBarrier>& group : sync.groups) merge_ranges(frame, group);
  drop_implied(sync);
  return sync;
}

}  // namespace rg::compiler
