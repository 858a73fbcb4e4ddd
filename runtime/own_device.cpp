// Instance, physical device and device of the runtime's own, headless. libvulkan is opened at run time: a program that never
// creates a device needs no Vulkan.
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>

#include "runtime/capabilities.h"
#include "runtime/device_state.h"
#include "runtime/errors.h"
#include "runtime/features.h"

namespace rg {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kLoadOpNone = "VK_EXT_load_store_op_none";

Error no_driver() { return Error{ErrorCode::unsupported, "no Vulkan device; the package `mesa-vulkan-drivers` brings one that runs on the CPU"}; }

Result<PFN_vkGetInstanceProcAddr> open_loader(Device::State& state) {
  // RTLD_NODELETE: drivers leave threads and exit handlers behind.
  state.library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (state.library == nullptr)
    return Error{ErrorCode::unsupported, "no Vulkan loader: libvulkan.so.1 was not found; install the package `libvulkan1`"};
  auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(state.library, "vkGetInstanceProcAddr"));
  const char* missing = get == nullptr ? "vkGetInstanceProcAddr" : load_global_functions(state.vk, get);
  if (missing != nullptr) return Error{ErrorCode::unsupported, std::string("the Vulkan loader lacks ") + missing};
  return get;
}

bool has_layer(const DeviceFunctions& vk, const char* name) {
  uint32_t count = 0;
  vk.EnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vk.EnumerateInstanceLayerProperties(&count, layers.data());
  for (const VkLayerProperties& layer : layers)
    if (std::strcmp(layer.layerName, name) == 0) return true;
  return false;
}

bool has_instance_extension(const DeviceFunctions& vk, const char* layer, const char* name) {
  uint32_t count = 0;
  vk.EnumerateInstanceExtensionProperties(layer, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vk.EnumerateInstanceExtensionProperties(layer, &count, extensions.data());
  for (const VkExtensionProperties& extension : extensions)
    if (std::strcmp(extension.extensionName, name) == 0) return true;
  return false;
}

VkBool32 VKAPI_CALL receive_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& state = *static_cast<Device::State*>(user);
  const std::string_view text = data->pMessage == nullptr ? "" : data->pMessage;
  if (text.find("for optimal performance") != std::string_view::npos) return VK_FALSE;
  ++state.messages;
  if (state.on_message) state.on_message((severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0, text);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(Device::State& state) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = receive_message;
  info.pUserData = &state;
  return info;
}

// Hazards between submits are off by default in the layer and can only be switched on from outside the API.
void ask_for_submit_time_checks() { setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 0); }

Status check_loader_version(const DeviceFunctions& vk) {
  uint32_t version = 0;
  vk.EnumerateInstanceVersion(&version);
  if (version >= VK_API_VERSION_1_3) return Done{};
  return Error{ErrorCode::unsupported, "the Vulkan loader is older than 1.3"};
}

// The layer with synchronization validation, and its messages from the first call on. Points into itself.
struct ValidationChain {
  explicit ValidationChain(Device::State& state) : messenger(messenger_info(state)) {
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
  }
  ValidationChain(const ValidationChain&) = delete;
  ValidationChain& operator=(const ValidationChain&) = delete;
  VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkDebugUtilsMessengerCreateInfoEXT messenger;
  VkValidationFeaturesEXT features{};
};

Status check_layer(const DeviceFunctions& vk) {
  if (has_layer(vk, kValidationLayer)) return Done{};
  return Error{ErrorCode::unsupported,
               "the validation layer VK_LAYER_KHRONOS_validation is not installed; install the package `vulkan-validationlayers`"};
}

Status load_instance(Device::State& state, PFN_vkGetInstanceProcAddr get) {
  const char* missing = load_instance_functions(state.vk, get, state.instance);
  if (missing == nullptr) return Done{};
  if (state.vk.DestroyInstance != nullptr) state.vk.DestroyInstance(state.instance, nullptr);
  state.instance = VK_NULL_HANDLE;
  return Error{ErrorCode::unsupported, std::string("the Vulkan instance lacks ") + missing};
}

Status create_messenger(Device::State& state, const ValidationChain& chain) {
  state.validating = state.classic_render_passes = true;
  return check(state.vk.CreateDebugUtilsMessengerEXT(state.instance, &chain.messenger, nullptr, &state.messenger), "vkCreateDebugUtilsMessengerEXT",
               {});
}

