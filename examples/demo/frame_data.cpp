#include "examples/demo/frame_data.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>

#include "examples/demo/lamps.h"

namespace rg::demo {
namespace {

constexpr float kFrameSeconds = 1.0f / 30;
struct Times {
  float now = 0, before = 0;
};  // seconds, of this frame and of the last one

constexpr float kTau = 2 * std::numbers::pi_v<float>;

float swing(const Animation& a, float time) { return a.motion == Motion::swing ? a.amount * std::sin(kTau * (a.rate * time + a.phase)) : 0.0f; }

glm::mat4 moved(const glm::mat4& transform, const Animation& a, float time) {
  if (a.motion == Motion::tumble) return glm::rotate(transform, kTau * a.amount * time, glm::vec3(1, 0, 0));
  return transform;
}

float stretch(const glm::mat4& m) { return std::sqrt(std::max({glm::dot(m[0], m[0]), glm::dot(m[1], m[1]), glm::dot(m[2], m[2])})); }

frame::Instance make_instance(const Scene& scene, const Instance& from, Times times) {
  const Mesh& mesh = scene.meshes[from.mesh];
  const glm::mat4 now = moved(from.transform, from.animation, times.now), before = moved(from.transform, from.animation, times.before);
  frame::Instance to;
  to.model = to_rows(now);
  to.previous = to_rows(before);
  to.center = to_rg(glm::vec3(now * glm::vec4(mesh.center, 1)));
  to.radius = mesh.radius * stretch(now);
  to.first_index = mesh.first_index;
  to.index_count = mesh.index_count;
  to.material = from.material;
  to.flags = (from.casts_shadow ? frame::INSTANCE_SHADOW : 0) | (from.glass ? frame::INSTANCE_GLASS : 0);
  return to;
}

PropPlacement place(const Prop& prop, Times times) {
  PropPlacement to{prop.mesh, {}};
  to.draw.model = to_rows(moved(prop.transform, prop.animation, times.now));
  to.draw.previous = to_rows(moved(prop.transform, prop.animation, times.before));
  to.draw.tint = to_rg(prop.tint);
  to.draw.swing = swing(prop.animation, times.now);
  to.draw.swing_before = swing(prop.animation, times.before);
  to.draw.sky = prop.sky;
  return to;
}

std::vector<uint32_t> sort_glass(const Scene& scene, const std::vector<frame::Instance>& instances, glm::vec3 eye) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < instances.size(); ++i)
    if (scene.instances[i].glass) order.push_back(i);
  const auto distance = [&](uint32_t i) {
    return glm::distance(eye, glm::vec3(instances[i].center.x, instances[i].center.y, instances[i].center.z));
  };
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return distance(a) > distance(b); });
  return order;
}

frame::View make_view(const Scene& scene, const NamedCamera& camera, const FrameSettings& settings, float time) {
  const glm::vec2 size(settings.width, settings.height);
  Projection projection = project(camera, size);
  const glm::mat4 to_view = world_to_view(camera), steady = view_to_clip(projection) * to_view;
  if (settings.jitter) projection.jitter = jitter_of(settings.number, size);
  const glm::mat4 to_clip = view_to_clip(projection) * to_view;
  frame::View view;
  view.world_to_view = to_rg(to_view);
  view.world_to_clip = to_rg(to_clip);
  // In double: depth spans many orders of magnitude.
  view.clip_to_world = to_rg(glm::mat4(glm::inverse(glm::dmat4(to_clip))));
  view.steady_to_clip = view.previous_to_clip = to_rg(steady);
  view.world_to_sun = to_rg(world_to_sun(scene.sun));
  view.position = to_rg(camera.eye);
  view.near = projection.near;
  view.sun_direction = to_rg(scene.sun.direction);
  view.time = time;
  view.sun_color = to_rg(scene.sun.color);
  view.sun_texel = 2 * scene.sun.radius / static_cast<float>(frame::SUN_SHADOW_SIZE);
  view.ambient = to_rg(scene.sun.ambient);
  view.exposure_bias = camera.exposure_bias;
  view.scale = to_rg(projection.scale);
  view.jitter = to_rg(projection.jitter);
  view.size = to_rg(size);
  view.inverse_size = to_rg(1.0f / size);
  view.zbin_scale = static_cast<float>(frame::ZBINS) / kZbinRange;
  view.sun_ndc = 1 / scene.sun.radius;
  view.frame = settings.number;
  view.debug_view = settings.debug_view;
  view.light_path = settings.light_path;
  view.forced_features = settings.forced_features;
  view.noise = settings.noise ? 1 : 0;
  return view;
}

// Places within a froxel, another one each frame: the sequence of golden ratios of three dimensions (Roberts 2018).
glm::vec3 froxel_jitter(uint32_t number) {
  return glm::fract(static_cast<float>(number % 64 + 1) * glm::vec3(0.819173f, 0.671044f, 0.549700f)) - 0.5f;
}

// Near cascades are thin, far ones thick.
glm::vec4 cascade_ends(float reach) { return reach * glm::vec4(0.10f, 0.27f, 0.55f, 1); }

