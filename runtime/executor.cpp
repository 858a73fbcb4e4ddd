#include "runtime/executor.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "runtime/barriers.h"
#include "runtime/descriptors.h"
#include "runtime/errors.h"
#include "runtime/prologue.h"
#include "runtime/record.h"
#include "runtime/render_pass.h"
#include "runtime/transfers.h"
#include "runtime/views.h"

namespace rg {

namespace {

Status create_fence(const Context& context, FrameSlot& slot) {
  VkFenceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
  VkFence fence = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateFence(context.device.device, &info, nullptr, &fence), "vkCreateFence", context.plan.name));
  slot.fence = UniqueFence(context.vk(), context.device.device, fence);
  return Done{};
}

Status create_queries(const Context& context, uint32_t queries, FrameSlot& slot) {
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = queries;
  VkQueryPool pool = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateQueryPool(context.device.device, &info, nullptr, &pool), "vkCreateQueryPool", context.plan.name));
  slot.queries = UniqueQueryPool(context.vk(), context.device.device, pool);
  return Done{};
}

Status create_slot(const Context& context, uint32_t command_buffers, uint32_t queries, FrameSlot& slot) {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool_info.queueFamilyIndex = context.device.queue_family;
  VkCommandPool pool = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateCommandPool(context.device.device, &pool_info, nullptr, &pool), "vkCreateCommandPool", context.plan.name));
  slot.pool = UniqueCommandPool(context.vk(), context.device.device, pool);
  slot.commands.resize(command_buffers);
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.commandBufferCount = command_buffers;
  RG_TRY(
      check(context.vk().AllocateCommandBuffers(context.device.device, &info, slot.commands.data()), "vkAllocateCommandBuffers", context.plan.name));
  if (context.device.validating) RG_TRY(create_fence(context, slot));
  return queries == 0 || context.device.timestamp_bits == 0 ? Status(Done{}) : create_queries(context, queries, slot);
}

Result<UniqueSemaphore> create_timeline(const Context& context) {
  VkSemaphoreTypeCreateInfo type{};
  type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  info.pNext = &type;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateSemaphore(context.device.device, &info, nullptr, &semaphore), "vkCreateSemaphore", context.plan.name));
  return UniqueSemaphore(context.vk(), context.device.device, semaphore);
}

Status create_timelines(GraphInstance::State& state) {
  Result<UniqueSemaphore> timeline = create_timeline(state.context);
  if (!timeline) return timeline.error();
  state.timeline = std::move(*timeline);
  const Plan& plan = state.context.plan;
  if (plan.signals.empty()) return Done{};
  state.queue_signals.resize(plan.queues.size());
  for (size_t q = 0; q < plan.queues.size(); ++q) {
    Result<UniqueSemaphore> queue = create_timeline(state.context);
    if (!queue) return queue.error();
    state.queue_timelines.push_back(std::move(*queue));
  }
  for (const Batch& batch : plan.batches)
    for (const Signal& signal : plan.signals.subspan(batch.first_signal, batch.signal_count))
      state.queue_signals[batch.queue] = std::max(state.queue_signals[batch.queue], signal.value);
  return Done{};
}

VkSemaphoreSubmitInfo semaphore_info(VkSemaphore semaphore, uint64_t value, VkPipelineStageFlags2 stages) {
  return {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, nullptr, semaphore, value, stages, 0};
}

VkCommandBufferSubmitInfo commands_info(VkCommandBuffer commands) { return {VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands, 0}; }

VkSubmitInfo2 submit_info(const VkCommandBufferSubmitInfo& commands) {
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &commands;
  return info;
}

Status submit(GraphInstance::State& state, FrameSlot& slot, uint32_t count, const VkSubmitInfo2* infos) {
  const Context& context = state.context;
  const VkFence fence = slot.fence.get();
  slot.value = 0;  // its last frame was waited for; if this submit fails there is nothing to wait for
  if (slot.fence) RG_TRY(check(context.vk().ResetFences(context.device.device, 1, &fence), "vkResetFences", context.plan.name));
  const std::lock_guard lock(context.device.queue_mutex);
  return check(context.vk().QueueSubmit2(context.device.queue, count, infos, fence), "vkQueueSubmit2", context.plan.name);
}

