// Frames of a few passes, program and plan side by side, written by hand.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "compiler/machine/machine.h"
#include "compiler/plan_data.h"
#include "dsl/program.h"

namespace rg::test {

struct Use {
  uint32_t resource = 0;
  dsl::Mode mode = dsl::Mode::read;
  dsl::Role role = dsl::Role::storage;
  Layout layout = Layout::undefined;  // images
  uint32_t age = 0;
  bool clear = false;  // attachments
};

inline Use reads(uint32_t resource, uint32_t age = 0) { return {.resource = resource, .age = age}; }
inline Use writes(uint32_t resource) { return {.resource = resource, .mode = dsl::Mode::write}; }
inline Use updates(uint32_t resource) { return {.resource = resource, .mode = dsl::Mode::update}; }
inline Use adds(uint32_t resource) { return {.resource = resource, .mode = dsl::Mode::atomic}; }
inline Use samples(uint32_t image) { return {image, dsl::Mode::read, dsl::Role::sampled, Layout::shader_read_only}; }
inline Use stores(uint32_t image) { return {image, dsl::Mode::write, dsl::Role::storage, Layout::general}; }
inline Use colors(uint32_t image, bool clear) { return {image, dsl::Mode::write, dsl::Role::color, Layout::color_attachment, 0, clear}; }

// Steps run in the order added, in one batch of one queue. Buffers hold 64 bytes, images one mip and one layer.
class TinyFrame {
 public:
  TinyFrame();
  uint32_t buffer(const std::string& name, dsl::Lifetime lifetime = dsl::Lifetime::transient, uint32_t history = 0);
  uint32_t image(const std::string& name, dsl::Lifetime lifetime = dsl::Lifetime::transient);
  dsl::Resource& declared(uint32_t resource) { return graph().resources.rows[resource]; }

  uint32_t compute(const std::string& name, std::initializer_list<Use> uses) { return pass(name, dsl::PassKind::compute, uses); }
  uint32_t pass(const std::string& name, dsl::PassKind kind, std::initializer_list<Use> uses);
  void memory(const MemoryBarrier& barrier);  // a group of its own
  void images(std::initializer_list<ImageBarrier> barriers);
  void group(std::initializer_list<MemoryBarrier> memory, std::initializer_list<ImageBarrier> images);
  void boundary(const Boundary& state);  // at entry and exit

  // The first use of anything waits for what compute did the frame before.
  void after_last_frame() { memory({.src_stages = stage::compute_shader, .dst_stages = stage::compute_shader}); }

  std::vector<machine::Divergence> run(const machine::MachineOptions& options = {}) const;

  PlanData plan;
  dsl::Program program;

 private:
  dsl::Graph& graph() { return program.graphs.rows[0]; }
  uint32_t add(dsl::Resource resource);
  void add_rendering(const std::vector<Use>& uses);
};

// `storage` writes of compute shaders become visible to their storage reads.
inline MemoryBarrier compute_to_compute() {
  return {stage::compute_shader, access::shader_storage_write, stage::compute_shader, access::shader_storage_read, BarrierTag::hazard};
}
inline ImageBarrier transition(uint32_t image, Layout from, Layout to, const MemoryBarrier& scope) {
  ImageBarrier barrier;
  barrier.image = {image, 0};
  barrier.src_stages = scope.src_stages, barrier.src_accesses = scope.src_accesses;
  barrier.dst_stages = scope.dst_stages, barrier.dst_accesses = scope.dst_accesses;
  barrier.old_layout = from, barrier.new_layout = to;
  return barrier;
}

}  // namespace rg::test
