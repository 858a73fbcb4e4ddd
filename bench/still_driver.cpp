#include "bench/still_driver.h"

#include <atomic>
#include <cstring>
#include <map>
#include <string>

#include "runtime/functions.h"

namespace rg::bench {
namespace {

uint64_t calls = 0;
uint64_t handles = 16;  // of everything that is created

// One function of the table: nothing, success, or a handle where the last argument asks for one.
template <class Function, bool counted>
struct Still;
template <class Result, class... Arguments, bool counted>
struct Still<Result (*)(Arguments...), counted> {
  static Result call(Arguments...) {
    if constexpr (counted) ++calls;
    if constexpr (!std::is_void_v<Result>) return Result{};
  }
};
template <class Info, class Handle, bool counted>
struct Still<VkResult (*)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*), counted> {
  static VkResult call(VkDevice, const Info*, const VkAllocationCallbacks*, Handle* handle) {
    *handle = reinterpret_cast<Handle>(++handles);
    return VK_SUCCESS;
  }
};
template <class Info, bool counted>
struct Still<VkResult (*)(VkDevice, VkPipelineCache, uint32_t, const Info*, const VkAllocationCallbacks*, VkPipeline*), counted> {
  static VkResult call(VkDevice, VkPipelineCache, uint32_t count, const Info*, const VkAllocationCallbacks*, VkPipeline* out) {
    for (uint32_t i = 0; i < count; ++i) out[i] = reinterpret_cast<VkPipeline>(++handles);
    return VK_SUCCESS;
  }
};

constexpr VkDeviceSize kMapped = 1 << 22;
alignas(64) std::byte mapped[kMapped];
std::map<uint64_t, VkDeviceSize> sizes;  // of images and buffers

VkResult VKAPI_CALL create_image(VkDevice, const VkImageCreateInfo* info, const VkAllocationCallbacks*, VkImage* image) {
  *image = reinterpret_cast<VkImage>(++handles);
  sizes[handles] = VkDeviceSize{info->extent.width} * info->extent.height * info->extent.depth * info->arrayLayers * info->samples * 8;
  return VK_SUCCESS;
}
VkResult VKAPI_CALL create_buffer(VkDevice, const VkBufferCreateInfo* info, const VkAllocationCallbacks*, VkBuffer* buffer) {
  *buffer = reinterpret_cast<VkBuffer>(++handles);
  sizes[handles] = info->size;
  return VK_SUCCESS;
}
void VKAPI_CALL image_requirements(VkDevice, VkImage image, VkMemoryRequirements* out) {
  *out = {sizes[reinterpret_cast<uint64_t>(image)], 65536, 1};
}
void VKAPI_CALL image_requirements_2(VkDevice device, const VkImageMemoryRequirementsInfo2* info, VkMemoryRequirements2* out) {
  image_requirements(device, info->image, &out->memoryRequirements);
}
void VKAPI_CALL buffer_requirements(VkDevice, VkBuffer buffer, VkMemoryRequirements* out) {
  *out = {sizes[reinterpret_cast<uint64_t>(buffer)], 256, 1};
}
VkResult VKAPI_CALL map_memory(VkDevice, VkDeviceMemory, VkDeviceSize, VkDeviceSize, VkMemoryMapFlags, void** data) {
  *data = mapped;
  return VK_SUCCESS;
}
VkResult VKAPI_CALL semaphore_value(VkDevice, VkSemaphore, uint64_t* value) {
  *value = UINT64_MAX;
  return VK_SUCCESS;
}
VkResult VKAPI_CALL allocate_commands(VkDevice, const VkCommandBufferAllocateInfo* info, VkCommandBuffer* commands) {
  for (uint32_t i = 0; i < info->commandBufferCount; ++i) commands[i] = reinterpret_cast<VkCommandBuffer>(++handles);
  return VK_SUCCESS;
}
VkResult VKAPI_CALL allocate_sets(VkDevice, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets) {
  for (uint32_t i = 0; i < info->descriptorSetCount; ++i) sets[i] = reinterpret_cast<VkDescriptorSet>(++handles);
  return VK_SUCCESS;
}
void VKAPI_CALL properties(VkPhysicalDevice, VkPhysicalDeviceProperties* out) {
  *out = {};
  std::strcpy(out->deviceName, "still");
  VkPhysicalDeviceLimits& limits = out->limits;
  limits.maxImageDimension1D = limits.maxImageDimension2D = limits.maxImageDimension3D = limits.maxImageDimensionCube = 16384;
  limits.maxImageArrayLayers = 2048;
  limits.maxPushConstantsSize = 256;
  limits.timestampPeriod = 1;
}
void VKAPI_CALL memory_properties(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* out) {
  *out = {};
  out->memoryTypeCount = out->memoryHeapCount = 1;
  out->memoryTypes[0].propertyFlags =
      VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}
void VKAPI_CALL families(VkPhysicalDevice, uint32_t* count, VkQueueFamilyProperties* out) {
  *count = 1;
  if (out != nullptr) *out = {VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT, 1, 64, {1, 1, 1}};
}
VkResult VKAPI_CALL image_formats(VkPhysicalDevice, VkFormat, VkImageType, VkImageTiling, VkImageUsageFlags, VkImageCreateFlags,
                                  VkImageFormatProperties* out) {
  *out = {{16384, 16384, 16384}, 15, 2048, VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT, 1ull << 36};
  return VK_SUCCESS;
}

template <bool counted>
const std::map<std::string, PFN_vkVoidFunction>& table() {
  static const std::map<std::string, PFN_vkVoidFunction> functions = [] {
    std::map<std::string, PFN_vkVoidFunction> out;
#define RG_STILL(name) out["vk" #name] = reinterpret_cast<PFN_vkVoidFunction>(Still<PFN_vk##name, counted>::call);
#define RG_INSTANCE RG_STILL
#define RG_DEVICE RG_STILL
#include "runtime/functions.def"
    auto set = [&](const char* name, auto* function) { out[name] = reinterpret_cast<PFN_vkVoidFunction>(function); };
    set("vkCreateImage", create_image), set("vkCreateBuffer", create_buffer);
    set("vkGetImageMemoryRequirements", image_requirements), set("vkGetImageMemoryRequirements2", image_requirements_2);
    set("vkGetBufferMemoryRequirements", buffer_requirements);
    set("vkMapMemory", map_memory), set("vkGetSemaphoreCounterValue", semaphore_value);
    set("vkAllocateCommandBuffers", allocate_commands), set("vkAllocateDescriptorSets", allocate_sets);
    set("vkGetPhysicalDeviceProperties", properties), set("vkGetPhysicalDeviceMemoryProperties", memory_properties);
    set("vkGetPhysicalDeviceQueueFamilyProperties", families), set("vkGetPhysicalDeviceImageFormatProperties", image_formats);
    return out;
  }();
  return functions;
}

template <bool counted>
PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice, const char* name) {
  const auto row = table<counted>().find(name);
  return row == table<counted>().end() ? nullptr : row->second;
}
template <bool counted>
PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(device_function<counted>);
  return device_function<counted>(VK_NULL_HANDLE, name);
}

}  // namespace

Result<Device> still_device(bool counted) {
  ExternalDevice external;
  external.device = reinterpret_cast<VkDevice>(uintptr_t{1});
  external.queue = reinterpret_cast<VkQueue>(uintptr_t{2});
  external.get_instance_proc_addr = counted ? instance_function<true> : instance_function<false>;
  return Device::adopt(external);
}

uint64_t still_calls() { return calls; }

}  // namespace rg::bench
