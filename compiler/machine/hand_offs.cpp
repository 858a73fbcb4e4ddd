#include "compiler/machine/hand_offs.h"

#include "runtime/alias.h"

namespace rg::machine {

PatchedPlan::PatchedPlan(const Plan& plan, const std::vector<Placement>& placement)
    : plan_(plan),
      groups_(plan.groups.begin(), plan.groups.end()),
      memory_barriers_(plan.memory_barriers.begin(), plan.memory_barriers.end()),
      image_barriers_(plan.image_barriers.begin(), plan.image_barriers.end()) {
  if (placement.empty()) return;
  std::vector<alias::Placed> placed;
  for (const Placement& place : placement) placed.push_back({place.offset, place.bytes});
  alias::HandOffs hand_offs;
  alias::find_hand_offs(plan, placed, hand_offs);
  for (const alias::GroupPatch& patch : hand_offs.groups) {
    BarrierGroup& group = groups_[patch.group];
    const std::vector<MemoryBarrier> own(memory_barriers_.begin() + group.first_memory,
                                         memory_barriers_.begin() + group.first_memory + group.memory_count);
    group.first_memory = static_cast<Index>(memory_barriers_.size());
    ++group.memory_count;
    memory_barriers_.insert(memory_barriers_.end(), own.begin(), own.end());
    memory_barriers_.push_back(patch.memory);
  }
  for (const alias::ImagePatch& patch : hand_offs.images)
    for (uint32_t i = 0; i < patch.count; ++i) {
      image_barriers_[patch.first + i].src_stages |= patch.src_stages;
      image_barriers_[patch.first + i].src_accesses |= patch.src_accesses;
    }
  plan_.groups = groups_;
  plan_.memory_barriers = memory_barriers_;
  plan_.image_barriers = image_barriers_;
}

}  // namespace rg::machine
