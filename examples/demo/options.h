// What the command line of the demo says.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rg::demo {

struct DemoOptions {
  uint32_t width = 640, height = 360;
  uint32_t frames = 6;
  std::string scene;               // a glTF file; empty: the plaza
  std::string camera;              // empty: the scene's first
  std::vector<std::string> views;  // what to show; empty: the final picture of every camera and all debug views of the first
  std::string out = "out";
  std::vector<std::string> dumps;  // PASS.resource
  std::string trace, profile;      // files; empty: none
  std::string watch;               // a plan file that may be replaced; empty: none
  uint32_t reloads = 0;            // ends the watch after so many attempts; 0: never
  std::string pipeline_cache;      // a file that keeps compiled pipelines between runs; empty: none
  uint32_t threads = 1;
  bool serial = false, poison = false;
  std::string record_spectrum;                                  // a file for the feature masks of the tiles; empty: none
  bool time_kernels = false;                                    // and what each kernel takes, in that file
  std::map<std::string, double> weights;                        // of cameras in that file; 1 where there is none
  uint32_t forced_features = 0;                                 // bits that every tile is shaded with
  std::vector<std::string> fog = {"sun", "lights", "ambient"};  // light that fog scatters
  int device = -1;
  bool validate = false, list_devices = false;
};

// Nothing where the program should end at once, with `exit_code` set; messages have been printed.
std::optional<DemoOptions> parse_options(int argc, char** argv, int& exit_code);

}  // namespace rg::demo
