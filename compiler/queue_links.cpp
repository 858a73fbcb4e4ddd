#include "compiler/queue_links.h"

#include <algorithm>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

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
Effect not_seen(const Side& side, const Effect& seen) {
  Effect unseen;
  if (side.events.empty()) add_unseen(side.effect.read_stages, side.effect.reads, seen, unseen);
  for (const Event& event : side.events) add_unseen(event.read_stages, event.reads, seen, unseen);
  return unseen;
}

void fill_second_scope(CellBarrier& b, const Side& from, const Side& to, bool new_layout) {
  const Effect& e = to.effect;
  if (from.writes || new_layout) {
    b.dst_stages = e.stages(), b.dst_accesses = e.reads | e.writes;
    return;
  }
  // Contents made available before, not yet visible to all reads of this one. The barrier into those before named all their reads in all their
  // stages, but for what had been seen.
  const Effect unseen = to.seen.reads ? not_seen(to, to.seen) : e, named = to.seen.reads ? not_seen(from, to.seen) : from.effect;
  const bool visible = unseen.reads == 0 || (is_subset(unseen.reads, named.reads) && is_subset(unseen.read_stages, named.read_stages));
  if (to.needs && from.defined && !visible)
    b.dst_stages = unseen.read_stages | earliest_stages(e.write_stages), b.dst_accesses = unseen.reads;
  else
    b.dst_stages = earliest_stages(to.writes ? e.write_stages : e.stages());
  // Without the readers in between this is a write after the write before them: made available by the barrier that serves them, not yet visible.
  if (from.skippable && to.writes) b.dst_stages |= e.write_stages, b.dst_accesses |= e.writes;
}

bool is_image(const Frame& frame, uint32_t cell) { return frame.resource_of(cell).kind == dsl::ResourceKind::image; }

uint32_t last_segment(const Side& side) {
  uint32_t last = 0;
  for (const Event& event : side.events) last = std::max(last, event.segment);
  return last;
}
uint32_t first_segment(const Side& side) {
  uint32_t first = UINT32_MAX;
  for (const Event& event : side.events) first = std::min(first, event.segment);
  return first;
}
bool is_earlier_frame(const Side& side) { return !side.events.empty() && side.events.front().earlier_frame; }

class Crosser {
 public:
  Crosser(const Frame& frame, const Schedule& schedule, const PlanOptions& options, const Crossing& crossing, SyncPlan& sync,
          std::vector<Need>& needs)
      : frame_(frame),
        schedule_(schedule),
        options_(options),
        cell_(crossing.cell),
        from_(crossing.from),
        to_(crossing.to),
        acquire_(crossing.acquire),
        sync_(sync),
        needs_(needs),
        whole_(connect(frame, options, cell_, from_, to_)),
        from_queues_(queues_of(from_)),
        to_queues_(queues_of(to_)) {}

  void run() {
    const bool changes = whole_.old_layout != whole_.new_layout;
    if (changes && to_queues_.size() > 1) return change_early();
    const bool shared = !is_image(frame_, cell_) || sync_.concurrent[frame_.cells[cell_].resource];
    const bool keeps = whole_.old_layout != Layout::undefined;
    for (const uint32_t queue : to_queues_) reach(queue, changes, !shared && keeps && from_queues_ != std::vector<uint32_t>{queue});
  }

