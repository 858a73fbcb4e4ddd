// What one frame of a scene hands to the graph: a function of scene, camera and frame number. No Vulkan in here.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "examples/demo/camera.h"
#include "examples/demo/scene.h"
#include "frame.h"

namespace rg::demo {

struct FrameSettings {
  uint32_t width = 640, height = 360;
  uint32_t number = 0;  // of the frame
  uint32_t debug_view = frame::DEBUG_FINAL;
  uint32_t light_path = frame::LIGHT_PATH_RECORDS;
  uint32_t forced_features = 0;                                // lamp::, shaded for in every tile
  bool fog_sun = true, fog_lights = true, fog_ambient = true;  // light that fog scatters, where there is any
  bool jitter = true;                                          // moves the camera within the pixel
  bool noise = true;                                           // other variations of each frame; without, fog has no history
  bool animate = true;                                         // else the scene stands still at time 0
};

struct PropPlacement {
  uint32_t mesh = 0;  // of Scene::prop_meshes
  frame::PropDraw draw;
};
struct FrameData {
  frame::View view;
  frame::Fog fog;
  frame::LampViews lamps;                  // of the shadow maps
  std::vector<frame::Light> lights;        // sorted by nearest
  std::vector<frame::Instance> instances;  // in the scene's order
  std::vector<PropPlacement> props;
  std::vector<uint32_t> glass;  // instances, farthest first
  frame::HologramDraw hologram;
  frame::Features features;
};

// Froxels of a picture of that size.
glm::uvec3 froxels_of(uint32_t width, uint32_t height);

FrameData make_frame(const Scene& scene, const NamedCamera& camera, const FrameSettings& settings);
std::vector<frame::Material> make_materials(const Scene& scene);
std::vector<frame::FogVolume> make_fog_volumes(const Scene& scene);

// Metres that the z-bins cover; what lies farther falls into the last one.
constexpr float kZbinRange = 96;

// Index of a debug view by its name, "final" or "lights"; -1 if there is none. Names are in the order of the DEBUG_ constants.
int find_view(std::string_view name);
std::vector<std::string_view> view_names();

}  // namespace rg::demo
