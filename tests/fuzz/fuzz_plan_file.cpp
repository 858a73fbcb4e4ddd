// Plans from anywhere: what the loader and check_plan let through runs on the null device - creation, frames, a resize, an invalidation - without a
// crash.
//
//   input: u8 base, then either bytes of a file (base 255), or edits of the plan `base`: u16 which number, u8 how, u8 operand
#include <algorithm>
#include <cstring>
#include <vector>

#include "compiler/codegen/plan_file.h"
#include "runtime/device.h"
#include "runtime/graph.h"
#include "runtime/plan_check.h"
#include "runtime/plan_fields.h"
#include "runtime/plan_file.h"
#include "tests/unit/runtime/plans.h"

namespace {

using rg::plan_file::PlanNumber;
using rg::plan_file::PlanRow;
using rg::test::TestPlan;

struct Number {
  unsigned char* bytes = nullptr;
  size_t size = 0;
  bool is_bool = false;  // a program cannot hold others than 0 and 1
};

// All numbers in the rows of a plan, in order.
class Numbers {
 public:
  template <PlanNumber T>
  void add(T& value) {
    list.push_back({reinterpret_cast<unsigned char*>(&value), sizeof(T), std::is_same_v<T, bool>});
  }
  template <PlanRow T>
  void add(T& row) {
    rg::plan_file::each_field(row, [&](auto&... fields) { (add(fields), ...); });
  }
  void add(rg::BarrierGroup& group) {  // without its event, see add_tables
    add(group.first_memory), add(group.memory_count), add(group.first_image), add(group.image_count), add(group.first_buffer), add(group.buffer_count);
  }
  template <class T, size_t N>
  void add(T (&values)[N]) {
    for (T& value : values) add(value);
  }
  template <class T>
  void add(std::vector<T>& rows) {
    for (T& row : rows) add(row);
  }
  void add(std::vector<std::string_view>&) {}
  void add(std::string_view&) {}
  void add(std::span<const uint32_t>&) {}  // words of a shader: drivers trust them

