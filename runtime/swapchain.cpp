#include "runtime/swapchain.h"

#include <algorithm>
#include <vector>

#include "runtime/device_state.h"
#include "runtime/errors.h"
#include "runtime/handles.h"

namespace rg {

using UniqueSwapchain = Unique<VkSwapchainKHR, &DeviceFunctions::DestroySwapchainKHR>;

struct Swapchain::State {
  explicit State(Device::State& d) : device(d) {}
  ~State();
  Device::State& device;
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  SwapchainOptions options;
  VkPresentModeKHR mode = VK_PRESENT_MODE_FIFO_KHR;
  UniqueSwapchain swapchain;
  VkExtent2D extent = {0, 0}, presented = {0, 0};
  VkExtent2D window = {0, 0};   // when the images were made
  bool follows_window = false;  // nobody else says how large the surface is
  bool stale = true;            // the images must be made anew
  bool out = false;             // a picture that was acquired and not presented
  std::vector<VkImage> images;
  std::vector<UniqueView> views;
  std::vector<UniqueSemaphore> drawn;     // by image
  std::vector<UniqueSemaphore> acquired;  // by image: what its last acquisition signalled
  UniqueSemaphore spare;                  // of the next acquisition: nobody waits for it any more
};

namespace {

Result<UniqueSemaphore> create_semaphore(Device::State& device) {
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  RG_TRY(check(device.vk.CreateSemaphore(device.device, &info, device.vk.allocator, &semaphore), "vkCreateSemaphore", "swapchain"));
  return UniqueSemaphore(device.vk, device.device, semaphore);
}

template <class Row, class Call>
Result<std::vector<Row>> list(const char* name, Call call) {
  uint32_t count = 0;
  RG_TRY(check(call(&count, nullptr), name, "surface"));
  std::vector<Row> rows(count);
  const VkResult result = call(&count, rows.data());
  if (result != VK_INCOMPLETE) RG_TRY(check(result, name, "surface"));
  rows.resize(count);
  return rows;
}

Status check_support(const Swapchain::State& state) {
  const DeviceFunctions& vk = state.device.vk;
  if (vk.CreateSwapchainKHR == nullptr || vk.GetPhysicalDeviceSurfaceSupportKHR == nullptr)
    return Error{ErrorCode::unsupported, "this device cannot present: ask for VK_KHR_surface and VK_KHR_swapchain when it is created"};
  VkBool32 supported = VK_FALSE;
  RG_TRY(check(vk.GetPhysicalDeviceSurfaceSupportKHR(state.device.physical, state.device.queues[0].family, state.surface, &supported),
               "vkGetPhysicalDeviceSurfaceSupportKHR", "surface"));
  if (supported == VK_TRUE) return Done{};
  return Error{ErrorCode::unsupported, "device `" + state.device.name + "` cannot present to this surface"};
}

Status check_format(const Swapchain::State& state) {
  const auto formats = list<VkSurfaceFormatKHR>("vkGetPhysicalDeviceSurfaceFormatsKHR", [&](uint32_t* count, VkSurfaceFormatKHR* rows) {
    return state.device.vk.GetPhysicalDeviceSurfaceFormatsKHR(state.device.physical, state.surface, count, rows);
  });
  if (!formats) return formats.error();
  for (const VkSurfaceFormatKHR& row : *formats)
    if (row.format == state.options.format && row.colorSpace == state.options.color_space) return Done{};
  std::string known;
  for (const VkSurfaceFormatKHR& row : *formats) known += (known.empty() ? "" : ", ") + std::to_string(row.format);
  return Error{ErrorCode::unsupported, "the surface does not show format " + std::to_string(state.options.format) + "; it shows " + known};
}

Status choose_mode(Swapchain::State& state) {
  if (state.options.vsync) return Done{};
  const auto modes = list<VkPresentModeKHR>("vkGetPhysicalDeviceSurfacePresentModesKHR", [&](uint32_t* count, VkPresentModeKHR* rows) {
    return state.device.vk.GetPhysicalDeviceSurfacePresentModesKHR(state.device.physical, state.surface, count, rows);
  });
  if (!modes) return modes.error();
  for (const VkPresentModeKHR mode : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR})
    if (std::find(modes->begin(), modes->end(), mode) != modes->end()) {
      state.mode = mode;
      break;
    }
  return Done{};
}

bool leaves_size(const VkSurfaceCapabilitiesKHR& surface) { return surface.currentExtent.width == UINT32_MAX; }
VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR& surface, VkExtent2D window) {
  if (!leaves_size(surface)) return surface.currentExtent;
  if (window.width == 0 || window.height == 0) return {0, 0};
  return {std::clamp(window.width, surface.minImageExtent.width, surface.maxImageExtent.width),
          std::clamp(window.height, surface.minImageExtent.height, surface.maxImageExtent.height)};
}

