// From references of the plan to Vulkan objects at given extents and a given frame. No allocation: also called while recording.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Fills `values`: each node once, so that shared operands cost nothing.
void evaluate_all(const Context& context, Sized& sized);

// The same with other extents; allocates nothing.
void evaluate_again(const Context& context, Sized& sized);

inline int64_t evaluate(const Context&, const Sized& sized, Index expr) { return expr == kNone ? 1 : sized.values[expr]; }

// Bytes of `resource`; `bytes` kNone reaches to the end.
ByteRange byte_range(const Context& context, const Sized& sized, const Bytes& bytes);

// A range with counts in place of kRemaining, clamped to the mips and layers that exist. `levelCount` 0: nothing is left.
VkImageSubresourceRange image_range(const Context& context, const Sized& sized, Index resource, const Range& range);

// How many different physical copies a reference names over the frames; imports count 1.
uint32_t copies_of(const Sized& sized, Index resource);

VkImage image_at(const Sized& sized, const std::vector<Import>& imports, const Plan& plan, Ref ref, uint64_t frame);
BufferSpan buffer_at(const Sized& sized, const std::vector<Import>& imports, const Plan& plan, Ref ref, const ByteRange& bytes, uint64_t frame);
VkImageView view_at(const Sized& sized, const ViewRef& view, uint64_t frame);

VkExtent3D mip_extent(const VkExtent3D& extent, uint32_t mip);

// Size of an image range as tightly packed buffer copies lay it out: first aspect of the range, all its mips and layers.
VkDeviceSize packed_bytes(const Context& context, const Sized& sized, Index resource, const Range& range);

}  // namespace rg
