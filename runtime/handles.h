// A Vulkan object with one owner: destroyed with it, moved, never copied.
#pragma once

#include <utility>

#include "runtime/functions.h"

namespace rg {

template <class T, auto Destroy>
class Unique {
 public:
  Unique() = default;
  Unique(const DeviceFunctions& vk, VkDevice device, T handle) : vk_(&vk), device_(device), handle_(handle) {}
  Unique(Unique&& other) noexcept : vk_(other.vk_), device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  Unique& operator=(Unique&& other) noexcept {
    std::swap(vk_, other.vk_);
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Unique() {
    if (handle_ != VK_NULL_HANDLE) (vk_->*Destroy)(device_, handle_, vk_->allocator);
  }
  T get() const { return handle_; }
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  const DeviceFunctions* vk_ = nullptr;
  VkDevice device_ = VK_NULL_HANDLE;
  T handle_ = VK_NULL_HANDLE;
};

using UniqueMemory = Unique<VkDeviceMemory, &DeviceFunctions::FreeMemory>;
using UniqueBuffer = Unique<VkBuffer, &DeviceFunctions::DestroyBuffer>;
using UniqueImage = Unique<VkImage, &DeviceFunctions::DestroyImage>;
using UniqueView = Unique<VkImageView, &DeviceFunctions::DestroyImageView>;
using UniqueBufferView = Unique<VkBufferView, &DeviceFunctions::DestroyBufferView>;
using UniqueSampler = Unique<VkSampler, &DeviceFunctions::DestroySampler>;
using UniqueShader = Unique<VkShaderModule, &DeviceFunctions::DestroyShaderModule>;
using UniquePipelineCache = Unique<VkPipelineCache, &DeviceFunctions::DestroyPipelineCache>;
using UniquePipelineLayout = Unique<VkPipelineLayout, &DeviceFunctions::DestroyPipelineLayout>;
using UniquePipeline = Unique<VkPipeline, &DeviceFunctions::DestroyPipeline>;
using UniqueRenderPass = Unique<VkRenderPass, &DeviceFunctions::DestroyRenderPass>;
using UniqueFramebuffer = Unique<VkFramebuffer, &DeviceFunctions::DestroyFramebuffer>;
using UniqueSetLayout = Unique<VkDescriptorSetLayout, &DeviceFunctions::DestroyDescriptorSetLayout>;
using UniqueDescriptorPool = Unique<VkDescriptorPool, &DeviceFunctions::DestroyDescriptorPool>;
using UniqueSemaphore = Unique<VkSemaphore, &DeviceFunctions::DestroySemaphore>;
using UniqueFence = Unique<VkFence, &DeviceFunctions::DestroyFence>;
using UniqueEvent = Unique<VkEvent, &DeviceFunctions::DestroyEvent>;
using UniqueQueryPool = Unique<VkQueryPool, &DeviceFunctions::DestroyQueryPool>;
using UniqueCommandPool = Unique<VkCommandPool, &DeviceFunctions::DestroyCommandPool>;

}  // namespace rg
