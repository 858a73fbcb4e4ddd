#include "engine.h"

#include <cstdlib>
#include <cstring>

namespace {

// Every block remembers its size in front, for reallocation.
constexpr size_t kHeader = 64;

void* allocate_block(void* user, size_t size, size_t alignment, VkSystemAllocationScope) {
  auto& blocks = *static_cast<HostBlocks*>(user);
  const size_t front = alignment > kHeader ? alignment : kHeader;
  auto* raw = static_cast<std::byte*>(std::aligned_alloc(front, (size + front + front - 1) / front * front));
  if (raw == nullptr) return nullptr;
  ++blocks.alive, ++blocks.total;
  std::byte* out = raw + front;
  std::memcpy(out - sizeof(size_t), &size, sizeof size);
  std::memcpy(out - 2 * sizeof(size_t), &front, sizeof front);
  return out;
}
void free_block(void* user, void* memory) {
  if (memory == nullptr) return;
  --static_cast<HostBlocks*>(user)->alive;
  size_t front = 0;
  std::memcpy(&front, static_cast<std::byte*>(memory) - 2 * sizeof(size_t), sizeof front);
  std::free(static_cast<std::byte*>(memory) - front);
}
void* reallocate_block(void* user, void* memory, size_t size, size_t alignment, VkSystemAllocationScope scope) {
  if (size == 0) return free_block(user, memory), nullptr;
  void* out = allocate_block(user, size, alignment, scope);
  if (memory == nullptr || out == nullptr) return out;
  size_t before = 0;
  std::memcpy(&before, static_cast<std::byte*>(memory) - sizeof(size_t), sizeof before);
  std::memcpy(out, memory, before < size ? before : size);
  free_block(user, memory);
  return out;
}

}  // namespace

Engine::Engine() {
  allocator = {&blocks, allocate_block, reallocate_block, free_block, nullptr, nullptr};
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (vkCreateInstance(&info, &allocator, &instance) != VK_SUCCESS) {
    error_ = "no Vulkan instance";
    return;
  }
  choose_device();
  if (error_.empty()) create_device();
}

void Engine::choose_device() {
  uint32_t count = 1;
  if (vkEnumeratePhysicalDevices(instance, &count, &physical) < VK_SUCCESS || count == 0) {
    error_ = "no Vulkan device";
    return;
  }
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  while (family < count && (families[family].queueFlags & wanted) != wanted) ++family;
  if (family == count) error_ = "no queue for graphics and compute";
}

void Engine::create_device() {
  const float priority = 1;
  VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority};
  VkPhysicalDeviceVulkan13Features v13{};
  v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  v13.synchronization2 = v13.dynamicRendering = VK_TRUE;
  VkPhysicalDeviceVulkan12Features v12{};
  v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  v12.pNext = &v13;
  v12.timelineSemaphore = VK_TRUE;
  VkPhysicalDeviceFeatures features{};
  features.shaderStorageImageExtendedFormats = VK_TRUE;  // the frame writes r16f
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &v12;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queues;
  info.pEnabledFeatures = &features;
  if (vkCreateDevice(physical, &info, &allocator, &device) != VK_SUCCESS) {
    error_ = "no device of Vulkan 1.3";
    return;
  }
  vkGetDeviceQueue(device, family, 0, &queue);
  const VkPipelineCacheCreateInfo cache_info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO, nullptr, 0, 0, nullptr};
  vkCreatePipelineCache(device, &cache_info, &allocator, &cache);
  const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, family};
  vkCreateCommandPool(device, &pool, &allocator, &pool_);
  const VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO, nullptr, VK_SEMAPHORE_TYPE_TIMELINE, 0};
  const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type, 0};
  vkCreateSemaphore(device, &semaphore, &allocator, &timeline);
}

Engine::~Engine() {
  if (device != VK_NULL_HANDLE) {
    vkDeviceWaitIdle(device);
    vkDestroySemaphore(device, timeline, &allocator);
    vkDestroyCommandPool(device, pool_, &allocator);
    vkDestroyPipelineCache(device, cache, &allocator);
    vkDestroyDevice(device, &allocator);
  }
  if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, &allocator);
}

uint32_t Engine::memory_type(uint32_t bits, VkMemoryPropertyFlags wanted) const {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  for (uint32_t type = 0; type < memory.memoryTypeCount; ++type)
    if ((bits >> type & 1) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
  return 0;
}

VkDeviceMemory Engine::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted) {
  const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, requirements.size,
                                  memory_type(requirements.memoryTypeBits, wanted)};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  vkAllocateMemory(device, &info, &allocator, &memory);
  return memory;
}

Buffer Engine::make_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage) {
  Buffer out;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  vkCreateBuffer(device, &info, &allocator, &out.handle);
  VkMemoryRequirements requirements;
  vkGetBufferMemoryRequirements(device, out.handle, &requirements);
  out.memory = allocate(requirements, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  vkBindBufferMemory(device, out.handle, out.memory, 0);
  vkMapMemory(device, out.memory, 0, VK_WHOLE_SIZE, 0, &out.mapped);
  return out;
}

Image Engine::make_image(uint32_t width, uint32_t height, VkImageUsageFlags usage) {
  Image out;
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = VK_FORMAT_R8G8B8A8_UNORM;
  info.extent = {width, height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  vkCreateImage(device, &info, &allocator, &out.handle);
  VkMemoryRequirements requirements;
  vkGetImageMemoryRequirements(device, out.handle, &requirements);
  out.memory = allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  vkBindImageMemory(device, out.handle, out.memory, 0);
  VkImageViewCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = out.handle;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = info.format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCreateImageView(device, &view, &allocator, &out.view);
  return out;
}

void Engine::destroy(Buffer& buffer) {
  vkDestroyBuffer(device, buffer.handle, &allocator);
  vkFreeMemory(device, buffer.memory, &allocator);
  buffer = {};
}
void Engine::destroy(Image& image) {
  vkDestroyImageView(device, image.view, &allocator);
  vkDestroyImage(device, image.handle, &allocator);
  vkFreeMemory(device, image.memory, &allocator);
  image = {};
}

VkCommandBuffer Engine::begin() {
  const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  vkAllocateCommandBuffers(device, &info, &commands);
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
  vkBeginCommandBuffer(commands, &begin);
  return commands;
}

uint64_t Engine::submit(const std::vector<VkCommandBuffer>& commands) {
  std::vector<VkCommandBufferSubmitInfo> infos;
  for (const VkCommandBuffer one : commands) {
    vkEndCommandBuffer(one);
    infos.push_back({VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, one, 0});
  }
  const VkSemaphoreSubmitInfo signal{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, nullptr, timeline, ++submitted,
                                     VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,    0};
  VkSubmitInfo2 submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  submit.commandBufferInfoCount = static_cast<uint32_t>(infos.size());
  submit.pCommandBufferInfos = infos.data();
  submit.signalSemaphoreInfoCount = 1;
  submit.pSignalSemaphoreInfos = &signal;
  const std::lock_guard lock(queue_mutex);
  vkQueueSubmit2(queue, 1, &submit, VK_NULL_HANDLE);
  return submitted;
}

void Engine::wait(uint64_t value) {
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &timeline;
  info.pValues = &value;
  vkWaitSemaphores(device, &info, UINT64_MAX);
}