Status create_instance(Device::State& state, const DeviceOptions& options, PFN_vkGetInstanceProcAddr get) {
  RG_TRY(check_loader_version(state.vk));
  if (options.validate) RG_TRY(check_layer(state.vk));
  for (const char* layer : options.layers)
    if (!has_layer(state.vk, layer)) return Error{ErrorCode::unsupported, std::string("the layer ") + layer + " was not found"};
  if (options.validate) ask_for_submit_time_checks();
  std::vector<const char*> extensions = options.instance_extensions;
  const bool labels = options.validate || has_instance_extension(state.vk, nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (labels) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pEngineName = "rgc";
  application.apiVersion = VK_API_VERSION_1_3;
  const ValidationChain chain(state);
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = options.validate ? &chain.features : nullptr;
  info.pApplicationInfo = &application;
  std::vector<const char*> layers = options.layers;
  if (options.validate) layers.insert(layers.begin(), kValidationLayer);
  info.enabledLayerCount = static_cast<uint32_t>(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = state.vk.CreateInstance(&info, nullptr, &state.instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return no_driver();
  RG_TRY(check(result, "vkCreateInstance", {}));
  RG_TRY(load_instance(state, get));
  return options.validate ? create_messenger(state, chain) : Status(Done{});
}

std::vector<VkPhysicalDevice> physical_devices(const Device::State& state) {
  uint32_t count = 0;
  if (state.vk.EnumeratePhysicalDevices(state.instance, &count, nullptr) != VK_SUCCESS) return {};
  std::vector<VkPhysicalDevice> devices(count);
  if (state.vk.EnumeratePhysicalDevices(state.instance, &count, devices.data()) < VK_SUCCESS) return {};
  devices.resize(count);
  return devices;
}

// A family that does graphics and compute; UINT32_MAX: none.
uint32_t universal_family(const Device::State& state, VkPhysicalDevice physical) {
  uint32_t count = 0;
  state.vk.GetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  state.vk.GetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t family = 0; family < count; ++family)
    if ((families[family].queueFlags & wanted) == wanted) return family;
  return UINT32_MAX;
}

// Why a device cannot run graphs; empty where it can.
std::string unsuitable(const Device::State& state, VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties;
  state.vk.GetPhysicalDeviceProperties(physical, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_3)
    return "Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
           std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + " instead of 1.3";
  if (universal_family(state, physical) == UINT32_MAX) return "no queue for graphics and compute";
  FeatureChain available;
  state.vk.GetPhysicalDeviceFeatures2(physical, &available.core);
  std::string text;
  for (const std::string& name : missing_features(available)) text += (text.empty() ? "no feature " : ", ") + name;
  return text;
}

DeviceDescription describe(const Device::State& state, VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties;
  state.vk.GetPhysicalDeviceProperties(physical, &properties);
  const std::string reason = unsuitable(state, physical);
  return {properties.deviceName, properties.apiVersion, reason.empty(), reason};
}

int rank(const Device::State& state, VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties;
  state.vk.GetPhysicalDeviceProperties(physical, &properties);
  switch (properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 1;
    default:
      return 0;
  }
}

Status choose_by_index(Device::State& state, const std::vector<VkPhysicalDevice>& devices, int index) {
  if (index >= static_cast<int>(devices.size()))
    return Error{ErrorCode::invalid_argument, "there is no device " + std::to_string(index) + ": found " + std::to_string(devices.size())};
  state.physical = devices[static_cast<size_t>(index)];
  const DeviceDescription description = describe(state, state.physical);
  if (description.usable) return Done{};
  return Error{ErrorCode::unsupported, "device `" + description.name + "` cannot run graphs: " + description.reason};
}

Status choose_physical_device(Device::State& state, int index) {
  const std::vector<VkPhysicalDevice> devices = physical_devices(state);
  if (index >= 0) return choose_by_index(state, devices, index);
  std::string reasons;
  for (VkPhysicalDevice physical : devices) {
    const DeviceDescription description = describe(state, physical);
    if (!description.usable) reasons += "; `" + description.name + "`: " + description.reason;
    if (description.usable && (state.physical == VK_NULL_HANDLE || rank(state, physical) > rank(state, state.physical))) state.physical = physical;
  }
  if (state.physical != VK_NULL_HANDLE) return Done{};
  if (devices.empty()) return no_driver();
  return Error{ErrorCode::unsupported, "no suitable Vulkan device" + reasons};
}

Result<std::vector<const char*>> device_extensions(Device::State& state, const DeviceOptions& options) {
  std::vector<const char*> extensions = options.device_extensions;
  for (const char* extension : extensions)
    if (!has_device_extension(state.vk, state.physical, extension))
      return Error{ErrorCode::unsupported, std::string("the device lacks the extension ") + extension};
  state.load_op_none = has_device_extension(state.vk, state.physical, kLoadOpNone);
  if (state.load_op_none) extensions.push_back(kLoadOpNone);
  for (const char* extension : capability_extensions(state))
    if (std::none_of(extensions.begin(), extensions.end(), [&](const char* other) { return std::string_view(other) == extension; }))
      extensions.push_back(extension);
  return extensions;
}

void enable_features(Device::State& state, FeatureChain& wanted) {
  FeatureChain available;
  state.vk.GetPhysicalDeviceFeatures2(state.physical, &available.core);
  enable_available(wanted, available);
  state.sampler_anisotropy = wanted.core.features.samplerAnisotropy == VK_TRUE;
  state.multi_draw_indirect = wanted.core.features.multiDrawIndirect == VK_TRUE;
  state.draw_indirect_count = wanted.v12.drawIndirectCount == VK_TRUE;
  state.pipeline_statistics = wanted.core.features.pipelineStatisticsQuery == VK_TRUE;
  state.host_query_reset = wanted.v12.hostQueryReset == VK_TRUE;
}

constexpr uint32_t kQueuesOfAFamily = 2;

// The universal family first. Of every family with queues for work as many as plans are likely to use.
std::vector<VkDeviceQueueCreateInfo> queue_infos(const Device::State& state) {
  static constexpr float kPriorities[kQueuesOfAFamily] = {1, 1};
  uint32_t count = 0;
  state.vk.GetPhysicalDeviceQueueFamilyProperties(state.physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  state.vk.GetPhysicalDeviceQueueFamilyProperties(state.physical, &count, families.data());
  const uint32_t universal = universal_family(state, state.physical);
  std::vector<VkDeviceQueueCreateInfo> infos;
  for (uint32_t family = 0; family < count; ++family) {
    constexpr VkQueueFlags work = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
    if ((families[family].queueFlags & work) == 0) continue;
    VkDeviceQueueCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    info.queueFamilyIndex = family;
    info.queueCount = std::min(families[family].queueCount, kQueuesOfAFamily);
    info.pQueuePriorities = kPriorities;
    infos.insert(family == universal ? infos.begin() : infos.end(), info);
  }
  return infos;
}

void take_queues(Device::State& state, const std::vector<VkDeviceQueueCreateInfo>& infos) {
  for (const VkDeviceQueueCreateInfo& info : infos)
    for (uint32_t i = 0; i < info.queueCount; ++i) {
      VkQueue queue = VK_NULL_HANDLE;
      state.vk.GetDeviceQueue(state.device, info.queueFamilyIndex, i, &queue);
      add_queue(state, {queue, info.queueFamilyIndex, nullptr});
    }
}

Status create_device(Device::State& state, const DeviceOptions& options) {
  for (const Capability capability : options.without) state.without |= bit(capability);
  FeatureChain wanted;
  enable_features(state, wanted);
  const Result<std::vector<const char*>> extensions = device_extensions(state, options);
  if (!extensions) return extensions.error();
  const auto enabled = [&](const char* name) {
    return std::any_of(extensions->begin(), extensions->end(), [&](const char* other) { return std::string_view(other) == name; });
  };
  EnabledFeatures found;
  found.multiview = wanted.v11.multiview == VK_TRUE && draws_every_view(state);
  found.depth_bounds = wanted.core.features.depthBounds == VK_TRUE;
  found.conservative_rasterization = enabled(VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME);
  found.sample_locations = enabled(VK_EXT_SAMPLE_LOCATIONS_EXTENSION_NAME) && places_samples(state);
  VkPhysicalDeviceFragmentShaderBarycentricFeaturesKHR barycentrics{};
  barycentrics.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_BARYCENTRIC_FEATURES_KHR;
  barycentrics.pNext = &wanted.core;
  barycentrics.fragmentShaderBarycentric = found.barycentrics = enabled(VK_KHR_FRAGMENT_SHADER_BARYCENTRIC_EXTENSION_NAME);
  state.capabilities = (subgroup_capabilities(state) | enabled_capabilities(found)) & ~state.without;
  const std::vector<VkDeviceQueueCreateInfo> queues = queue_infos(state);
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = found.barycentrics ? static_cast<const void*>(&barycentrics) : &wanted.core;
  info.queueCreateInfoCount = static_cast<uint32_t>(queues.size());
  info.pQueueCreateInfos = queues.data();
  info.enabledExtensionCount = static_cast<uint32_t>(extensions->size());
  info.ppEnabledExtensionNames = extensions->data();
  RG_TRY(check(state.vk.CreateDevice(state.physical, &info, nullptr, &state.device), "vkCreateDevice", {}));
  if (const char* missing = load_device_functions(state.vk, state.device))
    return Error{ErrorCode::unsupported, std::string("the Vulkan device lacks ") + missing};
  take_queues(state, queues);
  return Done{};
}

}  // namespace

Result<Device> Device::create(const DeviceOptions& options) {
  auto state = std::make_unique<State>();
  state->owned = true;
  state->on_message = options.on_message;
  const Result<PFN_vkGetInstanceProcAddr> get = open_loader(*state);
  if (!get) return get.error();
  state->get_instance_proc_addr = *get;
  RG_TRY(create_instance(*state, options, *get));
  RG_TRY(choose_physical_device(*state, options.device));
  RG_TRY(create_device(*state, options));
  describe_physical_device(*state);
  if (!options.pipeline_cache.empty()) RG_TRY(open_pipeline_cache(*state, options.pipeline_cache));
  return Device(std::move(state));
}

std::vector<DeviceDescription> list_devices() {
  Device::State state;
  state.owned = true;
  const Result<PFN_vkGetInstanceProcAddr> get = open_loader(state);
  if (!get || !create_instance(state, {}, *get)) return {};
  std::vector<DeviceDescription> descriptions;
  for (VkPhysicalDevice physical : physical_devices(state)) descriptions.push_back(describe(state, physical));
  return descriptions;
}

}  // namespace rg
