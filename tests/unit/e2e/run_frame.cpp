#include "tests/unit/e2e/run_frame.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "compiler/verify/folding.h"
#include "compiler/verify/verify.h"
#include "runtime/graph.h"

namespace rg::test {

void expect_proved(const compiler::CompileResult& result) {
  for (const compiler::CompiledGraph& graph : result.graphs)
    for (const compiler::FramePlan& plan : graph.plans) {
      for (const verify::Finding& finding :
           verify::verify(result.program, graph.graph, plan.configuration, plan.plan.view(), plan.plan.program_pass, plan.plan.program_resource))
        ADD_FAILURE() << finding.text;
      for (const verify::Finding& finding : verify::verify_folding(result.unfolded, result.program, graph.graph, plan.configuration))
        ADD_FAILURE() << finding.text;
    }
}

std::optional<Words> run(const Files& files, uint32_t frames, bool validate, std::vector<Capability> without,
                         const compiler::PlanOptions& plan_options) {
  const compiler::CompileResult result = compile_files(files, plan_options);
  if (result.graphs.empty() || result.graphs[0].plans.empty()) return Words{};
  expect_proved(result);
  DeviceOptions options;
  options.validate = validate;
  options.without = std::move(without);
  options.on_message = [](bool is_error, std::string_view message) {
    if (is_error) ADD_FAILURE() << message;
  };
  auto device = Device::create(options);
  if (!device) {
    if (std::getenv("RGC_REQUIRE_GPU")) ADD_FAILURE() << device.error().message;
    return std::nullopt;
  }
  const Plan plan = result.graphs[0].plans[0].plan.view();
  auto graph = GraphInstance::create(*device, plan, {});
  EXPECT_TRUE(graph) << graph.error().message;
  if (!graph) return Words{};
  for (uint32_t frame = 0; frame < frames; ++frame) {
    const Status status = graph->execute({});
    EXPECT_TRUE(status) << status.error().message;
  }
  for (uint32_t resource = 0; resource < plan.resources.size(); ++resource) {
    if (plan.resources[resource].lifetime != Lifetime::readback) continue;
    const auto bytes = graph->readback(resource);
    EXPECT_TRUE(bytes) << bytes.error().message;
    if (!bytes) continue;
    Words words((*bytes).size() / 4);
    std::memcpy(words.data(), (*bytes).data(), words.size() * 4);
    return words;
  }
  return Words{};
}

bool device_has(Capability capability) {
  const auto device = Device::create({});
  return device && device->has(capability);
}

}  // namespace rg::test
