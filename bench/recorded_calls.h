// The commands that a frame records on a real driver, kept so that they can be made again without the runtime: a command buffer as written by hand.
#pragma once

#include <functional>
#include <vector>

#include "runtime/device.h"

namespace rg::bench {

using Calls = std::vector<std::function<void(VkCommandBuffer)>>;

// The same Vulkan device once more, adopted with functions that keep every vkCmd call made while `keep_calls` is on. What arguments point to must
// stay: the tables of an instance do.
Result<Device> keeping_device(Device& real);
void keep_calls(Calls* calls);  // null: no more

}  // namespace rg::bench
