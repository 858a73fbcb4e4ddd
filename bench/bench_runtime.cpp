// What the runtime costs on the CPU: over a function table whose functions do nothing, and beside a command buffer written by hand on a real driver.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "bench/graphs.h"
#include "bench/recorded_calls.h"
#include "bench/rows.h"
#include "bench/still_driver.h"
#include "compiler/plan_frame.h"
#include "runtime/alias.h"
#include "runtime/functions.h"
#include "runtime/graph.h"
#include "runtime/handles.h"
#include "runtime/packing.h"

namespace rg::bench {
namespace {

void record_nothing(void*, Recording&) {}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}
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
  const double ms = median_cpu_ms(15, [&] {
    for (int frame = 0; frame < kFrames; ++frame) good &= static_cast<bool>(graph.execute(inputs));
  });
  return good ? std::optional(ms * 1e6 / kFrames) : std::nullopt;
}

// Of a frame over functions that do nothing.
std::optional<double> overhead_ns(const Plan& plan, const FrameInputs& inputs, bool timestamps) {
  Result<Device> device = still_device();
  if (!device) return std::nullopt;
  GraphOptions options;
  options.timestamps = timestamps;
  Result<GraphInstance> graph = GraphInstance::create(*device, plan, options);
  return graph ? frame_ns(*graph, inputs) : std::nullopt;
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
  Inputs inputs;
  fill(plan, inputs);
  const auto plain = overhead_ns(plan, inputs.frame, false), timed = overhead_ns(plan, inputs.frame, true);
  if (!plain || !timed) return;
  const auto passes = static_cast<double>(plan.passes.size());
  rows.push_back({"runtime/" + graph_name + "/overhead", *plain / passes, "ns", 15,
                  "a pass, empty callbacks, functions that do nothing; the bound of the project"});
  rows.push_back(
      {"runtime/" + graph_name + "/overhead_timed", *timed / passes, "ns", *plain / passes, "... with two timestamps a pass, beside without"});
  rows.push_back(
      {"runtime/" + graph_name + "/calls", static_cast<double>(calls_of_a_frame(plan, inputs.frame)), "count", {}, "Vulkan calls of one frame"});
}

std::vector<int64_t> initial_extents(const Plan& plan) {
  std::vector<int64_t> extents;
  for (const Extent& extent : plan.extents) extents.insert(extents.end(), std::begin(extent.initial), std::end(extent.initial));
  return extents;
}
uint32_t initial_side(const Plan& plan, Index expr) { return static_cast<uint32_t>(evaluate(plan.exprs, expr, initial_extents(plan))); }

// Re-places, recreates and rewrites everything that depends on extents.
void add_resize(const std::string& graph_name, const Plan& plan, Rows& rows) {
  Result<Device> device = still_device();
  if (!device) return;
  Result<GraphInstance> graph = GraphInstance::create(*device, plan, {});
  if (!graph) return;
  const std::vector<int64_t> extents = initial_extents(plan);
  const double ms = median_cpu_ms(9, [&] {
    for (int i = 0; i < 10; ++i) static_cast<void>(graph->resize(extents));
  });
  rows.push_back({"runtime/" + graph_name + "/resize", ms / 10, "ms", {}, "placement, objects, descriptors, barriers; the driver does nothing"});
}

// The packer's part of a resize: the plan's transients, an image of eight bytes a texel each as the driver that does nothing has them.
void add_packing(const std::string& graph_name, const Plan& plan, Rows& rows) {
  const std::vector<alias::GroupInterval> intervals = alias::group_intervals(plan);
  std::vector<packing::Item> items;
  std::vector<Index> resources;
  for (Index r = 0; r < plan.resources.size(); ++r) {
    const Resource& resource = plan.resources[r];
    if (resource.lifetime != Lifetime::transient || !intervals[r].used() || intervals[r].begin == kNone) continue;
    const uint64_t bytes = uint64_t{initial_side(plan, resource.width)} * initial_side(plan, resource.height) * resource.layers * 8;
    items.push_back({(bytes + 65535) / 65536 * 65536, 65536, intervals[r].begin, intervals[r].end + 1});
    resources.push_back(r);
  }
  const alias::Sharing allowed(plan);
  std::vector<packing::Conflict> conflicts;
  for (uint32_t a = 0; a < items.size(); ++a)
    for (uint32_t b = a + 1; b < items.size(); ++b)
      if (!allowed.may_share(resources[a], resources[b])) conflicts.emplace_back(a, b);
  packing::Placement placement;
  const double ms = median_cpu_ms(9, [&] {
    for (int i = 0; i < 10; ++i) placement = packing::pack(items, conflicts, packing::kPlacementEffort);
  });
  rows.push_back({"runtime/" + graph_name + "/packing", ms / 10, "ms", items.size() <= 100 ? std::optional(1.0) : std::nullopt,
                  std::to_string(items.size()) + " transients placed again; the bound of the project is for 100"});
}

