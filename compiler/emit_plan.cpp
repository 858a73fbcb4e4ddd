#include "compiler/emit_plan.h"

#include <algorithm>
#include <bit>

#include "compiler/format_table.h"
#include "compiler/lazy_attachments.h"
#include "compiler/slots.h"

namespace rg::compiler {
namespace {

PlanIndices number_rows(const PlanParts& parts, PlanData& plan) {
  const Frame& frame = parts.frame;
  PlanIndices indices{std::vector<Index>(frame.graph->resources.size(), kNone), std::vector<Index>(frame.graph->passes.size(), kNone),
                      first_update_slots(*frame.graph)};
  std::vector<bool> used(frame.graph->resources.size());
  for (const uint32_t pass : parts.schedule.order) {
    indices.pass[frame.passes[pass]] = static_cast<Index>(plan.program_pass.size());
    plan.program_pass.push_back(frame.passes[pass]);
    for (const Use& use : frame.uses_of(pass)) used[frame.cells[use.cell].resource] = true;
  }
  for (uint32_t r = 0; r < used.size(); ++r) {
    if (!used[r]) continue;
    indices.resource[r] = static_cast<Index>(plan.program_resource.size());
    plan.program_resource.push_back(r);
  }
  return indices;
}

void emit_program_tables(const PlanParts& parts, const PlanIndices& indices, PlanData& plan) {
  const dsl::Program& program = *parts.frame.program;
  for (const dsl::Extent& extent : program.extents) {
    Extent row;
    row.name = intern(extent.name), row.axes = extent.axes;
    std::copy(extent.initial, extent.initial + 3, row.initial);
    std::copy(extent.maximum, extent.maximum + 3, row.maximum);
    std::copy(extent.minimum, extent.minimum + 3, row.minimum);
    plan.extents.push_back(row);
  }
  for (const dsl::Condition& condition : program.conditions) plan.conditions.push_back(intern(condition.name));
  for (const dsl::EngineSet& set : program.engine_sets) plan.engine_sets.push_back({intern(set.name), static_cast<SetRole>(set.set)});
  for (const dsl::Params& params : parts.frame.graph->params)
    plan.params.push_back({intern(params.name), program.structs[params.type].size140, params.pass.valid() ? indices.pass[params.pass.value] : kNone});
}

void emit_culled(const PlanParts& parts, PlanData& plan) {
  for (uint32_t pass = 0; pass < parts.frame.passes.size(); ++pass)
    if (!parts.liveness.live[pass]) plan.culled.push_back({intern(parts.frame.pass(pass).name), intern(parts.liveness.reasons[pass])});
}

// What stands in a slot: events are awaited behind its barriers, so that neither goes on after the other, and set in front of them all, or behind
// them where they go on after them.
class SlotSteps {
 public:
  explicit SlotSteps(const PlanParts& parts)
      : groups_(groups_of_slots(parts)), set_before_(groups_.size()), awaited_(groups_.size()), set_behind_(groups_.size()) {
    Index group = first_split_group(groups_);
    for (const SplitGroup& split : parts.sync.splits) {
      (split.set.behind ? set_behind_ : set_before_)[split.set.slot].push_back(group);
      awaited_[split.wait_slot].push_back(group++);
    }
  }
  void emit(uint32_t slot, PlanData& plan) const {
    for (const Index group : set_before_[slot]) plan.steps.push_back({StepKind::set, group});
    if (groups_[slot] != kNone) plan.steps.push_back({StepKind::barriers, groups_[slot]});
    for (const Index group : awaited_[slot]) plan.steps.push_back({StepKind::barriers, group});
    for (const Index group : set_behind_[slot]) plan.steps.push_back({StepKind::set, group});
  }

