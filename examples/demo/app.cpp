#include "examples/demo/app.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "examples/demo/gltf.h"
#include "examples/demo/inspect.h"
#include "examples/demo/options.h"
#include "examples/demo/plaza.h"
#include "examples/demo/png.h"
#include "examples/demo/renderer.h"
#include "examples/demo/report.h"
#include "examples/demo/spectrum.h"
#include "examples/demo/watch.h"

namespace rg::demo {
namespace {

int complain(const std::string& message) {
  std::fprintf(stderr, "error: %s\n", message.c_str());
  return 1;
}

int print_devices() {
  const std::vector<DeviceDescription> devices = list_devices();
  if (devices.empty()) return complain("no Vulkan device was found; install a driver, for example mesa-vulkan-drivers");
  for (size_t i = 0; i < devices.size(); ++i)
    std::printf("%zu  %s%s%s\n", i, devices[i].name.c_str(), devices[i].usable ? "" : "  not usable: ", devices[i].reason.c_str());
  return 0;
}

Result<Scene> load_scene(const DemoOptions& options) { return options.scene.empty() ? Result<Scene>(make_plaza()) : load_gltf(options.scene); }

Status prepare_folder(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) return Error{ErrorCode::io, "`" + folder + "` cannot be created: " + failure.message() + "; choose another folder with --out"};
  return Done{};
}

// One picture: a camera and what to show of it.
struct Shot {
  const NamedCamera* camera = nullptr;
  uint32_t view = 0;
};

Result<std::vector<Shot>> choose_shots(const Scene& scene, const DemoOptions& options) {
  std::vector<const NamedCamera*> cameras;
  std::string names;
  for (const NamedCamera& camera : scene.cameras) {
    if (options.camera.empty() || camera.name == options.camera) cameras.push_back(&camera);
    names += (names.empty() ? "`" : ", `") + camera.name + "`";
  }
  if (cameras.empty()) return Error{ErrorCode::invalid_argument, "there is no camera `" + options.camera + "`; the scene has " + names};
  std::vector<Shot> shots;
  if (!options.views.empty()) {
    for (const std::string& view : options.views) shots.push_back({cameras.front(), static_cast<uint32_t>(find_view(view))});
    return shots;
  }
  for (const NamedCamera* camera : cameras) shots.push_back({camera, frame::DEBUG_FINAL});
  for (uint32_t view = 1; view < static_cast<uint32_t>(frame::DEBUG_COUNT); ++view) shots.push_back({cameras.front(), view});
  return shots;
}

std::string file_name(const Scene& scene, const Shot& shot) {
  return scene.name + "_" + shot.camera->name + (shot.view == frame::DEBUG_FINAL ? "" : "_" + std::string(view_names()[shot.view])) + ".png";
}

FrameSettings settings_for(const DemoOptions& options, const Shot& shot, uint32_t number) {
  FrameSettings settings;
  settings.width = options.width;
  settings.height = options.height;
  settings.number = number;
  settings.debug_view = shot.view;
  settings.forced_features = options.forced_features;
  const auto scatters = [&](std::string_view light) { return std::find(options.fog.begin(), options.fog.end(), light) != options.fog.end(); };
  settings.fog_sun = scatters("sun"), settings.fog_lights = scatters("lights"), settings.fog_ambient = scatters("ambient");
  return settings;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Renders until history and exposure have settled, then writes. A debug view needs one frame only.
Status take(Renderer& renderer, const Scene& scene, const DemoOptions& options, const Shot& shot) {
  const uint32_t frames = shot.view == frame::DEBUG_FINAL ? options.frames : 1;
  for (uint32_t number = 0; number < frames; ++number) {
    const FrameData data = make_frame(scene, *shot.camera, settings_for(options, shot, number));
    if (Status drawn = renderer.render(data); !drawn) return drawn;
  }
  const auto picture = renderer.picture();
  if (!picture) return picture.error();
  const std::filesystem::path path = std::filesystem::path(options.out) / file_name(scene, shot);
  if (Status written = write_png(path, *picture); !written) return written;
  std::printf("wrote %s\n", path.c_str());
  return Done{};
}

// A second instance that submits pass by pass; the first frame compiles, the second is measured.
Status measure_passes(Device& device, const Scene& scene, const DemoOptions& options, const Shot& shot, Measurements& out) {
  auto renderer = Renderer::create(device, scene, {.width = options.width, .height = options.height, .submit_per_pass = true});
  if (!renderer) return renderer.error();
  for (uint32_t number = 0; number < 2; ++number)
    if (Status drawn = renderer->render(make_frame(scene, *shot.camera, settings_for(options, shot, number))); !drawn) return drawn;
  if (Status idle = renderer->graph().instance().wait_idle(); !idle) return idle;
  for (const PassTime& time : renderer->graph().instance().pass_times()) out.passes.push_back({std::string(time.pass), time.ms});
  return Done{};
}

double weight_of(const DemoOptions& options, const Shot& shot) {
  const auto weight = options.weights.find(shot.camera->name);
  return weight == options.weights.end() ? 1 : weight->second;
}

// With an instance of its own, whose kernels are timed one by one where the driver cannot.
Status time_kernels(Device& device, const Scene& scene, const DemoOptions& options, const std::vector<Shot>& shots, SpectrumProfile& profile) {
  auto renderer = Renderer::create(device, scene, {.width = options.width, .height = options.height, .submit_per_pass = true});
  if (!renderer) return renderer.error();
  for (const Shot& shot : shots) {
    if (shot.view != frame::DEBUG_FINAL) continue;
    constexpr int kRounds = 3;
    const Status timed = time_kernels(*renderer, scene, *shot.camera, settings_for(options, shot, 0), kRounds, weight_of(options, shot), profile);
    if (!timed) return timed;
  }
  return Done{};
}

Status measure_frame(Renderer& renderer, const Scene& scene, const DemoOptions& options, const Shot& shot, Measurements& out) {
  const FrameData data = make_frame(scene, *shot.camera, settings_for(options, shot, options.frames));
  const auto start = std::chrono::steady_clock::now();
  if (Status drawn = renderer.render(data); !drawn) return drawn;
  if (Status idle = renderer.graph().instance().wait_idle(); !idle) return idle;
  out.frame_ms = seconds_since(start) * 1000;
  out.memory = renderer.graph().instance().memory();
  out.lights = data.view.light_count;
  const auto counts = renderer.graph().cull_counts();
  if (!counts) return counts.error();
  out.visible = (*counts)[frame::COUNT_VISIBLE];
  out.outside = (*counts)[frame::COUNT_OUTSIDE];
  out.in_sun = (*counts)[frame::COUNT_SUN];
  out.triangles = (*counts)[frame::COUNT_TRIANGLES];
  return Done{};
}

RendererOptions renderer_options(const DemoOptions& options) {
  RendererOptions renderer{.width = options.width, .height = options.height};
  renderer.poison = options.poison, renderer.serial = options.serial, renderer.threads = options.threads;
  return renderer;
}

// Dumps, a trace, a profile: an instance of its own, whose passes are timed one by one where the driver cannot.
Status look_inside(Device& device, const Scene& scene, const DemoOptions& options, const Shot& shot) {
  if (options.dumps.empty() && options.trace.empty() && options.profile.empty()) return Done{};
  RendererOptions wanted = renderer_options(options);
  wanted.debug_readback = true;
  wanted.submit_per_pass = true;
  auto renderer = Renderer::create(device, scene, wanted);
  if (!renderer) return renderer.error();
  uint32_t number = 0;
  const auto draw = [&] { return renderer->render(make_frame(scene, *shot.camera, settings_for(options, shot, number++))); };
  if (Status drawn = draw(); !drawn) return drawn;  // the first frame compiles
  return inspect(*renderer, options, draw);
}

Status watch_first_shot(Device& device, const Scene& scene, const DemoOptions& options, const Shot& shot) {
  auto renderer = Renderer::create(device, scene, renderer_options(options));
  if (!renderer) return renderer.error();
  return watch(*renderer, options, [&] { return take(*renderer, scene, options, shot); });
}

Status render_all(Device& device, const Scene& scene, const DemoOptions& options) {
  auto shots = choose_shots(scene, options);
  if (!shots) return shots.error();
  if (!options.watch.empty()) return watch_first_shot(device, scene, options, shots->front());
  auto renderer = Renderer::create(device, scene, renderer_options(options));
  if (!renderer) return renderer.error();
  SpectrumProfile spectrum(kernels_of<frame::spectrum::light_features>());
  for (const Shot& shot : *shots) {
    if (Status taken = take(*renderer, scene, options, shot); !taken) return taken;
    if (options.record_spectrum.empty() || shot.view != frame::DEBUG_FINAL) continue;
    if (Status recorded = record_tiles(*renderer, shot.camera->name, weight_of(options, shot), spectrum); !recorded) return recorded;
  }
  if (options.time_kernels)
    if (Status timed = time_kernels(device, scene, options, *shots, spectrum); !timed) return timed;
  if (!options.record_spectrum.empty())
    if (Status written = write_spectrum(options.record_spectrum, spectrum); !written) return written;
  Measurements measured;
  if (Status done = measure_frame(*renderer, scene, options, shots->front(), measured); !done) return done;
  if (Status done = look_inside(device, scene, options, shots->front()); !done) return done;
  if (Status done = measure_passes(device, scene, options, shots->front(), measured); !done) return done;
  std::fputs(format_report(frame::plan(), measured, std::string(device.name())).c_str(), stdout);
  return Done{};
}

DeviceOptions device_options(const DemoOptions& options) {
  DeviceOptions device;
  device.device = options.device;
  device.validate = options.validate;
  device.pipeline_cache = options.pipeline_cache;
  device.on_message = [](bool is_error, std::string_view message) {
    std::fprintf(stderr, "%s: %.*s\n", is_error ? "validation error" : "validation", static_cast<int>(message.size()), message.data());
  };
  return device;
}

// ~Device would, too, and could not say that it failed.
Status save_pipelines(Device& device, const DemoOptions& options) {
  if (options.pipeline_cache.empty()) return Done{};
  if (Status saved = device.save_pipeline_cache(); !saved) return saved;
  std::printf("wrote %s\n", options.pipeline_cache.c_str());
  return Done{};
}

}  // namespace

int run_demo(int argc, char** argv) {
  int exit_code = 0;
  const auto options = parse_options(argc, argv, exit_code);
  if (!options) return exit_code;
  if (options->list_devices) return print_devices();
  auto scene = load_scene(*options);
  if (!scene) return complain(scene.error().message);
  if (Status ready = prepare_folder(options->out); !ready) return complain(ready.error().message);
  auto device = Device::create(device_options(*options));
  if (!device) return complain(device.error().message);
  if (Status done = render_all(*device, *scene, *options); !done) return complain(done.error().message);
  if (Status saved = save_pipelines(*device, *options); !saved) return complain(saved.error().message);
  if (options->validate) std::printf("validation: %llu messages\n", static_cast<unsigned long long>(device->validation_messages()));
  return device->validation_messages() > 0 ? 1 : 0;
}

}  // namespace rg::demo
