#include "compiler/verify/work.h"

#include <algorithm>
#include <bit>

namespace rg::verify {
namespace {

struct Work {
  const Model& model;
  const std::vector<int64_t>& extents;
  Report& report;
  const Pass& plan;
  const dsl::Pass& pass;
};

void report_work(const Work& work, uint32_t access, const std::string& text) {
  const std::string resource = access < work.pass.accesses.size() ? work.model.resource(work.pass.accesses[access].resource.value).name : "";
  work.report.add({Hazard::invalid_plan, resource, work.pass.name, "",
                   "`" + work.pass.name + "`" + (resource.empty() ? "" : " and `" + resource + "`") + ": " + text});
}

bool names_access(const Work& work, Ref ref, uint32_t access) {
  const bool wanted = access < work.pass.accesses.size();
  if (ref.resource == kNone || !wanted) return (ref.resource == kNone) == !wanted;
  const dsl::Access& row = work.pass.accesses[access];
  return ref.resource < work.model.input->program_resource.size() && work.model.input->program_resource[ref.resource] == row.resource.value &&
         ref.age == row.age;
}

bool covers_access(const Work& work, const Range& range, const Bytes& bytes, uint32_t access) {
  const dsl::Access& row = work.pass.accesses[access];
  const Shape& shape = work.model.resources[row.resource.value].partition.shape;
  const Box wanted = box_of(work.model.input->program, shape, effective_range(row, shape.aspects), work.extents);
  return wanted == (shape.image ? box_of(shape, range) : box_of(work.model.input->plan.exprs, shape, bytes, work.extents));
}

void check_side(const Work& work, uint32_t access, Ref ref, const Range& range, const Bytes& bytes) {
  if (!names_access(work, ref, access))
    report_work(work, access, "a transfer of the plan touches another resource than declared");
  else if (ref.resource != kNone && !covers_access(work, range, bytes, access))
    report_work(work, access, "a transfer of the plan touches another range than declared");
}

bool same_kind(dsl::TransferKind declared, TransferKind planned, bool src_image, bool dst_image) {
  switch (declared) {
    case dsl::TransferKind::copy:
      if (src_image) return planned == (dst_image ? TransferKind::copy_image : TransferKind::copy_image_to_buffer);
      return planned == (dst_image ? TransferKind::copy_buffer_to_image : TransferKind::copy_buffer);
    case dsl::TransferKind::blit:
      return planned == TransferKind::blit;
    case dsl::TransferKind::clear:
      if (!dst_image) return planned == TransferKind::fill;
      return planned == TransferKind::clear_color || planned == TransferKind::clear_depth_stencil;
    case dsl::TransferKind::fill:
      return planned == TransferKind::fill;
    case dsl::TransferKind::update:
      return planned == TransferKind::update;
    case dsl::TransferKind::resolve:
      return planned == TransferKind::resolve;
    case dsl::TransferKind::host:
      return false;
  }
  return false;
}

// The bits Vulkan expects: floats or integers for colours, a float and an integer for depth and stencil.
bool same_clear(const dsl::ClearValue& declared, const ClearValue& planned, uint32_t aspects) {
  if (aspects & (aspect_depth | aspect_stencil)) {
    if ((aspects & aspect_depth) && planned.word[0] != std::bit_cast<uint32_t>(declared.f[0])) return false;
    return !(aspects & aspect_stencil) || planned.word[1] == declared.u[1];
  }
  for (int i = 0; i < 4; ++i)
    if (planned.word[i] != (declared.integer ? declared.u[i] : std::bit_cast<uint32_t>(declared.f[i]))) return false;
  return true;
}

bool is_image(const Work& work, uint32_t access) {
  return access < work.pass.accesses.size() && work.model.resource(work.pass.accesses[access].resource.value).kind == dsl::ResourceKind::image;
}

void check_transfer(const Work& work, const dsl::Transfer& declared, const Transfer& planned) {
  check_side(work, declared.src, planned.src, planned.src_range, planned.src_bytes);
  check_side(work, declared.dst, planned.dst, planned.dst_range, planned.dst_bytes);
  if (!same_kind(declared.kind, planned.kind, is_image(work, declared.src), is_image(work, declared.dst)))
    report_work(work, declared.dst, "a transfer of the plan is of another kind than declared");
  if (planned.linear != (declared.filter == dsl::Filter::linear))
    report_work(work, declared.dst, "a transfer of the plan filters otherwise than declared");
  const bool clears = declared.kind == dsl::TransferKind::clear && is_image(work, declared.dst);
  if (clears &&
      !same_clear(declared.value, planned.value, work.model.resources[work.pass.accesses[declared.dst].resource.value].partition.shape.aspects))
    report_work(work, declared.dst, "a transfer of the plan clears to another value than declared");
}

void check_transfers(const Work& work) {
  std::vector<const dsl::Transfer*> declared;
  for (const dsl::Transfer& transfer : work.pass.transfers)
    if (transfer.kind != dsl::TransferKind::host) declared.push_back(&transfer);
  const auto& transfers = work.model.input->plan.transfers;
  const uint32_t first = work.plan.work.first_transfer, count = work.plan.work.transfer_count;
  if (count != declared.size() || uint64_t{first} + count > transfers.size())
    return report_work(work, dsl::kAll, "the plan has other transfers than declared");
  for (uint32_t i = 0; i < count; ++i) check_transfer(work, *declared[i], transfers[first + i]);
}

bool declares_resolve(const dsl::Pass& pass) {
  return std::any_of(pass.transfers.begin(), pass.transfers.end(), [](const auto& transfer) { return transfer.kind == dsl::TransferKind::resolve; });
}

void check_resolves(const Work& work, const Rendering& rendering) {
  const auto& attachments = work.model.input->plan.attachments;
  const auto resolves = [](const dsl::Transfer& transfer) { return transfer.kind == dsl::TransferKind::resolve; };
  std::vector<Index> rows;
  for (uint32_t i = 0; i < rendering.color_count; ++i) rows.push_back(rendering.first_color + i);
  for (const Index row : {rendering.depth, rendering.stencil})
    if (row != kNone) rows.push_back(row);
  std::ptrdiff_t planned = 0;
  for (const Index index : rows) {
    const Attachment& row = attachments[index];
    if (row.resolve.resource == kNone) continue;
    ++planned;
    const bool declared = std::any_of(work.pass.transfers.begin(), work.pass.transfers.end(), [&](const dsl::Transfer& transfer) {
      return resolves(transfer) && names_access(work, row.ref, transfer.src) && names_access(work, row.resolve, transfer.dst);
    });
    if (!declared || index == rendering.stencil) report_work(work, dsl::kAll, "the rendering resolves otherwise than declared");
  }
  if (planned != std::count_if(work.pass.transfers.begin(), work.pass.transfers.end(), resolves))
    report_work(work, dsl::kAll, "the rendering resolves otherwise than declared");
}

// What the access names beside the subresource: slices of a volume, and whether it is seen in another format. (Numbers of formats are no business of
// the checker.)
bool same_view(const Work& work, const Attachment& row, const dsl::Access& access) {
  const dsl::Resource& image = work.model.resource(access.resource.value);
  const Format own = work.model.input->plan.resources[row.ref.resource].format;
  const bool is_other = row.view_format != Format::undefined && row.view_format != own;
  if ((row.view_format != Format::undefined) != (access.view != dsl::Format::none) || is_other != (access.view != dsl::Format::none)) return false;
  if (image.dimension != dsl::Dimension::d3) return row.slices == 0;
  const int64_t depth = std::max<int64_t>(dsl::evaluate(work.model.input->program, image.depth, work.extents) >> access.range.mip, 1);
  return is_slice(access) ? row.slice == access.range.slice && row.slices == access.range.slices : row.slice == 0 && row.slices == depth;
}

bool is_target(dsl::Role role) {
  return role == dsl::Role::color || role == dsl::Role::depth || role == dsl::Role::depth_readonly || role == dsl::Role::stencil;
}

void check_targets(const Work& work, const Rendering& rendering) {
  const auto& attachments = work.model.input->plan.attachments;
  uint32_t layers = kNone, color = 0;
  for (uint32_t a = 0; a < work.pass.accesses.size(); ++a) {
    const dsl::Access& access = work.pass.accesses[a];
    if (!is_target(access.role)) continue;
    const Shape& shape = work.model.resources[access.resource.value].partition.shape;
    const Box box = box_of(work.model.input->program, shape, effective_range(access, shape.aspects), work.extents);
    const Index index = access.role == dsl::Role::color     ? rendering.first_color + color++
                        : access.role == dsl::Role::stencil ? rendering.stencil
                                                            : rendering.depth;
    if (index >= attachments.size() || !names_access(work, attachments[index].ref, a)) continue;  // reported with its contents
    if (!same_view(work, attachments[index], access)) report_work(work, a, "the attachment is seen otherwise than declared");
    layers = std::min(layers, attachments[index].slices != 0 ? attachments[index].slices : static_cast<uint32_t>(box.layer_end - box.layer_begin));
  }
  if (layers == kNone) return;
  if (rendering.layers != layers) report_work(work, dsl::kAll, "the rendering has another number of layers than declared");
  if (rendering.view_mask != (work.pass.multiview ? (1u << layers) - 1 : 0u))
    report_work(work, dsl::kAll, "the rendering has other views than declared");
}

void check_clears(const Work& work, const Rendering& rendering) {
  const auto& attachments = work.model.input->plan.attachments;
  const auto check = [&](const Attachment& row, bool serves, uint32_t access, uint32_t aspects) {
    if (serves && names_access(work, row.ref, access) && row.load == LoadOp::clear &&
        !same_clear(*work.pass.accesses[access].clear, row.clear, aspects))
      report_work(work, access, "the attachment is cleared to another value than declared");
  };
  for (uint32_t a = 0; a < work.pass.accesses.size(); ++a) {
    const dsl::Access& access = work.pass.accesses[a];
    if (!access.clear) continue;
    for (uint32_t i = 0; i < rendering.color_count; ++i) {
      const Attachment& row = attachments[rendering.first_color + i];
      check(row, access.role == dsl::Role::color && covers_access(work, row.range, {}, a), a, aspect_color);
    }
    if (rendering.depth != kNone) check(attachments[rendering.depth], access.role == dsl::Role::depth, a, aspect_depth);
    if (rendering.stencil != kNone) check(attachments[rendering.stencil], access.role == dsl::Role::stencil, a, aspect_stencil);
  }
}

bool same_value(const Work& work, Index planned, dsl::ExprId declared, int64_t otherwise) {
  const int64_t wanted = declared.valid() ? dsl::evaluate(work.model.input->program, declared, work.extents) : otherwise;
  if (planned != kNone && planned >= work.model.input->plan.exprs.size()) return false;
  return (planned == kNone ? otherwise : evaluate(work.model.input->plan.exprs, planned, work.extents)) == wanted;
}

// VkBuffer and offset of a binding.
bool same_buffer(const Work& work, Ref ref, Index offset, uint32_t access) {
  if (!names_access(work, ref, access)) return false;
  return access >= work.pass.accesses.size() || same_value(work, offset, work.pass.accesses[access].range.offset, 0);
}

void check_draw(const Work& work) {
  const dsl::Draw& declared = work.pass.draw;
  const rg::Work& planned = work.plan.work;
  if (planned.kind == WorkKind::host || work.pass.kind != dsl::PassKind::raster) return;
  if (declared.kind == dsl::DrawKind::direct) {
    if (planned.kind != (declared.indexed ? WorkKind::draw_indexed : WorkKind::draw))
      report_work(work, dsl::kAll, "the plan draws in another way than declared");
    if (!same_value(work, planned.x, declared.vertices, 1) || !same_value(work, planned.y, declared.instances, 1) ||
        !same_value(work, planned.first, declared.first, 0) || !same_value(work, planned.vertex_offset, declared.offset, 0))
      report_work(work, dsl::kAll, "the plan draws other vertices than declared");
  }
  if (!same_buffer(work, planned.indices, planned.indices_offset, declared.indices))
    report_work(work, declared.indices, "the plan takes its indices from elsewhere");
  const auto& buffers = work.model.input->plan.vertex_buffers;
  const bool inside = uint64_t{planned.first_vertex_buffer} + planned.vertex_buffer_count <= buffers.size();
  if (!inside || planned.vertex_buffer_count != declared.vertex.size())
    return report_work(work, dsl::kAll, "the plan binds another number of vertex buffers than declared");
  for (uint32_t i = 0; i < planned.vertex_buffer_count; ++i)
    if (!same_buffer(work, buffers[planned.first_vertex_buffer + i].ref, buffers[planned.first_vertex_buffer + i].offset, declared.vertex[i].buffer))
      report_work(work, declared.vertex[i].buffer, "the plan takes its vertices from elsewhere");
}

void check_arguments(const Work& work) {
  const bool draws = work.pass.draw.kind == dsl::DrawKind::indirect || work.pass.draw.kind == dsl::DrawKind::indirect_count;
  const bool dispatches = work.pass.dispatch.kind == dsl::DispatchKind::indirect;
  const uint32_t arguments = draws ? work.pass.draw.arguments : dispatches ? work.pass.dispatch.arguments : dsl::kAll;
  if (work.plan.work.kind == WorkKind::host || (!draws && !dispatches)) return;
  if (!names_access(work, work.plan.work.arguments, arguments)) report_work(work, arguments, "the plan takes its indirect arguments from elsewhere");
  if (draws && work.pass.draw.kind == dsl::DrawKind::indirect_count && !names_access(work, work.plan.work.counts, work.pass.draw.counts))
    report_work(work, work.pass.draw.counts, "the plan takes its draw count from elsewhere");
}

}  // namespace

void check_work(const Model& model, const std::vector<int64_t>& extents, Report& report) {
  for (const PassNode& node : model.passes) {
    const Work work{model, extents, report, model.input->plan.passes[node.plan_pass], model.pass(node.plan_pass)};
    if (work.pass.kind == dsl::PassKind::transfer) check_transfers(work);
    check_arguments(work);
    check_draw(work);
    if (work.plan.rendering == kNone) continue;
    if (node.last_in_rendering)
      check_resolves(work, model.input->plan.renderings[work.plan.rendering]);
    else if (declares_resolve(work.pass))  // it would come after the last pass
      report_work(work, dsl::kAll, "the rendering resolves otherwise than declared");
    check_clears(work, model.input->plan.renderings[work.plan.rendering]);
    check_targets(work, model.input->plan.renderings[work.plan.rendering]);
  }
}

}  // namespace rg::verify
