#include "runtime/submit.h"

#include <algorithm>

#include "runtime/errors.h"
#include "runtime/prologue.h"
#include "runtime/queues.h"
#include "runtime/timelines.h"

namespace rg {

namespace {

constexpr VkPipelineStageFlags2 kAllCommands = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;

VkSemaphoreSubmitInfo semaphore_info(VkSemaphore semaphore, uint64_t value, VkPipelineStageFlags2 stages) {
  return {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, nullptr, semaphore, value, stages, 0};
}
VkSemaphoreSubmitInfo semaphore_info(const SemaphoreUse& use) { return semaphore_info(use.semaphore, use.value, use.stages); }

VkCommandBufferSubmitInfo commands_info(VkCommandBuffer commands) { return {VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands, 0}; }

VkSubmitInfo2 empty_submit() {
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  return info;
}

Status queue_submit(const Context& context, uint32_t queue, uint32_t count, const VkSubmitInfo2* infos, VkFence fence) {
  const DeviceQueue& row = context.device.queues[queue];
  const std::lock_guard lock(*row.mutex);
  return check(context.vk().QueueSubmit2(row.handle, count, infos, fence), "vkQueueSubmit2", context.plan.name);
}

// The timelines' values before and after this frame.
struct FrameValues {
  Moment before, after;
};
FrameValues frame_values(const GraphInstance::State& state) {
  FrameValues values{state.submitted, state.submitted};
  for (size_t q = 0; q + 1 < state.timelines->size(); ++q) values.after.values[1 + q] += state.signals_a_frame[q];
  return values;
}

// Appends waits and signals of submits in order; `finish` says how many belong to the submit in hand.
class SubmitBuilder {
 public:
  SubmitBuilder(GraphInstance::State& state, const FrameInputs& inputs)
      : state_(state), plan_(state.context.plan), inputs_(inputs), values_(frame_values(state)), whole_frame_(state.context.queues.several) {
    state.submits.clear(), state.submit_waits.clear(), state.submit_signals.clear();
  }

  bool needs_lead_in() const {
    return whole_frame_ && std::any_of(inputs_.waits.begin(), inputs_.waits.end(), [](const SemaphoreUse& use) { return use.import_slot == kNone; });
  }
  // All queues wait for what queue 0 has waited for.
  void lead_in() {
    for (const SemaphoreUse& use : inputs_.waits)
      if (use.import_slot == kNone) state_.submit_waits.push_back(semaphore_info(use));
    const uint64_t value = ++values_.after.values[0];
    state_.submit_signals.push_back(semaphore_info((*state_.timelines)[0].get(), value, kAllCommands));
    finish(empty_submit());
    state_.entry_waits.push_back(semaphore_info((*state_.timelines)[0].get(), value, kAllCommands));
  }

  void batch(Index b, const VkCommandBufferSubmitInfo* commands, uint32_t count) {
    const Batch& batch = plan_.batches[b];
    plan_waits(batch);
    if (state_.first_batch_of_queue[batch.queue] == b)
      state_.submit_waits.insert(state_.submit_waits.end(), state_.entry_waits.begin(), state_.entry_waits.end());
    external_waits(b);
    plan_signals(batch);
    external_signals(b);
    VkSubmitInfo2 info = empty_submit();
    info.commandBufferInfoCount = count;
    info.pCommandBufferInfos = commands;
    finish(info);
  }

  bool needs_lead_out() const {
    return std::any_of(inputs_.signals.begin(), inputs_.signals.end(), [&](const SemaphoreUse& use) { return at_end(use); });
  }
  // Queue 0 waits for all queues and says so.
  void lead_out() {
    for (size_t q = 0; q + 1 < state_.timelines->size(); ++q)
      if (state_.signals_a_frame[q] != 0)
        state_.submit_waits.push_back(semaphore_info((*state_.timelines)[1 + q].get(), values_.after.values[1 + q], kAllCommands));
    for (const SemaphoreUse& use : inputs_.signals)
      if (at_end(use)) state_.submit_signals.push_back(semaphore_info(use));
    finish(empty_submit());
  }

  const Moment& after() const { return values_.after; }

