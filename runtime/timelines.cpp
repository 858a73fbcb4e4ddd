#include "runtime/timelines.h"

#include <algorithm>

#include "runtime/errors.h"

namespace rg {

namespace {

Result<UniqueSemaphore> create_timeline(const Context& context) {
  VkSemaphoreTypeCreateInfo type{};
  type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  info.pNext = &type;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  RG_TRY(
      check(context.vk().CreateSemaphore(context.device.device, &info, context.vk().allocator, &semaphore), "vkCreateSemaphore", context.plan.name));
  return UniqueSemaphore(context.vk(), context.device.device, semaphore);
}

// The semaphores and values of a moment as Vulkan wants them.
struct WaitArrays {
  std::array<VkSemaphore, 2 + kMaxPlanQueues> semaphores;
  std::array<uint64_t, 2 + kMaxPlanQueues> values;
  uint32_t count = 0;
};
WaitArrays wait_arrays(const GraphInstance::State& state, const Moment& moment) {
  WaitArrays out;
  for (size_t i = 0; i < state.timelines->size(); ++i) {
    if (moment.values[i] == 0) continue;
    out.semaphores[out.count] = (*state.timelines)[i].get();
    out.values[out.count++] = moment.values[i];
  }
  if (moment.engine != VK_NULL_HANDLE) {
    out.semaphores[out.count] = moment.engine;
    out.values[out.count++] = moment.engine_value;
  }
  return out;
}

Status wait_for_semaphores(const Context& context, uint32_t count, const VkSemaphore* semaphores, const uint64_t* values) {
  if (count == 0) return Done{};
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = count;
  info.pSemaphores = semaphores;
  info.pValues = values;
  return check(context.vk().WaitSemaphores(context.device.device, &info, UINT64_MAX), "vkWaitSemaphores", context.plan.name);
}

Status wait_for_fences(const Context& context, const std::vector<UniqueFence>& fences, const std::vector<bool>& fenced) {
  for (size_t i = 0; i < fences.size(); ++i) {
    const VkFence fence = fences[i].get();
    if (fenced[i])
      RG_TRY(check(context.vk().WaitForFences(context.device.device, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences", context.plan.name));
  }
  return Done{};
}

bool within(const Moment& a, const Moment& b) {
  for (size_t i = 0; i < a.values.size(); ++i)
    if (a.values[i] > b.values[i]) return false;
  return true;
}

}  // namespace

Status create_timelines(GraphInstance::State& state) {
  const Plan& plan = state.context.plan;
  const size_t count = 1 + (plan.signals.empty() ? 0 : plan.queues.size());
  for (size_t i = 0; i < count; ++i) {
    Result<UniqueSemaphore> timeline = create_timeline(state.context);
    if (!timeline) return timeline.error();
    state.timelines->push_back(std::move(*timeline));
  }
  for (const Batch& batch : plan.batches)
    for (const Signal& signal : plan.signals.subspan(batch.first_signal, batch.signal_count))
      state.signals_a_frame[batch.queue] = std::max(state.signals_a_frame[batch.queue], signal.value);
  return Done{};
}

Status wait_for(const GraphInstance::State& state, const Moment& moment) {
  const Context& context = state.context;
  const WaitArrays arrays = wait_arrays(state, moment);
  RG_TRY(wait_for_semaphores(context, arrays.count, arrays.semaphores.data(), arrays.values.data()));
  if (!context.device.validating || arrays.count == 0) return Done{};
  if (within(state.prologue.done, moment)) RG_TRY(wait_for_fences(context, state.prologue.fences, state.prologue.fenced));
  for (const FrameSlot& slot : state.slots)
    if (within(slot.done, moment)) RG_TRY(wait_for_fences(context, slot.fences, slot.fenced));
  return Done{};
}

Status wait_for_entry(GraphInstance::State& state) {
  for (const VkSemaphoreSubmitInfo& wait : state.entry_waits) RG_TRY(wait_for_semaphores(state.context, 1, &wait.semaphore, &wait.value));
  state.entry_waits.clear();
  return Done{};
}

bool reached(const GraphInstance::State& state, const Moment& moment) {
  const WaitArrays arrays = wait_arrays(state, moment);
  for (uint32_t i = 0; i < arrays.count; ++i) {
    uint64_t done = 0;
    if (state.context.vk().GetSemaphoreCounterValue(state.context.device.device, arrays.semaphores[i], &done) != VK_SUCCESS) return false;
    if (done < arrays.values[i]) return false;
  }
  return true;
}

void release_retired(GraphInstance::State& state) {
  std::erase_if(state.retired, [&](const Retired& retired) { return reached(state, retired.moment); });
}

}  // namespace rg
