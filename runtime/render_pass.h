// Attachments of a raster pass in the two forms Vulkan knows. Validation records classic render passes because the layer of Debian 12
// does not see attachments of dynamic rendering; everything else uses dynamic rendering.
//
// Passes that share a rendering of the plan and follow each other are begun and ended once. Where each has to stand alone (a submit a pass, a dump),
// the contents go through memory between them: what is inside loads and stores.
//
// Attachments of the classic form: colours, then the depth and stencil attachment (one view), then the resolve targets of the colours.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

inline Index depth_or_stencil(const Rendering& rendering) { return rendering.depth != kNone ? rendering.depth : rendering.stencil; }
inline bool resolves(const Attachment& attachment) { return attachment.ref.resource != kNone && attachment.resolve.resource != kNone; }

// LOAD_OP_NONE needs an extension; loading keeps the contents just as well.
VkAttachmentLoadOp load_op(const Device::State& device, LoadOp op);
VkAttachmentStoreOp store_op(StoreOp op);
VkClearValue clear_value(const Context& context, const Attachment& attachment);

// By pass: its part of its rendering. Passes continue one where they name the same and follow each other in a batch without a barrier group between.
std::vector<RenderingPart> find_parts(const Plan& plan);

Result<UniqueRenderPass> create_render_pass(const Context& context, Index pass, RenderingPart part);

// Views and attachment infos; pass.info.extent is the render area. Where several passes share the rendering, the first also holds the whole of it.
Status create_rendering(const Context& context, const Objects& objects, Sized& sized, Index index, PassTable& pass);

// The render area and the viewport.
void cover(RenderingTable& table, VkExtent2D extent);

// Only where classic render passes are recorded: finds or creates the framebuffer of every pass for this frame.
Status update_framebuffers(const Context& context, Sized& sized, uint64_t frame);

// Allocates nothing.
void begin_rendering(const Context& context, const Sized& sized, RenderingTable& table, VkCommandBuffer commands, uint64_t frame);

}  // namespace rg
