// What a module really does with its descriptors and outputs, found by walking its instructions.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "compiler/shaders/spirv_tools.h"

namespace rg::compiler {

struct ModuleUse {
  bool touched = false;  // named by any instruction, size queries included
  bool reads = false, writes = false, atomics = false;
};
struct ModuleUses {
  std::map<std::pair<uint32_t, uint32_t>, ModuleUse> descriptors;  // by set and binding; all declared ones
  std::map<uint32_t, ModuleUse> outputs;                           // by location
  bool push_constants = false;
};

// A pointer or handle given to a function that was not inlined counts as read, written and atomic.
ModuleUses find_uses(const Words& words);

}  // namespace rg::compiler
