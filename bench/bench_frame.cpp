// Times of passes of the demo's frame on the Vulkan device there is: fog in three kernels and in one, its variants, and the lighting as a spectrum.
// Each pass is a submit of its own. What is compared is drawn by turns, so that other work on the machine falls on both.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>

#include "bench/rows.h"
#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "examples/demo/plaza.h"
#include "examples/demo/renderer.h"

namespace rg::bench {
namespace {

constexpr uint32_t kWidth = 640, kHeight = 360;
constexpr int kRounds = 9;

// A Result's or Status's message, where the bench cannot go on.
void give_up(const Error& error) { std::fprintf(stderr, "frame left out: %s\n", error.message.c_str()); }

// The frame with every block a kernel of its own, as a plan that the demo's program can run.
std::optional<PlanFile> unfused_plan() {
  dsl::Diagnostics diagnostics;
  compiler::CompileOptions options;
  options.until = compiler::Until::plans;
  options.fuse = false;
  const compiler::CompileResult result = compiler::compile("passes.rg", commands::reader_for("passes.rg"), options, diagnostics);
  if (diagnostics.has_errors() || result.graphs.empty()) return std::nullopt;
  const std::string bytes = commands::plan_file({}, result).text;
  auto file = PlanFile::parse(std::as_bytes(std::span(bytes)), "passes.rg");
  if (!file) return give_up(file.error()), std::nullopt;
  return *file;
}

struct Case {
  std::string name;
  demo::Renderer* renderer;
  demo::FrameSettings settings;
  std::function<bool(std::string_view)> counts;  // passes by name
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Milliseconds of the passes that count, by case: medians over the rounds, by turns. Empty where a frame fails.
std::map<std::string, double> measure(const demo::Scene& scene, size_t camera, const std::vector<Case>& cases) {
  std::map<std::string, std::vector<double>> times;
  for (int round = 0; round <= kRounds; ++round)
    for (const Case& one : cases) {
      demo::FrameSettings settings = one.settings;
      settings.width = kWidth, settings.height = kHeight, settings.number = static_cast<uint32_t>(round);
      const Status drawn = one.renderer->render(demo::make_frame(scene, scene.cameras[camera], settings));
      if (!drawn) return give_up(drawn.error()), std::map<std::string, double>{};
      if (Status idle = one.renderer->graph().wait_idle(); !idle) return give_up(idle.error()), std::map<std::string, double>{};
      double sum = 0;
      for (const PassTime& time : one.renderer->graph().pass_times())
        if (one.counts(time.pass)) sum += time.ms;
      if (round > 0) times[one.name].push_back(sum);  // the first compiles shaders
    }
  std::map<std::string, double> medians;
  for (auto& [name, values] : times) medians[name] = median(values);
  return medians;
}

bool is_fog(std::string_view pass) { return pass.starts_with("froxel_fog.chain.") || pass == "froxel_fog.merged"; }

Rows fog_rows(const demo::Scene& scene, demo::Renderer& merged, demo::Renderer& chain) {
  std::vector<Case> cases = {{"chain", &chain, {}, is_fog}};
  const std::pair<const char*, uint32_t> sets[] = {{"sun_lamps_sky", 7}, {"lamps_sky", 6}, {"sun_sky", 5}, {"sky", 4}, {"none", 0}};
  for (const auto& [name, terms] : sets) {
    demo::FrameSettings settings;
    settings.fog_sun = (terms & 1) != 0, settings.fog_lights = (terms & 2) != 0, settings.fog_ambient = (terms & 4) != 0;
    cases.push_back({name, &merged, settings, is_fog});
  }
  auto times = measure(scene, 0, cases);
  if (times.empty()) return {};
  Rows rows = {{"frame/fog/merged", times["sun_lamps_sky"], "ms", times["chain"], "in three kernels"}};
  for (const auto& [name, terms] : sets)
    if (terms != 7) rows.push_back({"frame/fog/" + std::string(name), times[name], "ms", times["sun_lamps_sky"], "sun, lamps and sky"});
  return rows;
}

// From every camera: the kernels that tiles choose against the one with everything.
Rows spectrum_rows(const demo::Scene& scene, demo::Renderer& renderer) {
  const auto is_light = [](std::string_view pass) { return pass.starts_with("deferred_light"); };
  demo::FrameSettings full;
  full.forced_features = (1u << frame::LAMP_FEATURES) - 1;
  Rows rows;
  for (size_t camera = 0; camera < scene.cameras.size(); ++camera) {
    auto times = measure(scene, camera, {{"chosen", &renderer, {}, is_light}, {"full", &renderer, full, is_light}});
    if (!times.empty())
      rows.push_back({"frame/light/" + scene.cameras[camera].name, times["chosen"], "ms", times["full"], "one kernel with everything"});
  }
  return rows;
}

}  // namespace

Rows bench_frame(const std::string&) {
  auto device = Device::create({});
  if (!device) return give_up(device.error()), Rows{};
  const demo::Scene scene = demo::make_plaza();
  const demo::RendererOptions options{.width = kWidth, .height = kHeight, .submit_per_pass = true};
  auto merged = demo::Renderer::create(*device, scene, options);
  auto chain = demo::Renderer::create(*device, scene, options);
  if (!merged || !chain) return give_up(merged ? chain.error() : merged.error()), Rows{};
  Rows rows;
  if (const auto plan = unfused_plan()) {
    if (const Status swapped = chain->reload(*plan); !swapped) return give_up(swapped.error()), Rows{};
    rows = fog_rows(scene, *merged, *chain);
  }
  const Rows light = spectrum_rows(scene, *merged);
  rows.insert(rows.end(), light.begin(), light.end());
  return rows;
}

namespace {

// At a size that costs nothing, so that pipelines are what takes the time. Nothing where it fails.
std::optional<double> creation_ms(Device& device, uint32_t threads) {
  GraphOptions options;
  options.pipeline_threads = threads;
  Status made = Done{};
  const double ms = once_ms([&] {
    const Result<frame::Frame> graph = frame::Frame::create(device, {.froxels = {16, 9, 8}, .view = {64, 36}}, options);
    if (!graph) made = graph.error();
  });
  if (!made) return give_up(made.error()), std::nullopt;
  return ms;
}

// On a device that is made for the occasion, with a file of pipelines or without; the file is written when it ends.
std::optional<double> first_creation_ms(const std::string& file) {
  DeviceOptions options;
  options.pipeline_cache = file;
  auto device = Device::create(options);
  if (!device) return give_up(device.error()), std::nullopt;
  return creation_ms(*device, 1);
}

}  // namespace

// By one thread and by one a core, and by one on a new device with what the last one has left in a file and without; by turns.
Rows bench_creation(const std::string&) {
  auto device = Device::create({});
  if (!device) return give_up(device.error()), Rows{};
  const std::string file = (std::filesystem::temp_directory_path() / ("rgc_bench_pipelines_" + std::to_string(::getpid()))).string();
  std::map<std::string, std::vector<double>> times;
  bool good = true;
  for (int round = 0; round <= kRounds && good; ++round) {
    const std::pair<const char*, std::optional<double>> row[] = {
        {"one", creation_ms(*device, 1)}, {"all", creation_ms(*device, 0)}, {"new", first_creation_ms({})}, {"kept", first_creation_ms(file)}};
    for (const auto& [name, ms] : row) {
      good &= ms.has_value();
      if (ms && round > 0) times[name].push_back(*ms);
    }
  }
  std::error_code none;
  const auto bytes = std::filesystem::file_size(file, none);
  std::filesystem::remove(file, none);
  if (!good) return {};
  return {{"creation/passes", median(times["all"]), "ms", median(times["one"]), "its pipelines made by one thread, instead of one a core"},
          {"creation/kept", median(times["kept"]), "ms", median(times["new"]), "by one thread without the file that keeps pipelines"},
          {"creation/file", static_cast<double>(bytes), "count", {}, "bytes of that file; 64 hold nothing but headers"}};
}

}  // namespace rg::bench
