#include "compiler/machine/timeline.h"

namespace rg::machine {
namespace {

bool within(Stages stages, Stages scope) { return (stages & ~scope) == 0; }

// Within a pass: the hardware reads a resource before it writes it, and completes a write after it began.
bool ordered_in_pass(const Event& a, const Event& b) {
  if (a.resource != b.resource) return false;
  return (a.kind == EventKind::read && b.kind == EventKind::write) || (a.partial && b.kind == EventKind::write && !b.partial);
}

// Transitions of a command follow what its memory barriers make available, where both wait for the same work.
bool ordered_in_group(const Event& a, const Event& b) { return a.resource == kNone && b.image && (a.src & b.src) != 0; }

// What the engine brings is there for those who read it as it comes.
bool is_brought_for(const Event& a, const Event& b) {
  return a.kind == EventKind::bring && !a.pending && a.dst_agents.any() && a.resource == b.resource && b.kind == EventKind::read &&
         within(b.stages, a.stages);
}

bool precedes(const Event& a, const Event& b, bool same_group) {
  if (a.queue != b.queue) return false;
  if (is_brought_for(a, b)) return true;
  const bool from_barrier = a.kind == EventKind::barrier, to_barrier = b.kind == EventKind::barrier;
  if (from_barrier && to_barrier)
    return same_group ? ordered_in_group(a, b) : (a.dst & b.src) != 0 || (b.all_commands && (a.image || a.half != Half::none));
  if (from_barrier) return b.stages != 0 && within(b.stages, a.dst);
  if (to_barrier) return within(a.stages, b.src);
  // Attachment work of one rendering happens in rasterization order.
  if (a.rendering != 0 && a.rendering == b.rendering && a.frame == b.frame && a.pass != b.pass) return true;
  return a.pass != kNone && a.pass == b.pass && a.frame == b.frame && ordered_in_pass(a, b);
}

}  // namespace

Predecessors find_order(const Timeline& timeline) {
  Predecessors predecessors(timeline.events.size());
  for (uint32_t b = 0; b < timeline.events.size(); ++b) {
    const Event& later = timeline.events[b];
    predecessors[b] = later.after;
    for (uint32_t a = 0; a < b; ++a) {
      const Event& earlier = timeline.events[a];
      const bool same_group = earlier.group != kNone && earlier.frame == later.frame && earlier.group == later.group;
      if (later.after_all || earlier.before_all || precedes(earlier, later, same_group)) predecessors[b].push_back(a);
    }
  }
  return predecessors;
}

}  // namespace rg::machine
