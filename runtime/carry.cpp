// What an instance may take over from the one before it.
#include "runtime/queues.h"
#include "runtime/resolve.h"
#include "runtime/resources.h"

namespace rg {

namespace {

bool contains(const Range& range, uint32_t aspects, uint32_t mip, uint32_t layer) {
  const bool mips = mip >= range.mip && (range.mips == kRemaining || mip - range.mip < range.mips);
  const bool layers = layer >= range.layer && (range.layers == kRemaining || layer - range.layer < range.layers);
  return mips && layers && (range.aspects == 0 || (range.aspects & aspects) != 0);
}

// The family that owns the resource between frames; families differ from row to row only in resources that are shared.
uint32_t owner_of(const Context& context, Index resource) {
  if (context.plan.resources[resource].concurrent) return context.queues.families[0];
  for (const Boundary& row : context.plan.entry)
    if (row.ref.resource == resource && row.queue != kNone) return family_of(context, row.queue);
  return context.queues.families[0];
}

// All subresources of a row lie in one layout of the plan before.
bool one_layout(const Plan& before, Index resource_before, const Boundary& row, const VkImageSubresourceRange& range) {
  const Ref ref{resource_before, row.ref.age};
  const Layout first = layout_between_frames(before, ref, range.aspectMask, range.baseMipLevel, range.baseArrayLayer);
  for (uint32_t mip = range.baseMipLevel; mip < range.baseMipLevel + range.levelCount; ++mip)
    for (uint32_t layer = range.baseArrayLayer; layer < range.baseArrayLayer + range.layerCount; ++layer)
      if (layout_between_frames(before, ref, range.aspectMask, mip, layer) != first) return false;
  return true;
}

}  // namespace

Layout layout_between_frames(const Plan& plan, Ref ref, uint32_t aspects, uint32_t mip, uint32_t layer) {
  for (const Boundary& row : plan.entry)
    if (row.ref == ref && contains(row.range, aspects, mip, layer)) return row.discard ? Layout::undefined : row.layout;
  return Layout::undefined;
}

bool Carried::may_carry(const Context& now, Index resource, Index before) const {
  const uint32_t owner = owner_of(now, resource), home = now.queues.families[0];
  if (owner != owner_of(context, before)) return false;
  if (now.plan.resources[resource].kind == ResourceKind::buffer) return true;
  for (const Boundary& row : now.plan.entry) {
    if (row.ref.resource != resource || row.discard || row.layout == Layout::undefined) continue;
    const VkImageSubresourceRange range = image_range(context, sized, before, row.range);
    if (range.levelCount == 0) continue;
    const Layout layout = layout_between_frames(plan, {before, row.ref.age}, range.aspectMask, range.baseMipLevel, range.baseArrayLayer);
    if (layout == Layout::undefined || !one_layout(plan, before, row, range) || (layout != row.layout && owner != home)) return false;
  }
  return true;
}

}  // namespace rg
