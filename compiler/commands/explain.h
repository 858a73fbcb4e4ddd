// The parts of `rgc explain`.
#pragma once

#include <string>
#include <vector>

#include "dsl/program.h"
#include "dsl/source.h"

namespace rg::commands {

std::string code_of(const std::string& text);  // of `RG0301`, `rg0301` or `ReadBeforeWrite`; empty: it is none
int explain_code(const std::string& code);     // its page, or an error that there is none
int list_codes();
// Graphs, params, features, samplers, constants, extents and conditions of that name: where they are declared and who uses them.
std::string explain_declarations(const dsl::Program& program, const dsl::SourceFiles& sources, const std::string& name);
// Their names, for those who misspell one.
std::vector<std::string> declaration_names(const dsl::Program& program);
// Offsets, sizes and strides of the struct in the three block layouts; empty if there is none of that name.
std::string explain_struct(const dsl::Program& program, const dsl::SourceFiles& sources, const std::string& name);

}  // namespace rg::commands
