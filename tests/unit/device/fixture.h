// A real Vulkan device for a test, or a reason to skip. With RGC_REQUIRE_GPU set there is no skipping; a missing validation layer is never skipped.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/device.h"
#include "runtime/graph.h"
#include "tests/unit/runtime/test_plan.h"

namespace rg::test {

class DeviceTest : public testing::Test {
 protected:
  // Empty, with the test skipped or failed, where there is none.
  std::optional<Device> open(bool validate, DeviceOptions options = {}) {
    options.validate = validate;
    options.on_message = [this](bool, std::string_view message) { messages.emplace_back(message); };
    Result<Device> device = Device::create(options);
    if (device) return std::move(*device);
    const bool layer_missing = device.error().message.find("layer") != std::string::npos;
    if (std::getenv("RGC_REQUIRE_GPU") != nullptr || layer_missing)
      ADD_FAILURE() << device.error().message;
    else
      reason = device.error().message;
    return std::nullopt;
  }

  bool reported(std::string_view text) const {
    for (const std::string& message : messages)
      if (message.find(text) != std::string::npos) return true;
    return false;
  }
  std::string all_messages() const {
    std::string text;
    for (const std::string& message : messages) text += message + "\n";
    return text;
  }

  std::vector<std::string> messages;
  std::string reason;
};

template <class T>
std::vector<T> as(std::span<const std::byte> bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

}  // namespace rg::test

#define RG_OPEN_DEVICE(name, validate)                      \
  std::optional<rg::Device> name##_opened = open(validate); \
  if (HasFailure()) return;                                 \
  if (!name##_opened) GTEST_SKIP() << reason;               \
  rg::Device& name = *name##_opened

#define RG_ASSERT_OK(...)                                \
  do {                                                   \
    const auto rg_result = (__VA_ARGS__);                \
    ASSERT_TRUE(rg_result) << rg_result.error().message; \
  } while (false)
