#include "compiler/synchronise.h"

#include <algorithm>

#include "compiler/gather_parts.h"
#include "compiler/queue_links.h"
#include "compiler/split_barriers.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

bool is_subset(uint64_t part, uint64_t whole) { return (part & ~whole) == 0; }

class Synchroniser {
 public:
  Synchroniser(const Frame& frame, const Schedule& schedule, const PlanOptions& options) : frame_(frame), schedule_(schedule), options_(options) {
    sync_.groups.resize(schedule.slots());
  }

  SyncPlan run(const std::vector<Line>& lines) {
    find_first_segments(lines);
    find_shared(lines);
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
    keep_declared_order();
    sync_.batches = reduce_waits(schedule_, needs_);
    return std::move(sync_);
  }

 private:
  Side side_of(uint32_t cell, const Epoch& epoch, bool defined) const {
    const bool skippable =
        std::all_of(epoch.events.begin(), epoch.events.end(), [&](const Event& event) { return may_skip(frame_, event.pass, frame_.cells[cell]); });
    return {epoch.covered, epoch.writes, defined, epoch.needs, epoch.events, skippable, {}};
  }

  uint32_t cell_at(const Line& line, uint32_t age) const { return line.cell + age * frame_.grids[frame_.cells[line.cell].resource].cells_per_age(); }

  void find_first_segments(const std::vector<Line>& lines) {
    first_segment_.assign(frame_.graph->resources.size(), UINT32_MAX);
    for (const Line& line : lines) {
      uint32_t& first = first_segment_[frame_.cells[line.cell].resource];
      for (const Epoch& epoch : line.epochs) first = std::min(first, epoch.first_segment);
    }
  }

  // What several queues use, and transients of which no use comes before all others.
  void find_shared(const std::vector<Line>& lines) {
    const size_t resources = frame_.graph->resources.size();
    sync_.concurrent.assign(resources, false), sync_.scattered.assign(resources, false);
    std::vector<uint32_t> user(resources, UINT32_MAX);
    for (const Line& line : lines) {
      const uint32_t r = frame_.cells[line.cell].resource;
      const bool buffer = frame_.resource_of(line.cell).kind == dsl::ResourceKind::buffer;
      const bool outlives = frame_.resource_of(line.cell).lifetime != dsl::Lifetime::transient;
      const uint32_t acquirer = schedule_.queue_of[first_segment_[r]];
      sync_.scattered[r] = sync_.scattered[r] || line.epochs.front().queue != acquirer;
      for (const Epoch& epoch : line.epochs) {
        if (user[r] == UINT32_MAX) user[r] = frame_.resource_of(line.cell).lifetime == dsl::Lifetime::imported ? 0 : epoch.queue;
        const bool several = epoch.queue == kSeveralQueues || ((buffer || outlives) && epoch.queue != user[r]);
        sync_.concurrent[r] = sync_.concurrent[r] || several;
      }
    }
  }

  // ---- one barrier ------------------------------------------------------------------------------------------------

