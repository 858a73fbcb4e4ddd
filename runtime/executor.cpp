#include "runtime/executor.h"

#include <chrono>

#include "runtime/errors.h"
#include "runtime/inputs.h"
#include "runtime/queues.h"
#include "runtime/record.h"
#include "runtime/render_pass.h"
#include "runtime/slots.h"
#include "runtime/submit.h"
#include "runtime/timelines.h"
#include "runtime/workers.h"

namespace rg {

namespace {

struct FrameJob {
  GraphInstance::State& state;
  const FrameInputs& inputs;
  const FrameSlot& slot;
};

VkResult record_steps(const FrameJob& job, uint32_t index) {
  const Chunk& chunk = job.state.chunks[index];
  const DeviceFunctions& vk = job.state.context.vk();
  const VkCommandBuffer commands = job.slot.commands[index];
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (const VkResult result = vk.BeginCommandBuffer(commands, &begin); result != VK_SUCCESS) return result;
  FrameRecording recording = start_recording(job.state, job.inputs, job.slot, commands, job.state.context.plan.batches[chunk.batch].queue);
  if (index == 0) reset_queries(recording);
  for (const Step& step : job.state.context.plan.steps.subspan(chunk.first_step, chunk.step_count)) record_step(recording, step);
  close_module(recording);
  return vk.EndCommandBuffer(commands);
}

void record_job(void* data, uint32_t index) {
  const FrameJob& job = *static_cast<const FrameJob*>(data);
  job.state.chunk_results[index] = record_steps(job, index);
}

Status record_frame(GraphInstance::State& state, const FrameInputs& inputs, const FrameSlot& slot) {
  FrameJob job{state, inputs, slot};
  const auto count = static_cast<uint32_t>(state.chunks.size());
  if (state.context.parallel.run != nullptr && state.context.threads > 1)
    state.context.parallel.run(state.context.parallel.user, count, record_job, &job);
  else if (state.workers)
    state.workers->run(count, record_job, &job);
  else
    for (uint32_t i = 0; i < count; ++i) record_job(&job, i);
  for (const VkResult result : state.chunk_results) RG_TRY(check(result, "recording a command buffer", state.context.plan.name));
  return Done{};
}

double milliseconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

// Each step in its own submit, waited for: only then does a clock separate passes on drivers that run asynchronously to their timestamps.
Status submit_one_by_one(GraphInstance::State& state, FrameSlot& slot) {
  const Plan& plan = state.context.plan;
  for (uint32_t i = 0; i < state.chunks.size(); ++i) {
    const Chunk& chunk = state.chunks[i];
    const auto start = std::chrono::steady_clock::now();
    RG_TRY(submit_one(state, {state.context.queues.device_queue[plan.batches[chunk.batch].queue], slot.commands[i], true, VK_NULL_HANDLE}));
    slot.done.values[0] = state.submitted.values[0];
    RG_TRY(wait_for(state, slot.done));
    if (chunk.step_count == 1 && plan.steps[chunk.first_step].kind == StepKind::pass)
      state.wall_ms[plan.steps[chunk.first_step].index] = milliseconds(std::chrono::steady_clock::now() - start);
  }
  state.entry_waits.clear();
  return Done{};
}

Status run_one_by_one(GraphInstance::State& state, FrameSlot& slot) {
  const Status done = submit_one_by_one(state, slot);
  state.broken |= !done;
  return done;
}

}  // namespace

Status execute_frame(GraphInstance::State& state, const FrameInputs& inputs) {
  RG_TRY(check_inputs(state, inputs));
  FrameSlot& slot = state.slots[state.frame % state.slots.size()];
  RG_TRY(wait_for_slot(state, slot));
  if (!state.retired.empty()) release_retired(state);
  RG_TRY(reset_slot(state, slot));
  RG_TRY(take_inputs(state, inputs));
  if (state.context.device.classic_render_passes) RG_TRY(update_framebuffers(state.context, *state.sized, state.frame));
  RG_TRY(record_frame(state, inputs, slot));
  slot.engine_done = VK_NULL_HANDLE;
  slot.done = {};  // waited for: if the submit fails there is nothing to wait for
  RG_TRY(state.context.submit_per_pass ? run_one_by_one(state, slot) : submit_frame(state, inputs, slot));
  slot.done = state.submitted;
  slot.frame = state.frame++;
  if (state.dump.pass != kNone && !state.dump.recorded) state.dump.recorded = true, state.dump.done = state.submitted;
  return Done{};
}

}  // namespace rg
