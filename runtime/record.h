// Commands of the steps of a frame, in whatever command buffer they go to.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

struct FrameRecording {
  GraphInstance::State& state;
  const FrameInputs& inputs;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  uint64_t frame = 0;
  VkQueryPool queries = VK_NULL_HANDLE;     // null: no timestamps
  VkQueryPool statistics = VK_NULL_HANDLE;  // null: none
  uint32_t module = 0;                      // whose label is open; 0: none
  const DeviceFunctions& vk;
  uint32_t section = 0;                 // of the parameter ring
  bool in_rendering = false;            // passes of one rendering follow
  const UniqueEvent* events = nullptr;  // by BarrierGroup::event; null: split groups are recorded whole, where they are awaited
};

// For a command buffer of a queue of the plan, with the queries that this queue can write.
FrameRecording start_recording(GraphInstance::State& state, const FrameInputs& inputs, const FrameSlot& slot, VkCommandBuffer commands, Index queue);

// First in a frame, where the host cannot do it.
void reset_queries(const FrameRecording& recording);

void record_steps(FrameRecording& recording, std::span<const Step> steps);

// Closes the label of the module before and opens the pass's. Only where the device has labels.
void change_module(FrameRecording& recording, const PassObjects& pass);

// Parts of a step, with whatever instruments there are.
void record_group(const FrameRecording& recording, Index group);
// The first half of a split group.
void record_set(const FrameRecording& recording, Index group);
void record_pass(FrameRecording& recording, Index pass);
// Pipeline, sets and work of a pass that runs, in the rendering that has begun.
void record_body(const FrameRecording& recording, Index pass);

void wait_for_all(const FrameRecording& recording);  // a barrier from everything to everything

void close_module(FrameRecording& recording);  // at the end of every command buffer

// The dumps that were asked for, right after their pass. In dump.cpp.
void record_dumps(FrameRecording& recording, Index pass);

}  // namespace rg
