#include "runtime/turns.h"

#include <algorithm>
#include <bit>

#include "runtime/errors.h"
#include "runtime/pass_tables.h"
#include "runtime/record_rows.h"
#include "runtime/resolve.h"
#include "runtime/resources.h"
#include "runtime/submit.h"
#include "runtime/transfers.h"

namespace rg {

namespace {

Index find_kept(const GraphInstance::State& state, const std::shared_ptr<Kept>& kept) {
  const auto& all = state.sized->kept;
  const auto found = std::find(all.begin(), all.end(), kept);
  return found == all.end() ? kNone : static_cast<Index>(found - all.begin());
}

// Marks what the two share. What only this one has has seen no frame of the other.
Status mark_shared(GraphInstance::State& state, const GraphInstance::State& other) {
  const Carried from{other.context.plan, *other.sized, other.context};
  Sized& sized = *state.sized;
  for (Index r = 0; r < sized.kept.size(); ++r) {
    sized.carried[r] = false;
    if (sized.kept[r] == nullptr) continue;
    const Index before = find_kept(other, sized.kept[r]);
    if (before == kNone) {
      sized.kept[r]->valid_since = other.frame;
      continue;
    }
    if (!from.may_carry(state.context, r, before))
      return Error{ErrorCode::invalid_argument, "`" + std::string(state.context.plan.resources[r].name) +
                                                    "` lies between frames where this plan does not find it; make a successor instead"};
    sized.carried[r] = true;
  }
  return Done{};
}

bool layouts_differ(const GraphInstance::State& state, const GraphInstance::State& other) {
  for (const Boundary& row : state.context.plan.entry) {
    if (!state.sized->carried[row.ref.resource] || row.discard || row.layout == Layout::undefined) continue;
    const VkImageSubresourceRange range = image_range(state.context, *state.sized, row.ref.resource, row.range);
    const Index before = find_kept(other, state.sized->kept[row.ref.resource]);
    if (range.levelCount != 0 &&
        layout_between_frames(other.context.plan, {before, row.ref.age}, range.aspectMask, range.baseMipLevel, range.baseArrayLayer) != row.layout)
      return true;
  }
  return false;
}

}  // namespace

Status follow(GraphInstance::State& state, const GraphInstance::State& other) {
  RG_TRY(mark_shared(state, other));
  state.frame = other.frame;
  state.entry_waits.clear();
  wait_at_entry(state, other.timelines, other.submitted);
  state.has_turn = state.context.heap != nullptr && state.context.heap->last_user == &other;
  if (!layouts_differ(state, other)) return Done{};
  state.sized->carried_from = &other.context.plan;
  state.sized->carried_only = true;
  const Status submitted = submit_prologue(state, *state.sized);
  state.sized->carried_from = nullptr;
  state.sized->carried_only = false;
  return submitted;
}

// ---- active extents -------------------------------------------------------------------------------------------------

namespace {

// The plan's sizes at the active extents stand in for the placed ones while `work` runs.
template <class Work>
void at_active_sizes(const Context& context, Sized& sized, std::span<const int64_t> extents, Work work) {
  std::copy(extents.begin(), extents.end(), sized.active_extents.begin());
  std::swap(sized.extents, sized.active_extents);
  evaluate_again(context, sized);
  active_extents_of_images(context, sized);
  for (size_t r = 0; r < sized.resources.size(); ++r) std::swap(sized.resources[r].extent, sized.active[r]);
  work();
  for (size_t r = 0; r < sized.resources.size(); ++r) std::swap(sized.resources[r].extent, sized.active[r]);
  std::swap(sized.extents, sized.active_extents);
  evaluate_again(context, sized);
}

}  // namespace

void activate(const Context& context, const Objects& objects, Sized& sized, std::span<const int64_t> extents) {
  sized.active_extents.resize(extents.size());
  at_active_sizes(context, sized, extents, [&] {
    for (size_t p = 0; p < sized.passes.size(); ++p) resize_pass(context, sized, static_cast<Index>(p));
    choose_step_rows(objects, sized);
  });
}

}  // namespace rg
