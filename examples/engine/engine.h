// An engine that has all of this already: instance, device, queues, allocator, command buffers, a timeline, images and buffers.
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

struct HostBlocks {  // what the engine's allocator has given out
  std::atomic<int64_t> alive = 0, total = 0;
};

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
};
struct Image {
  VkImage handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

class Engine {
 public:
  Engine();
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  const std::string& error() const { return error_; }  // empty: all is there

  Buffer make_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage);  // mapped
  Image make_image(uint32_t width, uint32_t height, VkImageUsageFlags usage);
  void destroy(Buffer& buffer);
  void destroy(Image& image);
  VkCommandBuffer begin();
  // Ends and submits; the timeline reaches the value that is returned when it is done.
  uint64_t submit(const std::vector<VkCommandBuffer>& commands);
  void wait(uint64_t value);

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;
  std::mutex queue_mutex;
  VkPipelineCache cache = VK_NULL_HANDLE;
  VkSemaphore timeline = VK_NULL_HANDLE;
  uint64_t submitted = 0;
  HostBlocks blocks;
  VkAllocationCallbacks allocator{};

 private:
  void choose_device();
  void create_device();
  uint32_t memory_type(uint32_t bits, VkMemoryPropertyFlags wanted) const;
  VkDeviceMemory allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted);
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::string error_;
};