// One submit of one command buffer that advances the timeline.
Status submit_one(GraphInstance::State& state, FrameSlot& slot, VkCommandBuffer commands) {
  const VkCommandBufferSubmitInfo command_info = commands_info(commands);
  const VkSemaphoreSubmitInfo signal = semaphore_info(state.timeline.get(), state.submitted + 1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  VkSubmitInfo2 info = submit_info(command_info);
  info.signalSemaphoreInfoCount = 1;
  info.pSignalSemaphoreInfos = &signal;
  RG_TRY(submit(state, slot, 1, &info));
  slot.value = ++state.submitted;
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

Error wrong(std::string message) { return Error{ErrorCode::invalid_argument, std::move(message)}; }

Status check_imports(const GraphInstance::State& state, const FrameInputs& inputs) {
  if (inputs.imports.size() < state.imports.size())
    return wrong("too few imports: " + std::to_string(inputs.imports.size()) + " of " + std::to_string(state.imports.size()));
  for (const Index index : state.imported) {
    const Resource& resource = state.context.plan.resources[index];
    const Import& import = inputs.imports[resource.import_slot];
    const bool present = resource.kind == ResourceKind::image ? import.image.image != VK_NULL_HANDLE : import.buffer.buffer != VK_NULL_HANDLE;
    if (!present) return wrong("nothing is imported for `" + std::string(resource.name) + "`");
  }
  return Done{};
}

Status check_params(const Plan& plan, const FrameInputs& inputs) {
  if (inputs.params.size() < plan.params.size()) return wrong("too few parameter blocks");
  for (size_t i = 0; i < plan.params.size(); ++i)
    if (inputs.params[i].size() != plan.params[i].bytes)
      return wrong("parameter block `" + std::string(plan.params[i].name) + "` has " + std::to_string(inputs.params[i].size()) +
                   " bytes instead of " + std::to_string(plan.params[i].bytes));
  return Done{};
}

Status check_inputs(const GraphInstance::State& state, const FrameInputs& inputs) {
  const Plan& plan = state.context.plan;
  RG_TRY(check_imports(state, inputs));
  RG_TRY(check_params(plan, inputs));
  if (!state.host_passes.empty() && inputs.callbacks == nullptr) return wrong("no callbacks");
  for (const Index pass : state.host_passes)
    if (inputs.callbacks[plan.passes[pass].host_slot] == nullptr) return wrong("pass `" + std::string(plan.passes[pass].name) + "` has no callback");
  if (inputs.updates.size() < state.update_slots) return wrong("too few updates");
  if (inputs.engine_sets.size() < plan.engine_sets.size()) return wrong("too few engine sets");
  return Done{};
}

bool same_imports(const std::vector<Import>& held, std::span<const Import> given) {
  for (size_t i = 0; i < held.size(); ++i) {
    const Import &a = held[i], &b = given[i];
    if (a.image.image != b.image.image || a.image.view != b.image.view || a.buffer.buffer != b.buffer.buffer || a.buffer.offset != b.buffer.offset ||
        a.buffer.size != b.buffer.size)
      return false;
  }
  return true;
}

Status take_imports(GraphInstance::State& state, const FrameInputs& inputs) {
  if (!same_imports(state.imports, inputs.imports) || !state.imports_applied) {
    std::copy_n(inputs.imports.begin(), state.imports.size(), state.imports.begin());
    update_imported_barriers(state.context, *state.sized, state.imports);
  }
  state.imports_applied = true;
  RG_TRY(update_imported_views(state.context, *state.sized, state.imports, state.frame));
  update_imported_bindings(state.context, *state.sized, state.imports, state.frame);
  return Done{};
}

void write_params(const GraphInstance::State& state, const FrameInputs& inputs) {
  const Ring& ring = state.sized->ring;
  for (size_t i = 0; i < state.context.plan.params.size(); ++i)
    if (!inputs.params[i].empty())
      std::memcpy(ring.mapped + state.frame % state.context.frames_in_flight * ring.section + ring.param_offsets[i], inputs.params[i].data(),
                  inputs.params[i].size());
}

Status record_batch(GraphInstance::State& state, const FrameInputs& inputs, const FrameSlot& slot, const Batch& batch, VkCommandBuffer commands,
                    bool first) {
  const Context& context = state.context;
  RG_TRY(begin_commands(context, commands));
  if (first && slot.queries) context.vk().CmdResetQueryPool(commands, slot.queries.get(), 0, 2 * static_cast<uint32_t>(context.plan.passes.size()));
  FrameRecording recording{state, inputs, commands, state.frame, slot.queries.get(), 0};
  for (const Step& step : context.plan.steps.subspan(batch.first_step, batch.step_count)) record_step(recording, step);
  close_module(recording);
  return end_commands(context, commands);
}

uint64_t queue_value(const GraphInstance::State& state, Index queue, uint64_t value) { return state.frame * state.queue_signals[queue] + value; }

// All batches in one call: with one queue their order is the order of execution.
void fill_submits(GraphInstance::State& state, const FrameSlot& slot) {
  const Plan& plan = state.context.plan;
  state.submit_waits.clear(), state.submit_signals.clear(), state.submits.clear();
  for (size_t b = 0; b < plan.batches.size(); ++b) {
    const Batch& batch = plan.batches[b];
    state.submit_commands[b] = commands_info(slot.commands[b]);
    VkSubmitInfo2& info = state.submits.emplace_back(submit_info(state.submit_commands[b]));
    info.waitSemaphoreInfoCount = batch.wait_count;
    info.pWaitSemaphoreInfos = state.submit_waits.data() + state.submit_waits.size();
    for (const Wait& wait : plan.waits.subspan(batch.first_wait, batch.wait_count))
      state.submit_waits.push_back(semaphore_info(state.queue_timelines[wait.queue].get(), queue_value(state, wait.queue, wait.value), wait.stages));
    info.signalSemaphoreInfoCount = batch.signal_count;
    info.pSignalSemaphoreInfos = state.submit_signals.data() + state.submit_signals.size();
    for (const Signal& signal : plan.signals.subspan(batch.first_signal, batch.signal_count))
      state.submit_signals.push_back(
          semaphore_info(state.queue_timelines[batch.queue].get(), queue_value(state, batch.queue, signal.value), signal.stages));
  }
  state.submit_signals.push_back(semaphore_info(state.timeline.get(), state.submitted + 1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT));
  state.submits.back().pSignalSemaphoreInfos = &state.submit_signals.back() - state.submits.back().signalSemaphoreInfoCount;
  ++state.submits.back().signalSemaphoreInfoCount;
}

Status run_batches(GraphInstance::State& state, const FrameInputs& inputs, FrameSlot& slot) {
  const Plan& plan = state.context.plan;
  for (size_t b = 0; b < plan.batches.size(); ++b) RG_TRY(record_batch(state, inputs, slot, plan.batches[b], slot.commands[b], b == 0));
  fill_submits(state, slot);
  RG_TRY(submit(state, slot, static_cast<uint32_t>(state.submits.size()), state.submits.data()));
  slot.value = ++state.submitted;
  return Done{};
}

double milliseconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

// Each step in its own submit, waited for: only then does a clock separate passes on drivers that run asynchronously to their timestamps.
Status run_one_by_one(GraphInstance::State& state, const FrameInputs& inputs, FrameSlot& slot) {
  const Plan& plan = state.context.plan;
  for (size_t s = 0; s < plan.steps.size(); ++s) {
    RG_TRY(begin_commands(state.context, slot.commands[s]));
    FrameRecording recording{state, inputs, slot.commands[s], state.frame, VK_NULL_HANDLE, 0};
    record_step(recording, plan.steps[s]);
    close_module(recording);
    RG_TRY(end_commands(state.context, slot.commands[s]));
    const auto start = std::chrono::steady_clock::now();
    RG_TRY(submit_one(state, slot, slot.commands[s]));
    RG_TRY(wait_for(state, state.submitted));
    if (plan.steps[s].kind == StepKind::pass) state.wall_ms[plan.steps[s].index] = milliseconds(std::chrono::steady_clock::now() - start);
  }
  return Done{};
}

}  // namespace

Status create_frames(GraphInstance::State& state) {
  const Plan& plan = state.context.plan;
  RG_TRY(create_timelines(state));
  RG_TRY(create_slot(state.context, 1, 0, state.prologue));
  const auto buffers = static_cast<uint32_t>(std::max<size_t>(state.context.submit_per_pass ? plan.steps.size() : plan.batches.size(), 1));
  state.slots.resize(state.context.frames_in_flight);
  for (FrameSlot& slot : state.slots) RG_TRY(create_slot(state.context, buffers, 2 * static_cast<uint32_t>(plan.passes.size()), slot));
  state.wall_ms.resize(plan.passes.size());
  state.submits.reserve(plan.batches.size());
  state.submit_commands.resize(plan.batches.size());
  state.submit_waits.reserve(plan.waits.size());
  state.submit_signals.reserve(plan.signals.size() + 1);
  return Done{};
}

namespace {

Status wait_for_fence(const Context& context, const FrameSlot& slot, uint64_t value) {
  if (!slot.fence || slot.value == 0 || slot.value > value) return Done{};
  const VkFence fence = slot.fence.get();
  return check(context.vk().WaitForFences(context.device.device, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences", context.plan.name);
}

}  // namespace

Status wait_for(const GraphInstance::State& state, uint64_t value) {
  if (value == 0) return Done{};
  const VkSemaphore semaphore = state.timeline.get();
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &semaphore;
  info.pValues = &value;
  RG_TRY(check(state.context.vk().WaitSemaphores(state.context.device.device, &info, UINT64_MAX), "vkWaitSemaphores", state.context.plan.name));
  RG_TRY(wait_for_fence(state.context, state.prologue, value));
  for (const FrameSlot& slot : state.slots) RG_TRY(wait_for_fence(state.context, slot, value));
  return Done{};
}

Status release_retired(GraphInstance::State& state) {
  if (state.retired.empty()) return Done{};
  uint64_t done = 0;
  RG_TRY(check(state.context.vk().GetSemaphoreCounterValue(state.context.device.device, state.timeline.get(), &done), "vkGetSemaphoreCounterValue",
               state.context.plan.name));
  std::erase_if(state.retired, [&](const Retired& retired) { return retired.value <= done; });
  return Done{};
}

Status submit_prologue(GraphInstance::State& state, const Sized& sized) {
  RG_TRY(wait_for(state, state.prologue.value));
  const VkCommandBuffer commands = state.prologue.commands[0];
  RG_TRY(check(state.context.vk().ResetCommandPool(state.context.device.device, state.prologue.pool.get(), 0), "vkResetCommandPool",
               state.context.plan.name));
  RG_TRY(begin_commands(state.context, commands));
  record_prologue(state.context, sized, commands, state.frame);
  RG_TRY(end_commands(state.context, commands));
  return submit_one(state, state.prologue, commands);
}

Status execute_frame(GraphInstance::State& state, const FrameInputs& inputs) {
  RG_TRY(check_inputs(state, inputs));
  FrameSlot& slot = state.slots[state.frame % state.slots.size()];
  RG_TRY(wait_for(state, slot.value));
  RG_TRY(release_retired(state));
  RG_TRY(check(state.context.vk().ResetCommandPool(state.context.device.device, slot.pool.get(), 0), "vkResetCommandPool", state.context.plan.name));
  RG_TRY(take_imports(state, inputs));
  if (state.context.device.classic_render_passes) RG_TRY(update_framebuffers(state.context, *state.sized, state.frame));
  write_params(state, inputs);
  RG_TRY(write_updates(state.context, *state.sized, inputs, state.frame));
  const bool one_by_one = state.context.submit_per_pass;
  RG_TRY(one_by_one ? run_one_by_one(state, inputs, slot) : run_batches(state, inputs, slot));
  slot.frame = state.frame++;
  if (state.dump.pass != kNone && state.dump.value == 0) state.dump.value = state.submitted;
  return Done{};
}

}  // namespace rg