// ---- beside a command buffer written by hand ----------------------------------------------------------------------

struct CommandBuffer {
  UniqueCommandPool pool;
  VkCommandBuffer commands = VK_NULL_HANDLE;
};
CommandBuffer make_commands(Device& device) {
  CommandBuffer out;
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, pool_info.queueFamilyIndex = device.queue_family();
  VkCommandPool pool = VK_NULL_HANDLE;
  if (device.vk().CreateCommandPool(device.handle(), &pool_info, nullptr, &pool) != VK_SUCCESS) return out;
  out.pool = UniqueCommandPool(device.vk(), device.handle(), pool);
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, info.commandPool = pool, info.commandBufferCount = 1;
  device.vk().AllocateCommandBuffers(device.handle(), &info, &out.commands);
  return out;
}

template <class Record>
void record_into(Device& device, const CommandBuffer& buffer, Record record) {
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  device.vk().ResetCommandPool(device.handle(), buffer.pool.get(), 0);
  device.vk().BeginCommandBuffer(buffer.commands, &begin);
  record();
  device.vk().EndCommandBuffer(buffer.commands);
}

// What a plan imports, as real images.
struct Imported {
  std::vector<UniqueMemory> memory;
  std::vector<UniqueImage> images;
  std::vector<UniqueView> views;
  std::vector<Import> imports;
};
bool import_image(Device& device, const Plan& plan, const Resource& resource, Imported& out) {
  const DeviceFunctions& vk = device.vk();
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, info.imageType = VK_IMAGE_TYPE_2D, info.format = static_cast<VkFormat>(resource.format);
  info.extent = {initial_side(plan, resource.width), initial_side(plan, resource.height), 1};
  info.mipLevels = info.arrayLayers = 1, info.samples = VK_SAMPLE_COUNT_1_BIT, info.usage = resource.usage;
  VkImage image = VK_NULL_HANDLE;
  if (vk.CreateImage(device.handle(), &info, nullptr, &image) != VK_SUCCESS) return false;
  out.images.emplace_back(vk, device.handle(), image);
  VkMemoryRequirements requirements;
  vk.GetImageMemoryRequirements(device.handle(), image, &requirements);
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocate.allocationSize = requirements.size;
  allocate.memoryTypeIndex = device.memory_type(requirements.memoryTypeBits, 0);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  if (vk.AllocateMemory(device.handle(), &allocate, nullptr, &memory) != VK_SUCCESS) return false;
  out.memory.emplace_back(vk, device.handle(), memory);
  if (vk.BindImageMemory(device.handle(), image, memory, 0) != VK_SUCCESS) return false;
  VkImageViewCreateInfo view_info{};
  view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, view_info.image = image, view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view_info.format = info.format, view_info.subresourceRange = {resource.aspects, 0, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  if (vk.CreateImageView(device.handle(), &view_info, nullptr, &view) != VK_SUCCESS) return false;
  out.views.emplace_back(vk, device.handle(), view);
  out.imports.resize(std::max<size_t>(out.imports.size(), resource.import_slot + 1));
  out.imports[resource.import_slot].image = {image, view};
  return true;
}
// Plain 2D images only.
bool import_all(Device& device, const Plan& plan, Imported& out) {
  for (const Resource& resource : plan.resources) {
    if (resource.lifetime != Lifetime::imported) continue;
    if (resource.kind != ResourceKind::image || resource.dimension != Dimension::d2 || resource.layers != 1 || resource.mips != 1) return false;
    if (!import_image(device, plan, resource, out)) return false;
  }
  return true;
}

// What says that a frame is done; the host does, as nothing is submitted.
class Timeline {
 public:
  explicit Timeline(Device& device) : device_(device) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO, type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, info.pNext = &type;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    device.vk().CreateSemaphore(device.handle(), &info, nullptr, &semaphore);
    semaphore_ = UniqueSemaphore(device.vk(), device.handle(), semaphore);
  }
  VkSemaphore handle() const { return semaphore_.get(); }
  // For the frame before: a command buffer in use is not reset.
  void wait() {
    const VkSemaphore semaphore = handle();
    VkSemaphoreWaitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO, wait.semaphoreCount = 1, wait.pSemaphores = &semaphore, wait.pValues = &value_;
    device_.vk().WaitSemaphores(device_.handle(), &wait, UINT64_MAX);
  }
  uint64_t next() { return ++value_; }
  void reach() {
    VkSemaphoreSignalInfo signal{};
    signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, signal.semaphore = handle(), signal.value = value_;
    device_.vk().SignalSemaphore(device_.handle(), &signal);
  }

 private:
  Device& device_;
  UniqueSemaphore semaphore_;
  uint64_t value_ = 0;
};

