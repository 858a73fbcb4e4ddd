#include <map>
#include <mutex>

#include "tests/layer/layer.h"

namespace rgc_layer {

namespace {
std::shared_mutex mutex;
std::map<void*, std::unique_ptr<InstanceLayer>> instances;
std::map<void*, std::unique_ptr<DeviceLayer>> devices;

template <class Map>
auto& find(Map& map, const void* handle) {
  const std::shared_lock lock(mutex);
  return *map.at(dispatch_key(handle));
}
}  // namespace

InstanceLayer& layer_of(VkInstance instance) { return find(instances, instance); }
InstanceLayer& layer_of(VkPhysicalDevice physical) { return find(instances, physical); }
DeviceLayer& layer_of(VkDevice device) { return find(devices, device); }
DeviceLayer& layer_of(VkCommandBuffer commands) { return find(devices, commands); }

void add_instance(std::unique_ptr<InstanceLayer> instance) {
  const std::lock_guard lock(mutex);
  instances[dispatch_key(instance->handle)] = std::move(instance);
}
void remove_instance(VkInstance instance) {
  const std::lock_guard lock(mutex);
  instances.erase(dispatch_key(instance));
}
void add_device(std::unique_ptr<DeviceLayer> device) {
  const std::lock_guard lock(mutex);
  devices[dispatch_key(device->handle)] = std::move(device);
}
std::unique_ptr<DeviceLayer> remove_device(VkDevice device) {
  const std::lock_guard lock(mutex);
  auto node = devices.extract(dispatch_key(device));
  return std::move(node.mapped());
}

}  // namespace rgc_layer
