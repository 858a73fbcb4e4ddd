// A frame in a window, resized at will: window [--frames N] [--screenshot FILE.ppm]
// With --frames it changes its own size on the way, and once to nothing but a line, so that a test sees what a user does.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#define VK_USE_PLATFORM_XCB_KHR
#include <vulkan/vulkan.h>

#include "runtime/swapchain.h"
#include "waves.h"
#include "xcb_window.h"

namespace {

int complain(const char* what, const rg::Error& error) {
  std::fprintf(stderr, "window: %s: %s\n", what, error.message.c_str());
  return 1;
}

struct Options {
  int frames = 0;  // 0: until the window is closed
  const char* screenshot = nullptr;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--frames") == 0) options.frames = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--screenshot") == 0) options.screenshot = argv[i + 1];
  }
  return options;
}

struct Surface {  // lives as long as the device's instance
  VkInstance instance = VK_NULL_HANDLE;
  VkSurfaceKHR handle = VK_NULL_HANDLE;
  PFN_vkDestroySurfaceKHR destroy = nullptr;
  ~Surface() {
    if (handle != VK_NULL_HANDLE) destroy(instance, handle, nullptr);
  }
};

bool make_surface(rg::Device& device, const XcbWindow& window, Surface& surface) {
  const auto create = reinterpret_cast<PFN_vkCreateXcbSurfaceKHR>(device.instance_function("vkCreateXcbSurfaceKHR"));
  surface.destroy = reinterpret_cast<PFN_vkDestroySurfaceKHR>(device.instance_function("vkDestroySurfaceKHR"));
  surface.instance = device.instance();
  const VkXcbSurfaceCreateInfoKHR info{VK_STRUCTURE_TYPE_XCB_SURFACE_CREATE_INFO_KHR, nullptr, 0, window.connection(), window.window()};
  return create != nullptr && create(surface.instance, &info, nullptr, &surface.handle) == VK_SUCCESS;
}

// Grows, shrinks, becomes a line, recovers.
void change_size(XcbWindow& window, int frame) {
  if (frame == 10) window.resize(400, 240);
  if (frame == 20) window.resize(200, 1);
  if (frame == 30) window.resize(320, 200);
}

rg::Status draw(waves::Frame& frame, rg::Swapchain& swapchain, const XcbWindow& window, float seconds) {
  const VkExtent2D size{window.width(), window.height()};
  auto picture = swapchain.acquire(size, rg::Index{0});
  if (!picture) return picture.error();
  if (!*picture) return rg::Done{};  // minimised: nothing to draw into
  if (picture->changed)
    if (const rg::Status resized = frame.resize({.view = {picture->extent.width, picture->extent.height}}); !resized) return resized;
  if (const rg::Status used = frame.instance().use_semaphores(picture->acquired, picture->drawn); !used) return used;
  waves::Params params;
  params.clock = {.seconds = seconds, .aspect = static_cast<float>(picture->extent.width) / static_cast<float>(picture->extent.height)};
  if (const rg::Status done = frame.execute({.window = picture->image}, params); !done) return done;
  return swapchain.present(*picture);
}

int run(const Options& options) {
  XcbWindow window(320, 200, "rgc: waves");
  if (!window.open()) return std::fprintf(stderr, "window: no display; start an X server or set DISPLAY\n"), 1;
  rg::DeviceOptions wanted;
  wanted.instance_extensions = {VK_KHR_SURFACE_EXTENSION_NAME, VK_KHR_XCB_SURFACE_EXTENSION_NAME};
  wanted.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  auto device = rg::Device::create(wanted);
  if (!device) return complain("device", device.error());
  Surface surface;
  if (!make_surface(*device, window, surface)) return std::fprintf(stderr, "window: no surface for the window\n"), 1;
  auto swapchain = rg::Swapchain::create(*device, surface.handle, {window.width(), window.height()}, {.format = VK_FORMAT_B8G8R8A8_UNORM});
  if (!swapchain) return complain("swapchain", swapchain.error());
  auto frame = waves::Frame::create(*device, {.view = {window.width(), window.height()}});
  if (!frame) return complain("frame", frame.error());

  for (int i = 0; window.open() && (options.frames == 0 || i < options.frames); ++i) {
    if (options.frames != 0) change_size(window, i);
    window.poll();
    if (const rg::Status drawn = draw(*frame, *swapchain, window, static_cast<float>(i) / 60); !drawn) return complain("frame", drawn.error());
  }
  if (const rg::Status idle = device->wait_idle(); !idle) return complain("device", idle.error());
  if (options.screenshot != nullptr && !window.write_screenshot(options.screenshot)) return std::fprintf(stderr, "window: no screenshot\n"), 1;
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return run(parse(argc, argv)); }