// An instance on one of the two devices, recording into a command buffer of ours; its frames are never submitted, and done at once.
class OwnFrames {
 public:
  OwnFrames(Device& device, const Plan& plan, const Imported& imported) : device_(device), buffer_(make_commands(device)), done_(device) {
    GraphOptions options;
    options.timestamps = false, options.single_queue = true;
    Result<GraphInstance> graph = GraphInstance::create(device, plan, options);
    if (!graph) return;
    graph_.emplace(std::move(*graph));
    fill(plan, inputs_);
    inputs_.frame.imports = imported.imports;
  }
  bool ready() const { return graph_.has_value() && buffer_.pool && done_.handle() != VK_NULL_HANDLE; }
  bool record() {
    bool good = true;
    const OwnCommands parts[] = {{buffer_.commands, kNone}};
    record_into(device_, buffer_, [&] { good = graph_->use_commands(parts, {done_.handle(), done_.next()}) && graph_->execute(inputs_.frame); });
    done_.reach();
    return good;
  }

 private:
  Device& device_;
  CommandBuffer buffer_;
  Timeline done_;  // outlives the instance
  std::optional<GraphInstance> graph_;
  Inputs inputs_;
};

void add_recording(const std::string& graph_name, const Plan& plan, Rows& rows) {
  Result<Device> real = Device::create({});
  if (!real) return;
  Result<Device> keeping = keeping_device(*real);
  Imported imported;
  if (!keeping || !import_all(*real, plan, imported)) return;
  OwnFrames source(*keeping, plan, imported), measured(*real, plan, imported);
  if (!source.ready() || !measured.ready()) return;
  Calls calls;
  bool good = source.record();
  keep_calls(&calls);
  good &= source.record();
  keep_calls(nullptr);
  const CommandBuffer by_hand = make_commands(*real);
  Timeline done(*real);
  constexpr int kFrames = 50;
  std::vector<double> ratios, times;
  for (int round = 0; round < 61; ++round) {  // both in every round: a busy machine slows them alike
    const double runtime = cpu_ms([&] {
      for (int i = 0; i < kFrames; ++i) good &= measured.record();
    });
    const double hand = cpu_ms([&] {
      for (int i = 0; i < kFrames; ++i) {
        done.wait();
        record_into(*real, by_hand, [&] {
          for (const auto& call : calls) call(by_hand.commands);
        });
        done.next(), done.reach();
      }
    });
    ratios.push_back(runtime / hand), times.push_back(hand);
  }
  if (!good) return;
  const double hand_us = median(std::move(times)) * 1000 / kFrames;
  rows.push_back({"runtime/" + graph_name + "/recording", hand_us * median(std::move(ratios)), "us", hand_us,
                  "the same " + std::to_string(calls.size()) + " calls written by hand, on a real driver; bound 1.05"});
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
    add_packing(reference.graph, plan.plan.view(), rows);
    add_recording(reference.graph, plan.plan.view(), rows);
  }
  return rows;
}

}  // namespace rg::bench
