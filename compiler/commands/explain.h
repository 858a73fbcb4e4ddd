// The parts of `rgc explain`.
#pragma once

#include <string>

#include "dsl/program.h"
#include "dsl/source.h"

namespace rg::commands {

bool is_code(const std::string& text);      // `RG0301`
int explain_code(const std::string& code);  // its page, or an error that there is none
int list_codes();
// Offsets, sizes and strides of the struct in the three block layouts; empty if there is none of that name.
std::string explain_struct(const dsl::Program& program, const dsl::SourceFiles& sources, const std::string& name);

}  // namespace rg::commands
