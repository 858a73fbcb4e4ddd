// A Vulkan driver whose functions do nothing and succeed: what is left of a frame is the cost of who calls them.
#pragma once

#include <functional>

#include "runtime/device.h"

namespace rg::bench {

Result<Device> still_device();

// How many of its functions `work` calls.
uint64_t still_calls(Device& device, const std::function<void()>& work);

}  // namespace rg::bench
