// VK_LAYER_RGC_queues: a device of one queue shows three families of one queue each: universal, compute, transfer. For tests.
//
//   RGC_QUEUES_SEED=n   reorder independent submissions by seed n; unset: in the order of the calls, as far as waits allow
//
// All queues run on one: this proves orderings, it says nothing about speed.
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/layer/layer.h"

namespace rgc_layer {

uint32_t universal_family(const InstanceLayer& instance, VkPhysicalDevice physical) {
  uint32_t count = 0;
  instance.GetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  instance.GetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t family = 0; family < count; ++family)
    if ((families[family].queueFlags & wanted) == wanted) return family;
  return 0;
}

namespace {

// ---- families -------------------------------------------------------------------------------------------------------

VkQueueFamilyProperties family_properties(VkPhysicalDevice physical, uint32_t family) {
  const InstanceLayer& instance = layer_of(physical);
  uint32_t count = 0;
  instance.GetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  instance.GetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  VkQueueFamilyProperties out = families[universal_family(instance, physical)];
  out.queueCount = 1;
  if (family == 1) out.queueFlags = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
  if (family == 2) out.queueFlags = VK_QUEUE_TRANSFER_BIT;
  return out;
}

void VKAPI_CALL GetPhysicalDeviceQueueFamilyProperties(VkPhysicalDevice physical, uint32_t* count, VkQueueFamilyProperties* out) {
  *count = out == nullptr ? kQueues : std::min(*count, kQueues);
  for (uint32_t family = 0; out != nullptr && family < *count; ++family) out[family] = family_properties(physical, family);
}
void VKAPI_CALL GetPhysicalDeviceQueueFamilyProperties2(VkPhysicalDevice physical, uint32_t* count, VkQueueFamilyProperties2* out) {
  *count = out == nullptr ? kQueues : std::min(*count, kQueues);
  for (uint32_t family = 0; out != nullptr && family < *count; ++family) out[family].queueFamilyProperties = family_properties(physical, family);
}
VkResult VKAPI_CALL GetPhysicalDeviceSurfaceSupportKHR(VkPhysicalDevice physical, uint32_t family, VkSurfaceKHR surface, VkBool32* supported) {
  *supported = VK_FALSE;
  const InstanceLayer& instance = layer_of(physical);
  if (family != 0) return VK_SUCCESS;
  return instance.GetPhysicalDeviceSurfaceSupportKHR(physical, universal_family(instance, physical), surface, supported);
}

// ---- instance -------------------------------------------------------------------------------------------------------

// The link to the next layer; the caller advances it.
template <class Link, class Info>
Link* find_link(const Info* info, VkStructureType type, VkLayerFunction function) {
  for (auto* at = const_cast<Link*>(static_cast<const Link*>(info->pNext)); at != nullptr;
       at = const_cast<Link*>(static_cast<const Link*>(at->pNext)))
    if (at->sType == type && at->function == function) return at;
  return nullptr;
}

template <class Function>
void load(Function& function, PFN_vkGetInstanceProcAddr next, VkInstance instance, const char* name) {
  function = reinterpret_cast<Function>(next(instance, name));
}

VkResult VKAPI_CALL CreateInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator, VkInstance* out) {
  auto* link = find_link<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO, VK_LAYER_LINK_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  auto instance = std::make_unique<InstanceLayer>();
  instance->next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  PFN_vkCreateInstance create = nullptr;
  load(create, instance->next, VK_NULL_HANDLE, "vkCreateInstance");
  const VkResult result = create(info, allocator, out);
  if (result != VK_SUCCESS) return result;
  instance->handle = *out;
  load(instance->DestroyInstance, instance->next, *out, "vkDestroyInstance");
  load(instance->GetPhysicalDeviceQueueFamilyProperties, instance->next, *out, "vkGetPhysicalDeviceQueueFamilyProperties");
  load(instance->GetPhysicalDeviceSurfaceSupportKHR, instance->next, *out, "vkGetPhysicalDeviceSurfaceSupportKHR");
  add_instance(std::move(instance));
  return VK_SUCCESS;
}

void VKAPI_CALL DestroyInstance(VkInstance instance, const VkAllocationCallbacks* allocator) {
  if (instance == VK_NULL_HANDLE) return;
  const PFN_vkDestroyInstance destroy = layer_of(instance).DestroyInstance;
  remove_instance(instance);
  destroy(instance, allocator);
}

// ---- device ---------------------------------------------------------------------------------------------------------

VkResult forward(const DeviceLayer& device, const Submission& submission) {
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.flags = submission.flags;
  info.waitSemaphoreInfoCount = static_cast<uint32_t>(submission.waits.size());
  info.pWaitSemaphoreInfos = submission.waits.data();
  info.commandBufferInfoCount = static_cast<uint32_t>(submission.commands.size());
  info.pCommandBufferInfos = submission.commands.data();
  info.signalSemaphoreInfoCount = static_cast<uint32_t>(submission.signals.size());
  info.pSignalSemaphoreInfos = submission.signals.data();
  const bool empty = submission.waits.empty() && submission.commands.empty() && submission.signals.empty();
  return device.QueueSubmit2(device.real, empty ? 0 : 1, &info, submission.fence);
}

std::optional<uint64_t> seed_of_environment() {
  const char* text = std::getenv("RGC_QUEUES_SEED");
  if (text == nullptr || *text == 0) return std::nullopt;
  return std::strtoull(text, nullptr, 10);
}

void load_functions(DeviceLayer& device) {
#define RGC_LOAD(name) device.name = reinterpret_cast<PFN_vk##name>(device.next(device.handle, "vk" #name));
  RGC_LAYER_DEVICE_FUNCTIONS(RGC_LOAD)
#undef RGC_LOAD
}

