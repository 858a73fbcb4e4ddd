// What a report says about one plan, as numbers; docs/cli.md documents the JSON form.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compiler/compile.h"

namespace rg::commands {

struct Facts {
  std::string graph, variant;  // variant: "fog=on", empty where the program has no features
  size_t passes_live = 0, passes_culled = 0;
  size_t passes_raster = 0, renderings = 0;                             // live raster passes, and how often one begins
  uint64_t heap_bytes = 0, unaliased_bytes = 0, lower_bound_bytes = 0;  // transients at the initial extents, by the device profile
  uint64_t lazy_bytes = 0, heap_beside_lazy_bytes = 0;                  // transients that may live on the chip; the heap without them
  size_t barrier_calls = 0, barriers = 0;                               // vkCmdPipelineBarrier2 with something in it; what they hold together
  size_t events = 0;                                                    // of those calls, vkCmdWaitEvents2 of barriers in two halves
  size_t all_commands = 0;                                              // barriers naming ALL_COMMANDS, ALL_GRAPHICS, MEMORY_READ or MEMORY_WRITE
  size_t submits = 0, waits = 0;
  size_t barrier_stages = 0, barrier_accesses = 0;  // bits named by all barriers together
  size_t signals = 0, queues = 0;
  compiler::Overlap overlap;
  compiler::OrderFacts order;
  double stall_us = 0;            // modelled: the GPU drains once a barrier call
  size_t plans = 0, shaders = 0;  // of the graph: feature configurations, different SPIR-V modules
  double plan_ms = 0;
  std::vector<std::pair<std::string, double>> phase_ms;
};

Facts find_facts(const dsl::Program& program, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan);
nlohmann::ordered_json to_json(const Facts& facts);

size_t barrier_count(const BarrierGroup& group);
// "COMPUTE_SHADER|FRAGMENT_SHADER", "SHADER_STORAGE_WRITE", "GENERAL": Vulkan's names without their prefixes; "NONE" for 0.
std::string stage_names(Stages stages);
std::string access_names(Accesses accesses);
std::string layout_name(Layout layout);
std::string tag_name(BarrierTag tag);

}  // namespace rg::commands
