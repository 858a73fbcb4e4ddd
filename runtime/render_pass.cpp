#include "runtime/render_pass.h"

#include <bit>

#include "runtime/errors.h"
#include "runtime/layouts.h"
#include "runtime/resolve.h"
#include "runtime/views.h"

namespace rg {

namespace {

VkImageLayout to_vk(Layout layout) { return static_cast<VkImageLayout>(layout); }

// A chain of structs that point at each other: built in place, never moved.
struct RenderPassShape {
  std::vector<VkAttachmentDescription2> descriptions;
  std::vector<VkAttachmentReference2> colors, color_resolves;
  VkAttachmentReference2 depth{};
  VkAttachmentReferenceStencilLayout stencil_reference{};
  VkAttachmentDescriptionStencilLayout stencil_description{};
  VkAttachmentReference2 depth_target{};
  VkSubpassDescriptionDepthStencilResolve depth_resolve{};
  bool has_depth = false, has_resolves = false, has_depth_resolve = false;
};

VkAttachmentReference2 reference(uint32_t attachment, Layout layout, VkImageAspectFlags aspects) {
  VkAttachmentReference2 out{};
  out.sType = VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2;
  out.attachment = attachment;
  out.layout = to_vk(layout);
  out.aspectMask = aspects;
  return out;
}

VkAttachmentDescription2 description(const Context& context, Ref ref, Layout layout, Format view_format = Format::undefined) {
  VkAttachmentDescription2 out{};
  out.sType = VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2;
  out.format = static_cast<VkFormat>(view_format != Format::undefined ? view_format : context.plan.resources[ref.resource].format);
  out.samples = static_cast<VkSampleCountFlagBits>(context.plan.resources[ref.resource].samples);
  out.loadOp = out.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  out.storeOp = out.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  out.initialLayout = out.finalLayout = to_vk(layout);
  return out;
}

// What is inside a rendering goes through memory where it is cut.
Attachment attachment_in(Attachment row, RenderingPart part) {
  if (!part.first) row.load = LoadOp::load;
  if (!part.last && row.store != StoreOp::none) row.store = StoreOp::store;
  if (!part.last) row.resolve = {};
  return row;
}

void add_color(const Context& context, const Attachment& attachment, RenderPassShape& shape) {
  if (attachment.ref.resource == kNone) {
    shape.colors.push_back(reference(VK_ATTACHMENT_UNUSED, Layout::undefined, 0));
    return;
  }
  VkAttachmentDescription2 color = description(context, attachment.ref, attachment.layout, attachment.view_format);
  color.loadOp = load_op(context.device, attachment.load);
  color.storeOp = store_op(attachment.store);
  shape.colors.push_back(reference(static_cast<uint32_t>(shape.descriptions.size()), attachment.layout, VK_IMAGE_ASPECT_COLOR_BIT));
  shape.descriptions.push_back(color);
}

// One aspect of the depth and stencil attachment.
struct AspectState {
  VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_NONE;
  VkImageLayout initial = VK_IMAGE_LAYOUT_UNDEFINED, during = VK_IMAGE_LAYOUT_UNDEFINED;
};

AspectState named_aspect(const Context& context, const Attachment& attachment, Layout layout) {
  return {load_op(context.device, attachment.load), store_op(attachment.store), to_vk(layout), to_vk(layout)};
}

// Dynamic rendering leaves an aspect alone that it does not name; a classic render pass has to say so: contents are loaded and not stored, in the
// layout that the frame's barriers left, or that it gets right before, see give_layout.
struct UnnamedLayout {
  Layout layout = Layout::undefined;
  bool given = false;  // the frame's barriers left none
};
UnnamedLayout unnamed_layout(const Context& context, Index pass, const Attachment& other, uint32_t aspect) {
  const Layout found = layout_at(context.plan, pass, other.ref, aspect, other.range.mip, other.range.layer);
  if (found == Layout::undefined) return {aspect == aspect_depth ? Layout::depth_attachment : Layout::stencil_attachment, true};
  return {aspect == aspect_depth ? depth_part(found) : stencil_part(found), false};
}

AspectState unnamed_aspect(const Context& context, Index pass, const Attachment& other, uint32_t aspect) {
  const UnnamedLayout found = unnamed_layout(context, pass, other, aspect);
  const VkImageLayout layout = to_vk(found.layout);
  if (found.given && context.plan.resources[other.ref.resource].import_slot != kNone) return {.during = layout};  // whose state the engine knows
  return {load_op(context.device, LoadOp::none), VK_ATTACHMENT_STORE_OP_NONE, layout, layout};
}

struct DepthStencil {
  const Attachment* depth = nullptr;
  const Attachment* stencil = nullptr;
};

AspectState depth_state(const Context& context, Index pass, const DepthStencil& in, bool both) {
  if (in.depth == nullptr) return unnamed_aspect(context, pass, *in.stencil, aspect_depth);
  return named_aspect(context, *in.depth, both ? depth_part(in.depth->layout) : in.depth->layout);
}

AspectState stencil_state(const Context& context, Index pass, const DepthStencil& in, bool both) {
  if (in.stencil == nullptr) return unnamed_aspect(context, pass, *in.depth, aspect_stencil);
  return named_aspect(context, *in.stencil, both ? stencil_part(in.stencil->layout) : in.stencil->layout);
}

// Where the format has both aspects, depth and stencil are one attachment with two layouts.
void add_depth(const Context& context, Index pass, const Rendering& rendering, RenderingPart part, RenderPassShape& shape) {
  const auto row = [&](Index index) { return index == kNone ? Attachment{} : attachment_in(context.plan.attachments[index], part); };
  const Attachment depth_row = row(rendering.depth), stencil_row = row(rendering.stencil);
  const DepthStencil in{rendering.depth == kNone ? nullptr : &depth_row, rendering.stencil == kNone ? nullptr : &stencil_row};
  const Attachment& any = in.depth != nullptr ? *in.depth : *in.stencil;
  const VkImageAspectFlags aspects = context.plan.resources[any.ref.resource].aspects;
  const bool both = aspects == (aspect_depth | aspect_stencil);
  const AspectState depth = both || in.depth != nullptr ? depth_state(context, pass, in, both) : AspectState{};
  const AspectState stencil = both || in.stencil != nullptr ? stencil_state(context, pass, in, both) : AspectState{};
  const AspectState& first = both || in.depth != nullptr ? depth : stencil;
  VkAttachmentDescription2 out = description(context, any.ref, any.layout);
  out.loadOp = depth.load, out.storeOp = depth.store, out.stencilLoadOp = stencil.load, out.stencilStoreOp = stencil.store;
  out.initialLayout = first.initial, out.finalLayout = first.during;
  shape.depth = reference(static_cast<uint32_t>(shape.descriptions.size()), any.layout, aspects);
  shape.depth.layout = first.during;
  if (both) {
    shape.stencil_reference = {VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_STENCIL_LAYOUT, nullptr, stencil.during};
    shape.stencil_description = {VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT, nullptr, stencil.initial, stencil.during};
    shape.depth.pNext = &shape.stencil_reference;
    out.pNext = &shape.stencil_description;
  }
  shape.descriptions.push_back(out);
  shape.has_depth = true;
}

void add_resolve(const Context& context, const Attachment& attachment, RenderPassShape& shape) {
  if (!resolves(attachment)) {
    shape.color_resolves.push_back(reference(VK_ATTACHMENT_UNUSED, Layout::undefined, 0));
    return;
  }
  VkAttachmentDescription2 target = description(context, attachment.resolve, attachment.resolve_layout);
  target.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  shape.color_resolves.push_back(reference(static_cast<uint32_t>(shape.descriptions.size()), attachment.resolve_layout, VK_IMAGE_ASPECT_COLOR_BIT));
  shape.descriptions.push_back(target);
  shape.has_resolves = true;
}

void add_depth_resolve(const Context& context, const Attachment& attachment, RenderPassShape& shape) {
  if (!resolves(attachment)) return;
  VkAttachmentDescription2 target = description(context, attachment.resolve, attachment.resolve_layout);
  target.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  shape.depth_target = reference(static_cast<uint32_t>(shape.descriptions.size()), attachment.resolve_layout, VK_IMAGE_ASPECT_DEPTH_BIT);
  shape.depth_resolve.sType = VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE;
  shape.depth_resolve.depthResolveMode = static_cast<VkResolveModeFlagBits>(attachment.resolve_mode);
  shape.depth_resolve.pDepthStencilResolveAttachment = &shape.depth_target;
  shape.descriptions.push_back(target);
  shape.has_depth_resolve = true;
}

void fill_shape(const Context& context, Index pass, const Rendering& rendering, RenderingPart part, RenderPassShape& shape) {
  const std::span<const Attachment> colors = context.plan.attachments.subspan(rendering.first_color, rendering.color_count);
  for (const Attachment& color : colors) add_color(context, attachment_in(color, part), shape);
  if (depth_or_stencil(rendering) != kNone) add_depth(context, pass, rendering, part, shape);
  for (const Attachment& color : colors) add_resolve(context, attachment_in(color, part), shape);
  if (rendering.depth != kNone) add_depth_resolve(context, attachment_in(context.plan.attachments[rendering.depth], part), shape);
}

VkImageUsageFlags attachment_usage(const Context& context, Ref ref) {
  const bool color = (context.plan.resources[ref.resource].aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0;
  return color ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
}

Result<ViewRef> attachment_view(const Context& context, Sized& sized, const Rendering& rendering, ViewRequest request) {
  if (request.ref.resource == kNone) return ViewRef{};
  request.range.mips = 1;
  request.arrayed = rendering.layers > 1 || rendering.view_mask != 0;
  request.usage = attachment_usage(context, request.ref);
  request.all_aspects = true;
  return create_views(context, sized, request);
}

ViewRequest target_of(const Attachment& attachment) {
  ViewRequest request{attachment.ref, attachment.range};
  request.format = attachment.view_format;
  request.slice = attachment.slice, request.slices = attachment.slices;
  return request;
}

VkRenderingAttachmentInfo attachment_info(const Context& context, const Attachment& attachment) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  if (attachment.ref.resource == kNone) return info;
  info.imageLayout = to_vk(attachment.layout);
  info.loadOp = load_op(context.device, attachment.load);
  info.storeOp = store_op(attachment.store);
  info.clearValue = clear_value(context, attachment);
  if (!resolves(attachment)) return info;
  info.resolveMode = attachment.resolve_mode == 0 ? VK_RESOLVE_MODE_AVERAGE_BIT : static_cast<VkResolveModeFlagBits>(attachment.resolve_mode);
  info.resolveImageLayout = to_vk(attachment.resolve_layout);
  return info;
}

struct TableTarget {
  const Rendering& rendering;
  RenderingPart part;
  PassTable& pass;
  RenderingTable& table;
};
Status add_attachment(const Context& context, Sized& sized, const TableTarget& target, Index index) {
  const Rendering& rendering = target.rendering;
  const Attachment attachment = attachment_in(context.plan.attachments[index], target.part);
  Result<ViewRef> view = attachment_view(context, sized, rendering, target_of(attachment));
  if (!view) return view.error();
  Result<ViewRef> resolve = attachment_view(context, sized, rendering, {attachment.resolve, attachment.resolve_range});
  if (!resolve) return resolve.error();
  target.table.views.push_back(*view);
  target.table.resolve_views.push_back(*resolve);
  target.table.attachments.push_back(attachment_info(context, attachment));
  target.pass.runs &= view->exists && resolve->exists;
  return Done{};
}

// The same order as fill_shape.
void list_framebuffer_views(const Rendering& plan, RenderingTable& table) {
  auto add = [&](const ViewRef& view, const VkClearValue& clear) {
    if (view.ref.resource == kNone) return;
    table.framebuffer_views.push_back(view);
    table.clears.push_back(clear);
  };
  for (uint32_t i = 0; i < plan.color_count; ++i) add(table.views[i], table.attachments[i].clearValue);
  if (depth_or_stencil(plan) != kNone) {
    VkClearValue clear = table.attachments[plan.color_count].clearValue;
    if (plan.depth != kNone && plan.stencil != kNone)
      clear.depthStencil.stencil = table.attachments[plan.color_count + 1].clearValue.depthStencil.stencil;
    add(table.views[plan.color_count], clear);
  }
  for (uint32_t i = 0; i < plan.color_count; ++i) add(table.resolve_views[i], {});
  if (plan.depth != kNone) add(table.resolve_views[plan.color_count], {});
  table.framebuffer_handles.resize(table.framebuffer_views.size());
}

}  // namespace

VkAttachmentLoadOp load_op(const Device::State& device, LoadOp op) {
  switch (op) {
    case LoadOp::clear:
      return VK_ATTACHMENT_LOAD_OP_CLEAR;
    case LoadOp::dont_care:
      return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    case LoadOp::none:
      return device.load_op_none ? VK_ATTACHMENT_LOAD_OP_NONE_EXT : VK_ATTACHMENT_LOAD_OP_LOAD;
    default:
      return VK_ATTACHMENT_LOAD_OP_LOAD;
  }
}

VkAttachmentStoreOp store_op(StoreOp op) {
  if (op == StoreOp::none) return VK_ATTACHMENT_STORE_OP_NONE;
  return op == StoreOp::store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

VkClearValue clear_value(const Context& context, const Attachment& attachment) {
  VkClearValue value{};
  if ((context.plan.resources[attachment.ref.resource].aspects & aspect_color) != 0)
    for (int i = 0; i < 4; ++i) value.color.uint32[i] = attachment.clear.word[i];
  else
    value.depthStencil = {std::bit_cast<float>(attachment.clear.word[0]), attachment.clear.word[1]};
  return value;
}

std::vector<RenderingPart> find_parts(const Plan& plan) {
  std::vector<RenderingPart> parts(plan.passes.size());
  for (const Batch& batch : plan.batches)
    for (Index s = batch.first_step + 1; s < batch.first_step + batch.step_count; ++s) {
      const Step &before = plan.steps[s - 1], &step = plan.steps[s];
      if (before.kind != StepKind::pass || step.kind != StepKind::pass) continue;
      const Index rendering = plan.passes[step.index].rendering;
      if (rendering != kNone && plan.passes[before.index].rendering == rendering) parts[before.index].last = parts[step.index].first = false;
    }
  return parts;
}

Result<UniqueRenderPass> create_render_pass(const Context& context, Index pass, RenderingPart part) {
  const std::string_view name = context.plan.passes[pass].name;
  const Rendering& rendering = context.plan.renderings[context.plan.passes[pass].rendering];
  RenderPassShape shape;
  fill_shape(context, pass, rendering, part, shape);
  VkSubpassDescription2 subpass{};
  subpass.sType = VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2;
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.viewMask = rendering.view_mask;
  subpass.colorAttachmentCount = static_cast<uint32_t>(shape.colors.size());
  subpass.pColorAttachments = shape.colors.data();
  subpass.pResolveAttachments = shape.has_resolves ? shape.color_resolves.data() : nullptr;
  subpass.pDepthStencilAttachment = shape.has_depth ? &shape.depth : nullptr;
  if (shape.has_depth_resolve) subpass.pNext = &shape.depth_resolve;
  VkRenderPassCreateInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2;
  info.attachmentCount = static_cast<uint32_t>(shape.descriptions.size());
  info.pAttachments = shape.descriptions.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  VkRenderPass handle = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateRenderPass2(context.device.device, &info, context.vk().allocator, &handle), "vkCreateRenderPass2", name));
  return UniqueRenderPass(context.vk(), context.device.device, handle);
}

