#include <cstdio>

#include "bench/graphs.h"
#include "bench/rows.h"
#include "compiler/plan_frame.h"
#include "runtime/device.h"
#include "runtime/graph.h"

namespace rg::bench {
namespace {

void record_nothing(void*, Recording&) {}

// Everything execute() wants, for a graph whose passes the host records.
struct Inputs {
  std::vector<RecordFunction> callbacks;
  std::vector<Import> imports;
  FrameInputs frame;
};

Inputs inputs_of(const Plan& plan) {
  Inputs inputs;
  size_t slots = 0, imports = 0;
  for (const Pass& pass : plan.passes)
    if (pass.host_slot != kNone) slots = std::max<size_t>(slots, pass.host_slot + 1);
  for (const Resource& resource : plan.resources)
    if (resource.import_slot != kNone) imports = std::max<size_t>(imports, resource.import_slot + 1);
  inputs.callbacks.assign(slots, record_nothing);
  Import import;
  import.image.image = reinterpret_cast<VkImage>(uintptr_t{1});  // the null device does not look at it
  import.image.view = reinterpret_cast<VkImageView>(uintptr_t{1});
  inputs.imports.assign(imports, import);
  inputs.frame.imports = inputs.imports;
  inputs.frame.callbacks = inputs.callbacks.data();
  return inputs;
}

// CPU time of a frame on a device whose driver does nothing: what the executor itself costs.
std::optional<double> null_frame_us(const Plan& plan) {
  Device device = Device::null(nullptr);
  auto instance = GraphInstance::create(device, plan, {});
  if (!instance) {
    std::fprintf(stderr, "left out: %s\n", instance.error().message.c_str());
    return std::nullopt;
  }
  const Inputs inputs = inputs_of(plan);
  constexpr int kFrames = 200;
  bool good = true;
  const double ms = median_ms(9, [&] {
    for (int frame = 0; frame < kFrames; ++frame) good &= static_cast<bool>(instance->execute(inputs.frame));
  });
  if (!good) return std::nullopt;
  return ms * 1000 / kFrames;
}

}  // namespace

Rows bench_executor(const std::string& graphs) {
  Rows rows;
  for (const Reference& reference : kReferences) {
    const auto graph = load_graph(graphs, reference);
    if (!graph || graph->text.size() > 1'000'000) continue;
    const compiler::FramePlan plan = compiler::plan_frame(graph->program, dsl::GraphId{0}, {}, {});
    const auto us = null_frame_us(plan.plan.view());
    if (!us) continue;
    const std::string prefix = std::string("executor/") + reference.graph;
    rows.push_back({prefix + "/frame", *us, "us", reference.record_null_us, "recording alone over a driver that does nothing; ours submits too"});
    rows.push_back({prefix + "/pass", *us * 1000 / static_cast<double>(plan.plan.passes.size()), "ns", {}, ""});
  }
  return rows;
}

}  // namespace rg::bench
