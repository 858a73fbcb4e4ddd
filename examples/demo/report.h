// The table at the end of the demo.
#pragma once

#include <string>
#include <vector>

#include "runtime/graph.h"

namespace rg::demo {

struct MeasuredPass {
  std::string name;
  double ms = 0;
};
struct Measurements {
  std::vector<MeasuredPass> passes;  // each in a submit of its own, by the wall clock
  double frame_ms = 0;               // the whole frame in one submit
  MemoryReport memory;
  uint32_t visible = 0, outside = 0, in_sun = 0, triangles = 0;  // meshes
  uint32_t lights = 0;
};
std::string format_report(const Plan& plan, const Measurements& measured, const std::string& device);

}  // namespace rg::demo
