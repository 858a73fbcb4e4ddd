// Memory that changes hands: which barriers a placement needs beyond those of the plan.
//
//   bytes   ..a..a..|        |..c..c     acquire of c takes bytes over from a and b: their last users must have finished, their
//           ..b.....|        |..c..c     writes be available. Whoever held a byte last counts; who held it before that was waited for then.
//   group           g        acquire of c
//
// Which transients may share bytes at all is said by points and clocks (see Release and Plan::alias_clocks): two of them, if in one frame the last
// users of the one have completed before the other is acquired, and the other's before the one is acquired again in the next frame. All of that
// follows from waits and queue order that the plan has anyway.
//
// The sweep runs twice over the frame, so that the first acquires of a frame find the last holders of the frame before.
//
// How to record a hand-off (the form that validation layers accept and the specification asks for): in the *same* vkCmdPipelineBarrier2
//   1. one global memory barrier, Patch::memory, for all hand-offs of the group, and
//   2. in each image barrier of ImagePatch, whose old layout is undefined, the same first scope added to its own.
//
// Header only; the compiler's reports and the runtime decide with the same code. Allocates: call it at creation and resize, never per frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <vector>

#include "runtime/plan.h"

namespace rg::alias {

struct Placed {  // bytes 0: not in the shared heap
  uint64_t offset = 0, bytes = 0;
};
struct GroupPatch {
  Index group = kNone;
  MemoryBarrier memory;  // tag alias_pair
};
struct ImagePatch {  // adds to the first scope of image_barriers[first .. first + count)
  Index first = kNone;
  uint32_t count = 0;
  Stages src_stages = 0;
  Accesses src_accesses = 0;
};
struct HandOffs {
  std::vector<GroupPatch> groups;  // ascending, one a group
  std::vector<ImagePatch> images;
};

// Groups between which a transient holds memory, as the executor meets them: [first group before a use, last group before a use].
// Indexed by plan resource; begin > end: not used. Needs Plan::steps, passes and accesses only.
struct GroupInterval {
  Index begin = kNone, end = 0;
  bool used() const { return begin <= end; }
};
inline std::vector<GroupInterval> group_intervals(const Plan& plan) {
  std::vector<GroupInterval> result(plan.resources.size());
  Index group = 0;
  for (const Step& step : plan.steps) {
    if (step.kind != StepKind::pass) {
      if (step.kind == StepKind::barriers && plan.groups[step.index].event == kNone) group = step.index;
      continue;
    }
    const Pass& pass = plan.passes[step.index];
    for (const Access& access : plan.accesses.subspan(pass.first_access, pass.access_count)) {
      GroupInterval& interval = result[access.ref.resource];
      interval.begin = std::min(interval.begin, group), interval.end = std::max(interval.end, group);
    }
  }
  for (const Acquire& acquire : plan.acquires) result[acquire.resource].begin = std::min(result[acquire.resource].begin, acquire.group);
  return result;
}

// Answers for one plan, which outlives it. O(resources + releases) to make.
class Sharing {
 public:
  explicit Sharing(const Plan& plan) : plan_(plan), first_release_(plan.resources.size() + 1), acquires_(plan.resources.size(), nullptr) {
    for (const Release& release : plan.releases) ++first_release_[release.resource + 1];
    for (size_t i = 1; i < first_release_.size(); ++i) first_release_[i] += first_release_[i - 1];
    releases_.resize(plan.releases.size());
    std::vector<uint32_t> next(first_release_.begin(), first_release_.end() - 1);
    for (const Release& release : plan.releases) releases_[next[release.resource]++] = &release;
    for (const Acquire& acquire : plan.acquires) acquires_[acquire.resource] = &acquire;
  }

  std::span<const Release* const> releases(Index resource) const {
    return {releases_.data() + first_release_[resource], releases_.data() + first_release_[resource + 1]};
  }
  const Acquire* acquire(Index resource) const { return acquires_[resource]; }  // nullptr: never shares

