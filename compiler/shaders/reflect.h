// What a module declares, read back by SPIRV-Cross. Needs names: reflect before stripping.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/shaders/interface.h"
#include "compiler/shaders/spirv_tools.h"

namespace rg::compiler {

struct ReflectedBinding {
  std::string name;  // of the variable, or of the block without the generated prefix
  uint32_t set = 0, binding = 0;
  BindingKind kind = BindingKind::texture;  // uniform blocks are uniform_buffer, parameter blocks too
  dsl::Dimension dimension = dsl::Dimension::d2;
  bool arrayed = false;
  bool statically_used = false;
  friend bool operator==(const ReflectedBinding&, const ReflectedBinding&) = default;
};
struct ReflectedStruct {  // a named struct inside a block, with the offsets that block gives its members
  std::string name;
  bool std140 = false;
  std::vector<uint32_t> offsets;
  friend bool operator==(const ReflectedStruct&, const ReflectedStruct&) = default;
};
struct Reflection {
  std::vector<ReflectedBinding> bindings;  // by set and binding
  std::vector<ReflectedStruct> structs;
  bool push_constants_used = false;
};

Reflection reflect(const Words& words);

}  // namespace rg::compiler
