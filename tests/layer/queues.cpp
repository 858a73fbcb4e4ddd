// Submits, waits and presentation: everything that the scheduler has a say in.
#include <cstring>

#include "tests/layer/layer.h"

namespace rgc_layer {

namespace {

template <class Struct>
const Struct* find_struct(const void* chain, VkStructureType type) {
  for (auto* at = static_cast<const VkBaseInStructure*>(chain); at != nullptr; at = at->pNext)
    if (at->sType == type) return reinterpret_cast<const Struct*>(at);
  return nullptr;
}

// ---- submits ------------------------------------------------------------------------------------------------------

Submission copy(const VkSubmitInfo2& info) {
  Submission out;
  out.flags = info.flags;
  out.waits.assign(info.pWaitSemaphoreInfos, info.pWaitSemaphoreInfos + info.waitSemaphoreInfoCount);
  out.signals.assign(info.pSignalSemaphoreInfos, info.pSignalSemaphoreInfos + info.signalSemaphoreInfoCount);
  out.commands.assign(info.pCommandBufferInfos, info.pCommandBufferInfos + info.commandBufferInfoCount);
  return out;
}

VkSemaphoreSubmitInfo semaphore_info(VkSemaphore semaphore, uint64_t value, VkPipelineStageFlags2 stages) {
  return {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, nullptr, semaphore, value, stages, 0};
}

uint64_t value_at(const uint64_t* values, uint32_t count, uint32_t i) { return values != nullptr && i < count ? values[i] : 0; }

Submission copy(const VkSubmitInfo& info) {
  constexpr VkPipelineStageFlags2 all = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  Submission out;
  const auto* timeline = find_struct<VkTimelineSemaphoreSubmitInfo>(info.pNext, VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO);
  const VkTimelineSemaphoreSubmitInfo values = timeline != nullptr ? *timeline : VkTimelineSemaphoreSubmitInfo{};
  for (uint32_t i = 0; i < info.waitSemaphoreCount; ++i)
    out.waits.push_back(semaphore_info(info.pWaitSemaphores[i], value_at(values.pWaitSemaphoreValues, values.waitSemaphoreValueCount, i),
                                       info.pWaitDstStageMask != nullptr ? info.pWaitDstStageMask[i] : all));
  for (uint32_t i = 0; i < info.signalSemaphoreCount; ++i)
    out.signals.push_back(
        semaphore_info(info.pSignalSemaphores[i], value_at(values.pSignalSemaphoreValues, values.signalSemaphoreValueCount, i), all));
  for (uint32_t i = 0; i < info.commandBufferCount; ++i)
    out.commands.push_back({VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, info.pCommandBuffers[i], 0});
  return out;
}

// Extension structs cannot be copied by one who does not know them: such a submit goes alone, after all that is held.
bool extended(const VkSubmitInfo2& info) { return info.pNext != nullptr; }

VkResult VKAPI_CALL QueueSubmit2(VkQueue handle, uint32_t count, const VkSubmitInfo2* infos, VkFence fence) {
  LayerQueue& queue = layer_of(handle);
  DeviceLayer& device = *queue.device;
  for (uint32_t i = 0; i < count; ++i)
    if (extended(infos[i])) return device.scheduler->drain([&] { return device.QueueSubmit2(device.real, count, infos, fence); });
  std::vector<Submission> submissions;
  for (uint32_t i = 0; i < count; ++i) submissions.push_back(copy(infos[i]));
  if (submissions.empty()) submissions.emplace_back();
  submissions.back().fence = fence;
  return device.scheduler->submit(queue.family, std::move(submissions));
}

VkResult VKAPI_CALL QueueSubmit(VkQueue handle, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
  LayerQueue& queue = layer_of(handle);
  std::vector<Submission> submissions;
  for (uint32_t i = 0; i < count; ++i) submissions.push_back(copy(infos[i]));
  if (submissions.empty()) submissions.emplace_back();
  submissions.back().fence = fence;
  return queue.device->scheduler->submit(queue.family, std::move(submissions));
}

VkResult VKAPI_CALL QueueBindSparse(VkQueue handle, uint32_t count, const VkBindSparseInfo* infos, VkFence fence) {
  DeviceLayer& device = *layer_of(handle).device;
  return device.scheduler->drain([&] { return device.QueueBindSparse(device.real, count, infos, fence); });
}

VkResult VKAPI_CALL QueuePresentKHR(VkQueue handle, const VkPresentInfoKHR* info) {
  DeviceLayer& device = *layer_of(handle).device;
  return device.scheduler->drain([&] { return device.QueuePresentKHR(device.real, info); });
}

// ---- waits of the host ----------------------------------------------------------------------------------------------

VkResult VKAPI_CALL QueueWaitIdle(VkQueue handle) {
  DeviceLayer& device = *layer_of(handle).device;
  return device.scheduler->drain([&] { return device.QueueWaitIdle(device.real); });
}
VkResult VKAPI_CALL DeviceWaitIdle(VkDevice handle) {
  DeviceLayer& device = layer_of(handle);
  return device.scheduler->drain([&] { return device.DeviceWaitIdle(handle); });
}
VkResult VKAPI_CALL WaitSemaphores(VkDevice handle, const VkSemaphoreWaitInfo* info, uint64_t timeout) {
  DeviceLayer& device = layer_of(handle);
  const Scheduler::HostWait wait(*device.scheduler);
  return device.WaitSemaphores(handle, info, timeout);
}
VkResult VKAPI_CALL WaitForFences(VkDevice handle, uint32_t count, const VkFence* fences, VkBool32 all, uint64_t timeout) {
  DeviceLayer& device = layer_of(handle);
  const Scheduler::HostWait wait(*device.scheduler);
  return device.WaitForFences(handle, count, fences, all, timeout);
}
VkResult VKAPI_CALL GetFenceStatus(VkDevice handle, VkFence fence) {  // who polls would poll for ever
  DeviceLayer& device = layer_of(handle);
  const Scheduler::HostWait wait(*device.scheduler);
  return device.GetFenceStatus(handle, fence);
}
VkResult VKAPI_CALL GetSemaphoreCounterValue(VkDevice handle, VkSemaphore semaphore, uint64_t* value) {
  DeviceLayer& device = layer_of(handle);
  const Scheduler::HostWait wait(*device.scheduler);
  return device.GetSemaphoreCounterValue(handle, semaphore, value);
}

// ---- semaphores -----------------------------------------------------------------------------------------------------

VkResult VKAPI_CALL CreateSemaphore(VkDevice handle, const VkSemaphoreCreateInfo* info, const VkAllocationCallbacks* allocator,
                                    VkSemaphore* semaphore) {
  DeviceLayer& device = layer_of(handle);
  const VkResult result = device.CreateSemaphore(handle, info, allocator, semaphore);
  if (result != VK_SUCCESS) return result;
  const auto* type = find_struct<VkSemaphoreTypeCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO);
  const bool timeline = type != nullptr && type->semaphoreType == VK_SEMAPHORE_TYPE_TIMELINE;
  device.scheduler->add_semaphore(*semaphore, timeline, timeline ? type->initialValue : 0);
  return result;
}
void VKAPI_CALL DestroySemaphore(VkDevice handle, VkSemaphore semaphore, const VkAllocationCallbacks* allocator) {
  DeviceLayer& device = layer_of(handle);
  device.scheduler->remove_semaphore(semaphore);
  device.DestroySemaphore(handle, semaphore, allocator);
}
VkResult VKAPI_CALL SignalSemaphore(VkDevice handle, const VkSemaphoreSignalInfo* info) {
  DeviceLayer& device = layer_of(handle);
  const VkResult result = device.SignalSemaphore(handle, info);
  if (result == VK_SUCCESS) device.scheduler->signal_from_host(info->semaphore, info->value);
  return result;
}

// ---- names and labels -----------------------------------------------------------------------------------------------

VkResult VKAPI_CALL SetDebugUtilsObjectNameEXT(VkDevice handle, const VkDebugUtilsObjectNameInfoEXT* info) {
  DeviceLayer& device = layer_of(handle);
  if (device.SetDebugUtilsObjectNameEXT == nullptr || info->objectType == VK_OBJECT_TYPE_QUEUE) return VK_SUCCESS;  // below there is only one
  return device.SetDebugUtilsObjectNameEXT(handle, info);
}
void VKAPI_CALL QueueBeginDebugUtilsLabelEXT(VkQueue, const VkDebugUtilsLabelEXT*) {}  // would label what was not forwarded yet
void VKAPI_CALL QueueEndDebugUtilsLabelEXT(VkQueue) {}
void VKAPI_CALL QueueInsertDebugUtilsLabelEXT(VkQueue, const VkDebugUtilsLabelEXT*) {}

}  // namespace

