#include "runtime/errors.h"

namespace rg {

std::string_view result_name(VkResult result) {
  switch (result) {
#define RG_NAME(name) \
  case name:          \
    return #name;
    RG_NAME(VK_SUCCESS)
    RG_NAME(VK_NOT_READY)
    RG_NAME(VK_TIMEOUT)
    RG_NAME(VK_INCOMPLETE)
    RG_NAME(VK_ERROR_OUT_OF_HOST_MEMORY)
    RG_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY)
    RG_NAME(VK_ERROR_INITIALIZATION_FAILED)
    RG_NAME(VK_ERROR_DEVICE_LOST)
    RG_NAME(VK_ERROR_MEMORY_MAP_FAILED)
    RG_NAME(VK_ERROR_LAYER_NOT_PRESENT)
    RG_NAME(VK_ERROR_EXTENSION_NOT_PRESENT)
    RG_NAME(VK_ERROR_FEATURE_NOT_PRESENT)
    RG_NAME(VK_ERROR_INCOMPATIBLE_DRIVER)
    RG_NAME(VK_ERROR_TOO_MANY_OBJECTS)
    RG_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED)
    RG_NAME(VK_ERROR_FRAGMENTED_POOL)
    RG_NAME(VK_ERROR_OUT_OF_POOL_MEMORY)
    RG_NAME(VK_ERROR_OUT_OF_DATE_KHR)
    RG_NAME(VK_ERROR_SURFACE_LOST_KHR)
#undef RG_NAME
    default:
      return "an unnamed VkResult";
  }
}

namespace {
ErrorCode code_of(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_TOO_MANY_OBJECTS:
    case VK_ERROR_MEMORY_MAP_FAILED:
      return ErrorCode::out_of_memory;
    case VK_ERROR_DEVICE_LOST:
      return ErrorCode::device_lost;
    case VK_ERROR_OUT_OF_DATE_KHR:
    case VK_ERROR_SURFACE_LOST_KHR:
      return ErrorCode::out_of_date;
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return ErrorCode::unsupported;
    default:
      return ErrorCode::driver;
  }
}
}  // namespace

Error lost_device() { return Error{ErrorCode::device_lost, "the device was lost; destroy everything made from it and create it again"}; }

Error vulkan_error(VkResult result, std::string_view call, std::string_view subject) {
  std::string message;
  if (!subject.empty()) message.append("`").append(subject).append("`: ");
  message.append(call).append(" failed with ").append(result_name(result));
  if (result == VK_SUCCESS) message += " but gave nothing";
  return Error{code_of(result), std::move(message)};
}

}  // namespace rg