 private:
  // The validation layer loses transitions between a barrier's second scope and a semaphore that names no more than that: while it watches,
  // semaphores name all commands.
  VkPipelineStageFlags2 watched(Stages stages) const { return state_.context.device.validating ? kAllCommands : stages; }
  void plan_waits(const Batch& batch) {
    for (const Wait& wait : plan_.waits.subspan(batch.first_wait, batch.wait_count)) {
      const uint64_t back = wait.frames_ago * state_.signals_a_frame[wait.queue], before = values_.before.values[1 + wait.queue];
      if (back > before) continue;  // there was no such frame
      state_.submit_waits.push_back(semaphore_info((*state_.timelines)[1 + wait.queue].get(), before - back + wait.value, watched(wait.stages)));
    }
  }
  void plan_signals(const Batch& batch) {
    for (const Signal& signal : plan_.signals.subspan(batch.first_signal, batch.signal_count))
      state_.submit_signals.push_back(
          semaphore_info((*state_.timelines)[1 + batch.queue].get(), values_.before.values[1 + batch.queue] + signal.value, watched(signal.stages)));
    if (!plan_.signals.empty() || &batch != &plan_.batches.back()) return;
    state_.submit_signals.push_back(semaphore_info((*state_.timelines)[0].get(), ++values_.after.values[0], kAllCommands));
  }
  void external_waits(Index b) {
    for (const SemaphoreUse& use : inputs_.waits) {
      if (use.import_slot == kNone) {
        if (!whole_frame_ && b == 0) state_.submit_waits.push_back(semaphore_info(use));
        continue;
      }
      const std::vector<Index>& first = state_.import_uses[use.import_slot].first;
      const bool here = use.value == 0 ? !first.empty() && first[0] == b : std::find(first.begin(), first.end(), b) != first.end();
      if (here) state_.submit_waits.push_back(semaphore_info(use));
    }
  }
  // The last batch alone knows that all is done, where there is one queue; that of an import, where one queue uses it.
  bool at_end(const SemaphoreUse& use) const {
    return use.import_slot == kNone ? whole_frame_ : state_.import_uses[use.import_slot].last.size() != 1;
  }
  void external_signals(Index b) {
    for (const SemaphoreUse& use : inputs_.signals) {
      if (at_end(use)) continue;
      const Index last = use.import_slot == kNone ? static_cast<Index>(plan_.batches.size() - 1) : state_.import_uses[use.import_slot].last[0];
      if (last == b) state_.submit_signals.push_back(semaphore_info(use));
    }
  }
  void finish(VkSubmitInfo2 info) {
    info.waitSemaphoreInfoCount = static_cast<uint32_t>(state_.submit_waits.size()) - first_wait_;
    info.pWaitSemaphoreInfos = state_.submit_waits.data() + first_wait_;
    info.signalSemaphoreInfoCount = static_cast<uint32_t>(state_.submit_signals.size()) - first_signal_;
    info.pSignalSemaphoreInfos = state_.submit_signals.data() + first_signal_;
    first_wait_ = static_cast<uint32_t>(state_.submit_waits.size());
    first_signal_ = static_cast<uint32_t>(state_.submit_signals.size());
    state_.submits.push_back(info);
  }