namespace {

void fill_views(const Sized& sized, RenderingTable& table, uint64_t frame) {
  for (size_t i = 0; i < table.attachments.size(); ++i) {
    table.attachments[i].imageView = view_at(sized, table.views[i], frame);
    table.attachments[i].resolveImageView = view_at(sized, table.resolve_views[i], frame);
  }
}

bool same_in_every_frame(const Sized& sized, const ViewRef& view) {
  return view.ref.resource == kNone || (view.imported == kNone && sized.resources[view.ref.resource].count == 1);
}

void fill_info(const Sized& sized, RenderingTable& table) {
  for (const ViewRef& view : table.views) table.fixed &= same_in_every_frame(sized, view);
  for (const ViewRef& view : table.resolve_views) table.fixed &= same_in_every_frame(sized, view);
  if (table.fixed) fill_views(sized, table, 0);
  VkRenderingInfo& info = table.info;
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.layerCount = table.layers;
  info.viewMask = table.view_mask;
  info.colorAttachmentCount = table.color_count;
  info.pColorAttachments = table.attachments.data();
  info.pDepthAttachment = table.has_depth ? &table.attachments[table.color_count] : nullptr;
  info.pStencilAttachment = table.has_stencil ? &table.attachments[table.color_count + (table.has_depth ? 1 : 0)] : nullptr;
  cover(table, table.area.extent);
}

void find_loose_aspect(const Context& context, Index pass, const Rendering& rendering, RenderingTable& table) {
  if (depth_or_stencil(rendering) == kNone || (rendering.depth != kNone && rendering.stencil != kNone)) return;
  const Attachment& named = context.plan.attachments[depth_or_stencil(rendering)];
  if (context.plan.resources[named.ref.resource].aspects != (aspect_depth | aspect_stencil)) return;
  const uint32_t aspect = rendering.depth != kNone ? aspect_stencil : aspect_depth;
  const UnnamedLayout found = unnamed_layout(context, pass, named, aspect);
  if (!found.given || context.plan.resources[named.ref.resource].import_slot != kNone) return;
  table.loose_aspect = aspect, table.loose_layout = to_vk(found.layout), table.loose_image = named.ref, table.loose_range = named.range;
}

Status fill_table(const Context& context, Sized& sized, const TableTarget& target) {
  const Rendering& rendering = target.rendering;
  RenderingTable& table = target.table;
  table.area.extent = target.pass.info.extent;
  table.layers = rendering.layers;
  table.view_mask = rendering.view_mask;
  table.color_count = rendering.color_count;
  for (uint32_t i = 0; i < rendering.color_count; ++i) RG_TRY(add_attachment(context, sized, target, rendering.first_color + i));
  table.has_depth = rendering.depth != kNone;
  table.has_stencil = rendering.stencil != kNone;
  if (table.has_depth) RG_TRY(add_attachment(context, sized, target, rendering.depth));
  if (table.has_stencil) RG_TRY(add_attachment(context, sized, target, rendering.stencil));
  list_framebuffer_views(rendering, table);
  fill_info(sized, table);
  return Done{};
}

}  // namespace