frame::Fog make_fog(const Scene& scene, const NamedCamera& camera, const FrameSettings& settings) {
  frame::Fog fog;
  fog.start = fog.previous_start = 0.2f;
  fog.ends = fog.previous_ends = to_rg(cascade_ends(camera.fog_reach));
  fog.density = scene.fog.density;
  fog.ground = scene.fog.ground;
  fog.thinning = scene.fog.thinning;
  fog.phase = scene.fog.phase;
  fog.albedo = to_rg(scene.fog.albedo);
  fog.blend = settings.noise && settings.number > 0 ? 0.08f : 1.0f;
  fog.volume_count = static_cast<uint32_t>(std::min<size_t>(scene.fog.boxes.size(), frame::MAX_FOG_VOLUMES));
  fog.jitter = to_rg(settings.noise ? froxel_jitter(settings.number) : glm::vec3(0));
  fog.count = to_rg(glm::vec3(froxels_of(settings.width, settings.height)));
  return fog;
}

constexpr std::string_view kViews[] = {"final",   "lights",   "albedo",   "normal",   "depth",  "roughness", "metallic",
                                       "diffuse", "specular", "emissive", "overflow", "zbin",   "occlusion", "velocity",
                                       "forward", "fog",      "through",  "features", "kernels"};
static_assert(std::size(kViews) == frame::DEBUG_COUNT);

}  // namespace

bool shines(const rg::vec3& color) { return color.x > 0 || color.y > 0 || color.z > 0; }

// What is dark has no kernel that asks for it.
frame::Features make_features(const Scene& scene, const FrameData& data, const FrameSettings& settings) {
  frame::Features features;
  features.holograms = scene.has_hologram;
  features.fog_sun = settings.fog_sun && shines(data.view.sun_color);
  features.fog_lights = settings.fog_lights && !data.lights.empty();
  features.fog_ambient = settings.fog_ambient && shines(data.view.ambient);
  return features;
}

FrameData make_frame(const Scene& scene, const NamedCamera& camera, const FrameSettings& settings) {
  const float time = settings.animate ? kFrameSeconds * static_cast<float>(settings.number) : 0.0f;
  const Times times{time, settings.animate ? time - kFrameSeconds : time};
  FrameData data;
  data.view = make_view(scene, camera, settings, time);
  data.lights = make_lights(scene, world_to_view(camera), time);
  data.lamps = make_lamp_views(scene);
  data.fog = make_fog(scene, camera, settings);
  data.view.light_count = static_cast<uint32_t>(data.lights.size());
  for (const Instance& instance : scene.instances) data.instances.push_back(make_instance(scene, instance, times));
  data.view.instance_count = static_cast<uint32_t>(data.instances.size());
  for (const Prop& prop : scene.props) data.props.push_back(place(prop, times));
  data.glass = sort_glass(scene, data.instances, camera.eye);
  const glm::mat4 at = glm::rotate(glm::translate(glm::mat4(1), scene.hologram_center), 0.6f * time, glm::vec3(0.2f, 1, 0.1f));
  Projection projection = project(camera, {settings.width, settings.height});
  if (settings.jitter) projection.jitter = jitter_of(settings.number, {settings.width, settings.height});
  data.hologram.model_to_clip = to_rg(view_to_clip(projection) * world_to_view(camera) * at);
  data.hologram.color = {0.10f, 0.85f, 0.75f, 1};
  data.features = make_features(scene, data, settings);
  return data;
}

glm::uvec3 froxels_of(uint32_t width, uint32_t height) {
  const auto cells = [](uint32_t pixels, uint32_t most) { return std::clamp((pixels + 9) / 10, 8u, most); };
  return {cells(width, 160), cells(height, 96), 64};
}

std::vector<frame::FogVolume> make_fog_volumes(const Scene& scene) {
  std::vector<frame::FogVolume> volumes;
  for (const FogBox& from : scene.fog.boxes) {
    frame::FogVolume to;
    to.to_box = to_rows(glm::inverse(from.transform));
    to.density = from.density;
    to.edge = from.edge;
    to.layer = from.layer;
    to.repeats = from.repeats;
    to.scroll = to_rg(from.scroll);
    volumes.push_back(to);
  }
  return volumes;
}

std::vector<frame::Material> make_materials(const Scene& scene) {
  std::vector<frame::Material> materials;
  for (const Material& from : scene.materials) {
    frame::Material to;
    to.base_color = to_rg(from.base_color);
    to.emissive = to_rg(from.emissive);
    to.roughness = from.roughness;
    to.metallic = from.metallic;
    to.bump = from.bump;
    to.albedo_layer = from.albedo_layer;
    to.surface_layer = from.surface_layer;
    materials.push_back(to);
  }
  return materials;
}

int find_view(std::string_view name) {
  const auto found = std::find(std::begin(kViews), std::end(kViews), name);
  return found == std::end(kViews) ? -1 : static_cast<int>(found - std::begin(kViews));
}
std::vector<std::string_view> view_names() { return {std::begin(kViews), std::end(kViews)}; }

}  // namespace rg::demo