// The loader finds data of its own behind `out`, so it must be the pointer that came from above.
VkResult create_real_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info, const VkAllocationCallbacks* allocator, uint32_t family,
                            PFN_vkCreateDevice create, VkDevice* out) {
  constexpr float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo translated = *info;
  translated.queueCreateInfoCount = 1;
  translated.pQueueCreateInfos = &queue;
  return create(physical, &translated, allocator, out);
}

VkResult VKAPI_CALL CreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info, const VkAllocationCallbacks* allocator, VkDevice* out) {
  auto* link = find_link<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO, VK_LAYER_LINK_INFO);
  auto* callback = find_link<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO, VK_LOADER_DATA_CALLBACK);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const InstanceLayer& instance = layer_of(physical);
  auto device = std::make_unique<DeviceLayer>();
  const PFN_vkGetInstanceProcAddr next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  device->next = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  device->real_family = universal_family(instance, physical);
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  PFN_vkCreateDevice create = nullptr;
  load(create, next_instance, instance.handle, "vkCreateDevice");
  const VkResult result = create_real_device(physical, info, allocator, device->real_family, create, out);
  if (result != VK_SUCCESS) return result;
  device->handle = *out;
  load_functions(*device);
  device->GetDeviceQueue(*out, device->real_family, 0, &device->real);
  if (callback != nullptr) callback->u.pfnSetDeviceLoaderData(*out, device->real);
  for (uint32_t family = 0; family < kQueues; ++family) device->queues[family] = {dispatch_key(*out), device.get(), family};
  const DeviceLayer* raw = device.get();
  device->scheduler = std::make_unique<Scheduler>([raw](const Submission& submission) { return forward(*raw, submission); }, seed_of_environment());
  add_device(std::move(device));
  return VK_SUCCESS;
}

void VKAPI_CALL DestroyDevice(VkDevice device, const VkAllocationCallbacks* allocator) {
  if (device == VK_NULL_HANDLE) return;
  const std::unique_ptr<DeviceLayer> layer = remove_device(device);
  layer->DestroyDevice(device, allocator);
}

void VKAPI_CALL GetDeviceQueue(VkDevice device, uint32_t family, uint32_t index, VkQueue* queue) {
  *queue = family < kQueues && index == 0 ? reinterpret_cast<VkQueue>(&layer_of(device).queues[family]) : VkQueue(VK_NULL_HANDLE);
}
void VKAPI_CALL GetDeviceQueue2(VkDevice device, const VkDeviceQueueInfo2* info, VkQueue* queue) {
  GetDeviceQueue(device, info->queueFamilyIndex, info->queueIndex, queue);
}

// ---- by name --------------------------------------------------------------------------------------------------------

PFN_vkVoidFunction VKAPI_CALL GetInstanceProcAddr(VkInstance instance, const char* name);
PFN_vkVoidFunction VKAPI_CALL GetDeviceProcAddr(VkDevice device, const char* name);

struct Row {
  const char* name;
  PFN_vkVoidFunction function;
};
#define RGC_ROW(function) \
  { "vk" #function, reinterpret_cast<PFN_vkVoidFunction>(function) }
const Row kInstanceRows[] = {
    RGC_ROW(GetInstanceProcAddr),
    RGC_ROW(CreateInstance),
    RGC_ROW(DestroyInstance),
    RGC_ROW(CreateDevice),
    RGC_ROW(GetPhysicalDeviceQueueFamilyProperties),
    RGC_ROW(GetPhysicalDeviceQueueFamilyProperties2),
    {"vkGetPhysicalDeviceQueueFamilyProperties2KHR", reinterpret_cast<PFN_vkVoidFunction>(GetPhysicalDeviceQueueFamilyProperties2)},
    RGC_ROW(GetPhysicalDeviceSurfaceSupportKHR),
};
const Row kDeviceRows[] = {RGC_ROW(GetDeviceProcAddr), RGC_ROW(DestroyDevice), RGC_ROW(GetDeviceQueue), RGC_ROW(GetDeviceQueue2)};
#undef RGC_ROW

template <size_t Count>
PFN_vkVoidFunction find_row(const Row (&rows)[Count], const char* name) {
  for (const Row& row : rows)
    if (std::strcmp(row.name, name) == 0) return row.function;
  return nullptr;
}

PFN_vkVoidFunction find_device_function(const char* name) {
  if (const PFN_vkVoidFunction found = find_row(kDeviceRows, name)) return found;
  if (const PFN_vkVoidFunction found = find_queue_function(name)) return found;
  return find_family_function(name);
}

// What the driver does not have, this layer does not pretend to have.
PFN_vkVoidFunction VKAPI_CALL GetDeviceProcAddr(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(GetDeviceProcAddr);
  const PFN_vkVoidFunction below = layer_of(device).next(device, name);
  const PFN_vkVoidFunction here = find_device_function(name);
  return below != nullptr && here != nullptr ? here : below;
}

PFN_vkVoidFunction VKAPI_CALL GetInstanceProcAddr(VkInstance instance, const char* name) {
  if (const PFN_vkVoidFunction found = find_row(kInstanceRows, name)) return found;
  if (const PFN_vkVoidFunction found = find_device_function(name)) return found;
  return instance == VK_NULL_HANDLE ? nullptr : layer_of(instance).next(instance, name);
}

}  // namespace

}  // namespace rgc_layer

extern "C" __attribute__((visibility("default"))) VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiation) {
  negotiation->loaderLayerInterfaceVersion = std::min(negotiation->loaderLayerInterfaceVersion, 2u);
  negotiation->pfnGetInstanceProcAddr = rgc_layer::GetInstanceProcAddr;
  negotiation->pfnGetDeviceProcAddr = rgc_layer::GetDeviceProcAddr;
  negotiation->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
