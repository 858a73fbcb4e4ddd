// Plans as one file that a running program loads, see runtime/plan_fields.h.
#pragma once

#include <span>
#include <string>

#include "runtime/plan.h"

namespace rg::compiler {

// The same plans give the same bytes. O(size of the plans); equal SPIR-V is stored once.
std::string emit_plan_file(std::span<const Plan> plans);

}  // namespace rg::compiler
