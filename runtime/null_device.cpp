// A device that only writes down what is asked of it. Every dispatchable handle points at something that knows the NullDevice, so
// that plain Vulkan function pointers need no global state.
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "runtime/capabilities.h"
#include "runtime/device_state.h"
#include "runtime/formats.h"
#include "runtime/null_text.h"

namespace rg {

struct NullCommands {  // behind a VkCommandBuffer
  NullDevice* owner = nullptr;
  uint64_t number = 0;
  VkCommandPool pool = VK_NULL_HANDLE;
};

struct NullQueue {  // behind a VkQueue
  NullDevice* owner = nullptr;
  uint64_t number = 0;
};

struct NullObject {
  uint64_t bytes = 0;
  uint32_t alignment = 1, memory_types = 0b11;
};

struct NullDevice {
  std::string* log = nullptr;
  NullOptions options;
  NullCounters own_counters;
  NullCounters* counters = nullptr;
  std::map<const char*, uint64_t> next;  // by handle name, whose addresses are unique and whose order never shows
  std::map<VkImage, NullObject> images;
  std::map<VkBuffer, NullObject> buffers;
  std::map<VkDeviceMemory, uint64_t> memory_bytes;
  std::map<VkDeviceMemory, std::vector<std::byte>> mapped;
  std::vector<uint64_t> semaphores;  // counter by number
  std::vector<std::unique_ptr<NullCommands>> commands;
  std::vector<std::unique_ptr<NullQueue>> queues;
  std::set<std::pair<const char*, uint64_t>> alive;
  std::recursive_mutex mutex;  // recording threads share it all

