#include "examples/demo/options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>

#include "examples/demo/frame_data.h"
#include "examples/demo/spectrum.h"

namespace rg::demo {
namespace {

// "courtyard=2"
std::optional<std::pair<std::string, double>> weight_of(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) return std::nullopt;
  char* end = nullptr;
  const double weight = std::strtod(text.c_str() + equals + 1, &end);
  if (*end != '\0' || !(weight >= 0) || !std::isfinite(weight)) return std::nullopt;
  return std::pair(text.substr(0, equals), weight);
}

}  // namespace

std::optional<DemoOptions> parse_options(int argc, char** argv, int& exit_code) {
  DemoOptions options;
  CLI::App app{"Renders a scene through the generated frame and writes pictures."};
  std::vector<std::string> views, weights, forced, features = {"all"};
  for (const std::string_view name : frame::spectrum::light_features::features) features.emplace_back(name);
  for (const std::string_view name : view_names()) views.emplace_back(name);
  app.add_option("--width", options.width, "pixels")->check(CLI::Range(16, 3840))->capture_default_str();
  app.add_option("--height", options.height, "pixels")->check(CLI::Range(16, 2160))->capture_default_str();
  app.add_option("--frames", options.frames, "frames to render before a picture is taken")->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--scene", options.scene, "a .gltf or .glb file instead of the plaza");
  app.add_option("--camera", options.camera, "one of the scene's cameras by name");
  app.add_option("--view", options.views, "what to show, may be repeated; all if left out")->check(CLI::IsMember(views));
  app.add_option("--device", options.device, "number from --list-devices; -1 takes the best")->capture_default_str();
  app.add_option("--out", options.out, "folder for the pictures")->capture_default_str();
  auto* record = app.add_option("--record-spectrum", options.record_spectrum,
                                "write the feature masks of all tiles, camera by camera, for `rgc spectrum --profile`");
  app.add_flag("--time-kernels", options.time_kernels, "write there what each kernel takes for the tiles that it can serve, too")->needs(record);
  app.add_option("--weight", weights, "how much a camera counts in that file; 1 if left out; may be repeated")
      ->type_name("CAMERA=NUMBER")
      ->check(CLI::Validator([](std::string& text) { return weight_of(text) ? "" : "`" + text + "` is not of the form CAMERA=NUMBER"; }, ""));
  app.add_option("--force-feature", forced, "shade every tile with a feature of lamps, whether it has such lamps or not; may be repeated; `all`")
      ->check(CLI::IsMember(features));
  app.add_option("--fog", options.fog, "light that fog scatters; a kernel for each set")
      ->delimiter(',')
      ->check(CLI::IsMember({"sun", "lights", "ambient", "none"}))
      ->capture_default_str();
  app.add_flag("--validate", options.validate, "run under the Khronos validation layer");
  app.add_option("--dump", options.dumps, "what PASS leaves in a resource, as PNG and EXR in --out; may be repeated")->type_name("PASS.RESOURCE");
  app.add_option("--trace", options.trace, "passes on a time line, for chrome://tracing or Perfetto")->type_name("FILE");
  app.add_option("--profile", options.profile, "measured times of passes, for `rgc --profile`")->type_name("FILE");
  auto* watch =
      app.add_option("--watch", options.watch, "go on, and run the plans that `rgc watch` writes to this file as they come")->type_name("FILE");
  app.add_option("--reloads", options.reloads, "end after so many changes of the watched file")->needs(watch)->type_name("N");
  app.add_option("--pipeline-cache", options.pipeline_cache, "keep compiled pipelines in this file from run to run")->type_name("FILE");
  app.add_option("--threads", options.threads, "threads that record a frame")->check(CLI::Range(1, 64))->capture_default_str();
  app.add_flag("--serial", options.serial, "every pass waits for all before it");
  app.add_flag("--poison", options.poison, "fill transients with a pattern before their first use");
  app.add_flag("--list-devices", options.list_devices, "print the Vulkan devices and end");
  try {
    app.parse(argc, argv);
    for (const std::string& text : weights) options.weights.insert(*weight_of(text));
    for (const std::string& name : forced) options.forced_features |= feature_bit(name).value_or((1u << frame::LAMP_FEATURES) - 1);
    return options;
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return std::nullopt;
  }
}

}  // namespace rg::demo
