// Puts shaders into a plan: pipelines, descriptor bindings, parameter blocks, push constants, vertex input.
#pragma once

#include "compiler/plan_data.h"
#include "compiler/shaders/shaders.h"
#include "dsl/program.h"

namespace rg::compiler {

// Set 1 of a pass holds one binding for each access a shader can see, in the order of Pass::accesses, then one dynamic uniform block for each
// of Pass::params. Replaces every table of `plan` named above; calling it twice gives the same plan.
// Pre-condition: `plan` is of `graph` and its program_pass and program_resource are filled; `bundle` comes from compile_shaders without errors, and
// `configuration` is the plan's row in the VariantSpace it was compiled for.
void attach_shaders(PlanData& plan, const dsl::Program& program, dsl::GraphId graph, const ShaderBundle& bundle, size_t configuration = 0);

// The plan's word for what a device can do.
Capability plan_capability(dsl::Capability capability);

}  // namespace rg::compiler
