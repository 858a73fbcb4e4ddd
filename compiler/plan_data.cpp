#include "compiler/plan_data.h"

#include <mutex>
#include <set>

namespace rg {

PlanData::PlanData() = default;
PlanData::PlanData(const PlanData&) = default;
PlanData::PlanData(PlanData&&) noexcept = default;
PlanData& PlanData::operator=(const PlanData&) = default;
PlanData& PlanData::operator=(PlanData&&) noexcept = default;
PlanData::~PlanData() = default;

Plan PlanData::view() const {
  Plan p;
  p.version = version, p.name = name, p.variant = variant, p.variant_count = variant_count, p.variant_name = variant_name;
  p.exprs = exprs, p.extents = extents, p.resources = resources;
  p.queues = queues, p.batches = batches, p.steps = steps, p.waits = waits, p.signals = signals;
  p.groups = groups, p.memory_barriers = memory_barriers, p.image_barriers = image_barriers, p.buffer_barriers = buffer_barriers;
  p.entry = entry, p.exit = exit, p.acquires = acquires, p.releases = releases;
  p.alias_clocks = alias_clocks;
  p.passes = passes, p.accesses = accesses, p.renderings = renderings, p.attachments = attachments;
  p.shaders = shaders, p.pipelines = pipelines, p.pipeline_shaders = pipeline_shaders, p.blends = blends;
  p.sample_locations = sample_locations;
  p.vertex_buffers = vertex_buffers, p.vertex_bindings = vertex_bindings, p.vertex_attributes = vertex_attributes, p.bindings = bindings,
  p.samplers = samplers;
  p.params = params, p.pass_params = pass_params;
  p.features = features, p.pass_features = pass_features, p.pipeline_choices = pipeline_choices;
  p.transfers = transfers, p.mip_limits = mip_limits;
  p.engine_sets = engine_sets, p.conditions = conditions, p.feature_conditions = feature_conditions, p.needs = needs, p.culled = culled;
  p.estimated_heap_bytes = estimated_heap_bytes;
  return p;
}

std::string_view intern(std::string_view text) {
  static std::mutex mutex;
  static std::set<std::string, std::less<>> pool;  // nodes never move
  const std::lock_guard lock(mutex);
  const auto found = pool.find(text);
  return found != pool.end() ? *found : *pool.emplace(text).first;
}

}  // namespace rg
