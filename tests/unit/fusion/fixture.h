// Programs with blocks, from memory: compiled as written and with every block a kernel of its own, proved, and run where there is a device.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "tests/unit/in_memory.h"

namespace rg::test {

struct Compiled {
  compiler::CompileResult result;
  dsl::Diagnostics diagnostics;
  // "RG0729 text\n" a diagnostic, its notes indented
  std::string messages() const;
  std::string text() const { return dsl::print(diagnostics, result.sources, false); }
};
// `main.rg` is the root.
Compiled compile_files(const Files& files, bool fuse = true, const std::vector<std::string>& fixed = {}, compiler::CompileOptions options = {});

// The checker on every plan, and on what became of the blocks; what it finds are failures.
void prove(const compiler::CompileResult& result);
// The abstract machine on every plan.
void run_machine(const compiler::CompileResult& result);

// The words of the read-back buffer called `name` after three frames of plan 0; none without a device or where it cannot run the graph.
std::optional<std::vector<uint32_t>> run(const compiler::CompileResult& result, const std::string& name);

}  // namespace rg::test
