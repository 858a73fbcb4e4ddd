#include "examples/demo/frame_data.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>

namespace rg::demo {
namespace {

constexpr float kFrameSeconds = 1.0f / 30;
struct Times {
  float now = 0, before = 0;
};  // seconds, of this frame and of the last one

constexpr float kTau = 2 * std::numbers::pi_v<float>;

rg::vec2 to_rg(glm::vec2 v) { return {v.x, v.y}; }
rg::vec3 to_rg(glm::vec3 v) { return {v.x, v.y, v.z}; }
rg::vec4 to_rg(glm::vec4 v) { return {v.x, v.y, v.z, v.w}; }
rg::mat4 to_rg(const glm::mat4& m) { return {{to_rg(m[0]), to_rg(m[1]), to_rg(m[2]), to_rg(m[3])}}; }
rg::mat3x4 to_rows(const glm::mat4& m) {
  const glm::mat4 t = glm::transpose(m);
  return {{to_rg(t[0]), to_rg(t[1]), to_rg(t[2])}};
}

float swing(const Animation& a, float time) { return a.motion == Motion::swing ? a.amount * std::sin(kTau * (a.rate * time + a.phase)) : 0.0f; }

glm::mat4 moved(const glm::mat4& transform, const Animation& a, float time) {
  if (a.motion == Motion::tumble) return glm::rotate(transform, kTau * a.amount * time, glm::vec3(1, 0, 0));
  return transform;
}

glm::vec3 drifted(glm::vec3 at, const Animation& a, float time) {
  if (a.motion != Motion::drift) return at;
  const float turn = kTau * (a.rate * time + a.phase);
  return at + a.amount * glm::vec3(std::sin(turn), 0.5f * std::sin(1.7f * turn), std::cos(0.8f * turn));
}

frame::Light make_light(const Light& from, const glm::mat4& to_view, float time) {
  frame::Light to;
  const glm::vec3 at = drifted(from.position, from.animation, time);
  const float depth = (to_view * glm::vec4(at, 1)).z, margin = 1e-3f + 1e-3f * from.range;
  to.position = to_rg(at);
  to.range = from.range;
  to.color = to_rg(from.color);
  to.kind = from.is_spot ? frame::LIGHT_SPOT : frame::LIGHT_OMNI;
  to.direction = to_rg(from.direction);
  to.cos_outer = std::cos(from.outer);
  to.sin_outer = std::sin(from.outer);
  to.cone_scale = 1 / std::max(std::cos(from.inner) - std::cos(from.outer), 1e-4f);
  to.nearest = depth - from.range - margin;
  to.farthest = depth + from.range + margin;
  return to;
}

std::vector<frame::Light> make_lights(const Scene& scene, const glm::mat4& to_view, float time) {
  std::vector<frame::Light> lights;
  for (const Light& light : scene.lights) lights.push_back(make_light(light, to_view, time));
  std::stable_sort(lights.begin(), lights.end(), [](const frame::Light& a, const frame::Light& b) { return a.nearest < b.nearest; });
  if (lights.size() > static_cast<size_t>(frame::MAX_LIGHTS)) lights.resize(static_cast<size_t>(frame::MAX_LIGHTS));
  return lights;
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
  view.noise = settings.noise ? 1 : 0;
  return view;
}

constexpr std::string_view kViews[] = {"final",    "lights",   "albedo",   "normal", "depth",     "roughness", "metallic", "diffuse",
                                       "specular", "emissive", "overflow", "zbin",   "occlusion", "velocity",  "forward"};
static_assert(std::size(kViews) == frame::DEBUG_COUNT);

}  // namespace

FrameData make_frame(const Scene& scene, const NamedCamera& camera, const FrameSettings& settings) {
  const float time = settings.animate ? kFrameSeconds * static_cast<float>(settings.number) : 0.0f;
  const Times times{time, settings.animate ? time - kFrameSeconds : time};
  FrameData data;
  data.view = make_view(scene, camera, settings, time);
  data.lights = make_lights(scene, world_to_view(camera), time);
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
  return data;
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
