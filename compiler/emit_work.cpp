#include "compiler/emit_plan.h"
#include "compiler/format_table.h"
#include "compiler/slots.h"

namespace rg::compiler {
namespace {

constexpr uint32_t kFullscreenVertices = 3;

WorkKind draw_kind(const dsl::Draw& draw) {
  switch (draw.kind) {
    case dsl::DrawKind::fullscreen:
    case dsl::DrawKind::direct:
      return draw.indexed ? WorkKind::draw_indexed : WorkKind::draw;
    case dsl::DrawKind::indirect:
      return draw.indexed ? WorkKind::draw_indexed_indirect : WorkKind::draw_indirect;
    case dsl::DrawKind::indirect_count:
      return draw.indexed ? WorkKind::draw_indexed_indirect_count : WorkKind::draw_indirect_count;
    case dsl::DrawKind::host:
      return WorkKind::host;
    case dsl::DrawKind::none:
      break;
  }
  return WorkKind::none;
}

void point_to(const dsl::Pass& pass, const PlanIndices& indices, uint32_t access, Ref& ref, Index* offset) {
  if (access >= pass.accesses.size()) return;
  ref = plan_ref(indices, pass.accesses[access].resource, pass.accesses[access].age);
  if (offset) *offset = index_of(pass.accesses[access].range.offset);
}

// What the draw takes its vertices and indices from.
void set_buffers(const PlanParts& parts, const dsl::Pass& pass, const PlanIndices& indices, PlanData& plan, Work& work) {
  work.first_vertex_buffer = static_cast<Index>(plan.vertex_buffers.size());
  for (const dsl::VertexInput& input : pass.draw.vertex) {
    if (input.buffer == dsl::kAll) continue;
    VertexBuffer& row = plan.vertex_buffers.emplace_back();
    point_to(pass, indices, input.buffer, row.ref, &row.offset);
  }
  work.vertex_buffer_count = static_cast<uint32_t>(plan.vertex_buffers.size()) - work.first_vertex_buffer;
  if (pass.draw.indices == dsl::kAll) return;
  point_to(pass, indices, pass.draw.indices, work.indices, &work.indices_offset);
  work.index_bytes = parts.frame.graph->resources[pass.accesses[pass.draw.indices].resource].stride;
}

void set_draw(const dsl::Pass& pass, const PlanIndices& indices, Expressions& exprs, Work& work) {
  work.kind = draw_kind(pass.draw);
  work.x = pass.draw.kind == dsl::DrawKind::fullscreen ? exprs.constant(kFullscreenVertices) : index_of(pass.draw.vertices);
  work.y = index_of(pass.draw.instances);
  work.first = index_of(pass.draw.first), work.vertex_offset = index_of(pass.draw.offset);
  point_to(pass, indices, pass.draw.arguments, work.arguments, &work.arguments_offset);
  point_to(pass, indices, pass.draw.counts, work.counts, nullptr);
  work.max_draws = pass.draw.max_draws, work.stride = pass.draw.stride;
}

void set_dispatch(const dsl::Pass& pass, const PlanIndices& indices, Expressions& exprs, Work& work) {
  const dsl::Dispatch& dispatch = pass.dispatch;
  work.kind = dispatch.kind == dsl::DispatchKind::indirect ? WorkKind::dispatch_indirect : WorkKind::dispatch;
  point_to(pass, indices, dispatch.arguments, work.arguments, &work.arguments_offset);
  Index* sizes[] = {&work.x, &work.y, &work.z};
  for (int axis = 0; axis < 3; ++axis) {
    const Index size = index_of(dispatch.size[axis]);
    const bool divides = dispatch.kind == dsl::DispatchKind::over && size != kNone && dispatch.group[axis] > 1;
    *sizes[axis] = divides ? exprs.binary(ExprOp::ceil_div, size, exprs.constant(dispatch.group[axis])) : size;
  }
}

TransferKind transfer_kind(dsl::TransferKind kind, const dsl::Resource* src, const dsl::Resource* dst) {
  const bool from_buffer = src && src->kind == dsl::ResourceKind::buffer, to_buffer = dst && dst->kind == dsl::ResourceKind::buffer;
  switch (kind) {
    case dsl::TransferKind::copy:
      if (from_buffer) return to_buffer ? TransferKind::copy_buffer : TransferKind::copy_buffer_to_image;
      return to_buffer ? TransferKind::copy_image_to_buffer : TransferKind::copy_image;
    case dsl::TransferKind::blit:
      return TransferKind::blit;
    case dsl::TransferKind::clear:
      if (to_buffer) return TransferKind::fill;
      return format_row(dst->format).aspects & aspect_color ? TransferKind::clear_color : TransferKind::clear_depth_stencil;
    case dsl::TransferKind::fill:
      return TransferKind::fill;
    case dsl::TransferKind::update:
      return TransferKind::update;
    case dsl::TransferKind::resolve:
      return TransferKind::resolve;
    case dsl::TransferKind::host:
      break;
  }
  return TransferKind::copy_image;
}

const dsl::Resource* resource_at(const PlanParts& parts, const dsl::Pass& pass, uint32_t access) {
  return access < pass.accesses.size() ? &parts.frame.graph->resources[pass.accesses[access].resource] : nullptr;
}

void set_side(const PlanParts& parts, const PlanIndices& indices, const dsl::Pass& pass, uint32_t access, Ref& ref, Range& range, Bytes& bytes) {
  const dsl::Resource* resource = resource_at(parts, pass, access);
  if (!resource) return;
  const dsl::Access& from = pass.accesses[access];
  ref = plan_ref(indices, from.resource, from.age);
  if (resource->kind == dsl::ResourceKind::image) range = plan_range(*resource, resolved_range(*resource, from));
  if (resource->kind == dsl::ResourceKind::buffer) bytes = {index_of(from.range.offset), index_of(from.range.size)};
}

Transfer transfer_row(const PlanParts& parts, const PlanIndices& indices, const dsl::Pass& pass, const dsl::Transfer& from, Index& update_slot) {
  const dsl::Resource *src = resource_at(parts, pass, from.src), *dst = resource_at(parts, pass, from.dst);
  Transfer row;
  row.kind = transfer_kind(from.kind, src, dst);
  set_side(parts, indices, pass, from.src, row.src, row.src_range, row.src_bytes);
  set_side(parts, indices, pass, from.dst, row.dst, row.dst_range, row.dst_bytes);
  row.linear = from.filter == dsl::Filter::linear;
  row.value = plan_clear(from.value, dst ? format_row(dst->format).aspects : 0);
  if (from.kind == dsl::TransferKind::update) row.update_slot = update_slot++;
  return row;
}

void set_transfers(const PlanParts& parts, const PlanIndices& indices, uint32_t pass_index, PlanData& plan, Work& work) {
  const dsl::Pass& pass = parts.frame.pass(pass_index);
  Index update_slot = indices.update_slot[parts.frame.passes[pass_index]];
  work.first_transfer = static_cast<Index>(plan.transfers.size());
  for (const dsl::Transfer& transfer : pass.transfers)
    if (transfer.kind != dsl::TransferKind::host) plan.transfers.push_back(transfer_row(parts, indices, pass, transfer, update_slot));
  work.transfer_count = static_cast<Index>(plan.transfers.size()) - work.first_transfer;
  if (work.transfer_count > 0) work.kind = WorkKind::transfers;
}

}  // namespace

void emit_work(const PlanParts& parts, const PlanIndices& indices, uint32_t pass_index, Expressions& exprs, PlanData& plan, Pass& row) {
  const dsl::Pass& pass = parts.frame.pass(pass_index);
  if (is_host_recorded(pass)) {
    row.work.kind = WorkKind::host;
    return;
  }
  if (pass.draw.kind != dsl::DrawKind::none) {
    set_draw(pass, indices, exprs, row.work);
    set_buffers(parts, pass, indices, plan, row.work);
  }
  if (pass.dispatch.kind != dsl::DispatchKind::none) set_dispatch(pass, indices, exprs, row.work);
  if (pass.kind == dsl::PassKind::transfer) set_transfers(parts, indices, pass_index, plan, row.work);
}

}  // namespace rg::compiler
