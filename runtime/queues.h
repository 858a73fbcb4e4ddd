// Which VkQueue runs which queue of a plan, and what follows from it for barriers, sharing and submits.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Every queue of the plan gets the least used queue of the device that can do its work, among those the most specialised. A device with
// fewer queues runs several of the plan's on one, in the order in which batches are listed.
QueueMap map_queues(const Device::State& device, const Plan& plan, bool single_queue);

inline const DeviceQueue& queue_of(const Context& context, Index plan_queue) {
  return context.device.queues[context.queues.device_queue[plan_queue]];
}
inline uint32_t family_of(const Context& context, Index plan_queue) { return queue_of(context, plan_queue).family; }

// Between these two a resource of its own family is handed over; on one family the transfer is no transfer.
inline bool changes_family(const Context& context, Index src_queue, Index dst_queue) {
  return src_queue != kNone && dst_queue != kNone && family_of(context, src_queue) != family_of(context, dst_queue);
}

}  // namespace rg