  GraphInstance::State& state_;
  const Plan& plan_;
  const FrameInputs& inputs_;
  FrameValues values_;
  bool whole_frame_;  // several queues: no batch begins or ends it
  uint32_t first_wait_ = 0, first_signal_ = 0;
};

// Which values are really under way after `count` of the frame's calls.
void count_submitted(GraphInstance::State& state, size_t count, const Moment& before) {
  for (size_t c = 0; c < count; ++c)
    for (const Batch& batch : state.context.plan.batches.subspan(state.calls[c].first_batch, state.calls[c].batch_count))
      for (const Signal& signal : state.context.plan.signals.subspan(batch.first_signal, batch.signal_count)) {
        uint64_t& value = state.submitted.values[1 + batch.queue];
        value = std::max(value, before.values[1 + batch.queue] + signal.value);
      }
}

// With fences, that of a queue goes with its last call.
VkFence fence_of(const GraphInstance::State& state, const FrameSlot& slot, size_t call) {
  if (slot.fences.empty()) return VK_NULL_HANDLE;
  for (size_t later = call + 1; later < state.calls.size(); ++later)
    if (state.calls[later].queue == state.calls[call].queue) return VK_NULL_HANDLE;
  return slot.fences[state.calls[call].queue].get();
}

Status submit_calls(GraphInstance::State& state, FrameSlot& slot, const VkSubmitInfo2* infos) {
  const Moment before = state.submitted;
  for (size_t c = 0; c < state.calls.size(); ++c) {
    const SubmitCall& call = state.calls[c];
    const VkFence fence = fence_of(state, slot, c);
    const Status submitted = queue_submit(state.context, call.queue, call.batch_count, infos + call.first_batch, fence);
    if (!submitted) {
      count_submitted(state, c, before);
      state.broken |= c > 0;
      return submitted.error();
    }
    if (fence != VK_NULL_HANDLE) slot.fenced[call.queue] = true;
  }
  return Done{};
}

}  // namespace

Status reset_fences(const Context& context, const std::vector<UniqueFence>& fences, std::vector<bool>& fenced) {
  for (size_t i = 0; i < fences.size(); ++i) {
    const VkFence fence = fences[i].get();
    if (fenced[i]) RG_TRY(check(context.vk().ResetFences(context.device.device, 1, &fence), "vkResetFences", context.plan.name));
    fenced[i] = false;
  }
  return Done{};
}

Status submit_frame(GraphInstance::State& state, const FrameInputs& inputs, FrameSlot& slot) {
  RG_TRY(reset_fences(state.context, slot.fences, slot.fenced));
  const size_t entry_waits = state.entry_waits.size();
  SubmitBuilder builder(state, inputs);
  const bool lead_in = builder.needs_lead_in();
  if (lead_in) builder.lead_in();
  for (size_t i = 0; i < state.chunks.size(); ++i) state.submit_commands[i] = commands_info(slot.commands[i]);
  for (Index b = 0; b < state.context.plan.batches.size(); ++b)
    builder.batch(b, &state.submit_commands[state.first_chunk[b]], state.first_chunk[b + 1] - state.first_chunk[b]);
  const bool lead_out = builder.needs_lead_out();
  if (lead_out) builder.lead_out();

  constexpr uint32_t home = 0;
  const VkSubmitInfo2* infos = state.submits.data() + (lead_in ? 1 : 0);
  const Status led_in = lead_in ? queue_submit(state.context, home, 1, state.submits.data(), VK_NULL_HANDLE) : Status(Done{});
  if (led_in && lead_in) state.submitted.values[0] = builder.after().values[0];
  Status submitted = led_in ? submit_calls(state, slot, infos) : led_in;
  if (submitted && lead_out) {
    state.submitted = builder.after();
    submitted = queue_submit(state.context, home, 1, &state.submits.back(), VK_NULL_HANDLE);
    state.broken |= !submitted;
  }
  if (!submitted) {
    state.entry_waits.resize(state.broken ? 0 : entry_waits);
    return submitted.error();
  }
  state.submitted = builder.after();
  state.entry_waits.clear();
  return Done{};
}

Status submit_one(GraphInstance::State& state, const SingleSubmit& submit) {
  const VkSemaphore timeline = (*state.timelines)[0].get();
  const uint64_t value = state.submitted.values[0];
  const VkCommandBufferSubmitInfo commands = commands_info(submit.commands);
  const VkSemaphoreSubmitInfo signal = semaphore_info(timeline, value + 1, kAllCommands);
  std::array<VkSemaphoreSubmitInfo, 3 * (1 + kMaxPlanQueues) + 1> waits;
  auto end = std::copy_n(submit.waits.begin(), std::min(submit.waits.size(), waits.size() - 1), waits.begin());
  if (submit.chained && value != 0) *end++ = semaphore_info(timeline, value, kAllCommands);
  VkSubmitInfo2 info = empty_submit();
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &commands;
  info.waitSemaphoreInfoCount = static_cast<uint32_t>(end - waits.begin());
  info.pWaitSemaphoreInfos = waits.data();
  info.signalSemaphoreInfoCount = 1;
  info.pSignalSemaphoreInfos = &signal;
  RG_TRY(queue_submit(state.context, submit.queue, 1, &info, submit.fence));
  ++state.submitted.values[0];
  return Done{};
}

void wait_at_entry(GraphInstance::State& state, const std::shared_ptr<Timelines>& timelines, const Moment& moment) {
  for (size_t i = 0; i < timelines->size(); ++i)
    if (moment.values[i] != 0) state.entry_waits.push_back(semaphore_info((*timelines)[i].get(), moment.values[i], kAllCommands));
  if (moment.engine != VK_NULL_HANDLE) state.entry_waits.push_back(semaphore_info(moment.engine, moment.engine_value, kAllCommands));
  state.entry_barrier = true;
  if (timelines != state.timelines) state.entry_sources.push_back(timelines);
}

namespace {

uint32_t queue_of_family(const Device::State& device, uint32_t family) {
  for (uint32_t i = 0; i < device.queues.size(); ++i)
    if (device.queues[i].family == family) return i;
  return 0;
}

Status submit_part(GraphInstance::State& state, uint32_t queue, size_t part) {
  const bool watched = !state.prologue.fences.empty();
  const std::span<const VkSemaphoreSubmitInfo> waits =
      part == 0 ? std::span<const VkSemaphoreSubmitInfo>(state.entry_waits) : std::span<const VkSemaphoreSubmitInfo>();
  RG_TRY(submit_one(
      state, {queue, state.prologue.commands[part], part != 0, waits, watched ? state.prologue.fences[queue].get() : VkFence(VK_NULL_HANDLE)}));
  if (watched) state.prologue.fenced[queue] = true;
  state.prologue.done.values[0] = state.submitted.values[0];
  return Done{};
}

// The first family does the work and gives away what others own; each of those takes it in a command buffer of its own.
Status submit_parts(GraphInstance::State& state, const Sized& sized) {
  const Context& context = state.context;
  for (size_t part = 0; part < context.queues.families.size(); ++part) {
    const VkCommandBuffer commands = state.prologue.commands[part];
    RG_TRY(check(context.vk().ResetCommandPool(context.device.device, state.prologue.pools[part].pool.get(), 0), "vkResetCommandPool",
                 context.plan.name));
    RG_TRY(begin_commands(context, commands));
    const bool recorded = part == 0 ? record_prologue(context, sized, commands, state.frame)
                                    : record_first_owner(context, sized, commands, state.frame, context.queues.families[part]);
    RG_TRY(end_commands(context, commands));
    if (recorded) RG_TRY(submit_part(state, queue_of_family(context.device, context.queues.families[part]), part));
  }
  return Done{};
}

}  // namespace

Status submit_prologue(GraphInstance::State& state, const Sized& sized) {
  RG_TRY(wait_for(state, state.prologue.done));
  RG_TRY(reset_fences(state.context, state.prologue.fences, state.prologue.fenced));
  const Status submitted = submit_parts(state, sized);
  if (!submitted) {
    static_cast<void>(wait_for(state, state.prologue.done));
    return submitted.error();
  }
  if (!state.context.queues.several) {
    // A plan of several queues leaves it to waits that its first passes see the prologue; on one VkQueue there are none.
    state.entry_barrier |= state.context.plan.queues.size() > 1;
    return Done{};
  }
  // Queues that nothing of the prologue's waits concerns wait for it, and with it for what it has waited for.
  state.entry_waits.assign(1, semaphore_info((*state.timelines)[0].get(), state.submitted.values[0], kAllCommands));
  return Done{};
}

Status mend_timelines(GraphInstance::State& state) {
  RG_TRY(wait_for(state, state.submitted));
  for (size_t q = 0; q + 1 < state.timelines->size(); ++q) {
    uint64_t& value = state.submitted.values[1 + q];
    const uint64_t step = state.signals_a_frame[q];
    if (step == 0 || value % step == 0) continue;
    VkSemaphoreSignalInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
    info.semaphore = (*state.timelines)[1 + q].get();
    info.value = (value / step + 1) * step;
    RG_TRY(check(state.context.vk().SignalSemaphore(state.context.device.device, &info), "vkSignalSemaphore", state.context.plan.name));
    value = info.value;
  }
  return Done{};
}

Status begin_commands(const Context& context, VkCommandBuffer commands) {
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  return check(context.vk().BeginCommandBuffer(commands, &info), "vkBeginCommandBuffer", context.plan.name);
}

Status end_commands(const Context& context, VkCommandBuffer commands) {
  return check(context.vk().EndCommandBuffer(commands), "vkEndCommandBuffer", context.plan.name);
}

}  // namespace rg