PFN_vkVoidFunction find_queue_function(const char* name) {
  struct Row {
    const char* name;
    PFN_vkVoidFunction function;
  };
#define RGC_ROW(function) \
  { "vk" #function, reinterpret_cast<PFN_vkVoidFunction>(function) }
#define RGC_KHR_ROW(function) \
  { "vk" #function "KHR", reinterpret_cast<PFN_vkVoidFunction>(function) }
  static const Row rows[] = {
      RGC_ROW(QueueSubmit),
      RGC_ROW(QueueSubmit2),
      RGC_KHR_ROW(QueueSubmit2),
      RGC_ROW(QueueBindSparse),
      RGC_ROW(QueuePresentKHR),
      RGC_ROW(QueueWaitIdle),
      RGC_ROW(DeviceWaitIdle),
      RGC_ROW(WaitSemaphores),
      RGC_KHR_ROW(WaitSemaphores),
      RGC_ROW(WaitForFences),
      RGC_ROW(GetFenceStatus),
      RGC_ROW(GetSemaphoreCounterValue),
      RGC_KHR_ROW(GetSemaphoreCounterValue),
      RGC_ROW(CreateSemaphore),
      RGC_ROW(DestroySemaphore),
      RGC_ROW(SignalSemaphore),
      RGC_KHR_ROW(SignalSemaphore),
      RGC_ROW(SetDebugUtilsObjectNameEXT),
      RGC_ROW(QueueBeginDebugUtilsLabelEXT),
      RGC_ROW(QueueEndDebugUtilsLabelEXT),
      RGC_ROW(QueueInsertDebugUtilsLabelEXT),
  };
#undef RGC_ROW
#undef RGC_KHR_ROW
  for (const Row& row : rows)
    if (std::strcmp(row.name, name) == 0) return row.function;
  return nullptr;
}

}  // namespace rgc_layer
