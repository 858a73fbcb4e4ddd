// From VkResult to rg::Error, and early return of failures.
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

#include "runtime/result.h"

namespace rg {

std::string_view result_name(VkResult result);  // "VK_ERROR_DEVICE_LOST"

// "`subject`: call failed with VK_ERROR_...": the code follows from `result`.
Error vulkan_error(VkResult result, std::string_view call, std::string_view subject);

// What a device says that has been lost before.
Error lost_device();

inline Status check(VkResult result, std::string_view call, std::string_view subject) {
  if (result == VK_SUCCESS) return Done{};
  return vulkan_error(result, call, subject);
}

// Returns the error of a Status from the enclosing function.
#define RG_TRY(...)                                        \
  do {                                                     \
    ::rg::Status rg_status = (__VA_ARGS__);                \
    if (!rg_status) return ::rg::Error(rg_status.error()); \
  } while (false)

}  // namespace rg
