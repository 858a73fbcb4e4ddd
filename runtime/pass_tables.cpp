#include "runtime/pass_tables.h"

#include <algorithm>

#include "runtime/errors.h"
#include "runtime/render_pass.h"
#include "runtime/resolve.h"
#include "runtime/transfers.h"

namespace rg {

namespace {

bool mips_exist(const Context& context, const Sized& sized, const Pass& pass) {
  for (const MipLimit& limit : context.plan.mip_limits.subspan(pass.first_mip_limit, pass.mip_limit_count))
    if (limit.mip >= sized.resources[limit.image].mips) return false;
  return true;
}

uint32_t amount(const Context& context, const Sized& sized, Index expr) {
  return static_cast<uint32_t>(std::clamp<int64_t>(evaluate(context, sized, expr), 0, UINT32_MAX));
}

uint32_t side(const Context& context, const Sized& sized, Index expr) { return std::max(amount(context, sized, expr), 1u); }

VkFormat format_of(const Context& context, Index attachment) {
  if (attachment == kNone) return VK_FORMAT_UNDEFINED;
  return static_cast<VkFormat>(context.plan.resources[context.plan.attachments[attachment].ref.resource].format);
}

void fill_rendering_info(const Context& context, const Sized& sized, const Rendering& rendering, PassInfo& info) {
  info.depth_format = format_of(context, rendering.depth);
  info.stencil_format = format_of(context, rendering.stencil);
  info.samples = static_cast<VkSampleCountFlagBits>(rendering.samples);
  info.view_mask = rendering.view_mask;
  info.extent = {side(context, sized, rendering.width), side(context, sized, rendering.height)};
}

void fill_info(const Context& context, const Sized& sized, const Pass& pass, const PassObjects& objects, PassTable& table) {
  PassInfo& info = table.info;
  info.name = objects.name;
  info.color_formats = objects.color_formats;
  info.layout = objects.layout.get();
  info.pipeline = objects.pipeline;
  info.set_layout = objects.set_layout.get();
  info.render_pass = objects.render_pass.get();
  info.extent = {table.x, table.y};
  if (pass.rendering != kNone) fill_rendering_info(context, sized, context.plan.renderings[pass.rendering], info);
}

VkDeviceSize offset(const Context& context, const Sized& sized, Index expr) { return expr == kNone ? 0 : amount(context, sized, expr); }

void fill_draw(const Context& context, const Sized& sized, const Work& work, DrawTable& draw) {
  draw.first = static_cast<uint32_t>(offset(context, sized, work.first));
  draw.vertex_offset =
      work.vertex_offset == kNone ? 0 : static_cast<int32_t>(std::clamp<int64_t>(evaluate(context, sized, work.vertex_offset), INT32_MIN, INT32_MAX));
  draw.indices_offset = offset(context, sized, work.indices_offset);
  draw.vertex_offsets.clear();
  for (const VertexBuffer& buffer : context.plan.vertex_buffers.subspan(work.first_vertex_buffer, work.vertex_buffer_count))
    draw.vertex_offsets.push_back(offset(context, sized, buffer.offset));
}

void fill_work(const Context& context, const Sized& sized, const Work& work, PassTable& table) {
  table.x = amount(context, sized, work.x);
  table.y = amount(context, sized, work.y);
  table.z = amount(context, sized, work.z);
  table.arguments_offset = offset(context, sized, work.arguments_offset);
  fill_draw(context, sized, work, table.draw);
}

Status check_dispatch(const Context& context, const Pass& pass, const PassTable& table) {
  if (pass.work.kind != WorkKind::dispatch || context.device.limits.maxComputeWorkGroupCount[0] == 0) return Done{};
  const uint32_t groups[] = {table.x, table.y, table.z};
  for (int axis = 0; axis < 3; ++axis)
    if (groups[axis] > context.device.limits.maxComputeWorkGroupCount[axis])
      return Error{ErrorCode::unsupported, "pass `" + std::string(pass.name) + "`: " + std::to_string(groups[axis]) +
                                               " groups on one axis; this device allows " +
                                               std::to_string(context.device.limits.maxComputeWorkGroupCount[axis])};
  return Done{};
}

// At smaller extents an image has a shorter chain.
bool mips_exist_now(const Context& context, const Sized& sized, const Pass& pass) {
  for (const MipLimit& limit : context.plan.mip_limits.subspan(pass.first_mip_limit, pass.mip_limit_count)) {
    const VkExtent3D& extent = sized.resources[limit.image].extent;
    if (std::max({extent.width, extent.height, extent.depth}) >> limit.mip == 0) return false;
  }
  return true;
}

}  // namespace

void fill_rows(const Context& context, const Objects& objects, Sized& sized) {
  for (size_t i = 0; i < sized.passes.size(); ++i) {
    const Pass& pass = context.plan.passes[i];
    const PassTable& table = sized.passes[i];
    PassRow& row = sized.rows.emplace_back();
    row.guard = pass.guard;
    row.pipeline = objects.passes[i].pipeline;
    row.host_slot = pass.host_slot;
    row.work = pass.work.kind;
    row.runs = table.runs;
    const RenderingPart part = objects.passes[i].part;
    row.has_rendering = pass.rendering != kNone;
    row.begins_rendering = part.first, row.ends_rendering = part.last, row.shares_rendering = row.has_rendering && !(part.first && part.last);
    row.classic = table.info.render_pass != VK_NULL_HANDLE;
    row.fixed_views = table.rendering.fixed && table.whole_rendering.fixed;
    row.has_set = table.set.period != 0;
    row.has_engine_set = pass.engine_set != kNone;
  }
}

void resize_pass(const Context& context, Sized& sized, Index index) {
  const Pass& pass = context.plan.passes[index];
  PassTable& table = sized.passes[index];
  sized.rows[index].runs = table.runs && mips_exist_now(context, sized, pass);
  fill_work(context, sized, pass.work, table);
  table.info.extent = {table.x, table.y};
  if (pass.rendering != kNone) {
    const Rendering& rendering = context.plan.renderings[pass.rendering];
    table.info.extent = {side(context, sized, rendering.width), side(context, sized, rendering.height)};
    cover(table.rendering, table.info.extent);
    cover(table.whole_rendering, table.info.extent);
  }
  for (TransferTable& transfer : table.transfers) resize_transfer(context, sized, transfer);
}

Status create_pass_tables(const Context& context, const Objects& objects, Sized& sized) {
  sized.passes.resize(context.plan.passes.size());
  for (size_t i = 0; i < sized.passes.size(); ++i) {
    const Pass& pass = context.plan.passes[i];
    PassTable& table = sized.passes[i];
    table.runs = mips_exist(context, sized, pass);
    fill_work(context, sized, pass.work, table);
    RG_TRY(check_dispatch(context, pass, table));
    fill_info(context, sized, pass, objects.passes[i], table);
    if (pass.rendering != kNone) RG_TRY(create_rendering(context, objects, sized, static_cast<Index>(i), table));
    table.transfers = create_transfers(context, sized, pass);
    for (Index t = 0; t < table.transfers.size(); ++t)
      if (table.transfers[t].transfer->kind == TransferKind::update) sized.updates.push_back({static_cast<Index>(i), t});
  }
  return Done{};
}

}  // namespace rg