  // Orders `to`, whose first user is in `segment`, after `from`. An acquire stands in front of `acquire`.
  void link(uint32_t cell, const Side& from, const Side& to, uint32_t segment, uint32_t acquire = UINT32_MAX) {
    if (schedule_.queues.size() > 1) {
      const std::vector<uint32_t> before = queues_of(from), after = queues_of(to);
      if (before.size() > 1 || after.size() > 1 || (!before.empty() && !after.empty() && before != after))
        return cross(frame_, schedule_, options_, {cell, from, to, acquire}, sync_, needs_);
    }
    CellBarrier b = connect(frame_, options_, cell, from, to);
    b.is_acquire = acquire != UINT32_MAX;
    add_barrier(sync_, schedule_.slot_before(b.is_acquire ? acquire : segment), std::move(b));
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
        link(cell_at(line, to.age), from, next, to.first_segment);
      }
      if (to.writes || to.effect.layout != line.epochs.front().effect.layout) seen = nullptr;
      defined = defined || to.writes;
    }
    return defined;
  }

  // ---- lifetimes ----------------------------------------------------------------------------------------------------

  void transient(const Line& line) {
    const uint32_t resource = frame_.cells[line.cell].resource, segment = first_segment_[resource];
    Side last = side_of(line.cell, line.epochs.back(), false);
    for (Event& event : last.events) event.earlier_frame = true;
    const bool acquired = !sync_.scattered[resource];
    link(line.cell, last, side_of(line.cell, line.epochs.front(), true), line.epochs.front().first_segment, acquired ? segment : UINT32_MAX);
    connect_within(line, false);
    if (acquired) note_hand_over(line, last, resource, schedule_.slot_before(segment));
    boundary(sync_.entry, line.cell, last, Layout::undefined, true);
    boundary(sync_.exit, line.cell, last, last.effect.layout, true);
  }

  void note_hand_over(const Line& line, const Side& last, uint32_t resource, uint32_t slot) {
    if (sync_.acquires.empty() || sync_.acquires.back().resource != resource) sync_.acquires.push_back({resource, slot, kNone, 0, 0, 0});
    const Effect& first = line.epochs.front().effect;
    sync_.acquires.back().stages |= first.stages(), sync_.acquires.back().accesses |= first.reads | first.writes;
    for (const uint32_t queue : queues_of(last)) {
      const Effect effect = one_queue_ ? last.effect : on_queue(frame_, line.cell, last, queue).effect;
      Release& release = release_of(resource, queue);
      released_writes_[static_cast<size_t>(&release - sync_.releases.data())] |= effect.write_stages;
      release.stages = released_writes_[static_cast<size_t>(&release - sync_.releases.data())] | latest_stages(release.stages | effect.stages());
      release.accesses |= effect.writes;
    }
  }
  Release& release_of(uint32_t resource, uint32_t queue) {
    auto& rows = sync_.releases;
    for (size_t i = rows.size(); i-- > 0 && rows[i].resource == resource;)
      if (rows[i].queue == queue) return rows[i];
    rows.push_back({resource, 0, 0, queue, 0});
    released_writes_.push_back(0);
    return rows.back();
  }

  // History and persistent: the state at the end of one age is the state at the start of the next.
  void circle(const Line& line) {
    const auto& epochs = line.epochs;
    for (size_t i = 0; i < epochs.size(); ++i) {
      const Epoch &from = epochs[(i + epochs.size() - 1) % epochs.size()], &to = epochs[i];
      if (continues(from, to)) continue;
      Side before = with_continued_reads(line, i);
      before.defined = i > 0 || !is_dead_at_entry(line);
      link(cell_at(line, to.age), before, side_of(line.cell, to, true), to.first_segment);
    }
    state_circle(line);
  }

  // The oldest copy of a history becomes the current one, and nobody needs what is in it.
  bool is_dead_at_entry(const Line& line) const {
    const Epoch& first = line.epochs.front();
    return may_discard(options_, frame_.resource_of(line.cell)) && first.age == 0 && !first.needs &&
           frame_.grids[frame_.cells[line.cell].resource].ages > 1;
  }

  // At each age's exit the last epoch so far with all reads it continues; that is the state at the entry of the next age.
  void state_circle(const Line& line) {
    const uint32_t ages = frame_.grids[frame_.cells[line.cell].resource].ages;
    const bool dead = is_dead_at_entry(line);
    Side state = with_continued_reads(line, 0);
    size_t next = 0;
    for (uint32_t age = 0; age < ages; ++age) {
      boundary(sync_.entry, cell_at(line, age), state, age == 0 && dead ? Layout::undefined : state.effect.layout, age == 0 && dead);
      for (; next < line.epochs.size() && line.epochs[next].age == age; ++next) state = with_continued_reads(line, next + 1);
      boundary(sync_.exit, cell_at(line, age), state, state.effect.layout, age + 1 == ages && dead);
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
    tie_to_first_queue(line, before.effect, after);
    const bool defined = connect_within(whole, before.defined, settled(before, whole.epochs.front()) ? &before.effect : nullptr);
    const Epoch& last = whole.epochs.back();
    boundary(sync_.entry, line.cell, before, before.effect.layout, !before.defined);
    if (resource.after.role == dsl::Role::undefined) {
      boundary(sync_.exit, line.cell, side_of(line.cell, last, true), last.effect.layout, true);
      return;
    }
    if (!continues_after(last, after)) leave(whole, before, after, defined);
    boundary(sync_.exit, line.cell, {after, after.writes != 0, true, true, {}, false, {}}, after.layout, false);
  }

  // Readers on other queues than the engine's: they come after the start of its frame, and it ends its frame after them.
  void tie_to_first_queue(const Line& line, const Effect& before, const Effect& after) {
    uint32_t first = UINT32_MAX, last = UINT32_MAX;  // batches of queue 0
    for (uint32_t segment = 0; segment < schedule_.segments; ++segment)
      if (schedule_.queue_of[segment] == 0) first = std::min(first, schedule_.batch_of[segment]), last = schedule_.batch_of[segment];
    for (const Epoch& epoch : line.epochs)
      for (const Event& event : epoch.events) {
        if (event.queue == 0 || event.stages == 0) continue;
        const uint32_t batch = schedule_.batch_of[event.segment];
        if (before.stages() && first < batch) needs_.push_back({0, first, before.stages(), batch, event.stages, line.cell, true, false});
        if (after.stages() && batch < last && last != UINT32_MAX)
          needs_.push_back({event.queue, batch, event.stages, last, after.stages(), line.cell, false, true});
      }
  }

  void enter(const Line& line, const Side& before) {
    const Epoch& first = line.epochs.front();
    if (is_visible(before, first)) return;
    Side to = side_of(line.cell, first, true);
    if (before.defined && !before.writes) to.seen = before.effect;
    link(line.cell, before, to, first.first_segment);
  }

  void leave(const Line& line, const Side& before, const Effect& after, bool defined) {
    const Epoch& last = line.epochs.back();
    Side next{after, after.writes != 0, true, true, {}, false, {}};
    const bool untouched = std::all_of(line.epochs.begin(), line.epochs.end(), [&](const Epoch& epoch) { return settled(before, epoch); });
    if (untouched)
      next.seen = before.effect;
    else if (!last.writes && last.effect.layout == after.layout)
      next.seen = last.covered;
    // Of readers on several queues those on other ones are waited for, see tie_to_first_queue().
    Side side = side_of(line.cell, last, defined);
    uint32_t segment = last.last_segment;
    if (last.queue == kSeveralQueues) {
      side = on_queue(frame_, line.cell, side, 0);
      segment = 0;
      for (const Event& event : side.events) segment = std::max(segment, event.segment);
    }
    if (side.events.empty()) return;
    CellBarrier barrier = connect(frame_, options_, line.cell, unnamed(side, after), next);
    barrier.reason = kStateAfter;
    exit(segment, std::move(barrier));
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
    if (!has_barrier || last.queue != 0 || !continues_after(last, after)) return;
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
    const bool joins =
        !last.writes && whole.epochs.size() > 1 && last.queue != kSeveralQueues && whole.epochs[whole.epochs.size() - 2].queue == last.queue;
    if (joins) merge(last.covered, host);
    connect_within(whole, false);
    if (!joins)
      exit(last.last_segment,
           connect(frame_, options_, line.cell, on_queue(frame_, line.cell, side_of(line.cell, last, true), schedule_.queue_of[last.last_segment]),
                   {host, false, true, true, {}, false, {}}));
    boundary(sync_.entry, line.cell, {}, Layout::undefined, true);
    boundary(sync_.exit, line.cell, {host, false, true, true, {}, false, {}}, Layout::undefined, false);
  }

  // ---- the frame's end ----------------------------------------------------------------------------------------------

  // `after` across queues is a wait of its own.
  void keep_declared_order() {
    std::vector<uint32_t> position(frame_.graph->passes.size(), UINT32_MAX);
    for (const uint32_t pass : schedule_.order) position[frame_.passes[pass]] = pass;
    for (const uint32_t pass : schedule_.order)
      for (const dsl::PassId id : frame_.pass(pass).after) {
        const uint32_t before = position[id.value];
        if (before == UINT32_MAX || before >= pass || schedule_.queue_of_pass(before) == schedule_.queue_of_pass(pass)) continue;
        needs_.push_back({schedule_.queue_of_pass(before), schedule_.batch_of[schedule_.segment_of[before]], stages_of(before),
                          schedule_.batch_of[schedule_.segment_of[pass]], stages_of(pass), 0, false, false});
      }
  }
  Stages stages_of(uint32_t pass) const {
    Stages stages = 0;
    for (const Use& use : frame_.uses_of(pass)) stages |= use.effect.stages() & ~stage::host;
    return stages;
  }

  // `segment`: of the last user.
  void exit(uint32_t segment, CellBarrier barrier) { exits_.push_back({segment, std::move(barrier)}); }

  // Together in the closing group of their queue where one needs it, else in the last group there is.
  void place_exits() {
    std::vector<uint32_t> last(schedule_.queues.size());
    for (uint32_t segment = 0; segment < schedule_.segments; ++segment) last[schedule_.queue_of[segment]] = segment;
    std::vector<bool> closes(schedule_.queues.size());
    for (const Exit& exit : exits_)
      closes[schedule_.queue_of[exit.segment]] = closes[schedule_.queue_of[exit.segment]] || exit.segment == last[schedule_.queue_of[exit.segment]];
    for (Exit& exit : exits_) {
      const uint32_t queue = schedule_.queue_of[exit.segment], end = last[queue];
      add_barrier(sync_, closes[queue] ? schedule_.closing_slot(schedule_.batch_of[end]) : schedule_.slot_before(end), std::move(exit.barrier));
    }
  }

  // One row a queue that has last users.
  void boundary(std::vector<CellBoundary>& rows, uint32_t cell, const Side& side, Layout layout, bool discard) const {
    const std::vector<uint32_t> queues = one_queue_ ? std::vector<uint32_t>() : queues_of(side);
    if (queues.size() < 2) return add_boundary(rows, cell, side, layout, discard, queues.empty() ? 0 : queues.front());
    for (const uint32_t queue : queues) add_boundary(rows, cell, on_queue(frame_, cell, side, queue), layout, discard, queue);
  }
  static void add_boundary(std::vector<CellBoundary>& rows, uint32_t cell, const Side& mine, Layout layout, bool discard, uint32_t queue) {
    Boundary row;
    row.stages = mine.effect.stages(), row.layout = layout, row.queue = queue, row.discard = discard;
    if (mine.writes || !discard) row.accesses = mine.writes ? mine.effect.writes : mine.effect.reads;
    rows.push_back({cell, row});
  }

  struct Exit {
    uint32_t segment = 0;  // of the last user
    CellBarrier barrier;
  };
  const Frame& frame_;
  const Schedule& schedule_;
  const PlanOptions& options_;
  const bool one_queue_ = schedule_.queues.size() == 1;
  SyncPlan sync_;
  std::vector<Need> needs_;
  std::vector<Stages> released_writes_;  // by release: stages that have to be named because they write
  std::vector<uint32_t> first_segment_;  // by program resource
  std::vector<Exit> exits_;
};

}  // namespace

SyncPlan synchronise(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, const PlanOptions& options,
                     const std::vector<MemorySignal>& for_memory) {
  SyncPlan sync = Synchroniser(frame, schedule, options).run(lines);
  for (size_t b = 0; b < for_memory.size(); ++b)
    if (sync.batches[b].signal != 0) sync.batches[b].signal |= for_memory[b].stages, sync.batches[b].for_memory = for_memory[b].counts;
  gather_parts(frame, schedule, lines, sync);
  for (std::vector<CellBarrier>& group : sync.groups) merge_ranges(frame, group);
  drop_redundant(frame, schedule, lines, sync);
  split_barriers(frame, schedule, options, sync);
  return sync;
}

}  // namespace rg::compiler