  bool fails() {
    const uint64_t call = ++counters->fallible_calls;
    return call == options.fail_at || (options.fails_from_then_on && options.fail_at != 0 && call > options.fail_at);
  }
  template <class Handle>
  void born(Handle handle) {
    ++counters->live_handles;
    alive.emplace(kHandleName<Handle>, reinterpret_cast<uintptr_t>(handle));
  }
  template <class Handle>
  void dead(Handle handle) {
    if (handle == VK_NULL_HANDLE) return;
    const bool lived = alive.erase({kHandleName<Handle>, reinterpret_cast<uintptr_t>(handle)}) != 0;
    counters->live_handles -= lived ? 1 : 0;
    counters->wrong_destroys += lived ? 0 : 1;
  }
};

void NullDeviceDeleter::operator()(NullDevice* device) const { delete device; }

namespace {

NullDevice& owner(VkDevice device) { return *reinterpret_cast<NullDevice*>(device); }
NullDevice& owner(VkQueue queue) { return *reinterpret_cast<NullQueue*>(queue)->owner; }
NullDevice& owner(VkCommandBuffer commands) { return *reinterpret_cast<NullCommands*>(commands)->owner; }

template <class Handle>
Handle new_handle(NullDevice& null) {
  return reinterpret_cast<Handle>(static_cast<uintptr_t>(++null.next[kHandleName<Handle>]));
}

void first_argument(NullLine& line, VkCommandBuffer commands) {
  line.text(" commands"), line.number(reinterpret_cast<NullCommands*>(commands)->number);
}
void first_argument(NullLine& line, VkQueue queue) {  // the universal queue goes without saying
  const uint64_t number = reinterpret_cast<NullQueue*>(queue)->number;
  if (number != 0) line.text(" queue"), line.number(number);
}
template <class Handle>
void first_argument(NullLine&, Handle) {}

template <class First, class... Rest>
void begin_line(NullLine& line, const char* name, First first, Rest... rest) {
  if (!line.wanted()) return;
  line.text(name);
  first_argument(line, first);
  (print_argument(line, rest), ...);
}

// One function of the table: what kind it is follows from its type.
template <class Tag, class Function>
struct Null;

template <class Tag, class Result, class First, class... Rest>
struct Null<Tag, Result (*)(First, Rest...)> {
  static Result call(First first, Rest... rest) {
    NullDevice& null = owner(first);
    const std::lock_guard lock(null.mutex);
    NullLine line(null.log);
    begin_line(line, Tag::name, first, rest...);
    if constexpr (std::is_same_v<Result, VkResult>) {
      const bool fails = null.fails();
      line.text(fails ? " -> failed\n" : "\n");
      return fails ? null.options.failure : VK_SUCCESS;
    } else {
      line.text("\n");
      if constexpr (!std::is_void_v<Result>) return Result{};
    }
  }
};

// vkCreateX(device, info, allocator, handle) and vkAllocateMemory.
template <class Tag, class Info, class Handle>
struct Null<Tag, VkResult (*)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*)> {
  static VkResult call(VkDevice device, const Info* info, const VkAllocationCallbacks*, Handle* handle) {
    NullDevice& null = owner(device);
    const std::lock_guard lock(null.mutex);
    NullLine line(null.log);
    begin_line(line, Tag::name, device, info);
    if (null.fails()) {
      line.text(" -> failed\n");
      return null.options.failure;
    }
    *handle = new_handle<Handle>(null);
    null.born(*handle);
    line.text(" -> "), line.handle(*handle), line.text("\n");
    return VK_SUCCESS;
  }
};

// vkDestroyX(device, handle, allocator) and vkFreeMemory.
template <class Tag, class Handle>
struct Null<Tag, void (*)(VkDevice, Handle, const VkAllocationCallbacks*)> {
  static void call(VkDevice device, Handle handle, const VkAllocationCallbacks*) {
    NullDevice& null = owner(device);
    const std::lock_guard lock(null.mutex);
    NullLine line(null.log);
    begin_line(line, Tag::name, device, handle);
    line.text("\n");
    null.dead(handle);
  }
};

template <class Tag, class Info>
struct Null<Tag, VkResult (*)(VkDevice, VkPipelineCache, uint32_t, const Info*, const VkAllocationCallbacks*, VkPipeline*)> {
  static VkResult call(VkDevice device, VkPipelineCache, uint32_t count, const Info* infos, const VkAllocationCallbacks*, VkPipeline* pipelines) {
    NullDevice& null = owner(device);
    const std::lock_guard lock(null.mutex);
    NullLine line(null.log);
    begin_line(line, Tag::name, device, count);
    if constexpr (PrintableStruct<Info>)
      for (uint32_t i = 0; i < count; ++i) print_struct(line, infos[i]);
    const bool fails = null.fails();
    for (uint32_t i = 0; i < count; ++i) pipelines[i] = fails ? VkPipeline(VK_NULL_HANDLE) : new_handle<VkPipeline>(null);
    for (uint32_t i = 0; i < count && !fails; ++i) null.born(pipelines[i]);
    line.text(" -> "), fails ? line.text("failed") : line.handle(pipelines[0]), line.text("\n");
    return fails ? null.options.failure : VK_SUCCESS;
  }
};

#define RG_TAG(name_)                                \
  struct Tag##name_ {                                \
    static constexpr const char* name = "vk" #name_; \
  };
#define RG_DEVICE RG_TAG
#define RG_DEVICE_OPTIONAL RG_TAG
#include "runtime/functions.def"
#undef RG_TAG

constexpr VkDeviceSize kImageAlignment = 65536, kBufferAlignment = 256;
constexpr uint32_t kImageSide = 16384;
constexpr VkDeviceSize kMostMapped = VkDeviceSize{128} << 20;  // mapped memory is real

uint64_t image_bytes(const VkImageCreateInfo& info) {
  const FormatInfo format = format_info(info.format);
  uint64_t bytes = 0;
  for (uint32_t mip = 0; mip < info.mipLevels; ++mip) {
    const uint64_t width = std::max(info.extent.width >> mip, 1u), height = std::max(info.extent.height >> mip, 1u);
    const uint64_t blocks = (width + format.block_width - 1) / format.block_width * ((height + format.block_height - 1) / format.block_height);
    bytes += blocks * std::max(info.extent.depth >> mip, 1u) * format.block_bytes;
  }
  return bytes * info.arrayLayers * info.samples;
}