VkSwapchainCreateInfoKHR swapchain_info(const Swapchain::State& state, const VkSurfaceCapabilitiesKHR& surface, VkExtent2D extent) {
  VkSwapchainCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
  info.surface = state.surface;
  info.minImageCount = std::max(state.options.min_images, surface.minImageCount);
  if (surface.maxImageCount != 0) info.minImageCount = std::min(info.minImageCount, surface.maxImageCount);
  info.imageFormat = state.options.format;
  info.imageColorSpace = state.options.color_space;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = state.options.usage;
  const bool shared = state.options.concurrent && state.device.families.size() > 1;
  info.imageSharingMode = shared ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE;
  info.queueFamilyIndexCount = shared ? static_cast<uint32_t>(state.device.families.size()) : 0;
  info.pQueueFamilyIndices = shared ? state.device.families.data() : nullptr;
  info.preTransform = surface.currentTransform;
  info.compositeAlpha = (surface.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0 ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                                                   : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = state.mode;
  info.clipped = VK_TRUE;
  info.oldSwapchain = state.swapchain.get();
  return info;
}

Result<UniqueView> create_view(Swapchain::State& state, VkImage image) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = state.options.format;
  info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  RG_TRY(check(state.device.vk.CreateImageView(state.device.device, &info, state.device.vk.allocator, &view), "vkCreateImageView", "swapchain"));
  return UniqueView(state.device.vk, state.device.device, view);
}

Status create_image_objects(Swapchain::State& state) {
  const auto images = list<VkImage>("vkGetSwapchainImagesKHR", [&](uint32_t* count, VkImage* rows) {
    return state.device.vk.GetSwapchainImagesKHR(state.device.device, state.swapchain.get(), count, rows);
  });
  if (!images) return images.error();
  state.images = *images;
  for (const VkImage image : state.images) {
    Result<UniqueView> view = create_view(state, image);
    if (!view) return view.error();
    Result<UniqueSemaphore> drawn = create_semaphore(state.device), acquired = create_semaphore(state.device);
    if (!drawn) return drawn.error();
    if (!acquired) return acquired.error();
    state.views.push_back(std::move(*view)), state.drawn.push_back(std::move(*drawn)), state.acquired.push_back(std::move(*acquired));
  }
  Result<UniqueSemaphore> spare = create_semaphore(state.device);
  if (!spare) return spare.error();
  state.spare = std::move(*spare);
  return Done{};
}

// `extent` stays 0x0 where there is nothing to show.
Status remake(Swapchain::State& state, VkExtent2D window) {
  VkSurfaceCapabilitiesKHR surface{};
  RG_TRY(check(state.device.vk.GetPhysicalDeviceSurfaceCapabilitiesKHR(state.device.physical, state.surface, &surface),
               "vkGetPhysicalDeviceSurfaceCapabilitiesKHR", "surface"));
  const VkExtent2D extent = choose_extent(surface, window);
  RG_TRY(check(wait_for_queues(state.device), "vkDeviceWaitIdle", "swapchain"));
  state.images.clear(), state.views.clear(), state.drawn.clear(), state.acquired.clear();
  state.extent = {0, 0};
  state.window = window, state.follows_window = leaves_size(surface);
  state.out = false;
  if (extent.width == 0 || extent.height == 0) return Done{};
  const VkSwapchainCreateInfoKHR info = swapchain_info(state, surface, extent);
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  const VkResult made = state.device.vk.CreateSwapchainKHR(state.device.device, &info, state.device.vk.allocator, &swapchain);
  state.swapchain = {};  // retired, also where there is none that replaces it
  RG_TRY(check(made, "vkCreateSwapchainKHR", "swapchain"));
  state.swapchain = UniqueSwapchain(state.device.vk, state.device.device, swapchain);
  RG_TRY(create_image_objects(state));
  state.extent = extent;
  state.stale = false;
  return Done{};
}

