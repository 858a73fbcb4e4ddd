#include "examples/demo/renderer.h"

#include <optional>

#include "examples/demo/hologram.h"
#include "examples/demo/upload.h"

namespace rg::demo {
namespace {

// The graph waits for the frame frames_in_flight ago inside execute(), so that one more slot is free before it.
constexpr uint32_t kMaxSlots = 5;

// What the host rewrites each frame.
struct Slot {
  GpuBuffer lights, instances;
};

// What the lamps' shadow maps were last drawn from.
struct ShadowState {
  frame::LampViews lamps;
  std::vector<frame::Instance> instances;
  bool is_drawn = false;

  // True if they have to be drawn anew.
  bool update(const FrameData& data) {
    const auto same = [](const auto* a, const auto* b, size_t bytes) { return bytes == 0 || std::memcmp(a, b, bytes) == 0; };
    const bool moved = !is_drawn || !same(&lamps, &data.lamps, sizeof lamps) || instances.size() != data.instances.size() ||
                       !same(instances.data(), data.instances.data(), instances.size() * sizeof(frame::Instance));
    lamps = data.lamps;
    instances = data.instances;
    is_drawn = true;
    return moved;
  }
};

struct Recorder {
  const Scene& scene;
  const GpuScene& gpu;
  const FrameData& data;
  VkPipeline hologram_pipeline;