VkMemoryRequirements requirements(const NullObject& object) {
  const uint64_t alignment = object.alignment;
  return {(object.bytes + alignment - 1) / alignment * alignment, alignment, object.memory_types};
}

VkResult VKAPI_CALL create_image(VkDevice device, const VkImageCreateInfo* info, const VkAllocationCallbacks* allocator, VkImage* image) {
  const VkResult result = Null<TagCreateImage, PFN_vkCreateImage>::call(device, info, allocator, image);
  const bool lazy = owner(device).options.lazy_memory && (info->usage & VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT) != 0;
  if (result == VK_SUCCESS) owner(device).images[*image] = {image_bytes(*info), kImageAlignment, lazy ? 0b111u : 0b11u};
  return result;
}

VkResult VKAPI_CALL create_buffer(VkDevice device, const VkBufferCreateInfo* info, const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
  const VkResult result = Null<TagCreateBuffer, PFN_vkCreateBuffer>::call(device, info, allocator, buffer);
  if (result == VK_SUCCESS) owner(device).buffers[*buffer] = {info->size, kBufferAlignment, 0b11};
  return result;
}

void VKAPI_CALL image_requirements(VkDevice device, VkImage image, VkMemoryRequirements* out) { *out = requirements(owner(device).images[image]); }
void VKAPI_CALL image_requirements_2(VkDevice device, const VkImageMemoryRequirementsInfo2* info, VkMemoryRequirements2* out) {
  image_requirements(device, info->image, &out->memoryRequirements);
  auto* next = static_cast<VkBaseOutStructure*>(out->pNext);
  if (next == nullptr || next->sType != VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS) return;
  const NullOptions& options = owner(device).options;
  auto* dedicated = reinterpret_cast<VkMemoryDedicatedRequirements*>(next);
  dedicated->requiresDedicatedAllocation = options.requires_dedicated;
  dedicated->prefersDedicatedAllocation = options.requires_dedicated || options.prefers_dedicated;
}
void VKAPI_CALL buffer_requirements(VkDevice device, VkBuffer buffer, VkMemoryRequirements* out) {
  *out = requirements(owner(device).buffers[buffer]);
}

VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* allocator,
                                    VkDeviceMemory* memory) {
  const VkResult result = Null<TagAllocateMemory, PFN_vkAllocateMemory>::call(device, info, allocator, memory);
  if (result == VK_SUCCESS) owner(device).memory_bytes[*memory] = info->allocationSize;
  return result;
}

VkResult VKAPI_CALL map_memory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size, VkMemoryMapFlags flags, void** data) {
  const VkResult result = Null<TagMapMemory, PFN_vkMapMemory>::call(device, memory, offset, size, flags, data);
  if (result != VK_SUCCESS) return result;
  NullDevice& null = owner(device);
  if (null.memory_bytes[memory] > kMostMapped) return VK_ERROR_MEMORY_MAP_FAILED;
  null.mapped[memory].resize(null.memory_bytes[memory]);
  *data = null.mapped[memory].data() + offset;
  return VK_SUCCESS;
}

VkResult VKAPI_CALL create_semaphore(VkDevice device, const VkSemaphoreCreateInfo* info, const VkAllocationCallbacks* allocator,
                                     VkSemaphore* semaphore) {
  const VkResult result = Null<TagCreateSemaphore, PFN_vkCreateSemaphore>::call(device, info, allocator, semaphore);
  if (result == VK_SUCCESS) owner(device).semaphores.resize(reinterpret_cast<uintptr_t>(*semaphore) + 1);
  return result;
}

