// A Vulkan driver whose functions do nothing and succeed: what is left of a frame is the cost of who calls them.
#pragma once

#include "runtime/device.h"

namespace rg::bench {

// `counted`: functions add to still_calls().
Result<Device> still_device(bool counted = false);
uint64_t still_calls();

}  // namespace rg::bench
