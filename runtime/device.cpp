#include "runtime/device.h"

#include <dlfcn.h>

#include "runtime/device_state.h"
#include "runtime/errors.h"

namespace rg {

Device::Device(std::unique_ptr<State> state) : state_(std::move(state)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

Device::State::~State() {
  if (owned) {
    if (device != VK_NULL_HANDLE) vk.DestroyDevice(device, nullptr);
    if (messenger != VK_NULL_HANDLE) vk.DestroyDebugUtilsMessengerEXT(instance, messenger, nullptr);
    if (instance != VK_NULL_HANDLE) vk.DestroyInstance(instance, nullptr);
  }
  if (library != nullptr) dlclose(library);
}

const DeviceFunctions& Device::vk() const { return state_->vk; }
VkDevice Device::handle() const { return state_->device; }
VkPhysicalDevice Device::physical() const { return state_->physical; }
VkQueue Device::queue() const { return state_->queue; }
uint32_t Device::queue_family() const { return state_->queue_family; }
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

void describe_physical_device(Device::State& state) {
  VkPhysicalDeviceProperties properties;
  state.vk.GetPhysicalDeviceProperties(state.physical, &properties);
  state.name = properties.deviceName;
  state.limits = properties.limits;
  state.vk.GetPhysicalDeviceMemoryProperties(state.physical, &state.memory);

  uint32_t count = 0;
  state.vk.GetPhysicalDeviceQueueFamilyProperties(state.physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  state.vk.GetPhysicalDeviceQueueFamilyProperties(state.physical, &count, families.data());
  if (state.queue_family < count) state.timestamp_bits = families[state.queue_family].timestampValidBits;
}

Result<Device> Device::adopt(const ExternalDevice& external) {
  if (external.get_instance_proc_addr == nullptr || external.device == VK_NULL_HANDLE || external.queue == VK_NULL_HANDLE)
    return Error{ErrorCode::invalid_argument, "an external device needs a VkDevice, a VkQueue and vkGetInstanceProcAddr"};
  auto state = std::make_unique<State>();
  state->instance = external.instance;
  state->physical = external.physical_device;
  state->device = external.device;
  state->queue = external.queue;
  state->queue_family = external.queue_family;
  const char* missing = load_instance_functions(state->vk, external.get_instance_proc_addr, external.instance);
  if (missing == nullptr) missing = load_device_functions(state->vk, external.device);
  if (missing != nullptr) return Error{ErrorCode::unsupported, std::string("the external device lacks ") + missing + "; create it for Vulkan 1.3"};
  describe_physical_device(*state);
  return Device(std::move(state));
}

}  // namespace rg