  std::vector<Number> list;
};

void add_tables(TestPlan& p, Numbers& numbers) {
  const auto add = [&](auto&... tables) { (numbers.add(tables), ...); };
  add(p.exprs, p.extents, p.resources, p.queues, p.batches, p.steps, p.waits, p.signals, p.groups, p.memory_barriers, p.image_barriers,
      p.buffer_barriers, p.entry, p.acquires, p.releases, p.alias_clocks, p.passes, p.accesses, p.renderings, p.attachments, p.shaders, p.pipelines,
      p.pipeline_shaders, p.bindings, p.samplers, p.params, p.pass_params, p.transfers, p.mip_limits);
  for (rg::BarrierGroup& group : p.groups) add(group.event);  // last, so that what seeds say of the others stays so
}

uint64_t edited(uint64_t value, uint8_t how, uint8_t operand) {
  switch (how % 8) {
    case 0:
      return operand;
    case 1:
      return value + operand;
    case 2:
      return value - operand;
    case 3:
      return uint64_t{1} << operand % 64;
    case 4:
      return ~uint64_t{0} - operand;
    case 5:
      return value ^ uint64_t { 1 } << operand % 64;
    case 6:
      return value << operand % 64;
    default:
      return (uint64_t{1} << 63) - operand;
  }
}

void edit(const Number& number, uint8_t how, uint8_t operand) {
  uint64_t value = 0;
  std::memcpy(&value, number.bytes, number.size);
  value = edited(value, how, operand);
  if (number.is_bool) value &= 1;
  std::memcpy(number.bytes, &value, number.size);
}

void edit_plan(TestPlan& plan, const uint8_t* data, size_t size) {
  plan.view();  // fills the batch that the frame is
  if (plan.batches.empty()) plan.batches = plan.one_batch;
  Numbers numbers;
  add_tables(plan, numbers);
  for (; size >= 4; data += 4, size -= 4) {
    const size_t which = static_cast<size_t>(data[0] | data[1] << 8) % numbers.list.size();
    edit(numbers.list[which], data[2], data[3]);
  }
}

TestPlan base_plan(uint8_t base) {
  switch (base % 7) {
    case 0:
      return rg::test::clear_and_copy().plan;
    case 1:
      return rg::test::counter().plan;
    case 2:
      return rg::test::tint().plan;
    case 3:
      return rg::test::relay().plan;
    case 4:
      return rg::test::mips().plan;
    case 5:
      return rg::test::aliased().plan;
    default:
      return rg::test::split().plan;
  }
}

struct Inputs {
  std::vector<std::vector<std::byte>> blocks, updates;
  std::vector<std::span<const std::byte>> params, update_spans;
  std::vector<rg::Import> imports;
  std::vector<rg::RecordFunction> callbacks;
  std::vector<VkDescriptorSet> sets;
  rg::FrameInputs frame;
};

void fill(const rg::Plan& plan, Inputs& in) {
  for (const rg::Params& block : plan.params) in.blocks.emplace_back(block.bytes);
  for (const auto& block : in.blocks) in.params.emplace_back(block);
  size_t imports = 0, slots = 0, updates = 0;
  for (const rg::Resource& resource : plan.resources)
    if (resource.lifetime == rg::Lifetime::imported) imports = std::max<size_t>(imports, resource.import_slot + 1);
  for (const rg::Pass& pass : plan.passes)
    if (pass.work.kind == rg::WorkKind::host) slots = std::max<size_t>(slots, pass.host_slot + 1);
  for (const rg::Transfer& transfer : plan.transfers)
    if (transfer.kind == rg::TransferKind::update) updates = std::max<size_t>(updates, transfer.update_slot + 1);
  rg::Import import;
  import.image = {reinterpret_cast<VkImage>(uintptr_t{1}), reinterpret_cast<VkImageView>(uintptr_t{1})};
  import.buffer.buffer = reinterpret_cast<VkBuffer>(uintptr_t{1});
  in.imports.assign(imports, import);
  in.callbacks.assign(slots, [](void*, rg::Recording&) {});
  in.updates.assign(updates, std::vector<std::byte>(16));
  for (const auto& update : in.updates) in.update_spans.emplace_back(update);
  in.sets.assign(plan.engine_sets.size(), reinterpret_cast<VkDescriptorSet>(uintptr_t{1}));
  in.frame.imports = in.imports, in.frame.params = in.params, in.frame.callbacks = in.callbacks.data(), in.frame.updates = in.update_spans,
  in.frame.engine_sets = in.sets, in.frame.conditions = ~uint64_t{0};
}

void run(const rg::Plan& plan, uint8_t variety) {
  rg::Device device = rg::Device::null(nullptr);
  rg::GraphOptions options;
  options.frames_in_flight = 1 + variety % 4;
  options.single_queue = variety % 3 == 1;
  options.poison = variety % 5 == 1;
  options.timestamps = variety % 2 == 1;  // without them a frame is recorded from packed rows
  const std::vector<VkDescriptorSetLayout> layouts(plan.engine_sets.size(), reinterpret_cast<VkDescriptorSetLayout>(uintptr_t{1}));
  options.engine_set_layouts = layouts;
  auto graph = rg::GraphInstance::create(device, plan, options);
  if (!graph) return;
  Inputs inputs;
  fill(plan, inputs);
  for (int frame = 0; frame < 4; ++frame) static_cast<void>(graph->execute(inputs.frame));
  for (rg::Index r = 0; r < plan.resources.size(); ++r) {
    static_cast<void>(graph->invalidate(r));
    if (plan.resources[r].lifetime == rg::Lifetime::readback) static_cast<void>(graph->readback(r));
  }
  std::vector<int64_t> extents;
  for (const rg::Extent& extent : plan.extents) extents.insert(extents.end(), std::begin(extent.maximum), std::end(extent.maximum));
  static_cast<void>(graph->resize(extents));
  static_cast<void>(graph->execute(inputs.frame));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0 || size > 65536) return 0;
  std::string file;
  if (data[0] == 255) {
    file.assign(reinterpret_cast<const char*>(data + 1), size - 1);
  } else {
    TestPlan plan = base_plan(data[0]);
    edit_plan(plan, data + 1, size - 1);
    const rg::Plan view = plan.view();
    file = rg::compiler::emit_plan_file({&view, 1});
  }
  const auto parsed = rg::PlanFile::parse(std::as_bytes(std::span(file)), "fuzz");
  if (!parsed) return 0;
  for (const rg::Plan& plan : parsed->plans()) run(plan, static_cast<uint8_t>(size));
  return 0;
}
