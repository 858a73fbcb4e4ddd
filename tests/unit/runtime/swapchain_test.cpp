// A surface that does what windows do, over the null device: resized, out of date, minimised, lost, and refusing every call in turn.
#include "runtime/swapchain.h"

#include <algorithm>
#include <array>
#include <deque>
#include <set>
#include <thread>

#include "runtime/device_state.h"
#include "tests/unit/runtime/null_fixture.h"

namespace rg {
namespace {

constexpr VkSurfaceKHR kNoSurface = VK_NULL_HANDLE;

// What stands behind the surface; its faults are counted with those of the device.
struct Window {
  NullOptions options = {};
  NullCounters counters = {};
  Device::State* device = nullptr;
  VkBool32 supported = VK_TRUE;
  VkSurfaceCapabilitiesKHR surface = {};
  std::vector<VkSurfaceFormatKHR> formats = {{VK_FORMAT_B8G8R8A8_UNORM, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR},
                                             {VK_FORMAT_B8G8R8A8_SRGB, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR}};
  std::vector<VkPresentModeKHR> modes = {VK_PRESENT_MODE_FIFO_KHR};
  std::deque<VkResult> acquires, presents;  // what the next ones give; then success
  VkSwapchainCreateInfoKHR made = {};
  std::vector<uint32_t> families;
  std::set<VkSwapchainKHR> retired;
  std::set<VkSemaphore> signalled;
  uint32_t swapchains = 0, images = 0, next_image = 0, misuses = 0, unlocked_waits = 0;
  PFN_vkCreateSwapchainKHR create = nullptr;
  PFN_vkDeviceWaitIdle wait_idle = nullptr;