Status create_rendering(const Context& context, const Objects& objects, Sized& sized, Index index, PassTable& pass) {
  const Rendering& rendering = context.plan.renderings[context.plan.passes[index].rendering];
  const RenderingPart part = objects.passes[index].part;
  pass.rendering.render_pass = objects.passes[index].render_pass.get();
  RG_TRY(fill_table(context, sized, {rendering, part, pass, pass.rendering}));
  if (pass.rendering.render_pass != VK_NULL_HANDLE) find_loose_aspect(context, index, rendering, pass.rendering);
  if (!part.first || part.last) return Done{};
  pass.whole_rendering.render_pass = objects.passes[index].whole_render_pass.get();
  if (pass.whole_rendering.render_pass != VK_NULL_HANDLE) find_loose_aspect(context, index, rendering, pass.whole_rendering);
  return fill_table(context, sized, {rendering, {}, pass, pass.whole_rendering});
}

void cover(RenderingTable& table, VkExtent2D extent) {
  table.area.extent = table.info.renderArea.extent = extent;
  table.viewport = {0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
}

namespace {

Result<UniqueFramebuffer> create_framebuffer(const Context& context, const RenderingTable& table, const std::vector<VkImageView>& views,
                                             std::string_view name) {
  VkFramebufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = table.render_pass;
  info.attachmentCount = static_cast<uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = table.area.extent.width;
  info.height = table.area.extent.height;
  info.layers = table.view_mask != 0 ? 1 : table.layers;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateFramebuffer(context.device.device, &info, context.vk().allocator, &framebuffer), "vkCreateFramebuffer", name));
  return UniqueFramebuffer(context.vk(), context.device.device, framebuffer);
}

