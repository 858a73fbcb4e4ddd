#include <algorithm>
#include <array>

#include "runtime/executor.h"

namespace rg {

namespace {

// The slot of the newest frame that the device has finished; null: none.
const FrameSlot* last_finished(const GraphInstance::State& state) {
  uint64_t done = 0;
  if (state.context.vk().GetSemaphoreCounterValue(state.context.device.device, state.timeline.get(), &done) != VK_SUCCESS) return nullptr;
  const FrameSlot* last = nullptr;
  for (const FrameSlot& slot : state.slots)
    if (slot.frame != UINT64_MAX && slot.value <= done && (last == nullptr || slot.frame > last->frame)) last = &slot;
  return last;
}

std::vector<PassTime> wall_times(const GraphInstance::State& state) {
  std::vector<PassTime> times;
  for (size_t i = 0; i < state.wall_ms.size(); ++i) times.push_back({state.objects.passes[i].name, state.wall_ms[i]});
  return times;
}

double elapsed_ms(const Device::State& device, uint64_t begin, uint64_t end) {
  const uint64_t mask = device.timestamp_bits >= 64 ? UINT64_MAX : (uint64_t{1} << device.timestamp_bits) - 1;
  return static_cast<double>((end - begin) & mask) * static_cast<double>(device.limits.timestampPeriod) * 1e-6;
}

}  // namespace

std::vector<PassTime> GraphInstance::pass_times() {
  if (state_->frame == 0) return {};
  if (state_->context.submit_per_pass) return wall_times(*state_);
  const FrameSlot* slot = last_finished(*state_);
  const size_t passes = state_->objects.passes.size();
  if (slot == nullptr || !slot->queries || passes == 0) return {};
  std::vector<std::array<uint64_t, 2>> stamps(passes);
  const VkResult result =
      state_->context.vk().GetQueryPoolResults(state_->context.device.device, slot->queries.get(), 0, static_cast<uint32_t>(2 * passes),
                                               stamps.size() * sizeof stamps[0], stamps.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
  if (result != VK_SUCCESS) return {};
  std::vector<PassTime> times;
  for (size_t i = 0; i < passes; ++i)
    times.push_back({state_->objects.passes[i].name, elapsed_ms(state_->context.device, stamps[i][0], stamps[i][1])});
  return times;
}

}  // namespace rg
