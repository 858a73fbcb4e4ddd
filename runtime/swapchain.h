// Presents frames to a surface. The surface is the engine's, as is the window behind it; the images are handed to a graph as imports.
//
//   acquire(window size) -> Picture ──> Imports, GraphInstance::use_semaphores ──> execute ──> present(picture)
//
// Threading: one thread a swapchain at a time. Cost: acquire and present make one Vulkan call each and allocate nothing, unless the window has
// changed.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <memory>

#include "runtime/device.h"
#include "runtime/graph.h"
#include "runtime/result.h"

namespace rg {

// What the images of a swapchain shall be.
struct SwapchainOptions {
  VkFormat format = VK_FORMAT_B8G8R8A8_UNORM;  // must be that of the graph's surface; an error where the surface cannot show it
  VkColorSpaceKHR color_space = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
  VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;  // what the plan's surface wants: Plan::resources[...].usage
  bool vsync = true;                                              // false: mailbox or immediate where the surface has them
  uint32_t min_images = 3;
  bool concurrent = false;  // the plan's surface is used on several queues (Resource::concurrent)
};

// An image to draw into, or none: a minimised or zero-sized window shows nothing, and the frame may be left out.
struct Picture {
  ImportedImage image = {};  // null: nothing to draw
  VkExtent2D extent = {0, 0};
  bool changed = false;  // another size than the last one that was presented: resize what depends on it first
  uint32_t index = 0;
  // For GraphInstance::use_semaphores: the image may be written after `acquired`, and is presented after `drawn`. The slot is the surface's import
  // slot.
  std::array<SemaphoreUse, 1> acquired = {}, drawn = {};
  // Whether there is something to draw into.
  explicit operator bool() const { return image.image != VK_NULL_HANDLE; }
};

// The images of one surface, made anew as the window changes; see the top of this file.
class Swapchain {
 public:
  // The device was created with VK_KHR_swapchain (and its instance with the surface extensions); `surface` outlives the swapchain and belongs to the
  // same instance. Errors: `unsupported` where the device cannot present to the surface or not in that format.
  static Result<Swapchain> create(Device& device, VkSurfaceKHR surface, VkExtent2D window, const SwapchainOptions& options = {});
  Swapchain(Swapchain&&) noexcept;  // leaves an object that can only be destroyed or assigned to
  Swapchain& operator=(Swapchain&&) noexcept;
  ~Swapchain();  // waits for the device

  // `window`: its size in pixels now, for surfaces that leave the choice to the program. Makes the images anew where the size changed, the surface
  // went out of date, or the last picture was not presented because its frame failed (this waits for the device, on all queues). One picture at a
  // time. A surface that is lost: `out_of_date`; make another.
  Result<Picture> acquire(VkExtent2D window, Index import_slot = kNone);
  // The last picture, after a frame that signals `drawn`. An out-of-date surface is no error: the next acquire makes the images anew.
  Status present(const Picture& picture);

  VkFormat format() const;  // of all pictures

  struct State;  // in swapchain.cpp

 private:
  explicit Swapchain(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace rg
