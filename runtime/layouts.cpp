#include "runtime/layouts.h"

namespace rg {

namespace {

bool contains(const Range& range, uint32_t aspect, uint32_t mip, uint32_t layer) {
  const bool in_mips = mip >= range.mip && (range.mips == kRemaining || mip - range.mip < range.mips);
  const bool in_layers = layer >= range.layer && (range.layers == kRemaining || layer - range.layer < range.layers);
  return in_mips && in_layers && (range.aspects == 0 || (range.aspects & aspect) != 0);
}

}  // namespace

Layout layout_at(const Plan& plan, Index pass, Ref ref, uint32_t aspect, uint32_t mip, uint32_t layer) {
  Layout layout = Layout::undefined;
  for (const Boundary& boundary : plan.entry)
    if (boundary.ref == ref && contains(boundary.range, aspect, mip, layer)) layout = boundary.layout;
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::pass && step.index == pass) break;
    if (step.kind != StepKind::barriers) continue;
    const BarrierGroup& group = plan.groups[step.index];
    for (const ImageBarrier& barrier : plan.image_barriers.subspan(group.first_image, group.image_count))
      if (barrier.image == ref && contains(barrier.range, aspect, mip, layer)) layout = barrier.new_layout;
  }
  return layout;
}

Layout depth_part(Layout layout) {
  switch (layout) {
    case Layout::depth_stencil_attachment:
    case Layout::depth_attachment_stencil_read_only:
      return Layout::depth_attachment;
    case Layout::depth_stencil_read_only:
    case Layout::depth_read_only_stencil_attachment:
      return Layout::depth_read_only;
    default:
      return layout;
  }
}

Layout stencil_part(Layout layout) {
  switch (layout) {
    case Layout::depth_stencil_attachment:
    case Layout::depth_read_only_stencil_attachment:
      return Layout::stencil_attachment;
    case Layout::depth_stencil_read_only:
    case Layout::depth_attachment_stencil_read_only:
      return Layout::stencil_read_only;
    default:
      return layout;
  }
}

}  // namespace rg
