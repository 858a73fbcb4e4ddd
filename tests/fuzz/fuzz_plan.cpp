// Any program that the front end accepts: the planner plans it, and the checker proves the plan.
#include <cstdio>

#include "compiler/compile.h"
#include "compiler/verify/verify.h"
#include "dsl/check_macro.h"

namespace {

void prove(const rg::compiler::CompileResult& result) {
  for (const rg::compiler::CompiledGraph& graph : result.graphs) {
    for (const rg::compiler::FramePlan& plan : graph.plans) {
      const auto findings =
          rg::verify::verify(result.program, graph.graph, plan.configuration, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource);
      for (const rg::verify::Finding& finding : findings) std::fprintf(stderr, "%s\n", finding.text.c_str());
      RG_CHECK(findings.empty(), "the plan is proved");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > 16384) return 0;  // planning may be quadratic; the fuzzer needs speed
  const std::string text(reinterpret_cast<const char*>(data), size);
  const rg::dsl::ReadSource read = [&](const std::string& path, std::string& why) -> std::optional<std::string> {
    if (path == "fuzz.rg") return text;
    why = "no such file";
    return std::nullopt;
  };
  rg::compiler::CompileOptions options;
  options.max_plans = 8;
  options.command = "fuzz";
  rg::dsl::Diagnostics diagnostics;
  const rg::compiler::CompileResult result = rg::compiler::compile("fuzz.rg", read, options, diagnostics);
  if (!diagnostics.has_errors()) prove(result);
  return 0;
}
