// Programs held in memory, compiled up to their plans.
#pragma once

#include <string>

#include "compiler/compile.h"
#include "tests/unit/in_memory.h"

namespace rg::test {

// Of `frame.rg`; an error is a failure of the test.
compiler::CompileResult compile_files(const Files& files, const compiler::PlanOptions& plan = {});

}  // namespace rg::test