  // The last users of `before` have completed when `after` is acquired: in the same frame, or (`wraps`) in the next one.
  bool may_follow(Index before, Index after, bool wraps) const {
    if (before == after || !can_share(before) || !can_share(after)) return false;
    const size_t first = acquires_[after]->first_clock + (wraps ? plan_.queues.size() : 0);
    for (const Release* release : releases(before)) {
      const Index clock = plan_.alias_clocks[first + release->queue];
      if (clock == kNone || clock < release->point) return false;
    }
    return true;
  }
  // Bytes may go to and fro between the two.
  bool may_share(Index a, Index b) const {
    return (may_follow(a, b, false) && may_follow(b, a, true)) || (may_follow(b, a, false) && may_follow(a, b, true));
  }

 private:
  bool can_share(Index resource) const {
    return !plan_.resources[resource].no_alias && acquires_[resource] && acquires_[resource]->first_clock != kNone && !releases(resource).empty();
  }

  const Plan& plan_;
  std::vector<uint32_t> first_release_;  // by resource, one more at the end
  std::vector<const Release*> releases_;
  std::vector<const Acquire*> acquires_;
};

// One question about one plan.
inline bool may_follow(const Plan& plan, Index before, Index after, bool wraps) { return Sharing(plan).may_follow(before, after, wraps); }

namespace detail {

// Who held each byte last.
class Owners {
 public:
  // Gives [offset, offset + bytes) to `owner`; visits every other owner of a part of it.
  template <class Visit>
  void take(uint64_t offset, uint64_t bytes, Index owner, Visit visit) {
    const uint64_t end = offset + bytes;
    auto at = parts_.upper_bound(offset);
    if (at != parts_.begin() && std::prev(at)->second.end > offset) --at;
    while (at != parts_.end() && at->first < end) {
      const uint64_t part_begin = at->first;
      const Part part = at->second;
      if (part.owner != owner) visit(part.owner);
      at = parts_.erase(at);
      if (part_begin < offset) parts_[part_begin] = {offset, part.owner};
      if (part.end > end) parts_[end] = {part.end, part.owner};
    }
    parts_[offset] = {end, owner};
  }

 private:
  struct Part {
    uint64_t end = 0;
    Index owner = kNone;
  };
  std::map<uint64_t, Part> parts_;
};

}  // namespace detail

// `placed` by plan resource. Pre-condition: resources that share bytes may, see Sharing. Users on other queues have completed by then, by a wait of
// the plan; what the acquire's barrier chains on is the wait's stages, which cover those of the first users. O(n log n + overlaps).
inline void find_hand_offs(const Plan& plan, std::span<const Placed> placed, HandOffs& out) {
  out.groups.clear(), out.images.clear();
  const Sharing sharing(plan);
  std::vector<const Acquire*> in_order;
  for (const Acquire& acquire : plan.acquires) in_order.push_back(&acquire);
  std::stable_sort(in_order.begin(), in_order.end(), [](const Acquire* a, const Acquire* b) { return a->group < b->group; });

  detail::Owners owners;
  for (const bool emit : {false, true}) {
    for (const Acquire* acquire : in_order) {
      const Placed& place = placed[acquire->resource];
      if (place.bytes == 0) continue;
      Stages stages = 0;
      Accesses accesses = 0;
      owners.take(place.offset, place.bytes, acquire->resource, [&](Index before) {
        for (const Release* release : sharing.releases(before)) {
          const bool same_queue = release->queue == acquire->queue;
          stages |= same_queue ? release->stages : acquire->stages, accesses |= same_queue ? release->accesses : 0;
        }
      });
      if (!emit || stages == 0) continue;
      if (out.groups.empty() || out.groups.back().group != acquire->group)
        out.groups.push_back({acquire->group, {0, 0, 0, 0, BarrierTag::alias_pair}});
      MemoryBarrier& memory = out.groups.back().memory;
      memory.src_stages |= stages, memory.src_accesses |= accesses;
      memory.dst_stages |= acquire->stages, memory.dst_accesses |= acquire->accesses;
      if (acquire->image_barriers > 0) out.images.push_back({acquire->image_barrier, acquire->image_barriers, stages, accesses});
    }
  }
}

}  // namespace rg::alias
