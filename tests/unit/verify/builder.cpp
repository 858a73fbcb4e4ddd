#include "tests/unit/verify/builder.h"

#include <algorithm>
#include <set>

namespace rg::verify {
namespace {

// Plan rows name more than any pass does, so that they never decide a case.
constexpr Stages kEveryStage = stage::all_commands | stage::host | stage::copy;
constexpr Accesses kEveryAccess = access::memory_read | access::memory_write;

Layout usual_layout(dsl::Role role, bool depth) {
  switch (role) {
    case dsl::Role::sampled:
    case dsl::Role::input:
      return depth ? Layout::depth_read_only : Layout::shader_read_only;
    case dsl::Role::color:
    case dsl::Role::resolve_dst:
    case dsl::Role::resolve_src:
      return Layout::color_attachment;
    case dsl::Role::depth:
      return Layout::depth_attachment;
    case dsl::Role::depth_readonly:
      return Layout::depth_read_only;
    case dsl::Role::stencil:
      return Layout::stencil_attachment;
    case dsl::Role::copy_src:
    case dsl::Role::blit_src:
      return Layout::transfer_src;
    case dsl::Role::copy_dst:
    case dsl::Role::blit_dst:
    case dsl::Role::clear_dst:
    case dsl::Role::fill_dst:
    case dsl::Role::update_dst:
      return Layout::transfer_dst;
    case dsl::Role::present:
      return Layout::present_src;
    default:
      return Layout::general;
  }
}

uint32_t plan_aspects(const dsl::Resource& resource, dsl::Role role) {
  const std::string format = dsl::name(resource.format);
  const bool depth = format.starts_with("d"), stencil = format.ends_with("s8");
  if (role == dsl::Role::stencil) return aspect_stencil;
  if (depth && stencil && (role == dsl::Role::copy_src || role == dsl::Role::copy_dst)) return aspect_depth | aspect_stencil;
  return depth ? aspect_depth : stencil ? aspect_stencil : aspect_color;
}

bool is_attachment_role(dsl::Role role) {
  return role == dsl::Role::color || role == dsl::Role::depth || role == dsl::Role::depth_readonly || role == dsl::Role::stencil;
}

dsl::Access declare(const Do& use, const std::string& name) {
  dsl::Access access;
  access.resource = use.resource;
  access.range = use.range;
  access.age = use.age;
  access.mode = use.mode;
  access.role = use.role;
  access.stages = use.stages;
  access.name = name;
  access.covers = use.covers;
  access.disjoint = use.disjoint;
  if (use.clear) access.clear = dsl::ClearValue{};
  return access;
}

}  // namespace

Plan PlanTables::view() const {
  Plan plan;
  plan.exprs = exprs, plan.resources = resources, plan.queues = queues, plan.batches = batches, plan.steps = steps, plan.groups = groups;
  plan.waits = waits, plan.signals = signals, plan.alias_clocks = alias_clocks;
  plan.memory_barriers = memory_barriers, plan.image_barriers = image_barriers, plan.buffer_barriers = buffer_barriers;
  plan.entry = entry, plan.exit = exit, plan.acquires = acquires, plan.releases = releases;
  plan.passes = passes, plan.accesses = accesses, plan.renderings = renderings, plan.attachments = attachments, plan.transfers = transfers;
  plan.vertex_buffers = vertex_buffers, plan.conditions = conditions;
  return plan;
}

Builder::Builder() { program.graphs.add({}); }

Index Builder::constant(int64_t value) {
  plan.exprs.push_back({ExprOp::constant, kNone, kNone, value});
  return static_cast<Index>(plan.exprs.size() - 1);
}

dsl::ExprId Builder::program_constant(int64_t value) { return program.exprs.add({dsl::ExprOp::constant, {}, {}, value}); }

dsl::ResourceId Builder::buffer(const std::string& name, int64_t bytes) {
  dsl::Resource row;
  row.name = name;
  row.kind = dsl::ResourceKind::buffer;
  row.lifetime = dsl::Lifetime::imported;
  row.stride = 1;
  row.count = program_constant(bytes);
  const dsl::ResourceId id = graph().resources.add(row);
  names.push_back(name);
  Resource planned_row;
  planned_row.name = names.back();
  planned_row.kind = ResourceKind::buffer;
  planned_row.lifetime = Lifetime::imported;
  planned_row.bytes = constant(bytes);
  plan.resources.push_back(planned_row);
  plan.program_resource.push_back(id.value);
  boundary(id, {}, {{}, {}, kEveryStage, kEveryAccess, Layout::undefined});
  return id;
}

dsl::ResourceId Builder::image(const std::string& name, dsl::Format format, uint32_t mips, uint32_t layers) {
  const dsl::ResourceId id = buffer(name);
  dsl::Resource& row = source(id);
  row.kind = dsl::ResourceKind::image;
  row.format = format;
  row.mips = mips, row.layers = layers;
  row.count = {};
  planned(id).kind = ResourceKind::image;
  planned(id).mips = mips, planned(id).layers = layers;
  return id;
}

void Builder::boundary(dsl::ResourceId id, Boundary entry, Boundary exit) {
  entry.ref.resource = exit.ref.resource = id.value;
  const auto mine = [&](const Boundary& row) { return row.ref.resource == id.value && row.ref.age == entry.ref.age; };
  std::erase_if(plan.entry, mine);
  std::erase_if(plan.exit, [&](const Boundary& row) { return row.ref.resource == id.value && row.ref.age == exit.ref.age; });
  plan.entry.push_back(entry);
  plan.exit.push_back(exit);
}

void Builder::lifetime(dsl::ResourceId id, dsl::Lifetime lifetime, uint32_t history) {
  source(id).lifetime = lifetime;
  source(id).history = history;
  if (lifetime == dsl::Lifetime::history || lifetime == dsl::Lifetime::persistent) source(id).init = dsl::InitKind::clear;
  planned(id).lifetime = static_cast<Lifetime>(lifetime);
  planned(id).copies = history + 1;
}

BarrierGroup& Builder::open_group(bool join) {
  if (join) return plan.groups.back();
  BarrierGroup group;
  group.first_memory = static_cast<Index>(plan.memory_barriers.size());
  group.first_image = static_cast<Index>(plan.image_barriers.size());
  group.first_buffer = static_cast<Index>(plan.buffer_barriers.size());
  plan.groups.push_back(group);
  plan.steps.push_back({StepKind::barriers, static_cast<Index>(plan.groups.size() - 1)});
  return plan.groups.back();
}

void Builder::memory(Stages s, Accesses sa, Stages d, Accesses da, bool join) {
  ++open_group(join).memory_count;
  plan.memory_barriers.push_back({s, sa, d, da});
}

void Builder::image_barrier(dsl::ResourceId id, Layout from, Layout to, Stages s, Accesses sa, Stages d, Accesses da, Range range, bool join) {
  ++open_group(join).image_count;
  if (range.aspects == 0) range.aspects = plan_aspects(source(id), dsl::Role::copy_src);
  plan.image_barriers.push_back({{id.value, 0}, range, s, sa, d, da, from, to});
}

void Builder::buffer_barrier(dsl::ResourceId id, Stages s, Accesses sa, Stages d, Accesses da, bool join) {
  ++open_group(join).buffer_count;
  plan.buffer_barriers.push_back({{id.value, 0}, {}, s, sa, d, da});
}

dsl::PassId Builder::pass(dsl::PassKind kind, const std::string& name, const std::vector<Do>& accesses) {
  dsl::Pass row;
  row.name = name;
  row.kind = kind;
  if (!plan.batches.empty()) row.queue = static_cast<dsl::QueueKind>(plan.queues[plan.batches.back().queue].kind);
  Pass planned_pass;
  names.push_back(name);
  planned_pass.name = names.back();
  planned_pass.kind = static_cast<PassKind>(kind);
  planned_pass.first_access = static_cast<Index>(plan.accesses.size());
  Rendering rendering;
  rendering.first_color = static_cast<Index>(plan.attachments.size());
  std::vector<std::pair<dsl::Role, Attachment>> others;
  for (const Do& use : accesses) {
    row.accesses.push_back(declare(use, "a" + std::to_string(row.accesses.size())));
    const bool depth = plan_aspects(source(use.resource), use.role) == aspect_depth;
    const Layout layout = use.layout == Layout::undefined ? usual_layout(use.role, depth) : use.layout;
    Range range{plan_aspects(source(use.resource), use.role), use.range.mip, use.range.mips, use.range.layer, use.range.layers};
    Bytes bytes;
    if (use.range.offset.valid())
      bytes = {constant(dsl::evaluate(program, use.range.offset, {})), constant(dsl::evaluate(program, use.range.size, {}))};
    if (is_attachment_role(use.role)) range.mips = 1;
    plan.accesses.push_back({{use.resource.value, use.age}, range, bytes, kEveryStage, kEveryAccess, layout, use.mode != dsl::Mode::read});
    if (!is_attachment_role(use.role) || kind != dsl::PassKind::raster) continue;
    const Attachment attachment{
        {use.resource.value, use.age}, range, 0, 0, rg::Format::undefined, layout, use.load, use.store, {}, {}, {}, Layout::undefined, 0};
    const uint32_t layers = use.range.layers == dsl::kAll ? source(use.resource).layers - use.range.layer : use.range.layers;
    rendering.layers = rendering.color_count + others.size() == 0 ? layers : std::min(rendering.layers, layers);
    if (use.role == dsl::Role::color)
      plan.attachments.push_back(attachment), ++rendering.color_count;
    else
      others.emplace_back(use.role, attachment);
  }
  planned_pass.access_count = static_cast<Index>(accesses.size());
  for (const auto& [role, attachment] : others) {
    (role == dsl::Role::stencil ? rendering.stencil : rendering.depth) = static_cast<Index>(plan.attachments.size());
    plan.attachments.push_back(attachment);
  }
  if (rendering.color_count + others.size() > 0) {
    planned_pass.rendering = static_cast<Index>(plan.renderings.size());
    plan.renderings.push_back(rendering);
  }
  plan.steps.push_back({StepKind::pass, static_cast<Index>(plan.passes.size())});
  plan.passes.push_back(planned_pass);
  const dsl::PassId id = graph().passes.add(std::move(row));
  plan.program_pass.push_back(id.value);
  return id;
}

void Builder::merge_rendering() { plan.passes.back().rendering = plan.passes[plan.passes.size() - 2].rendering; }

void Builder::condition(dsl::PassId pass, const std::string& name) {
  const dsl::ConditionId id = program.conditions.add({name, {}});
  graph().passes[pass].conditions.push_back(id);
  names.push_back(name);
  plan.conditions.push_back(names.back());
  for (size_t p = 0; p < plan.passes.size(); ++p)
    if (plan.program_pass[p] == pass.value) plan.passes[p].guard |= uint64_t{1} << (plan.conditions.size() - 1);
}

Index Builder::queue(QueueKind kind) {
  plan.queues.push_back({kind});
  return static_cast<Index>(plan.queues.size() - 1);
}

// Where nothing is said of a resource's end, it may end on any queue.
void Builder::end_anywhere() {
  std::vector<Boundary> more;
  if (plan.queues.size() == 1) return;
  for (Boundary& row : plan.exit)
    if (row.queue == kNone) row.queue = 0;
  for (Boundary row : plan.exit)
    for (row.queue = 1; row.stages == kEveryStage && row.queue < plan.queues.size(); ++row.queue) more.push_back(row);
  plan.exit.insert(plan.exit.end(), more.begin(), more.end());
}

void Builder::batch(Index queue) {
  close_batch();
  plan.batches.push_back(
      {queue, static_cast<Index>(plan.steps.size()), 0, static_cast<Index>(plan.waits.size()), 0, static_cast<Index>(plan.signals.size()), 0});
}

void Builder::close_batch() {
  if (plan.batches.empty()) return;
  plan.batches.back().step_count = static_cast<Index>(plan.steps.size()) - plan.batches.back().first_step;
}

void Builder::wait(Index queue, uint64_t value, Stages stages, uint32_t frames_ago) {
  plan.waits.push_back({queue, value, stages, frames_ago});
  ++plan.batches.back().wait_count;
}

void Builder::signal(Stages stages) {
  uint64_t value = 1;
  for (const Batch& batch : plan.batches)
    if (batch.queue == plan.batches.back().queue) value += batch.signal_count;
  plan.signals.push_back({value, stages});
  ++plan.batches.back().signal_count;
}

void Builder::give(dsl::ResourceId id, Index to, Layout from_layout, Layout to_layout, Stages s, Accesses sa, Stages d) {
  transfer_barrier(id, plan.batches.back().queue, to, from_layout, to_layout, {s, sa, d, 0});
}

void Builder::take(dsl::ResourceId id, Index from, Layout from_layout, Layout to_layout, Stages s, Stages d, Accesses da) {
  transfer_barrier(id, from, plan.batches.back().queue, from_layout, to_layout, {s, 0, d, da});
}

void Builder::transfer_barrier(dsl::ResourceId id, Index from, Index to, Layout from_layout, Layout to_layout, const MemoryBarrier& m) {
  if (source(id).kind == dsl::ResourceKind::image) {
    image_barrier(id, from_layout, to_layout, m.src_stages, m.src_accesses, m.dst_stages, m.dst_accesses);
    plan.image_barriers.back().src_queue = from, plan.image_barriers.back().dst_queue = to;
    return;
  }
  buffer_barrier(id, m.src_stages, m.src_accesses, m.dst_stages, m.dst_accesses);
  plan.buffer_barriers.back().src_queue = from, plan.buffer_barriers.back().dst_queue = to;
}

Index Builder::split() {
  const auto is_split = [](const BarrierGroup& group) { return group.event != kNone; };
  plan.groups.back().event = static_cast<Index>(std::count_if(plan.groups.begin(), plan.groups.end(), is_split));
  plan.steps.back().kind = StepKind::set;
  return static_cast<Index>(plan.groups.size() - 1);
}

Plan Builder::view() {
  if (plan.batches.empty()) plan.batches = {{}};
  close_batch();
  end_anywhere();
  return plan.view();
}

std::vector<Finding> Builder::check(bool irredundancy) {
  VerifyOptions options;
  options.irredundancy = irredundancy;
  return verify(program, dsl::GraphId{size_t{0}}, configuration, view(), plan.program_pass, plan.program_resource, options);
}

std::vector<std::string> Builder::hazards(bool irredundancy) {
  std::set<std::string> kinds;
  for (const Finding& finding : check(irredundancy)) kinds.insert(name(finding.hazard));
  return {kinds.begin(), kinds.end()};
}

Do reads(dsl::ResourceId id, dsl::Role role, uint32_t stages) { return {id, dsl::Mode::read, role, stages}; }
Do writes(dsl::ResourceId id, dsl::Role role, uint32_t stages) { return {id, dsl::Mode::write, role, stages}; }
Do updates(dsl::ResourceId id, dsl::Role role, uint32_t stages) { return {id, dsl::Mode::update, role, stages}; }
Do counts(dsl::ResourceId id, uint32_t stages) { return {id, dsl::Mode::atomic, dsl::Role::storage, stages}; }

}  // namespace rg::verify