  bool fails() {
    const uint64_t call = ++counters.fallible_calls;
    return call == options.fail_at || (options.fails_from_then_on && options.fail_at != 0 && call > options.fail_at);
  }
};
Window* window = nullptr;

VkResult take(std::deque<VkResult>& results) {
  if (results.empty()) return VK_SUCCESS;
  const VkResult result = results.front();
  results.pop_front();
  return result;
}

template <class Row>
VkResult list(const std::vector<Row>& rows, uint32_t* count, Row* out) {
  if (window->fails()) return window->options.failure;
  if (out != nullptr) std::copy_n(rows.begin(), std::min<size_t>(*count, rows.size()), out);
  *count = static_cast<uint32_t>(rows.size());
  return VK_SUCCESS;
}

VkResult VKAPI_CALL support(VkPhysicalDevice, uint32_t, VkSurfaceKHR, VkBool32* out) {
  *out = window->supported;
  return window->fails() ? window->options.failure : VK_SUCCESS;
}
VkResult VKAPI_CALL capabilities(VkPhysicalDevice, VkSurfaceKHR, VkSurfaceCapabilitiesKHR* out) {
  *out = window->surface;
  return window->fails() ? window->options.failure : VK_SUCCESS;
}
VkResult VKAPI_CALL formats(VkPhysicalDevice, VkSurfaceKHR, uint32_t* count, VkSurfaceFormatKHR* out) { return list(window->formats, count, out); }
VkResult VKAPI_CALL modes(VkPhysicalDevice, VkSurfaceKHR, uint32_t* count, VkPresentModeKHR* out) { return list(window->modes, count, out); }

// Retires the old one, also where it fails.
VkResult VKAPI_CALL create(VkDevice device, const VkSwapchainCreateInfoKHR* info, const VkAllocationCallbacks* allocator, VkSwapchainKHR* swapchain) {
  window->misuses += window->retired.contains(info->oldSwapchain) ? 1 : 0;
  if (info->oldSwapchain != VK_NULL_HANDLE) window->retired.insert(info->oldSwapchain);
  const VkResult result = window->create(device, info, allocator, swapchain);
  if (result != VK_SUCCESS) return result;
  ++window->swapchains;
  window->made = *info;
  window->families.assign(info->pQueueFamilyIndices, info->pQueueFamilyIndices + info->queueFamilyIndexCount);
  window->images = info->minImageCount, window->next_image = 0;
  window->signalled.clear();  // semaphores of the old one are gone
  return VK_SUCCESS;
}
VkResult VKAPI_CALL get_images(VkDevice, VkSwapchainKHR swapchain, uint32_t* count, VkImage* out) {
  window->misuses += window->retired.contains(swapchain) ? 1 : 0;
  std::vector<VkImage> rows;
  for (uint32_t i = 0; i < window->images; ++i) rows.push_back(reinterpret_cast<VkImage>(uintptr_t{1000} * window->swapchains + i));
  return list(rows, count, out);
}
VkResult VKAPI_CALL acquire(VkDevice, VkSwapchainKHR swapchain, uint64_t, VkSemaphore semaphore, VkFence, uint32_t* index) {
  window->misuses += window->retired.contains(swapchain) || window->signalled.contains(semaphore) ? 1 : 0;
  if (window->fails()) return window->options.failure;
  const VkResult result = take(window->acquires);
  if (result != VK_SUCCESS && result != VK_SUBOPTIMAL_KHR) return result;
  window->signalled.insert(semaphore);
  *index = window->next_image++ % window->images;
  return result;
}
VkResult VKAPI_CALL present(VkQueue, const VkPresentInfoKHR* info) {
  window->misuses += window->retired.contains(info->pSwapchains[0]) || window->signalled.erase(info->pWaitSemaphores[0]) == 0 ? 1 : 0;
  if (window->fails()) return window->options.failure;
  return take(window->presents);
}

// Nothing may be submitted to any queue meanwhile: all of them are locked.
VkResult VKAPI_CALL wait_idle(VkDevice device) {
  std::thread([] {
    for (const DeviceQueue& queue : window->device->queues)
      if (queue.mutex->try_lock()) queue.mutex->unlock(), ++window->unlocked_waits;
  }).join();
  return window->wait_idle(device);
}

class SwapchainTest : public testing::Test {
 protected:
  SwapchainTest() {
    window = &behind;
    behind.surface.currentExtent = {320, 200};
    behind.surface.minImageCount = 2;
    behind.surface.minImageExtent = {1, 1}, behind.surface.maxImageExtent = {4096, 4096};
    behind.surface.currentTransform = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR;
    behind.surface.supportedCompositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  }
  ~SwapchainTest() override { window = nullptr; }

  // A device that can present, counted and failing with the surface.
  Device open() {
    behind.options.counters = &behind.counters, behind.options.compute_queues = 1;
    Device device = Device::null(nullptr, behind.options);
    behind.device = &device.state();
    DeviceFunctions& vk = device.state().vk;
    vk.GetPhysicalDeviceSurfaceSupportKHR = support, vk.GetPhysicalDeviceSurfaceCapabilitiesKHR = capabilities;
    vk.GetPhysicalDeviceSurfaceFormatsKHR = formats, vk.GetPhysicalDeviceSurfacePresentModesKHR = modes;
    vk.GetSwapchainImagesKHR = get_images, vk.AcquireNextImageKHR = acquire, vk.QueuePresentKHR = present;
    behind.create = std::exchange(vk.CreateSwapchainKHR, create);
    behind.wait_idle = std::exchange(vk.DeviceWaitIdle, wait_idle);
    return device;
  }
  // What the GPU does with a picture: the frame waits for `acquired` and signals `drawn`.
  void draw(const Picture& picture) {
    behind.misuses += behind.signalled.erase(picture.acquired[0].semaphore) == 0 ? 1 : 0;
    behind.misuses += behind.signalled.insert(picture.drawn[0].semaphore).second ? 0 : 1;
  }
  Status frame(Swapchain& swapchain, VkExtent2D size = {320, 200}) {
    const Result<Picture> picture = swapchain.acquire(size);
    if (!picture) return picture.error();
    if (!*picture) return Done{};
    draw(*picture);
    return swapchain.present(*picture);
  }
  void expect_clean() {
    EXPECT_EQ(behind.misuses, 0u);
    EXPECT_EQ(behind.unlocked_waits, 0u);
    EXPECT_EQ(behind.counters.live_handles, 0u);
    EXPECT_EQ(behind.counters.wrong_destroys, 0u);
  }

