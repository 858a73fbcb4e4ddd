#include "tests/unit/fusion/fixture.h"

#include <cstdlib>
#include <cstring>

#include "compiler/machine/machine.h"
#include "compiler/verify/fusion.h"
#include "compiler/verify/verify.h"
#include "runtime/graph.h"

namespace rg::test {

std::string Compiled::messages() const {
  std::string text;
  for (const dsl::Diagnostic& diagnostic : diagnostics.rows()) {
    if (dsl::row(diagnostic.kind).severity == dsl::Severity::warning) continue;  // of what a small program leaves unused
    text += std::string(dsl::row(diagnostic.kind).code) + " " + diagnostic.message() + "\n";
    for (const dsl::Diagnostic& note : diagnostic.notes) text += "  " + note.message() + "\n";
  }
  return text;
}

Compiled compile_files(const Files& files, bool fuse, const std::vector<std::string>& fixed, compiler::CompileOptions options) {
  Compiled compiled;
  options.until = compiler::Until::plans;
  options.workers = 1;
  options.fuse = fuse;
  options.fixed_features = fixed;
  compiled.result = compiler::compile("main.rg", reader_of(files), options, compiled.diagnostics);
  return compiled;
}

void prove(const compiler::CompileResult& result) {
  for (const compiler::CompiledGraph& graph : result.graphs) {
    std::vector<verify::Kernel> kernels;
    for (const compiler::FusedKernel& kernel : result.fused)
      if (kernel.graph == graph.graph) kernels.push_back({kernel.pass, kernel.members});
    for (const compiler::FramePlan& frame : graph.plans) {
      auto findings =
          verify::verify(result.program, graph.graph, frame.configuration, frame.plan.view(), frame.plan.program_pass, frame.plan.program_resource);
      for (verify::Finding& finding : verify::verify_fusion(result.written, result.unfolded, graph.graph, frame.configuration, kernels))
        findings.push_back(std::move(finding));
      for (const verify::Finding& finding : findings) ADD_FAILURE() << verify::name(finding.hazard) << ": " << finding.text;
    }
  }
}

void run_machine(const compiler::CompileResult& result) {
  for (const compiler::CompiledGraph& graph : result.graphs)
    for (const compiler::FramePlan& frame : graph.plans)
      for (const machine::Divergence& divergence : machine::run_adversarially(result.program, graph.graph, frame.configuration, frame.plan.view(),
                                                                              frame.plan.program_pass, frame.plan.program_resource, {}))
        ADD_FAILURE() << machine::text(divergence);
}

std::optional<std::vector<uint32_t>> run(const compiler::CompileResult& result, const std::string& name) {
  static const auto device = Device::create({});
  if (!device) {
    if (std::getenv("RGC_REQUIRE_GPU")) ADD_FAILURE() << device.error().message;
    return std::nullopt;
  }
  const Plan plan = result.graphs.at(0).plans.at(0).plan.view();
  auto graph = GraphInstance::create(const_cast<Device&>(*device), plan, {});
  if (!graph) return std::nullopt;
  for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(graph->execute({}));
  for (Index i = 0; i < plan.resources.size(); ++i) {
    if (plan.resources[i].name != name) continue;
    const auto bytes = graph->readback(i);
    EXPECT_TRUE(bytes);
    std::vector<uint32_t> words(bytes ? (*bytes).size() / 4 : 0);
    if (bytes) std::memcpy(words.data(), (*bytes).data(), words.size() * 4);
    return words;
  }
  ADD_FAILURE() << "no resource " << name;
  return std::nullopt;
}

}  // namespace rg::test
