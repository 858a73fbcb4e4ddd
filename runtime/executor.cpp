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
  if (job.state.entry_barrier && index == job.state.first_chunk[job.state.first_batch_of_queue[job.state.context.plan.batches[chunk.batch].queue]])
    wait_for_all(recording);
  record_steps(recording, job.state.context.plan.steps.subspan(chunk.first_step, chunk.step_count));
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
    const std::span<const VkSemaphoreSubmitInfo> waits =
        i == 0 ? std::span<const VkSemaphoreSubmitInfo>(state.entry_waits) : std::span<const VkSemaphoreSubmitInfo>();
    const uint32_t queue = state.context.queues.device_queue[plan.batches[chunk.batch].queue];
    const bool watched = !slot.fences.empty();
    RG_TRY(reset_fences(state.context, slot.fences, slot.fenced));
    RG_TRY(submit_one(state, {queue, slot.commands[i], true, waits, watched ? slot.fences[queue].get() : VkFence(VK_NULL_HANDLE)}));
    if (watched) slot.fenced[queue] = true;
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

namespace {

// Who had the heap last comes first.
void take_turn(GraphInstance::State& state) {
  const TransientHeap* heap = state.context.heap.get();
  if (heap == nullptr || heap->last_user == nullptr || heap->last_user == &state || state.has_turn) return;
  wait_at_entry(state, heap->timelines, heap->moment);
  state.has_turn = true;
}

// Everything before recording, the wait for the slot included. `whose`: who records into which command buffers.
enum class Commands : uint8_t { ours, engines };
Status begin_frame(GraphInstance::State& state, FrameInputs& inputs, const FrameSlot& slot, Commands whose) {
  RG_TRY(check_inputs(state, inputs));
  take_turn(state);
  RG_TRY(wait_for(state, slot.done));
  if (!state.retired.empty()) release_retired(state);
  if (whose == Commands::ours) RG_TRY(reset_commands(state.context, slot));
  RG_TRY(reset_events(state.context, slot));
  reset_slot_queries(state.context, slot);
  RG_TRY(take_inputs(state, inputs));
  return state.context.device.classic_render_passes ? update_framebuffers(state.context, *state.sized, state.frame) : Status(Done{});
}

void end_frame(GraphInstance::State& state, FrameSlot& slot) {
  slot.done = state.submitted;
  slot.frame = state.frame++;
  for (std::shared_ptr<Timelines>& source : slot.sources) state.context.device.rest(std::move(source));
  slot.sources.clear();
  slot.sources.swap(state.entry_sources);
  state.entry_barrier = state.has_turn = false;
  if (TransientHeap* heap = state.context.heap.get()) heap->last_user = &state, heap->timelines = state.timelines, heap->moment = state.submitted;
  for (DumpRequest& dump : state.dumps)
    if (!dump.recorded) dump.recorded = true, dump.done = state.submitted;
}

}  // namespace

Status execute_frame(GraphInstance::State& state, const FrameInputs& given) {
  FrameInputs inputs = given;
  FrameSlot& slot = state.slots[state.frame % state.slots.size()];
  RG_TRY(begin_frame(state, inputs, slot, Commands::ours));
  RG_TRY(record_frame(state, inputs, slot));
  slot.done = {};  // waited for: if the submit fails there is nothing to wait for
  RG_TRY(state.context.submit_per_pass ? run_one_by_one(state, slot) : submit_frame(state, inputs, slot));
  end_frame(state, slot);
  return Done{};
}

namespace {

// Walks the steps of all batches in listed order over the engine's command buffers. Where a batch would wait for others, a barrier stands in.
class OwnRecorder {
 public:
  OwnRecorder(GraphInstance::State& state, const FrameInputs& inputs, const FrameSlot& slot, std::span<const OwnCommands> parts)
      : state_(state), inputs_(inputs), slot_(slot), parts_(parts), recording_(start(0)) {
    reset_queries(recording_);
    if (state.entry_barrier) wait_for_all(recording_);
  }

  void batch(const Batch& batch) {
    if (batch.wait_count != 0) wait_for_all(recording_);
    const std::span<const Step> steps = state_.context.plan.steps.subspan(batch.first_step, batch.step_count);
    size_t begin = 0;  // of the part
    for (size_t i = 0; i < steps.size() && part_ + 1 < parts_.size(); ++i) {
      if (steps[i].kind != StepKind::pass || parts_[part_].last_pass != steps[i].index) continue;
      record_steps(recording_, steps.subspan(begin, i + 1 - begin));
      begin = i + 1;
      next();
    }
    record_steps(recording_, steps.subspan(begin));
  }
  // False: a pass that ends a part never came.
  bool finish() {
    close_module(recording_);
    return part_ + 1 == parts_.size();
  }

 private:
  FrameRecording start(size_t part) const {
    return start_recording(state_, inputs_, slot_, parts_[part].commands, state_.context.plan.batches[0].queue);
  }
  void next() {
    close_module(recording_);
    FrameRecording following = start(++part_);
    recording_.commands = following.commands;
  }

  GraphInstance::State& state_;
  const FrameInputs& inputs_;
  const FrameSlot& slot_;
  std::span<const OwnCommands> parts_;
  size_t part_ = 0;
  FrameRecording recording_;
};

}  // namespace

Status record_own_frame(GraphInstance::State& state, const FrameInputs& given, std::span<const OwnCommands> parts, const FrameDone& done) {
  FrameInputs inputs = given;
  FrameSlot& slot = state.slots[state.frame % state.slots.size()];
  RG_TRY(begin_frame(state, inputs, slot, Commands::engines));
  RG_TRY(wait_for_entry(state));  // a submit of the engine's waits for nothing of ours
  OwnRecorder recorder(state, inputs, slot, parts);
  for (const Batch& batch : state.context.plan.batches) recorder.batch(batch);
  if (!recorder.finish())
    return Error{ErrorCode::invalid_argument, "own commands: their last passes are not in the order in which passes are recorded"};
  state.submitted.engine = done.timeline;
  state.submitted.engine_value = done.value;
  end_frame(state, slot);
  return Done{};
}

}  // namespace rg
