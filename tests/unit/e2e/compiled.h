// Programs held in memory, compiled up to their plans.
#pragma once

#include <map>
#include <string>

#include "compiler/compile.h"

namespace rg::test {

using Files = std::map<std::string, std::string>;

dsl::ReadSource reader_of(const Files& files);  // `files` outlives it

// Of `frame.rg`; an error is a failure of the test.
compiler::CompileResult compile_files(const Files& files, const compiler::PlanOptions& plan = {});

}  // namespace rg::test