FramebufferEntry* find_framebuffer(RenderingTable& table) {
  for (FramebufferEntry& entry : table.framebuffers)
    if (entry.views == table.framebuffer_handles) return &entry;
  return nullptr;
}

// Those of imports that are no longer seen would pile up.
FramebufferEntry& framebuffer_slot(RenderingTable& table) {
  constexpr size_t kMost = 64;
  if (table.framebuffers.size() < kMost) return table.framebuffers.emplace_back();
  FramebufferEntry* oldest = &table.framebuffers[0];
  for (FramebufferEntry& entry : table.framebuffers)
    if (entry.frame < oldest->frame) oldest = &entry;
  return *oldest;
}

Status update_framebuffer(const Context& context, const Sized& sized, RenderingTable& table, std::string_view name, uint64_t frame) {
  for (size_t i = 0; i < table.framebuffer_views.size(); ++i) table.framebuffer_handles[i] = view_at(sized, table.framebuffer_views[i], frame);
  FramebufferEntry* entry = find_framebuffer(table);
  if (entry == nullptr) {
    Result<UniqueFramebuffer> created = create_framebuffer(context, table, table.framebuffer_handles, name);
    if (!created) return created.error();
    entry = &framebuffer_slot(table);
    *entry = {table.framebuffer_handles, std::move(*created), 0};
  }
  entry->frame = frame;
  table.framebuffer = entry->framebuffer.get();
  return Done{};
}