VkResult VKAPI_CALL semaphore_value(VkDevice device, VkSemaphore semaphore, uint64_t* value) {
  *value = owner(device).semaphores[reinterpret_cast<uintptr_t>(semaphore)];
  return owner(device).fails() ? owner(device).options.failure : VK_SUCCESS;
}

void check_wait(NullDevice& null, VkSemaphore semaphore, uint64_t value) {
  const auto number = reinterpret_cast<uintptr_t>(semaphore);
  const bool ours = number < null.semaphores.size();
  if (ours && null.semaphores[number] < value) ++null.counters->unmet_waits;
}

VkResult VKAPI_CALL wait_semaphores(VkDevice device, const VkSemaphoreWaitInfo* info, uint64_t timeout) {
  const VkResult result = Null<TagWaitSemaphores, PFN_vkWaitSemaphores>::call(device, info, timeout);
  const std::lock_guard lock(owner(device).mutex);
  for (uint32_t i = 0; i < info->semaphoreCount; ++i) check_wait(owner(device), info->pSemaphores[i], info->pValues[i]);
  return result;
}

VkResult VKAPI_CALL signal_semaphore(VkDevice device, const VkSemaphoreSignalInfo* info) {
  const VkResult result = Null<TagSignalSemaphore, PFN_vkSignalSemaphore>::call(device, info);
  if (result == VK_SUCCESS) owner(device).semaphores[reinterpret_cast<uintptr_t>(info->semaphore)] = info->value;
  return result;
}

// Timelines must grow, and in this device everything is done when it is submitted: so a wait for what is not submitted yet would never end
// on a real queue that runs in order.
void run_submit(NullDevice& null, const VkSubmitInfo2& info) {
  for (uint32_t i = 0; i < info.waitSemaphoreInfoCount; ++i)
    check_wait(null, info.pWaitSemaphoreInfos[i].semaphore, info.pWaitSemaphoreInfos[i].value);
  for (uint32_t i = 0; i < info.signalSemaphoreInfoCount; ++i) {
    const auto number = reinterpret_cast<uintptr_t>(info.pSignalSemaphoreInfos[i].semaphore);
    const uint64_t value = info.pSignalSemaphoreInfos[i].value;
    if (number >= null.semaphores.size()) continue;  // the engine's
    if (value != 0 && value <= null.semaphores[number]) ++null.counters->unmet_waits;
    null.semaphores[number] = value;
  }
}

VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos, VkFence) {
  NullDevice& null = owner(queue);
  const std::lock_guard lock(null.mutex);
  const bool fails = null.fails();
  for (uint32_t i = 0; i < count; ++i) {
    NullLine line(null.log);
    begin_line(line, TagQueueSubmit2::name, queue, &infos[i]);
    line.text(fails ? " -> failed\n" : "\n");
    if (!fails) run_submit(null, infos[i]);
  }
  return fails ? null.options.failure : VK_SUCCESS;
}

VkResult VKAPI_CALL allocate_commands(VkDevice device, const VkCommandBufferAllocateInfo* info, VkCommandBuffer* commands) {
  NullDevice& null = owner(device);
  const VkResult result = Null<TagAllocateCommandBuffers, PFN_vkAllocateCommandBuffers>::call(device, info, commands);
  if (result != VK_SUCCESS) return result;
  for (uint32_t i = 0; i < info->commandBufferCount; ++i) {
    null.commands.push_back(std::make_unique<NullCommands>(NullCommands{&null, null.commands.size() + 1, info->commandPool}));
    commands[i] = reinterpret_cast<VkCommandBuffer>(null.commands.back().get());
  }
  return VK_SUCCESS;
}

VkResult VKAPI_CALL allocate_sets(VkDevice device, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets) {
  const VkResult result = Null<TagAllocateDescriptorSets, PFN_vkAllocateDescriptorSets>::call(device, info, sets);
  if (result != VK_SUCCESS) return result;
  for (uint32_t i = 0; i < info->descriptorSetCount; ++i) sets[i] = new_handle<VkDescriptorSet>(owner(device));
  return VK_SUCCESS;
}

