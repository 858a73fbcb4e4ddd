// Devices under VK_LAYER_RGC_queues.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "runtime/device.h"

namespace rg::test {

inline int seeds_to_run() {
  const char* text = std::getenv("RGC_LONG");
  return text != nullptr && *text == '1' ? 500 : 20;
}

// Without a seed: in the order of the calls. `folder`: where the layer lies.
inline Result<Device> open_under_layer(const std::string& folder, std::optional<int> seed, bool validate,
                                       std::function<void(bool, std::string_view)> on_message = {}) {
  setenv("VK_ADD_LAYER_PATH", folder.c_str(), 1);
  setenv("RGC_QUEUES_SEED", seed ? std::to_string(*seed).c_str() : "", 1);
  DeviceOptions options;
  options.validate = validate;
  options.layers = {"VK_LAYER_RGC_queues"};
  options.on_message = std::move(on_message);
  return Device::create(options);
}

}  // namespace rg::test
