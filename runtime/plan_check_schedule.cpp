#include <algorithm>
#include <vector>

#include "runtime/plan_check_parts.h"

namespace rg::plan_check {

namespace {

constexpr size_t kMostQueues = 16;

void check_ranges(const Plan& plan, Checker& c) {
  c.that(!plan.batches.empty(), "plan", 0, "no batch");
  c.that(plan.queues.size() <= kMostQueues, "plan", 0, "more than 16 queues");
  for (size_t i = 0; i < plan.queues.size(); ++i) c.that(plan.queues[i].kind <= QueueKind::transfer, "queue", i, "kind");
  for (size_t i = 0; i < plan.batches.size(); ++i) {
    const Batch& batch = plan.batches[i];
    c.index(batch.queue, plan.queues.size(), "batch", i, "queue");
    c.range(batch.first_step, batch.step_count, plan.steps.size(), "batch", i, "steps");
    c.range(batch.first_wait, batch.wait_count, plan.waits.size(), "batch", i, "waits");
    c.range(batch.first_signal, batch.signal_count, plan.signals.size(), "batch", i, "signals");
  }
  for (size_t i = 0; i < plan.steps.size(); ++i) {
    c.that(plan.steps[i].kind <= StepKind::set, "step", i, "kind");
    const bool pass = plan.steps[i].kind == StepKind::pass;
    c.index(plan.steps[i].index, pass ? plan.passes.size() : plan.groups.size(), "step", i, "index");
  }
  for (size_t i = 0; i < plan.waits.size(); ++i) c.index(plan.waits[i].queue, plan.queues.size(), "wait", i, "queue");
}

// Each step belongs to one batch; each group and each pass is one step, and a split group is set by another.
void check_steps(const Plan& plan, Checker& c) {
  std::vector<bool> taken(plan.steps.size()), groups(plan.groups.size()), passes(plan.passes.size()), set(plan.groups.size());
  for (size_t i = 0; i < plan.batches.size(); ++i)
    for (Index s = plan.batches[i].first_step; s < plan.batches[i].first_step + plan.batches[i].step_count; ++s) {
      c.that(!taken[s], "batch", i, "a step of another batch");
      taken[s] = true;
    }
  for (size_t i = 0; i < plan.steps.size(); ++i) {
    const StepKind kind = plan.steps[i].kind;
    std::vector<bool>& seen = kind == StepKind::barriers ? groups : kind == StepKind::pass ? passes : set;
    c.that(taken[i], "step", i, "in no batch");
    c.that(!seen[plan.steps[i].index], "step", i, "recorded twice");
    seen[plan.steps[i].index] = true;
  }
}

// Events are numbered from 0 on. Each is set once and awaited later in the same batch, on a queue that has events; the runtime patches no hand-off
// into its group, and neither owners nor the host are its business.
void check_event(const Plan& plan, const BarrierGroup& group, size_t row, Checker& c) {
  const auto check = [&](const auto& barriers) {
    for (const auto& barrier : barriers) {
      c.that(((barrier.src_stages | barrier.dst_stages) & stage::host) == 0, "group", row, "an event that orders the host");
      if constexpr (requires { barrier.src_queue; }) c.that(barrier.src_queue == barrier.dst_queue, "group", row, "an event that changes owners");
    }
  };
  check(plan.memory_barriers.subspan(group.first_memory, group.memory_count));
  check(plan.image_barriers.subspan(group.first_image, group.image_count));
  check(plan.buffer_barriers.subspan(group.first_buffer, group.buffer_count));
}
void check_events(const Plan& plan, Checker& c) {
  std::vector<bool> numbers(plan.groups.size());
  size_t events = 0;
  for (size_t i = 0; i < plan.groups.size(); ++i) {
    const Index event = plan.groups[i].event;
    if (event == kNone) continue;
    ++events;
    c.that(event < numbers.size() && !numbers[event], "group", i, "event");
    if (!c.ok()) return;
    numbers[event] = true;
    check_event(plan, plan.groups[i], i, c);
  }
  for (size_t i = events; i < numbers.size(); ++i) c.that(!numbers[i], "group", i, "events that are not numbered from 0 on");
  for (size_t i = 0; i < plan.acquires.size(); ++i)
    c.that(plan.groups[plan.acquires[i].group].event == kNone, "acquire", i, "in a group that is split");
}
void check_halves(const Plan& plan, Checker& c) {
  constexpr Index kAwaited = kNone - 1;
  std::vector<Index> set(plan.groups.size(), kNone);  // by group: in which batch, or kAwaited
  for (Index b = 0; b < plan.batches.size(); ++b)
    for (const Step& step : plan.steps.subspan(plan.batches[b].first_step, plan.batches[b].step_count)) {
      if (step.kind == StepKind::pass) continue;
      const bool sets = step.kind == StepKind::set, split = plan.groups[step.index].event != kNone;
      c.that(split || !sets, "group", step.index, "set, but not split");
      if (!split) continue;
      c.that(plan.queues[plan.batches[b].queue].kind != QueueKind::transfer, "group", step.index, "an event on a queue that has none");
      c.that(set[step.index] == (sets ? kNone : b), "group", step.index, "an event that is not set in the batch that awaits it");
      set[step.index] = sets ? b : kAwaited;
    }
  for (size_t i = 0; i < set.size(); ++i) c.that(set[i] == kNone || set[i] == kAwaited, "group", i, "an event that nothing awaits");
}

// Passes of one rendering: where the first is skipped nothing begins it for the others.
void check_shared_renderings(const Plan& plan, Checker& c) {
  const Pass* first = nullptr;
  for (const Step& step : plan.steps) {
    const Pass* pass = step.kind == StepKind::pass ? &plan.passes[step.index] : nullptr;
    if (first == nullptr || pass == nullptr || pass->rendering == kNone || pass->rendering != first->rendering) {
      first = pass;
      continue;
    }
    c.that((first->guard & ~pass->guard) == 0, "pass", step.index, "may run where the first pass of its rendering is skipped");
    c.that(plan.renderings[pass->rendering].view_mask == 0, "pass", step.index, "shares a rendering with several views");
  }
}

// ---- timelines ----------------------------------------------------------------------------------------------------

// Values that each queue has signalled, counted while batches are walked in listed order.
using Values = std::vector<uint64_t>;

Values signals_a_frame(const Plan& plan) {
  Values values(plan.queues.size());
  for (const Batch& batch : plan.batches) values[batch.queue] += batch.signal_count;
  return values;
}

void check_wait(const Plan& plan, Index w, const Values& so_far, const Values& whole, Checker& c) {
  const Wait& wait = plan.waits[w];
  c.that(wait.stages != 0, "wait", w, "no stages");
  c.that(wait.frames_ago <= 1, "wait", w, "frames ago");
  c.that(wait.value >= 1 && wait.value <= whole[wait.queue], "wait", w, "for a value that its queue does not signal");
  if (wait.frames_ago == 0) c.that(wait.value <= so_far[wait.queue], "wait", w, "for a batch that is listed later");
}

void check_signals(const Plan& plan, const Batch& batch, Values& so_far, Checker& c) {
  for (Index s = batch.first_signal; s < batch.first_signal + batch.signal_count; ++s) {
    c.that(plan.signals[s].stages != 0, "signal", s, "no stages");
    c.that(plan.signals[s].value == so_far[batch.queue] + 1, "signal", s, "values of a queue count 1, 2, ... in the order of its batches");
    ++so_far[batch.queue];
  }
}

void check_timelines(const Plan& plan, Checker& c) {
  c.that(!plan.signals.empty() || plan.queues.size() <= 1, "plan", 0, "several queues and no signal");
  const Values whole = signals_a_frame(plan);
  Values so_far(plan.queues.size());
  std::vector<Index> last(plan.queues.size(), kNone);
  for (Index b = 0; b < plan.batches.size() && c.ok(); ++b) {
    const Batch& batch = plan.batches[b];
    for (Index w = batch.first_wait; w < batch.first_wait + batch.wait_count; ++w) check_wait(plan, w, so_far, whole, c);
    check_signals(plan, batch, so_far, c);
    last[batch.queue] = b;
  }
  for (const Index b : last)
    if (b != kNone && !plan.signals.empty()) c.that(plan.batches[b].signal_count != 0, "batch", b, "the last of its queue signals nothing");
}

// ---- what a queue can do ------------------------------------------------------------------------------------------

constexpr Stages kTransferStages = stage::all_transfer | stage::copy | stage::clear | stage::host | stage::bottom_of_pipe | stage::all_commands | 1;
constexpr Stages kComputeStages = kTransferStages | stage::compute_shader | stage::draw_indirect;

bool can_synchronise(QueueKind kind, Stages stages) {
  if (kind == QueueKind::graphics) return true;
  return (stages & ~(kind == QueueKind::compute ? kComputeStages : kTransferStages)) == 0;
}

bool needs_graphics(TransferKind kind) {
  return kind == TransferKind::blit || kind == TransferKind::resolve || kind == TransferKind::clear_depth_stencil;
}

bool can_run(const Plan& plan, QueueKind kind, const Pass& pass) {
  if (kind == QueueKind::graphics) return true;
  if (pass.kind == PassKind::raster || (pass.kind == PassKind::compute && kind == QueueKind::transfer)) return false;
  if (pass.work.kind != WorkKind::transfers) return true;
  for (const Transfer& transfer : plan.transfers.subspan(pass.work.first_transfer, pass.work.transfer_count))
    if (needs_graphics(transfer.kind) || (kind == QueueKind::transfer && transfer.kind == TransferKind::clear_color)) return false;
  return true;
}

template <class Barrier>
void check_barrier(const Plan& plan, Index queue, const Barrier& barrier, std::string_view table, size_t row, Checker& c) {
  c.that(can_synchronise(plan.queues[queue].kind, barrier.src_stages | barrier.dst_stages), table, row, "stages that its queue does not have");
  const bool transfers = barrier.src_queue != kNone || barrier.dst_queue != kNone;
  if (!transfers) return;
  c.that(barrier.src_queue < plan.queues.size() && barrier.dst_queue < plan.queues.size() && barrier.src_queue != barrier.dst_queue, table, row,
         "queues of the transfer");
  c.that(barrier.src_queue == queue || barrier.dst_queue == queue, table, row, "a transfer between two other queues");
}

void check_group(const Plan& plan, Index queue, Index g, Checker& c) {
  const BarrierGroup& group = plan.groups[g];
  for (Index i = group.first_memory; i < group.first_memory + group.memory_count; ++i)
    c.that(can_synchronise(plan.queues[queue].kind, plan.memory_barriers[i].src_stages | plan.memory_barriers[i].dst_stages), "memory barrier", i,
           "stages that its queue does not have");
  for (Index i = group.first_image; i < group.first_image + group.image_count; ++i)
    check_barrier(plan, queue, plan.image_barriers[i], "image barrier", i, c);
  for (Index i = group.first_buffer; i < group.first_buffer + group.buffer_count; ++i)
    check_barrier(plan, queue, plan.buffer_barriers[i], "buffer barrier", i, c);
}

void check_work(const Plan& plan, Checker& c) {
  for (const Batch& batch : plan.batches)
    for (const Step& step : plan.steps.subspan(batch.first_step, batch.step_count)) {
      if (!c.ok()) return;
      if (step.kind != StepKind::pass) {
        check_group(plan, batch.queue, step.index, c);
        continue;
      }
      c.that(plan.passes[step.index].queue == batch.queue, "pass", step.index, "on another queue than its batch");
      c.that(can_run(plan, plan.queues[batch.queue].kind, plan.passes[step.index]), "pass", step.index, "work that its queue cannot do");
    }
}

// ---- ownership ----------------------------------------------------------------------------------------------------

struct Half {  // of a transfer
  ImageBarrier image;
  BufferBarrier buffer;
  Index batch = kNone;
  bool release = false, matched = false;
};

bool same_transfer(const Half& a, const Half& b) {
  return a.image.image == b.image.image && a.image.range == b.image.range && a.image.old_layout == b.image.old_layout &&
         a.image.new_layout == b.image.new_layout && a.image.src_queue == b.image.src_queue && a.image.dst_queue == b.image.dst_queue &&
         a.buffer.buffer == b.buffer.buffer && a.buffer.bytes == b.buffer.bytes && a.buffer.src_queue == b.buffer.src_queue &&
         a.buffer.dst_queue == b.buffer.dst_queue;
}

void add_halves(const Plan& plan, Index b, const BarrierGroup& group, std::vector<Half>& out) {
  const Index queue = plan.batches[b].queue;
  for (const ImageBarrier& barrier : plan.image_barriers.subspan(group.first_image, group.image_count))
    if (barrier.src_queue != kNone) out.push_back({barrier, {}, b, barrier.src_queue == queue});
  for (const BufferBarrier& barrier : plan.buffer_barriers.subspan(group.first_buffer, group.buffer_count))
    if (barrier.src_queue != kNone) out.push_back({{}, barrier, b, barrier.src_queue == queue});
}

std::vector<Half> list_halves(const Plan& plan) {
  std::vector<Half> halves;
  for (Index b = 0; b < plan.batches.size(); ++b)
    for (const Step& step : plan.steps.subspan(plan.batches[b].first_step, plan.batches[b].step_count))
      if (step.kind == StepKind::barriers) add_halves(plan, b, plan.groups[step.index], halves);
  return halves;
}

// Every acquire finds the release of the same range before it.
void check_ownership(const Plan& plan, Checker& c) {
  std::vector<Half> halves = list_halves(plan);
  std::vector<std::vector<Half*>> releases(plan.resources.size());  // in listed order, not yet acquired
  for (Half& half : halves) {
    const Index resource = half.image.image.resource != kNone ? half.image.image.resource : half.buffer.buffer.resource;
    c.that(!plan.resources[resource].concurrent, "batch", half.batch, "transfers a resource that all queues share");
    if (half.release) {
      releases[resource].push_back(&half);
      continue;
    }
    const auto release =
        std::find_if(releases[resource].begin(), releases[resource].end(), [&](const Half* other) { return same_transfer(*other, half); });
    c.that(release != releases[resource].end(), "batch", half.batch, "acquires what no batch before it released");
    if (!c.ok()) return;
    (*release)->matched = true;
    releases[resource].erase(release);
  }
  for (const Half& half : halves)
    if (half.release) c.that(half.matched, "batch", half.batch, "releases what no batch after it acquires");
  for (size_t i = 0; i < plan.entry.size(); ++i) c.optional(plan.entry[i].queue, plan.queues.size(), "entry", i, "queue");
  for (size_t i = 0; i < plan.exit.size(); ++i) c.optional(plan.exit[i].queue, plan.queues.size(), "exit", i, "queue");
}

}  // namespace

void check_schedule(const Plan& plan, Checker& c) {
  check_ranges(plan, c);
  if (c.ok()) check_steps(plan, c);
  if (c.ok()) check_events(plan, c);
  if (c.ok()) check_halves(plan, c);
  if (c.ok()) check_shared_renderings(plan, c);
  if (c.ok()) check_timelines(plan, c);
  if (c.ok()) check_work(plan, c);
  if (c.ok()) check_ownership(plan, c);
}

}  // namespace rg::plan_check