void VKAPI_CALL update_sets(VkDevice device, uint32_t count, const VkWriteDescriptorSet* writes, uint32_t, const VkCopyDescriptorSet*) {
  for (uint32_t i = 0; i < count; ++i) {
    NullLine line(owner(device).log);
    begin_line(line, TagUpdateDescriptorSets::name, device, &writes[i]);
    line.text("\n");
  }
}

// A clock that ticks a microsecond a query, so that a pass takes 0.001 ms.
VkResult VKAPI_CALL query_results(VkDevice device, VkQueryPool, uint32_t first, uint32_t count, size_t, void* data, VkDeviceSize stride,
                                  VkQueryResultFlags flags) {
  constexpr uint64_t available = 1;
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t value = 1000ull * (first + i);
    std::byte* row = static_cast<std::byte*>(data) + i * stride;
    for (VkDeviceSize at = 0; at + sizeof value <= stride; at += sizeof value) std::memcpy(row + at, &value, sizeof value);
    if ((flags & VK_QUERY_RESULT_WITH_AVAILABILITY_BIT) != 0) std::memcpy(row + stride - sizeof available, &available, sizeof available);
  }
  return owner(device).fails() ? owner(device).options.failure : VK_SUCCESS;
}

void VKAPI_CALL format_properties(VkPhysicalDevice, VkFormat, VkFormatProperties* out) { *out = {~0u, ~0u, ~0u}; }

VkResult VKAPI_CALL image_format_properties(VkPhysicalDevice physical, VkFormat, VkImageType, VkImageTiling, VkImageUsageFlags, VkImageCreateFlags,
                                            VkImageFormatProperties* out) {
  NullDevice& null = *reinterpret_cast<NullDevice*>(physical);
  *out = {{kImageSide, kImageSide, kImageSide}, 15, 2048, VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT, 1ull << 36};
  return null.fails() ? null.options.failure : VK_SUCCESS;
}

constexpr CacheIdentity kIdentity{1, 2, 3, {'n', 'u', 'l', 'l'}};

// What drivers begin with, and how many pipelines there have been.
VkResult VKAPI_CALL cache_data(VkDevice device, VkPipelineCache cache, size_t* size, void* data) {
  const VkResult result = Null<TagGetPipelineCacheData, PFN_vkGetPipelineCacheData>::call(device, cache, size, data);
  if (result != VK_SUCCESS) return result;
  NullDevice& null = owner(device);
  const std::lock_guard lock(null.mutex);
  VkPipelineCacheHeaderVersionOne header{sizeof header, VK_PIPELINE_CACHE_HEADER_VERSION_ONE, kIdentity.vendor, kIdentity.device, {}};
  std::copy(kIdentity.uuid.begin(), kIdentity.uuid.end(), header.pipelineCacheUUID);
  const uint64_t pipelines = null.next[kHandleName<VkPipeline>];
  const size_t room = data == nullptr ? SIZE_MAX : *size;
  *size = room < sizeof header + sizeof pipelines ? (room < sizeof header ? 0 : sizeof header) : sizeof header + sizeof pipelines;
  if (data == nullptr) return VK_SUCCESS;
  if (*size != 0) std::memcpy(data, &header, sizeof header);
  if (*size > sizeof header) std::memcpy(static_cast<std::byte*>(data) + sizeof header, &pipelines, sizeof pipelines);
  return *size > sizeof header ? VK_SUCCESS : VK_INCOMPLETE;
}