 private:
  std::vector<Index> groups_;
  std::vector<std::vector<Index>> set_before_, awaited_, set_behind_;  // by slot
};

void emit_steps(const PlanParts& parts, PlanData& plan) {
  const Schedule& schedule = parts.schedule;
  const SlotSteps slots(parts);
  size_t next = 0;
  uint32_t segment = 0;
  for (uint32_t b = 0; b < schedule.batches; ++b) {
    Batch batch;
    batch.queue = segment < schedule.segments ? schedule.queue_of[segment] : 0;
    batch.first_step = static_cast<Index>(plan.steps.size());
    for (; segment < schedule.segments && schedule.batch_of[segment] == b; ++segment) {
      slots.emit(schedule.slot_before(segment), plan);
      for (; next < schedule.order.size() && schedule.segment_of[schedule.order[next]] == segment; ++next)
        plan.steps.push_back({StepKind::pass, static_cast<Index>(next)});
    }
    slots.emit(schedule.closing_slot(b), plan);
    batch.step_count = static_cast<Index>(plan.steps.size()) - batch.first_step;
    plan.batches.push_back(batch);
  }
}

// Values of signals count by queue; the last batch of each queue signals the end of its frame. One queue alone needs neither.
void emit_waits(const PlanParts& parts, PlanData& plan) {
  for (const dsl::QueueKind kind : parts.schedule.queues) plan.queues.push_back({static_cast<QueueKind>(kind)});
  if (plan.queues.size() == 1) return;
  std::vector<Index> last(plan.queues.size(), kNone);
  for (Index b = 0; b < plan.batches.size(); ++b) last[plan.batches[b].queue] = b;
  std::vector<uint64_t> values(plan.queues.size()), value_of(plan.batches.size());
  for (Index b = 0; b < plan.batches.size(); ++b) {
    Batch& batch = plan.batches[b];
    const bool retires = last[batch.queue] == b;
    if (parts.sync.batches[b].signal == 0 && !retires) continue;
    value_of[b] = ++values[batch.queue];
    batch.first_signal = static_cast<Index>(plan.signals.size()), batch.signal_count = 1;
    plan.signals.push_back({value_of[b], retires ? stage::all_commands : parts.sync.batches[b].signal});
  }
  for (Index b = 0; b < plan.batches.size(); ++b) {
    const std::vector<BatchWait>& waits = parts.sync.batches[b].waits;
    plan.batches[b].first_wait = static_cast<Index>(plan.waits.size()), plan.batches[b].wait_count = static_cast<Index>(waits.size());
    for (const BatchWait& wait : waits)
      plan.waits.push_back({wait.queue, wait.batch == kNone ? values[wait.queue] : value_of[wait.batch], wait.stages, wait.batch == kNone ? 1u : 0u});
  }
}

}  // namespace

Range plan_range(const dsl::Resource& resource, const Range& exact) {
  Range range = exact;
  if (range.mip + range.mips == resource.mips) range.mips = kRemaining;
  if (range.layer + range.layers == resource.layers) range.layers = kRemaining;
  return range;
}

Ref plan_ref(const PlanIndices& indices, dsl::ResourceId resource, uint32_t age) { return {indices.resource[resource.value], age}; }

ClearValue plan_clear(const dsl::ClearValue& value, uint32_t aspects) {
  ClearValue clear;
  if (aspects & (aspect_depth | aspect_stencil)) {
    clear.word[0] = std::bit_cast<uint32_t>(value.f[0]), clear.word[1] = value.u[1];
    return clear;
  }
  for (int i = 0; i < 4; ++i) clear.word[i] = value.integer ? value.u[i] : std::bit_cast<uint32_t>(value.f[i]);
  return clear;
}

PlanData emit_plan(const PlanParts& parts) {
  PlanData plan;
  plan.name = intern(parts.frame.graph->name);
  Expressions exprs(convert_expressions(*parts.frame.program));
  const PlanIndices indices = number_rows(parts, plan);
  emit_program_tables(parts, indices, plan);
  emit_resources(parts, indices, exprs, plan);
  emit_passes(parts, indices, exprs, plan);
  mark_lazy(plan);
  emit_barriers(parts, indices, exprs, plan);
  emit_steps(parts, plan);
  emit_waits(parts, plan);
  emit_culled(parts, plan);
  plan.exprs = exprs.take();
  return plan;
}

}  // namespace rg::compiler