 private:
  // Orders the users on one queue after all earlier ones.
  void reach(uint32_t queue, bool changes, bool transfers) {
    const Side own = on_queue(frame_, cell_, from_, queue), mine = on_queue(frame_, cell_, to_, queue);
    const uint32_t segment = acquire_ != UINT32_MAX ? acquire_ : first_segment(mine);
    // Where a barrier gathers the users, one of their stages is enough for the wait.
    const Stages earliest = earliest_stages(mine.effect.stages());
    const Stages waiting = changes || transfers ? earliest & ~(earliest - 1) : mine.effect.stages();
    const bool waits = wait_for_others(queue, segment, waiting, changes || transfers);
    CellBarrier b = connect(frame_, options_, cell_, own, mine);
    if (changes || transfers) {
      b.old_layout = whole_.old_layout, b.new_layout = whole_.new_layout;
      b.src_stages = own.effect.write_stages | latest_stages(own.effect.stages()) | (waits ? waiting : 0), b.src_accesses = own.effect.writes;
      b.dst_stages = mine.effect.stages(), b.dst_accesses = mine.effect.reads | mine.effect.writes;
    } else if (is_image(frame_, cell_)) {
      b.old_layout = b.new_layout = mine.effect.layout;
    }
    if (own.events.empty() && !changes && !transfers) return;
    b.is_acquire = acquire_ != UINT32_MAX;
    b.reason = whole_.reason, b.wraps = whole_.wraps;
    if (transfers) release(b, from_queues_.front(), queue);
    add_barrier(sync_, schedule_.slot_before(segment), std::move(b));
  }

  bool wait_for_others(uint32_t queue, uint32_t segment, Stages stages, bool chains) {
    bool waits = false;
    for (const uint32_t other : from_queues_) {
      const Side theirs = on_queue(frame_, cell_, from_, other);
      if (other == queue || theirs.effect.stages() == 0) continue;
      needs_.push_back({other, last_batch(theirs), theirs.effect.write_stages | latest_stages(theirs.effect.stages()), schedule_.batch_of[segment],
                        stages, cell_, false, chains});
      waits = true;
    }
    return waits;
  }

  // In this frame, which comes after all that the queue did before; kNone: it did nothing in this one.
  uint32_t last_batch(const Side& side) const {
    uint32_t batch = kNone;
    for (const Event& event : side.events)
      if (!event.earlier_frame) batch = batch == kNone ? schedule_.batch_of[event.segment] : std::max(batch, schedule_.batch_of[event.segment]);
    return batch;
  }

  // The other half of the acquire `b`, at the end of the batch that gives the image away.
  void release(CellBarrier& b, uint32_t from, uint32_t to) {
    RG_CHECK(from_queues_.size() == 1 && !is_earlier_frame(from_), "an image changes its owner within a frame, from one queue");
    b.src_queue = from, b.dst_queue = to;
    CellBarrier half = b;
    half.src_stages = from_.effect.write_stages | latest_stages(from_.effect.stages()), half.src_accesses = from_.effect.writes,
    half.dst_accesses = 0;
    half.dst_stages = signals_all(schedule_.batch_of[last_segment(from_)]) ? stage::none : half.src_stages & ~(half.src_stages - 1);
    half.is_acquire = false, half.changes_queue = true;
    const uint32_t slot = schedule_.closing_slot(schedule_.batch_of[last_segment(from_)]);
    b.src_accesses = 0;
    add_barrier(sync_, slot, std::move(half));
  }

  // The last batch of a queue signals everything, which comes after a barrier whatever that names.
  bool signals_all(uint32_t batch) const {
    const auto next = std::upper_bound(schedule_.batch_of.begin(), schedule_.batch_of.end(), batch) - schedule_.batch_of.begin();
    const auto rest = schedule_.queue_of.begin() + next;
    return std::find(rest, schedule_.queue_of.end(), *(rest - 1)) == schedule_.queue_of.end();
  }

  // Users on several queues, one layout: changed where the one queue before them is done, before anybody waits for it.
  void change_early() {
    RG_CHECK(from_queues_.size() == 1 && !is_earlier_frame(from_), "a layout changes with one queue before or after it");
    const uint32_t queue = from_queues_.front(), batch = schedule_.batch_of[last_segment(from_)];
    const Side mine = on_queue(frame_, cell_, to_, queue);
    const bool within = !mine.events.empty() && schedule_.batch_of[first_segment(mine)] == batch;
    CellBarrier b = whole_;
    b.src_stages = from_.effect.write_stages | latest_stages(from_.effect.stages()), b.src_accesses = from_.effect.writes;
    b.dst_stages = mine.events.empty() ? b.src_stages & ~(b.src_stages - 1) : mine.effect.stages(),
    b.dst_accesses = mine.effect.reads | mine.effect.writes;
    const uint32_t slot = within ? schedule_.slot_before(first_segment(mine)) : schedule_.closing_slot(batch);
    for (const uint32_t other : to_queues_) {
      if (other == queue) continue;
      const Side theirs = on_queue(frame_, cell_, to_, other);
      needs_.push_back({queue, batch, b.dst_stages, schedule_.batch_of[first_segment(theirs)], theirs.effect.stages(), cell_, true, false});
    }
    add_barrier(sync_, slot, std::move(b));
  }

