// From recorded command buffers to vkQueueSubmit2. Allocates nothing.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Submits the frame that `slot` holds: a VkSubmitInfo2 a batch, consecutive batches of one VkQueue in one call. On failure either nothing was
// submitted, or `state.broken` is set.
Status submit_frame(GraphInstance::State& state, const FrameInputs& inputs, FrameSlot& slot);

// Those that were given to a submit, which has been waited for.
Status reset_fences(const Context& context, const std::vector<UniqueFence>& fences, std::vector<bool>& fenced);

// One command buffer on a device queue; advances the instance's own timeline, after waiting for what it was submitted last where `chained`.
struct SingleSubmit {
  uint32_t queue = 0;  // in Device::State::queues
  VkCommandBuffer commands = VK_NULL_HANDLE;
  bool chained = false;
  std::span<const VkSemaphoreSubmitInfo> waits = {};  // besides
  VkFence fence = VK_NULL_HANDLE;
};
Status submit_one(GraphInstance::State& state, const SingleSubmit& submit);

// The next frame waits for `moment` on every queue, and begins behind it.
void wait_at_entry(GraphInstance::State& state, const std::shared_ptr<Timelines>& timelines, const Moment& moment);

// Records and submits the prologue of `sized`, ordered before the next frame on every queue. On failure nothing of it runs any more.
Status submit_prologue(GraphInstance::State& state, const Sized& sized);

// After a frame that was submitted in part: lets its queues catch up.
Status mend_timelines(GraphInstance::State& state);

Status begin_commands(const Context& context, VkCommandBuffer commands);
Status end_commands(const Context& context, VkCommandBuffer commands);

}  // namespace rg
