// Kill switches that name what they switch off.
#pragma once

#include <string>

#include "compiler/plan_frame.h"
#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::compiler {

// Names that switches give have to be graphs, passes or resources of the program as planned, or as it was before passes became parts of others; else
// nothing would be switched off.
void check_switches(const std::string& root_path, const dsl::Program& written, const dsl::Program& planned, const PlanOptions& options,
                    dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