// A render pass that made the transition itself would race with the one before, which no barrier of the frame follows: for dynamic rendering there is
// nothing to wait for.
void give_layout(const Context& context, const Sized& sized, const RenderingTable& table, VkCommandBuffer commands, uint64_t frame) {
  constexpr VkPipelineStageFlags2 kTests = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = barrier.dstStageMask = kTests;
  barrier.srcAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  barrier.newLayout = table.loose_layout;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image_at(sized, {}, context.plan, table.loose_image, frame);
  barrier.subresourceRange = image_range(context, sized, table.loose_image.resource, table.loose_range);
  barrier.subresourceRange.aspectMask = table.loose_aspect, barrier.subresourceRange.levelCount = 1;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  context.vk().CmdPipelineBarrier2(commands, &info);
}

void begin_classic(const Context& context, const Sized& sized, const RenderingTable& table, VkCommandBuffer commands, uint64_t frame) {
  if (table.loose_aspect != 0) give_layout(context, sized, table, commands, frame);
  VkRenderPassBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = table.render_pass;
  info.framebuffer = table.framebuffer;
  info.renderArea = table.area;
  info.clearValueCount = static_cast<uint32_t>(table.clears.size());
  info.pClearValues = table.clears.data();
  context.vk().CmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

void begin_dynamic(const Context& context, const Sized& sized, RenderingTable& table, VkCommandBuffer commands, uint64_t frame) {
  if (!table.fixed) fill_views(sized, table, frame);
  context.vk().CmdBeginRendering(commands, &table.info);
}

}  // namespace

Status update_framebuffers(const Context& context, Sized& sized, uint64_t frame) {
  for (PassTable& pass : sized.passes)
    for (RenderingTable* table : {&pass.rendering, &pass.whole_rendering})
      if (pass.runs && table->render_pass != VK_NULL_HANDLE) RG_TRY(update_framebuffer(context, sized, *table, pass.info.name, frame));
  return Done{};
}

void begin_rendering(const Context& context, const Sized& sized, RenderingTable& table, VkCommandBuffer commands, uint64_t frame) {
  if (table.render_pass != VK_NULL_HANDLE)
    begin_classic(context, sized, table, commands, frame);
  else
    begin_dynamic(context, sized, table, commands, frame);
}

}  // namespace rg