  Window behind;
};

std::pair<uint32_t, uint32_t> size_of(const Picture& picture) { return {picture.extent.width, picture.extent.height}; }
using Size = std::pair<uint32_t, uint32_t>;

TEST_F(SwapchainTest, PicturesComeOneAfterTheOther) {
  {
    Device device = open();
    auto swapchain = Swapchain::create(device, kNoSurface, {1, 1});
    ASSERT_TRUE(swapchain) << swapchain.error().message;
    EXPECT_EQ(swapchain->format(), VK_FORMAT_B8G8R8A8_UNORM);
    EXPECT_EQ(behind.made.minImageCount, 3u);
    EXPECT_EQ(behind.made.presentMode, VK_PRESENT_MODE_FIFO_KHR);
    EXPECT_EQ(behind.made.imageSharingMode, VK_SHARING_MODE_EXCLUSIVE);
    for (uint32_t i = 0; i < 10; ++i) {
      const auto picture = swapchain->acquire({1, 1}, 7);
      ASSERT_TRUE(picture && *picture);
      EXPECT_EQ(size_of(*picture), Size(320, 200));
      EXPECT_EQ(picture->changed, i == 0);
      EXPECT_EQ(picture->index, i % 3);
      EXPECT_EQ(picture->acquired[0].import_slot, 7u);
      draw(*picture);
      ASSERT_TRUE(swapchain->present(*picture));
    }
    EXPECT_EQ(behind.swapchains, 1u);
  }
  expect_clean();
}

TEST_F(SwapchainTest, OutOfDateImagesAreMadeAnew) {
  {
    Device device = open();
    auto swapchain = Swapchain::create(device, kNoSurface, {});
    ASSERT_TRUE(swapchain);
    ASSERT_TRUE(frame(*swapchain));
    behind.acquires = {VK_ERROR_OUT_OF_DATE_KHR};
    behind.surface.currentExtent = {100, 50};
    const auto resized = swapchain->acquire({});
    ASSERT_TRUE(resized && *resized);
    EXPECT_EQ(size_of(*resized), Size(100, 50));
    EXPECT_TRUE(resized->changed);
    draw(*resized);
    behind.presents = {VK_ERROR_OUT_OF_DATE_KHR};
    EXPECT_TRUE(swapchain->present(*resized)) << "no error";
    EXPECT_TRUE(frame(*swapchain));
    EXPECT_EQ(behind.swapchains, 3u);
    behind.acquires = {VK_SUBOPTIMAL_KHR};
    EXPECT_TRUE(frame(*swapchain)) << "good for this frame";
    EXPECT_EQ(behind.swapchains, 3u);
    EXPECT_TRUE(frame(*swapchain));
    EXPECT_EQ(behind.swapchains, 4u);
    behind.acquires.assign(4, VK_ERROR_OUT_OF_DATE_KHR);  // faster than images can be made
    const auto none = swapchain->acquire({});
    ASSERT_TRUE(none);
    EXPECT_FALSE(*none);
    EXPECT_TRUE(frame(*swapchain));
  }
  expect_clean();
}

TEST_F(SwapchainTest, MinimisedWindowsShowNothingAndComeBack) {
  {
    Device device = open();
    behind.surface.currentExtent = {0, 0};
    auto swapchain = Swapchain::create(device, kNoSurface, {});
    ASSERT_TRUE(swapchain) << swapchain.error().message;
    for (int i = 0; i < 3; ++i) {
      const auto none = swapchain->acquire({});
      ASSERT_TRUE(none);
      EXPECT_FALSE(*none);
    }
    EXPECT_EQ(behind.swapchains, 0u);
    behind.surface.currentExtent = {320, 200};
    ASSERT_TRUE(frame(*swapchain));
    behind.surface.currentExtent = {320, 0}, behind.acquires = {VK_ERROR_OUT_OF_DATE_KHR};
    const auto none = swapchain->acquire({});
    ASSERT_TRUE(none);
    EXPECT_FALSE(*none);
    behind.surface.currentExtent = {320, 200};
    const auto back = swapchain->acquire({});
    ASSERT_TRUE(back && *back);
    EXPECT_FALSE(back->changed) << "as large as before";
    draw(*back);
    ASSERT_TRUE(swapchain->present(*back));
  }
  expect_clean();
}

TEST_F(SwapchainTest, SurfacesThatLeaveTheirSizeFollowTheWindow) {
  {
    Device device = open();
    behind.surface.currentExtent = {UINT32_MAX, UINT32_MAX};
    behind.surface.maxImageExtent = {500, 500};
    auto swapchain = Swapchain::create(device, kNoSurface, {300, 100});
    ASSERT_TRUE(swapchain);
    const std::pair<VkExtent2D, Size> steps[] = {{{300, 100}, {300, 100}}, {{300, 120}, {300, 120}}, {{900, 120}, {500, 120}},
                                                 {{0, 0}, {0, 0}},         {{300, 0}, {0, 0}},       {{20, 10}, {20, 10}}};
    for (const auto& [size, shown] : steps) {
      const auto picture = swapchain->acquire(size);
      ASSERT_TRUE(picture);
      EXPECT_EQ(size_of(*picture), shown);
      if (!*picture) continue;
      draw(*picture);
      ASSERT_TRUE(swapchain->present(*picture));
    }
    EXPECT_EQ(behind.swapchains, 4u);
  }
  expect_clean();
}

// A frame that fails is not presented; its image and its semaphores come back.
TEST_F(SwapchainTest, APictureThatIsNotPresentedIsGivenBack) {
  {
    Device device = open();
    auto swapchain = Swapchain::create(device, kNoSurface, {});
    ASSERT_TRUE(swapchain);
    for (int i = 0; i < 10; ++i) {
      const auto dropped = swapchain->acquire({});
      ASSERT_TRUE(dropped && *dropped);
      EXPECT_TRUE(dropped->changed) << "until one is shown";
    }
    ASSERT_TRUE(frame(*swapchain));
    const auto next = swapchain->acquire({});
    ASSERT_TRUE(next && *next);
    EXPECT_FALSE(next->changed);
  }
  expect_clean();
}

TEST_F(SwapchainTest, WhatASurfaceCannotShowIsSaid) {
  {
    Device plain = Device::null(nullptr);
    EXPECT_EQ(Swapchain::create(plain, kNoSurface, {}).error().message,
              "this device cannot present: ask for VK_KHR_surface and VK_KHR_swapchain when it is created");
    Device device = open();
    EXPECT_EQ(Swapchain::create(device, kNoSurface, {}, {.format = VK_FORMAT_R8G8B8A8_UNORM}).error().message,
              "the surface does not show format 37; it shows 44, 50");
    behind.supported = VK_FALSE;
    const auto refused = Swapchain::create(device, kNoSurface, {});
    EXPECT_EQ(refused.error().message, "device `null` cannot present to this surface");
    EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  }
  expect_clean();
}

TEST_F(SwapchainTest, OptionsReachTheSurface) {
  {
    Device device = open();
    behind.surface.maxImageCount = 2;
    behind.modes = {VK_PRESENT_MODE_FIFO_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR};
    ASSERT_TRUE(Swapchain::create(device, kNoSurface, {}, {.vsync = false, .concurrent = true}));
    EXPECT_EQ(behind.made.minImageCount, 2u);
    EXPECT_EQ(behind.made.presentMode, VK_PRESENT_MODE_IMMEDIATE_KHR);
    EXPECT_EQ(behind.made.imageSharingMode, VK_SHARING_MODE_CONCURRENT);
    EXPECT_EQ(behind.families, (std::vector<uint32_t>{0, 1}));
    behind.modes.push_back(VK_PRESENT_MODE_MAILBOX_KHR);
    ASSERT_TRUE(Swapchain::create(device, kNoSurface, {}, {.vsync = false}));
    EXPECT_EQ(behind.made.presentMode, VK_PRESENT_MODE_MAILBOX_KHR);
    behind.modes = {VK_PRESENT_MODE_FIFO_KHR};
    ASSERT_TRUE(Swapchain::create(device, kNoSurface, {}, {.vsync = false}));
    EXPECT_EQ(behind.made.presentMode, VK_PRESENT_MODE_FIFO_KHR);
  }
  expect_clean();
}

TEST_F(SwapchainTest, ALostSurfaceIsToldApartFromALostDevice) {
  {
    Device device = open();
    auto swapchain = Swapchain::create(device, kNoSurface, {});
    ASSERT_TRUE(swapchain);
    behind.acquires = {VK_ERROR_SURFACE_LOST_KHR};
    EXPECT_EQ(swapchain->acquire({}).error().code, ErrorCode::out_of_date);
    EXPECT_TRUE(frame(*swapchain)) << "it may be tried again";
    behind.acquires = {VK_ERROR_DEVICE_LOST};
    EXPECT_EQ(swapchain->acquire({}).error().message, "`swapchain`: vkAcquireNextImageKHR failed with VK_ERROR_DEVICE_LOST");
    const uint64_t calls = behind.counters.fallible_calls;
    EXPECT_EQ(swapchain->acquire({}).error().code, ErrorCode::device_lost);
    EXPECT_EQ(swapchain->present({}).error().code, ErrorCode::device_lost);
    EXPECT_EQ(device.wait_idle().error().code, ErrorCode::device_lost);
    EXPECT_EQ(Swapchain::create(device, kNoSurface, {}).error().code, ErrorCode::device_lost);
    EXPECT_EQ(behind.counters.fallible_calls, calls) << "said once";
  }
  expect_clean();
}

// Every call of creation, frames and changes of size fails once: an error each time, the next try succeeds, and nothing is left over.
TEST_F(SwapchainTest, FailuresOfEveryCallAreOverAtTheNextTry) {
  const auto run = [&](uint64_t fail_at) {
    behind = {};
    window = &behind;
    behind.surface.currentExtent = {320, 200}, behind.surface.minImageCount = 2;
    behind.options.fail_at = fail_at;
    int errors = 0;
    const auto count = [&](const auto& result) { errors += result ? 0 : 1; };
    {
      Device device = open();
      auto swapchain = Swapchain::create(device, kNoSurface, {}, {.vsync = false});
      count(swapchain);
      if (!swapchain) swapchain = Swapchain::create(device, kNoSurface, {}, {.vsync = false});
      if (!swapchain) return ADD_FAILURE() << swapchain.error().message, errors;
      for (int i = 0; i < 6; ++i) {
        if (i == 2) behind.surface.currentExtent = {100, 100}, behind.acquires = {VK_ERROR_OUT_OF_DATE_KHR};
        if (i == 4) behind.presents = {VK_SUBOPTIMAL_KHR};
        const Status drawn = frame(*swapchain);
        count(drawn);
        if (!drawn) count(frame(*swapchain));
      }
    }
    expect_clean();
    return errors;
  };
  EXPECT_EQ(run(0), 0);
  const uint64_t calls = behind.counters.fallible_calls - 1;  // without the wait at the end, which has nobody to tell
  ASSERT_GT(calls, 40u);
  for (uint64_t fail_at = 1; fail_at <= calls; ++fail_at) EXPECT_EQ(run(fail_at), 1) << "call " << fail_at;
}

}  // namespace
}  // namespace rg
