#include "runtime/queues.h"

#include <algorithm>
#include <bit>

namespace rg {

namespace {

VkQueueFlags needed_flags(QueueKind kind) {
  switch (kind) {
    case QueueKind::graphics:
      return VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    case QueueKind::compute:
      return VK_QUEUE_COMPUTE_BIT;
    default:
      return VK_QUEUE_TRANSFER_BIT;
  }
}

bool serves(const DeviceQueue& queue, QueueKind kind) {
  const VkQueueFlags needed = needed_flags(kind);
  return (queue.flags & needed) == needed && !(kind == QueueKind::transfer && queue.whole_copies_only);
}

uint32_t choose(const Device::State& device, QueueKind kind, std::vector<uint32_t>& users) {
  uint32_t best = 0;
  auto rank = [&](uint32_t i) { return std::pair(users[i], std::popcount(device.queues[i].flags)); };
  for (uint32_t i = 1; i < device.queues.size(); ++i)
    if (serves(device.queues[i], kind) && rank(i) < rank(best)) best = i;
  ++users[best];
  return best;
}

void locate_steps(const Plan& plan, QueueMap& map) {
  map.of_group.resize(plan.groups.size());
  map.of_pass.resize(plan.passes.size());
  for (const Batch& batch : plan.batches)
    for (const Step& step : plan.steps.subspan(batch.first_step, batch.step_count))
      (step.kind == StepKind::pass ? map.of_pass : map.of_group)[step.index] = batch.queue;
}

void list_families(const Device::State& device, QueueMap& map) {
  map.families = {device.queues[0].family};
  for (const uint32_t queue : map.device_queue) {
    map.several |= queue != map.device_queue[0];
    if (std::find(map.families.begin(), map.families.end(), device.queues[queue].family) == map.families.end())
      map.families.push_back(device.queues[queue].family);
  }
}

}  // namespace

QueueMap map_queues(const Device::State& device, const Plan& plan, bool single_queue) {
  QueueMap map;
  map.device_queue.resize(plan.queues.size());
  std::vector<uint32_t> users(device.queues.size());
  for (const QueueKind kind : {QueueKind::graphics, QueueKind::compute, QueueKind::transfer})
    for (size_t q = 0; q < plan.queues.size() && !single_queue; ++q)
      if (plan.queues[q].kind == kind) map.device_queue[q] = choose(device, kind, users);
  locate_steps(plan, map);
  list_families(device, map);
  return map;
}

}  // namespace rg