Picture make_picture(Swapchain::State& state, uint32_t index, Index slot) {
  std::swap(state.acquired[index], state.spare);  // what the image's last acquisition signalled was waited for before it was presented
  Picture picture;
  picture.image = {state.images[index], state.views[index].get()};
  picture.extent = state.extent;
  picture.changed = state.extent.width != state.presented.width || state.extent.height != state.presented.height;
  state.out = true;
  picture.index = index;
  picture.acquired[0] = {state.acquired[index].get(), 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot};
  picture.drawn[0] = {state.drawn[index].get(), 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot};
  return picture;
}

}  // namespace

Swapchain::State::~State() {
  if (swapchain && !device.lost) static_cast<void>(wait_for_queues(device));
}

Swapchain::Swapchain(std::unique_ptr<State> state) : state_(std::move(state)) {}
Swapchain::Swapchain(Swapchain&&) noexcept = default;
Swapchain& Swapchain::operator=(Swapchain&&) noexcept = default;
Swapchain::~Swapchain() = default;

Result<Swapchain> Swapchain::create(Device& device, VkSurfaceKHR surface, VkExtent2D window, const SwapchainOptions& options) {
  if (device.state().lost) return lost_device();
  auto state = std::make_unique<State>(device.state());
  state->surface = surface;
  state->options = options;
  RG_TRY(check_support(*state));
  RG_TRY(check_format(*state));
  RG_TRY(choose_mode(*state));
  RG_TRY(guarded(device.state(), remake(*state, window)));
  return Swapchain(std::move(state));
}

namespace {

bool resized(const Swapchain::State& state, VkExtent2D window) {
  return state.follows_window && (window.width != state.window.width || window.height != state.window.height);
}

Result<Picture> acquire_image(Swapchain::State& state, VkExtent2D window, Index import_slot) {
  state.stale |= state.out || resized(state, window);
  for (int attempt = 0; attempt < 4; ++attempt) {
    if (state.stale || state.extent.width == 0) RG_TRY(remake(state, window));
    if (state.extent.width == 0) return Picture{};
    uint32_t index = 0;
    const VkResult result =
        state.device.vk.AcquireNextImageKHR(state.device.device, state.swapchain.get(), UINT64_MAX, state.spare.get(), VK_NULL_HANDLE, &index);
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) {
      state.stale = result == VK_SUBOPTIMAL_KHR;  // good for this frame
      return make_picture(state, index, import_slot);
    }
    if (result != VK_ERROR_OUT_OF_DATE_KHR) return vulkan_error(result, "vkAcquireNextImageKHR", "swapchain");
    state.stale = true;
  }
  return Picture{};  // the window changes faster than images can be made for it
}

}  // namespace

Result<Picture> Swapchain::acquire(VkExtent2D window, Index import_slot) {
  if (state_->device.lost) return lost_device();
  return guarded(state_->device, acquire_image(*state_, window, import_slot));
}

Status Swapchain::present(const Picture& picture) {
  State& state = *state_;
  if (state.device.lost) return lost_device();
  const VkSwapchainKHR swapchain = state.swapchain.get();
  VkPresentInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &picture.drawn[0].semaphore;
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain;
  info.pImageIndices = &picture.index;
  const std::lock_guard lock(*state.device.queues[0].mutex);
  const VkResult result = state.device.vk.QueuePresentKHR(state.device.queues[0].handle, &info);
  state.stale |= result != VK_SUCCESS;  // after a failure `drawn` may be signalled or not
  state.out = false;
  state.presented = picture.extent;
  const bool changed = result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR;
  return changed ? Status(Done{}) : guarded(state.device, check(result, "vkQueuePresentKHR", "swapchain"));
}

VkFormat Swapchain::format() const { return state_->options.format; }

}  // namespace rg