  template <class Pass>
  void draw_props(Pass& pass) {
    if (data.props.empty()) return;
    pass.bind_vertices(0, gpu.props.buffer.get());
    pass.bind_indices(gpu.prop_indices.buffer.get());
    for (const PropPlacement& prop : data.props) {
      const Mesh& mesh = scene.prop_meshes[prop.mesh];
      pass.push(prop.draw);
      pass.draw_indexed(mesh.index_count, 1, mesh.first_index);
    }
  }
  void sun_shadow_props(frame::SunShadowPropsPass& pass) { draw_props(pass); }
  void depth_props(frame::DepthPropsPass& pass) { draw_props(pass); }
  void gbuffer_props(frame::GbufferPropsPass& pass) { draw_props(pass); }
  void transparent(frame::TransparentPass& pass) {
    for (const uint32_t index : data.glass) {
      const frame::Instance& instance = data.instances[index];
      frame::GlassDraw draw;
      draw.instance = index;
      pass.push(draw);
      pass.draw(instance.index_count, 1, instance.first_index);
    }
  }
  void hologram(frame::HologramPass& pass) {
    pass.bind_pipeline(hologram_pipeline);
    pass.push(data.hologram);
    pass.draw(kHologramVertices);
  }
};

template <class T>
void write(GpuBuffer& buffer, const std::vector<T>& values) {
  const size_t bytes = std::min<size_t>(values.size() * sizeof(T), buffer.size);
  if (bytes > 0) std::memcpy(buffer.mapped, values.data(), bytes);
}

}  // namespace

struct Renderer::State {
  Device* device = nullptr;
  const Scene* scene = nullptr;
  RendererOptions options;
  GpuScene gpu;
  std::vector<Slot> slots;
  GpuImage backbuffer;
  GpuBuffer readback;
  std::optional<frame::Frame> graph;
  UniquePipeline hologram_pipeline;
  uint64_t frames = 0;
  ShadowState shadows;
};

namespace {

Result<Slot> make_slot(Device& device) {
  constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  auto lights = make_buffer(device, static_cast<size_t>(frame::MAX_LIGHTS) * sizeof(frame::Light), usage, true);
  if (!lights) return lights.error();
  auto instances = make_buffer(device, static_cast<size_t>(frame::MAX_INSTANCES) * sizeof(frame::Instance), usage, true);
  if (!instances) return instances.error();
  return Slot{std::move(*lights), std::move(*instances)};
}

struct Target {
  GpuImage backbuffer;
  GpuBuffer readback;
};
Result<Target> make_target(Device& device, uint32_t width, uint32_t height) {
  auto image =
      make_image(device, {VK_FORMAT_R8G8B8A8_UNORM, width, height, 1, 1, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  if (!image) return image.error();
  auto buffer = make_buffer(device, VkDeviceSize{width} * height * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT, true);
  if (!buffer) return buffer.error();
  return Target{std::move(*image), std::move(*buffer)};
}

frame::Extents extents_of(uint32_t width, uint32_t height) {
  frame::Extents extents;
  extents.view = {width, height};
  const glm::uvec3 froxels = froxels_of(width, height);
  extents.froxels = {froxels.x, froxels.y, froxels.z};
  return extents;
}

GraphOptions graph_options(const RendererOptions& options) {
  GraphOptions graph;
  graph.frames_in_flight = options.frames_in_flight;
  graph.aliasing = options.aliasing;
  graph.poison = options.poison;
  graph.debug_readback = options.debug_readback;
  graph.submit_per_pass = options.submit_per_pass;
  graph.serial = options.serial;
  graph.threads = options.threads;
  return graph;
}

ImportedBuffer import(const GpuBuffer& buffer) { return {buffer.buffer.get(), 0, VK_WHOLE_SIZE}; }
ImportedImage import(const GpuImage& image) { return {image.image.get(), image.view.get()}; }

void copy_to_host(const DeviceFunctions& vk, VkCommandBuffer commands, VkImage image, VkBuffer buffer, uint32_t width, uint32_t height) {
  // The graph leaves the image as a copy source, visible to copies.
  const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {0, 0, 0}, {width, height, 1}};
  vk.CmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &region);
  auto barrier = vulkan_struct<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  auto info = vulkan_struct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  vk.CmdPipelineBarrier2(commands, &info);
}

}  // namespace

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() {
  if (state_ && state_->device != nullptr) state_->device->vk().DeviceWaitIdle(state_->device->handle());
}

Result<Renderer> Renderer::create(Device& device, const Scene& scene, const RendererOptions& options) {
  auto state = std::make_unique<State>();
  state->device = &device;
  state->scene = &scene;
  state->options = options;
  auto gpu = upload(device, scene);
  if (!gpu) return gpu.error();
  state->gpu = std::move(*gpu);
  for (uint32_t i = 0; i < std::min(options.frames_in_flight + 1, kMaxSlots); ++i) {
    auto slot = make_slot(device);
    if (!slot) return slot.error();
    state->slots.push_back(std::move(*slot));
  }
  auto target = make_target(device, options.width, options.height);
  if (!target) return target.error();
  state->backbuffer = std::move(target->backbuffer);
  state->readback = std::move(target->readback);
  auto graph = frame::Frame::create(device, extents_of(options.width, options.height), graph_options(options));
  if (!graph) return graph.error();
  state->graph.emplace(std::move(*graph));
  auto pipeline = make_hologram_pipeline(device, state->graph->pass_info(frame::pass::hologram));
  if (!pipeline) return pipeline.error();
  state->hologram_pipeline = std::move(*pipeline);
  return Renderer(std::move(state));
}

Status Renderer::resize(uint32_t width, uint32_t height) {
  State& s = *state_;
  auto target = make_target(*s.device, width, height);
  if (!target) return target.error();
  if (Status idle = s.graph->wait_idle(); !idle) return idle;  // the old backbuffer is still drawn into
  if (Status resized = s.graph->resize(extents_of(width, height)); !resized) return resized;
  auto pipeline = make_hologram_pipeline(*s.device, s.graph->pass_info(frame::pass::hologram));
  if (!pipeline) return pipeline.error();
  s.hologram_pipeline = std::move(*pipeline);
  s.backbuffer = std::move(target->backbuffer);
  s.readback = std::move(target->readback);
  s.options.width = width;
  s.options.height = height;
  s.shadows.is_drawn = false;
  return Done{};
}

Status Renderer::reload(const PlanFile& file) {
  State& s = *state_;
  if (Status idle = s.graph->wait_idle(); !idle) return idle;  // frames before use the old pipeline
  if (Status reloaded = s.graph->reload(file); !reloaded) return reloaded;
  auto pipeline = make_hologram_pipeline(*s.device, s.graph->pass_info(frame::pass::hologram));
  if (!pipeline) return pipeline.error();
  s.hologram_pipeline = std::move(*pipeline);
  s.shadows.is_drawn = false;
  return Done{};
}

Status Renderer::render(const FrameData& data) {
  State& s = *state_;
  Slot& slot = s.slots[s.frames++ % s.slots.size()];
  write(slot.lights, data.lights);
  write(slot.instances, data.instances);
  const frame::Imports imports{
      .scene_lights = import(slot.lights),
      .scene_fog_volumes = import(s.gpu.fog_volumes),
      .scene_instances = import(slot.instances),
      .scene_materials = import(s.gpu.materials),
      .scene_vertices = import(s.gpu.vertices),
      .scene_indices = import(s.gpu.indices),
      .scene_props = import(s.gpu.props),
      .scene_prop_indices = import(s.gpu.prop_indices),
      .scene_albedo_maps = import(s.gpu.albedo_maps),
      .scene_surface_maps = import(s.gpu.surface_maps),
      .backbuffer = import(s.backbuffer),
  };
  frame::Params params;
  params.camera = data.view;
  params.fog = data.fog;
  params.lamps = data.lamps;
  frame::Conditions conditions;
  conditions.lamps_moved = s.shadows.update(data);
  Recorder recorder{*s.scene, s.gpu, data, s.hologram_pipeline.get()};
  return s.graph->execute(imports, params, conditions, data.features, recorder);
}

Result<Picture> Renderer::picture() {
  State& s = *state_;
  if (Status idle = s.graph->wait_idle(); !idle) return idle.error();
  const Status copied = submit_once(*s.device, [&](VkCommandBuffer commands) {
    copy_to_host(s.device->vk(), commands, s.backbuffer.image.get(), s.readback.buffer.get(), s.options.width, s.options.height);
  });
  if (!copied) return copied.error();
  Picture picture{s.options.width, s.options.height, std::vector<uint8_t>(s.readback.size)};
  std::memcpy(picture.texels.data(), s.readback.mapped, s.readback.size);
  return picture;
}

frame::Frame& Renderer::graph() { return *state_->graph; }

}  // namespace rg::demo
