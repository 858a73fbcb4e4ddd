// The C++ mirror of the structs that shaders see.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dsl/program.h"
#include "dsl/source.h"

namespace rg::compiler {

// Which layouts of each struct cross between C++ and GLSL, nested ones included. Indexed by StructId.
struct StructUse {
  bool std140 = false, std430 = false;
};
std::vector<StructUse> find_struct_uses(const dsl::Program& program);

// What C++ calls the mirror. A struct used in both layouts that differ has two; the std140 one is called NAME_std140.
std::string mirror_name(const dsl::Program& program, const std::vector<StructUse>& uses, dsl::StructId id, bool std140);

// Type of a value in C++; `rg::vec3`, `float`, a mirror's name.
std::string mirror_type(const dsl::Program& program, const std::vector<StructUse>& uses, const dsl::Type& type, bool std140);

// All mirrors, nested before outer, each followed by the static_asserts of its layout.
std::string emit_structs(const dsl::Program& program, const dsl::SourceFiles& files);

}  // namespace rg::compiler
