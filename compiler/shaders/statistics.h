// Figures of a SPIR-V module that cost models and budgets use. Estimates of what hardware does with it, exact counts of what stands in it.
#pragma once

#include <cstdint>

#include "compiler/shaders/spirv_tools.h"

namespace rg::compiler {

// Counts are static: an instruction in a loop counts once.
struct ShaderStatistics {
  uint32_t instructions = 0;  // in function bodies, labels and ends included
  uint32_t alu = 0;           // arithmetic, logic, comparison, conversion, selection, the extended set; vectors count once
  uint32_t samples = 0;       // sampled, gathered and fetched texels
  uint32_t loads = 0;         // of buffers, uniform blocks and storage images
  uint32_t stores = 0;        // to buffers and storage images
  uint32_t atomics = 0;
  uint32_t barriers = 0;
  uint32_t branches = 0;      // conditional branches and switches
  uint32_t shared_bytes = 0;  // workgroup memory, members at their natural alignment
  // Most scalars of 32 bits alive at once, by liveness on the SSA form, over all functions: constants, pointers and handles count nothing, phis where
  // their block begins. What registers are needed depends on a driver's order; this is the floor of the order in the module.
  uint32_t live_scalars = 0;
  friend bool operator==(const ShaderStatistics&, const ShaderStatistics&) = default;
};

// Each count's greater one.
ShaderStatistics greatest(const ShaderStatistics& a, const ShaderStatistics& b);

// ShaderStatistics::shared_bytes alone. `words` is a valid module. O(words) where it declares no workgroup memory.
uint32_t shared_bytes(const Words& words);

// `words` is a valid module. O(instructions + sweeps * blocks * values / 64); sweeps are as many as loops nest, and one.
ShaderStatistics find_statistics(const Words& words);

}  // namespace rg::compiler
