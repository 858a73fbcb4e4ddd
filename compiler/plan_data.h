// A plan that owns its tables: what the planner builds, the checker mutates and code generation prints.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/plan.h"

namespace rg {

// Same fields as Plan, as vectors. Copyable; strings are interned in a shared-nothing deque that is never shrunk, so a copy
// keeps views into the *source's* pool: keep the original alive, or call `intern` again.
struct PlanData {
  // Not inline: in each file that includes this, copying so many tables would take long to compile.
  PlanData();
  PlanData(const PlanData&);
  PlanData(PlanData&&) noexcept;
  PlanData& operator=(const PlanData&);
  PlanData& operator=(PlanData&&) noexcept;
  ~PlanData();

  uint32_t version = kPlanVersion;
  std::string_view name;
  uint32_t variant = 0, variant_count = 1;
  std::string_view variant_name;
  std::vector<Expr> exprs;
  std::vector<Extent> extents;
  std::vector<Resource> resources;
  std::vector<Queue> queues;
  std::vector<Batch> batches;
  std::vector<Step> steps;
  std::vector<Wait> waits;
  std::vector<Signal> signals;
  std::vector<BarrierGroup> groups;
  std::vector<MemoryBarrier> memory_barriers;
  std::vector<ImageBarrier> image_barriers;
  std::vector<BufferBarrier> buffer_barriers;
  std::vector<Boundary> entry, exit;
  std::vector<Acquire> acquires;
  std::vector<Release> releases;
  std::vector<Index> alias_clocks;
  std::vector<Pass> passes;
  std::vector<Access> accesses;
  std::vector<Rendering> renderings;
  std::vector<Attachment> attachments;
  std::vector<ShaderModule> shaders;
  std::vector<Pipeline> pipelines;
  std::vector<Index> pipeline_shaders;
  std::vector<ColorBlend> blends;
  std::vector<VertexBuffer> vertex_buffers;
  std::vector<VertexBinding> vertex_bindings;
  std::vector<VertexAttribute> vertex_attributes;
  std::vector<SampleLocation> sample_locations;
  std::vector<Binding> bindings;
  std::vector<Sampler> samplers;
  std::vector<Params> params;
  std::vector<Index> pass_params;
  std::vector<Feature> features;
  std::vector<Index> pass_features;
  std::vector<Index> pipeline_choices;
  std::vector<Transfer> transfers;
  std::vector<MipLimit> mip_limits;
  std::vector<EngineSet> engine_sets;
  std::vector<std::string_view> conditions;
  std::vector<FeatureCondition> feature_conditions;
  std::vector<Capability> needs;
  std::vector<Culled> culled;
  uint64_t estimated_heap_bytes = 0;

  // Which program pass each plan pass came from (same order as `passes`); the checker and reports use it.
  std::vector<uint32_t> program_pass;
  // Which program resource each plan resource came from.
  std::vector<uint32_t> program_resource;

  // The same plan as spans into this object; valid while it lives and is not changed.
  Plan view() const;
};

// Process-wide immutable string pool: the returned view lives for ever. For names in plans built in process.
std::string_view intern(std::string_view text);

}  // namespace rg
