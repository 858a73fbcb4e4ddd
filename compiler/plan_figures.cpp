#include "compiler/plan_figures.h"

#include <algorithm>

namespace rg::compiler {
namespace {

uint32_t barriers_of(const BarrierGroup& group) { return group.memory_count + group.image_count + group.buffer_count; }

// The batch whose signal a wait waits for; kNone: one of another frame, or none.
uint32_t awaited(const PlanData& plan, const Wait& wait) {
  if (wait.frames_ago > 0) return kNone;
  for (uint32_t b = 0; b < plan.batches.size(); ++b) {
    const Batch& batch = plan.batches[b];
    if (batch.queue != wait.queue) continue;
    for (Index s = batch.first_signal; s < batch.first_signal + batch.signal_count; ++s)
      if (plan.signals[s].value >= wait.value) return b;
  }
  return kNone;
}

// By batch: those that have finished before it begins. What a batch waits for, the later ones of its queue have waited for too.
std::vector<uint64_t> finished_before(const PlanData& plan) {
  constexpr size_t kMaxBatches = 64;
  std::vector<uint64_t> before(plan.batches.size(), 0);
  if (plan.batches.size() > kMaxBatches) return std::vector<uint64_t>(plan.batches.size(), UINT64_MAX);
  for (uint32_t b = 0; b < plan.batches.size(); ++b) {
    const Batch& batch = plan.batches[b];
    for (uint32_t earlier = 0; earlier < b; ++earlier)
      if (plan.batches[earlier].queue == batch.queue) before[b] |= before[earlier];
    for (Index w = batch.first_wait; w < batch.first_wait + batch.wait_count; ++w) {
      const uint32_t other = awaited(plan, plan.waits[w]);
      if (other < b) before[b] |= before[other] | (uint64_t{1} << other);
    }
  }
  return before;
}

struct Walk {
  const PlanData& plan;
  PlanFigures& figures;
  std::vector<uint32_t> groups;  // by queue: barrier groups so far
  uint32_t position = 0, pending = 0;
};

void visit(Walk& at, const Step& step, uint32_t batch, uint32_t queue, uint64_t before) {
  if (at.groups.size() <= queue) at.groups.resize(queue + 1);
  if (step.kind == StepKind::set) return;
  if (step.kind == StepKind::barriers) {
    const BarrierGroup& group = at.plan.groups[step.index];
    const uint32_t count = barriers_of(group);
    at.groups[queue] += group.event == kNone;  // a split one stands behind another that is not
    at.pending += count;
    at.figures.barrier_calls += count > 0;
    return;
  }
  at.figures.passes[step.index] = {at.position++, at.groups[queue], batch, queue, at.pending, before};
  at.pending = 0;
}

void use(ResourceFigures& resource, uint32_t position) {
  resource.first = resource.first == kNone ? position : std::min(resource.first, position);
  resource.last = resource.last == kNone ? position : std::max(resource.last, position);
}

void find_resources(const PlanData& plan, PlanFigures& figures) {
  for (const Resource& row : plan.resources) {
    ResourceFigures resource;
    resource.bytes = row.estimated_bytes * row.copies;
    resource.offset = row.estimated_offset;
    resource.transient = row.lifetime == Lifetime::transient;
    figures.resources.push_back(resource);
  }
  for (size_t p = 0; p < plan.passes.size(); ++p) {
    const Pass& pass = plan.passes[p];
    for (Index a = pass.first_access; a < pass.first_access + pass.access_count; ++a)
      use(figures.resources[plan.accesses[a].ref.resource], figures.passes[p].position);
  }
}

}  // namespace

PlanFigures find_figures(const PlanData& plan) {
  PlanFigures figures;
  figures.passes.resize(plan.passes.size());
  figures.barriers = static_cast<uint32_t>(plan.memory_barriers.size() + plan.image_barriers.size() + plan.buffer_barriers.size());
  const std::vector<uint64_t> before = finished_before(plan);
  Walk at{plan, figures, {}};
  for (uint32_t b = 0; b < plan.batches.size(); ++b) {
    const Batch& batch = plan.batches[b];
    for (Index s = batch.first_step; s < batch.first_step + batch.step_count; ++s) visit(at, plan.steps[s], b, batch.queue, before[b]);
  }
  find_resources(plan, figures);
  return figures;
}

std::vector<ShaderStatistics> find_shader_figures(const PlanData& plan) {
  std::vector<ShaderStatistics> shaders, passes(plan.passes.size());
  for (const ShaderModule& shader : plan.shaders) shaders.push_back(find_statistics({shader.words.begin(), shader.words.end()}));
  for (const Pipeline& pipeline : plan.pipelines)
    for (Index i = pipeline.first_shader; i < pipeline.first_shader + pipeline.shader_count; ++i)
      passes[pipeline.pass] = greatest(passes[pipeline.pass], shaders[plan.pipeline_shaders[i]]);
  return passes;
}

bool overlap(const PassFigures& a, const PassFigures& b) {
  if (a.queue == b.queue) return a.group == b.group;
  const auto waited = [](uint64_t before, uint32_t batch) { return batch >= 64 || (before >> batch & 1) != 0; };
  return !waited(a.before, b.batch) && !waited(b.before, a.batch);
}

bool share_bytes(const ResourceFigures& a, const ResourceFigures& b) {
  return a.transient && b.transient && a.offset < b.offset + b.bytes && b.offset < a.offset + a.bytes;
}

}  // namespace rg::compiler
