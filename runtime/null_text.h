// How the null device writes calls: "vkCmdDispatch commands1 8 8 1". Handles are a kind and a number, so that logs are the same in every run.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>

namespace rg {

// A non-dispatchable handle's value: its number in order of creation among its kind.
template <class Handle>
inline constexpr const char* kHandleName = nullptr;
#define RG_HANDLE(Type, text) \
  template <>                 \
  inline constexpr const char* kHandleName<Type> = text;
RG_HANDLE(VkDeviceMemory, "memory")
RG_HANDLE(VkBuffer, "buffer")
RG_HANDLE(VkImage, "image")
RG_HANDLE(VkImageView, "view")
RG_HANDLE(VkBufferView, "buffer_view")
RG_HANDLE(VkSampler, "sampler")
RG_HANDLE(VkShaderModule, "shader")
RG_HANDLE(VkPipelineCache, "cache")
RG_HANDLE(VkPipelineLayout, "layout")
RG_HANDLE(VkPipeline, "pipeline")
RG_HANDLE(VkRenderPass, "render_pass")
RG_HANDLE(VkFramebuffer, "framebuffer")
RG_HANDLE(VkDescriptorSetLayout, "set_layout")
RG_HANDLE(VkDescriptorPool, "descriptor_pool")
RG_HANDLE(VkDescriptorSet, "set")
RG_HANDLE(VkSemaphore, "semaphore")
RG_HANDLE(VkFence, "fence")
RG_HANDLE(VkEvent, "event")
RG_HANDLE(VkQueryPool, "queries")
RG_HANDLE(VkCommandPool, "command_pool")
RG_HANDLE(VkSwapchainKHR, "swapchain")
#undef RG_HANDLE

// One line under construction. Appends to the log only; a log with room never allocates.
class NullLine {
 public:
  explicit NullLine(std::string* log) : log_(log) {}
  bool wanted() const { return log_ != nullptr; }
  void text(std::string_view value) {
    if (log_ != nullptr) log_->append(value);
  }
  void number(uint64_t value) { format("%llu", static_cast<unsigned long long>(value)); }
  void signed_number(int64_t value) { format("%lld", static_cast<long long>(value)); }
  void hex(uint64_t value) { format("0x%llx", static_cast<unsigned long long>(value)); }
  void real(double value) { format("%g", value); }
  template <class Handle>
  void handle(Handle value) {
    if (value == VK_NULL_HANDLE) return text("null");
    text(kHandleName<Handle>);
    number(reinterpret_cast<uintptr_t>(value));
  }

 private:
  template <class Value>
  void format(const char* pattern, Value value) {
    if (log_ == nullptr) return;
    char buffer[32];
    const int size = std::snprintf(buffer, sizeof buffer, pattern, value);
    text({buffer, static_cast<size_t>(size)});
  }
  std::string* log_;
};

// Structs whose contents tests look at; any other pointer prints nothing.
void print_struct(NullLine& line, const VkDependencyInfo& info);
void print_struct(NullLine& line, const VkRenderingInfo& info);
void print_struct(NullLine& line, const VkRenderPassBeginInfo& info);
void print_struct(NullLine& line, const VkImageCreateInfo& info);
void print_struct(NullLine& line, const VkBufferCreateInfo& info);
void print_struct(NullLine& line, const VkImageViewCreateInfo& info);
void print_struct(NullLine& line, const VkMemoryAllocateInfo& info);
void print_struct(NullLine& line, const VkSubmitInfo2& info);
void print_struct(NullLine& line, const VkPipelineCacheCreateInfo& info);
void print_struct(NullLine& line, const VkImageCopy& info);
void print_struct(NullLine& line, const VkImageBlit& info);
void print_struct(NullLine& line, const VkImageResolve& info);
void print_struct(NullLine& line, const VkBufferCopy& info);
void print_struct(NullLine& line, const VkBufferImageCopy& info);
void print_struct(NullLine& line, const VkImageSubresourceRange& info);
void print_struct(NullLine& line, const VkViewport& info);
void print_struct(NullLine& line, const VkRect2D& info);
void print_struct(NullLine& line, const VkClearColorValue& info);
void print_struct(NullLine& line, const VkClearDepthStencilValue& info);
void print_struct(NullLine& line, const VkSemaphoreWaitInfo& info);
void print_struct(NullLine& line, const VkGraphicsPipelineCreateInfo& info);  // what only some devices can
void print_struct(NullLine& line, const VkDescriptorSet& info);
void print_struct(NullLine& line, const VkBuffer& info);
void print_struct(NullLine& line, const VkEvent& info);
void print_struct(NullLine& line, const VkWriteDescriptorSet& info);
void print_struct(NullLine& line, const VkDebugUtilsLabelEXT& info);
void print_struct(NullLine& line, const uint32_t& info);

template <class T>
concept PrintableStruct = requires(NullLine& line, const T& value) {
  print_struct(line, value);
};

template <class T>
void print_argument(NullLine& line, T value) {
  if constexpr (std::is_enum_v<T>) {
    line.text(" "), line.signed_number(static_cast<int64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    line.text(" "), line.real(value);
  } else if constexpr (std::is_integral_v<T>) {
    line.text(" "), std::is_signed_v<T> ? line.signed_number(static_cast<int64_t>(value)) : line.number(static_cast<uint64_t>(value));
  } else if constexpr (kHandleName<T> != nullptr) {
    line.text(" "), line.handle(value);
  } else if constexpr (std::is_pointer_v<T> && std::is_const_v<std::remove_pointer_t<T>>) {
    if constexpr (PrintableStruct<std::remove_const_t<std::remove_pointer_t<T>>>)
      if (value != nullptr) line.text(" "), print_struct(line, *value);
  }
}

}  // namespace rg
