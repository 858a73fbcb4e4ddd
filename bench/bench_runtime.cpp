// What the runtime costs on the CPU: over a function table whose functions do nothing, and beside a command buffer written by hand on a real driver.
#include <cstdlib>
#include <cstring>
#include <memory>

#include "bench/graphs.h"
#include "bench/rows.h"
#include "bench/still_driver.h"
#include "compiler/plan_frame.h"
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

void fill(const Plan& plan, Inputs& inputs) {
  size_t slots = 0, imports = 0;
  for (const Pass& pass : plan.passes)
    if (pass.host_slot != kNone) slots = std::max<size_t>(slots, pass.host_slot + 1);
  for (const Resource& resource : plan.resources)
    if (resource.import_slot != kNone) imports = std::max<size_t>(imports, resource.import_slot + 1);
  inputs.callbacks.assign(slots, record_nothing);
  Import import;
  import.image.image = reinterpret_cast<VkImage>(uintptr_t{1});  // nobody looks at it
  import.image.view = reinterpret_cast<VkImageView>(uintptr_t{1});
  inputs.imports.assign(imports, import);
  inputs.frame.imports = inputs.imports;
  inputs.frame.callbacks = inputs.callbacks.data();
}

std::optional<double> frame_ns(GraphInstance& graph, const FrameInputs& inputs) {
  constexpr int kFrames = 500;
  bool good = true;
  const double ms = median_ms(15, [&] {
    for (int frame = 0; frame < kFrames; ++frame) good &= static_cast<bool>(graph.execute(inputs));
  });
  return good ? std::optional(ms * 1e6 / kFrames) : std::nullopt;
}

uint64_t calls_of_a_frame(const Plan& plan, const FrameInputs& inputs) {
  Result<Device> device = still_device(true);
  if (!device) return 0;
  GraphOptions options;
  options.timestamps = false;
  Result<GraphInstance> graph = GraphInstance::create(*device, plan, options);
  const uint64_t before = still_calls();
  return graph && graph->execute(inputs) ? still_calls() - before : 0;
}

void add_overhead(const std::string& graph_name, const Plan& plan, Rows& rows) {
  Result<Device> device = still_device();
  if (!device) return;
  GraphOptions options;
  options.timestamps = false;
  Result<GraphInstance> graph = GraphInstance::create(*device, plan, options);
  if (!graph) return;
  Inputs inputs;
  fill(plan, inputs);
  const auto ns = frame_ns(*graph, inputs.frame);
  if (!ns) return;
  const auto passes = static_cast<double>(plan.passes.size());
  rows.push_back({"runtime/" + graph_name + "/overhead", *ns / passes, "ns", 15, "a pass, empty callbacks, functions that do nothing; the bound of the project"});
  rows.push_back({"runtime/" + graph_name + "/calls", static_cast<double>(calls_of_a_frame(plan, inputs.frame)), "count", {}, "Vulkan calls of one frame"});
}

// Re-places, recreates and rewrites everything that depends on extents.
void add_resize(const std::string& graph_name, const Plan& plan, Rows& rows) {
  if (plan.extents.empty()) return;
  Result<Device> device = still_device();
  if (!device) return;
  Result<GraphInstance> graph = GraphInstance::create(*device, plan, {});
  if (!graph) return;
  std::vector<int64_t> extents;
  for (const Extent& extent : plan.extents) extents.insert(extents.end(), std::begin(extent.initial), std::end(extent.initial));
  const double ms = median_ms(9, [&] {
    for (int i = 0; i < 10; ++i) static_cast<void>(graph->resize(extents));
  });
  rows.push_back({"runtime/" + graph_name + "/resize", ms / 10, "ms", {}, "placement, objects, descriptors, barriers; the driver does nothing"});
}

}  // namespace

Rows bench_runtime(const std::string& graphs) {
  Rows rows;
  for (const Reference& reference : kReferences) {
    const auto graph = load_graph(graphs, reference);
    if (!graph || graph->text.size() > 1'000'000) continue;
    const compiler::FramePlan plan = compiler::plan_frame(graph->program, dsl::GraphId{0}, {}, {});
    add_overhead(reference.graph, plan.plan.view(), rows);
    add_resize(reference.graph, plan.plan.view(), rows);
  }
  return rows;
}

}  // namespace rg::bench
