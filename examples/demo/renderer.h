// A scene, the generated frame and a picture to draw into.
#pragma once

#include <memory>
#include <vector>

#include "examples/demo/frame_data.h"
#include "examples/demo/scene.h"
#include "frame.h"

namespace rg::demo {

struct RendererOptions {
  uint32_t width = 640, height = 360;
  uint32_t frames_in_flight = 2;
  bool aliasing = true;
  bool poison = false;
  bool debug_readback = false;
  bool submit_per_pass = false;
  bool serial = false;
  uint32_t threads = 1;
};

// rgba8, rows from the top.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> texels;
};

class Renderer {
 public:
  // `device` and `scene` must outlive the renderer.
  static Result<Renderer> create(Device& device, const Scene& scene, const RendererOptions& options);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  Status resize(uint32_t width, uint32_t height);
  // The plan of the next frame. On failure the old one goes on, but for a pipeline that cannot be made for the new one: then nothing can be drawn.
  Status reload(const PlanFile& file);
  // `data` must have been made for the current size.
  Status render(const FrameData& data);
  // Of the last frame; waits for it.
  Result<Picture> picture();
  frame::Frame& graph();

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace rg::demo
