// A graph inside an engine: the engine's device, allocator, pipeline cache, image and buffer. Some frames the runtime submits, waiting for and
// signalling the engine's timeline; some are recorded into the engine's own command buffers, with its own commands in between.
#include <cstdio>
#include <cstring>

#include "arena.h"
#include "engine.h"

namespace {

constexpr uint32_t kWidth = 128, kHeight = 64;
constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;

int complain(const std::string& text) {
  std::fprintf(stderr, "engine: %s\n", text.c_str());
  return 1;
}

rg::Result<rg::Device> adopt(Engine& engine) {
  rg::ExternalDevice external;
  external.instance = engine.instance, external.physical_device = engine.physical, external.device = engine.device;
  external.queue = engine.queue, external.queue_family = engine.family, external.queue_mutex = &engine.queue_mutex;
  external.get_instance_proc_addr = vkGetInstanceProcAddr;
  external.allocator = &engine.allocator;
  external.pipeline_cache = engine.cache;
  return rg::Device::adopt(external);
}

// The graph leaves the picture as a source of copies.
void copy_picture(VkCommandBuffer commands, const Image& picture, const Buffer& pixels) {
  const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {0, 0, 0}, {kWidth, kHeight, 1}};
  vkCmdCopyImageToBuffer(commands, picture.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels.handle, 1, &region);
}

struct World {
  Engine& engine;
  Buffer lights, pixels;
  Image picture;
  arena::Imports imports() const {
    return {.world_lights = rg::ImportedBuffer{lights.handle}, .picture = rg::ImportedImage{picture.handle, picture.view}};
  }
};

// The runtime submits; the copy is the engine's own submit before and after.
rg::Status submitted_frame(World& world, arena::Frame& frame) {
  Engine& engine = world.engine;
  const rg::SemaphoreUse before[] = {{engine.timeline, engine.submitted, kAll}}, after[] = {{engine.timeline, ++engine.submitted, kAll}};
  if (const rg::Status used = frame.instance().use_semaphores(before, after); !used) return used;
  return frame.execute(world.imports());
}

// The engine submits: the first pass, a command of its own, the rest.
rg::Status recorded_frame(World& world, arena::Frame& frame) {
  Engine& engine = world.engine;
  const VkCommandBuffer first = engine.begin(), second = engine.begin();
  const rg::OwnCommands parts[] = {{first, arena::pass::gather}, {second, rg::kNone}};
  if (const rg::Status used = frame.instance().use_commands(parts, {engine.timeline, engine.submitted + 1}); !used) return used;
  if (const rg::Status done = frame.execute(world.imports()); !done) return done;
  copy_picture(second, world.picture, world.pixels);
  engine.submit({first, second});
  return rg::Done{};
}

int run() {
  Engine engine;
  if (!engine.error().empty()) return complain(engine.error());
  World world{engine, engine.make_buffer(2 * sizeof(arena::Light), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
              engine.make_buffer(kWidth * kHeight * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT),
              engine.make_image(kWidth, kHeight, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT)};
  const arena::Light lights[] = {{{0.3f, 0.5f}, 0.2f, 0.6f}, {{0.7f, 0.5f}, 0.3f, 0.9f}};
  std::memcpy(world.lights.mapped, lights, sizeof lights);
  uint32_t middle = 0;
  {
    auto device = adopt(engine);
    if (!device) return complain(device.error().message);
    auto frame = arena::Frame::create(*device, {.view = {kWidth, kHeight}});
    if (!frame) return complain(frame.error().message);
    for (int i = 0; i < 8; ++i)
      if (const rg::Status done = i % 2 == 0 ? submitted_frame(world, *frame) : recorded_frame(world, *frame); !done)
        return complain(done.error().message);
    engine.wait(engine.submitted);
    std::memcpy(&middle, static_cast<const std::byte*>(world.pixels.mapped) + (kHeight / 2 * kWidth + kWidth * 7 / 10) * 4, sizeof middle);
  }
  engine.destroy(world.lights), engine.destroy(world.pixels), engine.destroy(world.picture);
  // Eight frames of history: 1 - 2^-8 of the light's strength is there.
  const uint32_t red = middle & 0xff;
  std::printf("the second light shows as %u of 255; %lld host blocks came from the engine\n", red, static_cast<long long>(engine.blocks.total));
  return red > 215 && red < 232 ? 0 : complain("the picture is wrong");
}

}  // namespace

int main() { return run(); }
