#include "tests/unit/e2e/compiled.h"

#include <gtest/gtest.h>

namespace rg::test {

compiler::CompileResult compile_files(const Files& files, const compiler::PlanOptions& plan) {
  compiler::CompileOptions options;
  options.until = compiler::Until::plans;
  options.plan = plan;
  dsl::Diagnostics diagnostics;
  compiler::CompileResult result = compiler::compile("frame.rg", reader_of(files), options, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.sources, false);
  return result;
}

}  // namespace rg::test
