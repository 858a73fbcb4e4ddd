// Builds a program and a plan for it side by side, line by line in execution order. Plans are written by hand here: what the planner
// would do is not asked.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "compiler/verify/verify.h"
#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::verify {

// Tables of a plan that can be changed, and the plan as spans into them.
struct PlanTables {
  std::vector<Expr> exprs;
  std::vector<Resource> resources;
  std::vector<Queue> queues{{}};
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
  std::vector<Transfer> transfers;
  std::vector<VertexBuffer> vertex_buffers;
  std::vector<std::string_view> conditions;
  std::vector<uint32_t> program_pass, program_resource;
  Plan view() const;
};

// One access of a pass. The helpers below make them.
struct Do {
  dsl::ResourceId resource;
  dsl::Mode mode = dsl::Mode::read;
  dsl::Role role = dsl::Role::storage;
  uint32_t stages = 0;
  Layout layout = Layout::undefined;  // undefined: the usual one of the role
  LoadOp load = LoadOp::load;
  StoreOp store = StoreOp::store;
  dsl::Range range = {};
  uint32_t age = 0;
  bool clear = false, covers = false, disjoint = false;

  Do in(Layout other) const {
    Do d = *this;
    return d.layout = other, d;
  }
  Do with(LoadOp l, StoreOp s = StoreOp::store) const {
    Do d = *this;
    return d.load = l, d.store = s, d;
  }
  Do cleared() const {
    Do d = *this;
    return d.clear = true, d.load = LoadOp::clear, d;
  }
  Do covering() const {
    Do d = *this;
    return d.covers = true, d.load = LoadOp::dont_care, d;
  }
  Do mip(uint32_t m) const {
    Do d = *this;
    return d.range.mip = m, d.range.mips = 1, d;
  }
  Do layer(uint32_t l) const {
    Do d = *this;
    return d.range.layer = l, d.range.layers = 1, d;
  }
  Do prev(uint32_t k) const {
    Do d = *this;
    return d.age = k, d;
  }
  Do apart() const {
    Do d = *this;
    return d.disjoint = true, d;
  }
};

struct Builder {
  dsl::Program program;
  PlanTables plan;
  std::deque<std::string> names;
  std::vector<uint32_t> configuration;

  Builder();
  dsl::Graph& graph() { return program.graphs.rows[0]; }

  // Resources that come in free of any pending access, with worthless contents, and leave in any state.
  dsl::ResourceId buffer(const std::string& name, int64_t bytes = 1024);
  dsl::ResourceId image(const std::string& name, dsl::Format format = dsl::Format::rgba16f, uint32_t mips = 1, uint32_t layers = 1);
  dsl::Resource& source(dsl::ResourceId id) { return graph().resources[id]; }
  Resource& planned(dsl::ResourceId id) { return plan.resources[id.value]; }
  // Another lifetime, and the boundary rows that go with it; `state` of an age at entry, `left` at exit.
  void lifetime(dsl::ResourceId id, dsl::Lifetime lifetime, uint32_t history = 0);
  void boundary(dsl::ResourceId id, Boundary entry, Boundary exit);

  dsl::PassId pass(dsl::PassKind kind, const std::string& name, const std::vector<Do>& accesses);
  dsl::PassId compute(const std::string& name, const std::vector<Do>& a) { return pass(dsl::PassKind::compute, name, a); }
  dsl::PassId raster(const std::string& name, const std::vector<Do>& a) { return pass(dsl::PassKind::raster, name, a); }
  dsl::PassId transfer(const std::string& name, const std::vector<Do>& a) { return pass(dsl::PassKind::transfer, name, a); }
  // The last pass belongs to the rendering of the one before.
  void merge_rendering();
  void condition(dsl::PassId pass, const std::string& name);

  // Without these calls there is one batch on queue 0. Passes are permitted on the queue of the batch they are in.
  Index queue(QueueKind kind);
  void batch(Index queue);
  void wait(Index queue, uint64_t value, Stages stages, uint32_t frames_ago = 0);  // before anything is recorded in the batch
  void signal(Stages stages);                                                      // the next value of the batch's queue, after all is recorded
  // Halves of a transfer from the queue of the batch `give` is in to that of `take`; the range is the whole image or buffer.
  void give(dsl::ResourceId id, Index to, Layout from_layout, Layout to_layout, Stages s, Accesses sa, Stages d);
  void take(dsl::ResourceId id, Index from, Layout from_layout, Layout to_layout, Stages s, Stages d, Accesses da);

  // A barrier alone in its group; the group of the last call where `join`.
  void memory(Stages s, Accesses sa, Stages d, Accesses da, bool join = false);
  void image_barrier(dsl::ResourceId id, Layout from, Layout to, Stages s, Accesses sa, Stages d, Accesses da, Range range = {}, bool join = false);
  void buffer_barrier(dsl::ResourceId id, Stages s, Accesses sa, Stages d, Accesses da, bool join = false);
  // From undefined, waiting for nothing.
  void start(dsl::ResourceId id, Layout to, Stages d, Accesses da) { image_barrier(id, Layout::undefined, to, 0, 0, d, da); }

  // The group of the last barrier becomes split: where it stood its event is set. Gives the group.
  Index split();
  void await(Index group) { plan.steps.push_back({StepKind::barriers, group}); }

  Index constant(int64_t value);
  dsl::ExprId program_constant(int64_t value);
  Plan view();
  std::vector<Finding> check(bool irredundancy = false);
  std::vector<std::string> hazards(bool irredundancy = false);  // names of the kinds found, sorted, each once

 private:
  void close_batch();
  void end_anywhere();
  void transfer_barrier(dsl::ResourceId id, Index from, Index to, Layout from_layout, Layout to_layout, const MemoryBarrier& masks);
  BarrierGroup& open_group(bool join);
};

Do reads(dsl::ResourceId id, dsl::Role role = dsl::Role::storage, uint32_t stages = 0);
Do writes(dsl::ResourceId id, dsl::Role role = dsl::Role::storage, uint32_t stages = 0);
Do updates(dsl::ResourceId id, dsl::Role role = dsl::Role::storage, uint32_t stages = 0);
Do counts(dsl::ResourceId id, uint32_t stages = 0);  // atomic

}  // namespace rg::verify
