// Figures of one plan, pass by pass and resource by resource: what assertions judge and what generated headers repeat as constants.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/plan_data.h"
#include "compiler/shaders/statistics.h"

namespace rg::compiler {

struct PassFigures {
  uint32_t position = 0;  // in the serial order of the plan
  uint32_t group = 0;     // barrier groups on its queue before it: passes of one queue with the same number have no barrier between them
  uint32_t batch = 0, queue = 0;
  uint32_t barriers = 0;  // in the groups right before it
  uint64_t before = 0;    // bit i: batch i has finished before its batch begins; all bits where a plan has more than 64
};
struct ResourceFigures {
  uint64_t bytes = 0, offset = 0;  // estimated; offset only of transients
  bool transient = false;
  uint32_t first = kNone, last = kNone;  // positions of the first and last pass that use it; kNone: nobody
};
struct PlanFigures {
  std::vector<PassFigures> passes;           // by index of Plan::passes
  std::vector<ResourceFigures> resources;    // by index of Plan::resources
  uint32_t barriers = 0, barrier_calls = 0;  // calls: groups with something in it
};
PlanFigures find_figures(const PlanData& plan);
// By index of Plan::passes: each count's greatest over the shaders of the pass, all its variants. O(bytes of SPIR-V).
std::vector<ShaderStatistics> find_shader_figures(const PlanData& plan);

// No barrier separates the two, or they run on different queues and neither waits for the other.
bool overlap(const PassFigures& a, const PassFigures& b);
// Whether two transients share bytes in the estimated placement.
bool share_bytes(const ResourceFigures& a, const ResourceFigures& b);

}  // namespace rg::compiler
