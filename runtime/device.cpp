#include "runtime/device.h"

#include <dlfcn.h>

#include <algorithm>

#include "runtime/capabilities.h"
#include "runtime/device_state.h"
#include "runtime/errors.h"

namespace rg {

Device::Device(std::unique_ptr<State> state) : state_(std::move(state)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

void Device::State::rest(std::shared_ptr<void> object) {
  if (null) return;  // nothing runs
  const std::lock_guard lock(resting_mutex);
  resting[next_resting++ % resting.size()].swap(object);
}

CommandPool Device::State::take_pool(uint32_t family) {
  const std::lock_guard lock(spare_mutex);
  const auto spare = std::find_if(spare_pools.begin(), spare_pools.end(), [&](const CommandPool& pool) { return pool.family == family; });
  if (spare == spare_pools.end()) return {};
  CommandPool pool = std::move(*spare);
  spare_pools.erase(spare);
  return pool;
}

void Device::State::give_pool(CommandPool pool) {
  if (!validating || lost || !pool.pool) return;
  pool.used = 0;
  const std::lock_guard lock(spare_mutex);
  spare_pools.push_back(std::move(pool));
}

VkResult wait_for_queues(Device::State& state) {
  std::vector<std::unique_lock<std::mutex>> locks;
  for (const DeviceQueue& queue : state.queues) {
    const bool locked = std::any_of(locks.begin(), locks.end(), [&](const auto& lock) { return lock.mutex() == queue.mutex; });
    if (!locked) locks.emplace_back(*queue.mutex);
  }
  const VkResult result = state.vk.DeviceWaitIdle(state.device);
  if (result == VK_ERROR_DEVICE_LOST) state.lost = true;
  return result;
}

Device::State::~State() {
  if (next_resting != 0 && !lost) static_cast<void>(wait_for_queues(*this));
  resting = {};
  spare_pools.clear();
  if (!lost && cache_file.cache) static_cast<void>(rg::save_pipeline_cache(*this, false));  // nobody is left to be told
  cache_file.cache = {};
  if (owned) {
    if (device != VK_NULL_HANDLE) vk.DestroyDevice(device, nullptr);
    if (messenger != VK_NULL_HANDLE) vk.DestroyDebugUtilsMessengerEXT(instance, messenger, nullptr);
    if (instance != VK_NULL_HANDLE) vk.DestroyInstance(instance, nullptr);
  }
  if (library != nullptr) dlclose(library);
}

const DeviceFunctions& Device::vk() const { return state_->vk; }
VkInstance Device::instance() const { return state_->instance; }
PFN_vkVoidFunction Device::instance_function(const char* name) const {
  return state_->get_instance_proc_addr == nullptr ? nullptr : state_->get_instance_proc_addr(state_->instance, name);
}
VkDevice Device::handle() const { return state_->device; }
VkPhysicalDevice Device::physical() const { return state_->physical; }
VkQueue Device::queue() const { return state_->queues[0].handle; }
uint32_t Device::queue_family() const { return state_->queues[0].family; }
std::span<const uint32_t> Device::queue_families() const { return state_->families; }
size_t Device::queue_count() const { return state_->queues.size(); }
std::string_view Device::name() const { return state_->name; }
const VkPhysicalDeviceLimits& Device::limits() const { return state_->limits; }
bool Device::validating() const { return state_->validating; }
uint64_t Device::validation_messages() const { return state_->messages; }

namespace {
uint32_t find_memory_type(const VkPhysicalDeviceMemoryProperties& memory, uint32_t type_bits, VkMemoryPropertyFlags wanted) {
  for (uint32_t type = 0; type < memory.memoryTypeCount; ++type)
    if ((type_bits >> type & 1) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
  return UINT32_MAX;
}
}  // namespace

uint32_t Device::memory_type(uint32_t type_bits, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred) const {
  const uint32_t best = find_memory_type(state_->memory, type_bits, wanted | preferred);
  return best != UINT32_MAX ? best : find_memory_type(state_->memory, type_bits, wanted);
}

namespace {
void describe_queue(const VkQueueFamilyProperties& family, DeviceQueue& queue) {
  queue.flags = family.queueFlags;
  if ((queue.flags & (VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT)) != 0) queue.flags |= VK_QUEUE_TRANSFER_BIT;
  queue.timestamp_bits = family.timestampValidBits;
  const VkExtent3D& granularity = family.minImageTransferGranularity;
  queue.whole_copies_only = granularity.width != 1 || granularity.height != 1 || granularity.depth != 1;
}
}  // namespace

void describe_physical_device(Device::State& state) {
  VkPhysicalDeviceProperties properties;
  state.vk.GetPhysicalDeviceProperties(state.physical, &properties);
  state.name = properties.deviceName;
  state.limits = properties.limits;
  state.identity = {properties.vendorID, properties.deviceID, properties.driverVersion, std::to_array(properties.pipelineCacheUUID)};
  state.vk.GetPhysicalDeviceMemoryProperties(state.physical, &state.memory);

  uint32_t count = 0;
  state.vk.GetPhysicalDeviceQueueFamilyProperties(state.physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  state.vk.GetPhysicalDeviceQueueFamilyProperties(state.physical, &count, families.data());
  for (DeviceQueue& queue : state.queues)
    if (queue.family < count) describe_queue(families[queue.family], queue);
}

void add_queue(Device::State& state, const ExternalQueue& queue) {
  if (queue.mutex == nullptr) state.mutexes.push_back(std::make_unique<std::mutex>());
  if (std::find(state.families.begin(), state.families.end(), queue.family) == state.families.end()) state.families.push_back(queue.family);
  state.queues.push_back({queue.queue, queue.family, 0, 0, false, queue.mutex != nullptr ? queue.mutex : state.mutexes.back().get()});
}

bool Device::has(Capability capability) const { return (state_->capabilities & bit(capability)) != 0; }

Status Device::save_pipeline_cache() {
  if (!state_->cache_file.cache)
    return Error{ErrorCode::invalid_argument, "this device has no file for pipelines; name one as DeviceOptions::pipeline_cache"};
  if (state_->lost) return lost_device();
  return rg::save_pipeline_cache(*state_, true);
}
uint64_t Device::pipeline_cache_loaded() const { return state_->cache_file.loaded_bytes; }

Status Device::wait_idle() {
  if (state_->lost) return lost_device();
  return check(wait_for_queues(*state_), "vkDeviceWaitIdle", {});
}

Result<Device> Device::adopt(const ExternalDevice& external) {
  if (external.get_instance_proc_addr == nullptr || external.device == VK_NULL_HANDLE || external.queue == VK_NULL_HANDLE)
    return Error{ErrorCode::invalid_argument, "an external device needs a VkDevice, a VkQueue and vkGetInstanceProcAddr"};
  auto state = std::make_unique<State>();
  state->instance = external.instance;
  state->get_instance_proc_addr = external.get_instance_proc_addr;
  state->physical = external.physical_device;
  state->device = external.device;
  add_queue(*state, {external.queue, external.queue_family, external.queue_mutex});
  for (const ExternalQueue& queue : external.more_queues) add_queue(*state, queue);
  state->sampler_anisotropy = external.features.sampler_anisotropy;
  state->multi_draw_indirect = external.features.multi_draw_indirect;
  state->draw_indirect_count = external.features.draw_indirect_count;
  state->host_query_reset = external.features.host_query_reset;
  state->pipeline_statistics = external.features.pipeline_statistics;
  state->load_op_none = external.features.load_op_none;
  state->pipeline_cache = external.pipeline_cache;
  state->vk.allocator = external.allocator;
  const char* missing = load_instance_functions(state->vk, external.get_instance_proc_addr, external.instance);
  if (missing == nullptr) missing = load_device_functions(state->vk, external.device);
  if (missing != nullptr) return Error{ErrorCode::unsupported, std::string("the external device lacks ") + missing + "; create it for Vulkan 1.3"};
  describe_physical_device(*state);
  state->capabilities = subgroup_capabilities(*state) | enabled_capabilities(external.features);
  constexpr VkQueueFlags universal = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  if ((state->queues[0].flags & universal) != universal)
    return Error{ErrorCode::invalid_argument,
                 "ExternalDevice::queue must do graphics and compute; its family " + std::to_string(external.queue_family) + " does not"};
  return Device(std::move(state));
}

}  // namespace rg