  const Frame& frame_;
  const Schedule& schedule_;
  const PlanOptions& options_;
  uint32_t cell_;
  const Side &from_, &to_;
  uint32_t acquire_;
  SyncPlan& sync_;
  std::vector<Need>& needs_;
  CellBarrier whole_;
  std::vector<uint32_t> from_queues_, to_queues_;
};

}  // namespace

std::vector<uint32_t> queues_of(const Side& side) {
  std::vector<uint32_t> queues;
  for (const Event& event : side.events) queues.push_back(event.queue);
  std::sort(queues.begin(), queues.end());
  queues.erase(std::unique(queues.begin(), queues.end()), queues.end());
  return queues;
}

Side on_queue(const Frame& frame, uint32_t cell, const Side& side, uint32_t queue) {
  if (queues_of(side) == std::vector<uint32_t>{queue}) return side;
  Side result = side;
  std::erase_if(result.events, [&](const Event& event) { return event.queue != queue; });
  result.effect = {};
  result.effect.layout = side.effect.layout;
  for (const Event& event : result.events) {
    result.effect.read_stages |= event.effect.read_stages, result.effect.write_stages |= event.effect.write_stages;
    result.effect.reads |= event.effect.reads, result.effect.writes |= event.effect.writes;
  }
  result.writes = result.effect.writes != 0;
  result.skippable = !result.events.empty() && std::all_of(result.events.begin(), result.events.end(), [&](const Event& event) {
    return event.pass != UINT32_MAX && may_skip(frame, event.pass, frame.cells[cell]);
  });
  return result;
}

CellBarrier connect(const Frame& frame, const PlanOptions& options, uint32_t cell, const Side& from, const Side& to) {
  const bool image = is_image(frame, cell);
  CellBarrier b;
  b.cell = cell, b.range = frame.cells[cell].range, b.begin = frame.cells[cell].begin, b.end = frame.cells[cell].end;
  // Where readers of the same layout come before, execution alone is enough: a discard would make a transition of it.
  const bool worthwhile = from.writes || from.effect.layout != to.effect.layout;
  const bool discards = image && (!from.defined || (!to.needs && worthwhile && may_discard(options, frame.resource_of(cell))));
  if (image) b.old_layout = discards ? Layout::undefined : from.effect.layout, b.new_layout = to.effect.layout;
  const bool new_layout = image && (b.old_layout != b.new_layout);
  const bool rewrites = to.writes || new_layout;  // waits for readers too

  b.src_accesses = from.effect.writes;
  b.src_stages = from.effect.write_stages;
  if (rewrites || !from.writes) b.src_stages |= latest_stages(from.effect.read_stages | from.effect.write_stages) & ~from.effect.write_stages;
  fill_second_scope(b, from, to, new_layout);
  b.wraps = std::any_of(from.events.begin(), from.events.end(), [](const Event& event) { return event.earlier_frame; });
  b.reason = hazard_name(from, to, discards);
  return b;
}

void cross(const Frame& frame, const Schedule& schedule, const PlanOptions& options, const Crossing& crossing, SyncPlan& sync,
           std::vector<Need>& needs) {
  Crosser(frame, schedule, options, crossing, sync, needs).run();
}

void add_barrier(SyncPlan& sync, uint32_t slot, CellBarrier barrier) {
  const bool transfers = barrier.src_queue != barrier.dst_queue;
  if (barrier.src_stages == 0 && barrier.old_layout == barrier.new_layout && !transfers) return;  // nothing to order, nothing to change
  sync.groups[slot].push_back(std::move(barrier));
}

}  // namespace rg::compiler
