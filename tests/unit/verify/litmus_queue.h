// What litmus cases on several queues have in common. Queue 0 is graphics, queue 1 compute.
#pragma once

#include "tests/unit/verify/litmus.h"

namespace rg::verify {

inline constexpr Stages kCs = stage::compute_shader, kFragment = stage::fragment_shader, kAll = stage::all_commands;
inline constexpr Accesses kRead = access::shader_storage_read, kWrite = access::shader_storage_write;
inline constexpr Index kGraphics = 0, kCompute = 1;

// Used by both queues without transfers.
inline dsl::ResourceId shared(Builder& b, const std::string& name) {
  const auto id = b.buffer(name);
  b.planned(id).concurrent = true;
  return id;
}

inline Boundary state(Index queue, Stages stages, Accesses accesses, Layout layout = Layout::undefined) {
  Boundary row;
  row.stages = stages, row.accesses = accesses, row.layout = layout, row.queue = queue;
  return row;
}

// A batch that writes `x` in compute and signals.
inline void write_on(Builder& b, Index queue, dsl::ResourceId x, Stages signal = kCs) {
  b.batch(queue);
  b.compute("w", {writes(x)});
  b.signal(signal);
}
// The last batch of every queue signals.
inline void end_on(Builder& b, Index queue) {
  b.batch(queue);
  b.signal(kAll);
}
inline void read_on(Builder& b, Index queue, dsl::ResourceId x) {
  b.batch(queue);
  b.compute("r", {reads(x)});
  b.signal(kAll);
}

// Persistent from frame to frame, pending on one queue.
inline void keep(Builder& b, dsl::ResourceId id, const Boundary& at) {
  b.lifetime(id, dsl::Lifetime::persistent);
  b.boundary(id, at, at);
}

// `x` is written on the compute queue and sampled on the graphics queue, after a transfer.
inline dsl::ResourceId moved_image(Builder& b, Layout given = Layout::general, Layout taken = Layout::general) {
  b.queue(QueueKind::compute);
  const auto x = b.image("x");
  b.batch(kCompute);
  b.start(x, Layout::general, kCs, kWrite);
  b.compute("w", {writes(x)});
  b.give(x, kGraphics, given, Layout::shader_read_only, kCs, kWrite, kCs);
  b.signal(kCs);
  b.batch(kGraphics);
  b.wait(kCompute, 1, kFragment);
  b.take(x, kCompute, taken, Layout::shader_read_only, kFragment, kFragment, ac::shader_sampled_read);
  b.raster("r", {reads(x, Role::sampled, kFs)});
  b.signal(kAll);
  return x;
}

// `a` on the compute queue, then `c` on the graphics queue in the same memory, and `a` again in the next frame.
inline void shared_memory(Builder& b, Stages signal = kCs, Stages wait = kCs, bool waits_for_frame_before = true) {
  b.queue(QueueKind::compute);
  const auto a = shared(b, "a"), c = shared(b, "c");
  for (const auto id : {a, c}) {
    b.lifetime(id, dsl::Lifetime::transient);
    const Boundary at = state(id == a ? kCompute : kGraphics, kCs, kWrite);
    b.boundary(id, at, at);
    b.plan.entry.back().discard = b.plan.exit.back().discard = true;
    b.planned(id).estimated_bytes = 1024;
  }
  b.batch(kCompute);
  if (waits_for_frame_before) b.wait(kGraphics, 1, kCs, 1);
  b.memory(kCs, kWrite, kCs, kWrite);
  b.compute("wa", {writes(a)});
  b.signal(signal);
  b.batch(kGraphics);
  b.wait(kCompute, 1, wait);
  b.memory(kCs, kWrite, kCs, kWrite);
  b.compute("wc", {writes(c)});
  b.signal(kAll);
  end_on(b, kCompute);
  // Points: queue 1 has its group and two ends of batches, queue 0 its group and one end.
  b.plan.acquires = {{a.value, 0, kNone, 0, kCs, kWrite, kCompute, 0, 0}, {c.value, 1, kNone, 0, kCs, kWrite, kGraphics, 0, 4}};
  b.plan.releases = {{a.value, kCs, kWrite, kCompute, 1}, {c.value, kCs, kWrite, kGraphics, 1}};
  b.plan.alias_clocks = {kNone, 0, 1, 2, 0, 1, 1, 1};
}

}  // namespace rg::verify
