// What SPIR-V asks of devices beyond what every device of the target has.
#pragma once

#include "compiler/shaders/agreement.h"

namespace rg::compiler {

// Capabilities that a module declares and that only some devices have, ascending, each once.
std::vector<dsl::Capability> device_capabilities(const Words& words);

// Reports a capability of the variant that no feature of the row asks the device for. False after a report.
bool check_floor(const PassContext& context, const dsl::Shader& shader, const VariantRow& row, const Words& words, dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
