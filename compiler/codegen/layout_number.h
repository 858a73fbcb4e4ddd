// One number for how a C++ mirror has to look: equal where fields have the same names, types and places, or values the same names in the same order.
// A plan that is loaded into a running program is refused where the program's mirrors would no longer fit.
#pragma once

#include <cstdint>

#include "dsl/program.h"

namespace rg::compiler {

uint32_t layout_of_struct(const dsl::Program& program, dsl::StructId record);
// 0 for images.
uint32_t layout_of_elements(const dsl::Program& program, const dsl::Resource& resource);
// Of the C++ enum that the values of a feature are; 0 for bool.
uint32_t layout_of_values(const dsl::Feature& feature);

}  // namespace rg::compiler
