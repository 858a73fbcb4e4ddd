#include "tests/unit/e2e/compiled.h"

#include <gtest/gtest.h>

namespace rg::test {

dsl::ReadSource reader_of(const Files& files) {
  return [&files](const std::string& path, std::string& why) -> std::optional<std::string> {
    const auto file = files.find(path);
    if (file != files.end()) return file->second;
    why = "no such file";
    return std::nullopt;
  };
}

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