void fill_functions(DeviceFunctions& vk) {
#define RG_DEVICE(name) vk.name = Null<Tag##name, PFN_vk##name>::call;
#define RG_DEVICE_OPTIONAL RG_DEVICE
#include "runtime/functions.def"
  vk.CreateImage = create_image;
  vk.CreateBuffer = create_buffer;
  vk.GetImageMemoryRequirements = image_requirements;
  vk.GetImageMemoryRequirements2 = image_requirements_2;
  vk.GetBufferMemoryRequirements = buffer_requirements;
  vk.AllocateMemory = allocate_memory;
  vk.MapMemory = map_memory;
  vk.CreateSemaphore = create_semaphore;
  vk.GetSemaphoreCounterValue = semaphore_value;
  vk.QueueSubmit2 = submit;
  vk.WaitSemaphores = wait_semaphores;
  vk.SignalSemaphore = signal_semaphore;
  vk.AllocateCommandBuffers = allocate_commands;
  vk.AllocateDescriptorSets = allocate_sets;
  vk.UpdateDescriptorSets = update_sets;
  vk.GetQueryPoolResults = query_results;
  vk.GetPipelineCacheData = cache_data;
  vk.GetPhysicalDeviceFormatProperties = format_properties;
  vk.GetPhysicalDeviceImageFormatProperties = image_format_properties;
}

void fill_description(Device::State& state, const NullOptions& options) {
  state.name = "null";
  state.identity = kIdentity;
  state.pipeline_statistics = true;
  state.sampler_anisotropy = state.multi_draw_indirect = state.draw_indirect_count = true;
  state.limits.timestampPeriod = 1;
  state.limits.maxImageDimension1D = state.limits.maxImageDimension2D = state.limits.maxImageDimension3D = kImageSide;
  state.limits.maxImageDimensionCube = kImageSide;
  state.limits.maxImageArrayLayers = 2048;
  state.limits.minUniformBufferOffsetAlignment = 256;
  state.limits.minStorageBufferOffsetAlignment = 256;
  state.limits.nonCoherentAtomSize = 64;
  state.limits.maxPushConstantsSize = 128;
  state.limits.maxSamplerAnisotropy = 16;
  state.limits.maxUniformBufferRange = 65536;
  state.memory.memoryTypeCount = options.lazy_memory ? 3 : 2;
  state.memory.memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
  state.memory.memoryTypes[1] = {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 0};
  state.memory.memoryTypes[2] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, 0};
  state.memory.memoryHeapCount = 1;
  state.memory.memoryHeaps[0] = {1ull << 36, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

}  // namespace

namespace {

void add_null_queues(NullDevice& null, Device::State& state) {
  constexpr VkQueueFlags kinds[] = {VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT,
                                    VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT, VK_QUEUE_TRANSFER_BIT};
  const uint32_t counts[] = {1, null.options.compute_queues, null.options.transfer_queues};
  for (uint32_t family = 0; family < 3; ++family)
    for (uint32_t i = 0; i < counts[family]; ++i) {
      null.queues.push_back(std::make_unique<NullQueue>(NullQueue{&null, null.queues.size()}));
      add_queue(state, {reinterpret_cast<VkQueue>(null.queues.back().get()), family, nullptr});
      state.queues.back().flags = kinds[family];
      state.queues.back().timestamp_bits = 64;
    }
}

}  // namespace

Device Device::null(std::string* log, const NullOptions& options) {
  auto state = std::make_unique<State>();
  NullDevice* null = new NullDevice;
  state->null.reset(null);
  null->log = log;
  null->options = options;
  null->counters = options.counters != nullptr ? options.counters : &null->own_counters;
  state->device = reinterpret_cast<VkDevice>(null);
  add_null_queues(*null, *state);
  state->physical = reinterpret_cast<VkPhysicalDevice>(null);
  state->instance = reinterpret_cast<VkInstance>(null);
  fill_functions(state->vk);
  fill_description(*state, options);
  for (const Capability capability : options.capabilities) state->capabilities |= bit(capability);
  return Device(std::move(state));
}

}  // namespace rg
