#include "tiny_frame.h"

namespace rg::test {

namespace {
dsl::ExprId constant(dsl::Program& program, int64_t value) {
  dsl::Expr expr;
  expr.value = value;
  return program.exprs.add(expr);
}
}  // namespace

TinyFrame::TinyFrame() {
  program.graphs.add({});
  plan.queues.push_back({});
  plan.batches.push_back({});
}

uint32_t TinyFrame::add(dsl::Resource resource) {
  graph().resources.add(resource);
  Resource row;
  row.name = intern(resource.name);
  row.kind = static_cast<ResourceKind>(resource.kind);
  row.lifetime = static_cast<Lifetime>(resource.lifetime);
  row.copies = resource.history + 1;
  plan.resources.push_back(row);
  plan.program_resource.push_back(static_cast<uint32_t>(plan.program_resource.size()));
  return plan.program_resource.back();
}

uint32_t TinyFrame::buffer(const std::string& name, dsl::Lifetime lifetime, uint32_t history) {
  dsl::Resource row;
  row.name = name, row.kind = dsl::ResourceKind::buffer, row.lifetime = lifetime, row.history = history;
  row.stride = 4, row.count = constant(program, 16);
  return add(row);
}

uint32_t TinyFrame::image(const std::string& name, dsl::Lifetime lifetime) {
  dsl::Resource row;
  row.name = name, row.format = dsl::Format::rgba8, row.lifetime = lifetime;
  row.width = row.height = constant(program, 16);
  return add(row);
}

void TinyFrame::add_rendering(const std::vector<Use>& uses) {
  Rendering rendering;
  rendering.first_color = static_cast<Index>(plan.attachments.size());
  for (const Use& use : uses) {
    if (use.role != dsl::Role::color) continue;
    Attachment attachment;
    attachment.ref = {use.resource, use.age}, attachment.layout = use.layout;
    attachment.load = use.clear ? LoadOp::clear : LoadOp::load;
    plan.attachments.push_back(attachment);
    ++rendering.color_count;
  }
  plan.renderings.push_back(rendering);
  plan.passes.back().rendering = static_cast<Index>(plan.renderings.size() - 1);
}

uint32_t TinyFrame::pass(const std::string& name, dsl::PassKind kind, std::initializer_list<Use> uses) {
  dsl::Pass source;
  source.name = name, source.kind = kind;
  Pass pass;
  pass.name = intern(name), pass.kind = static_cast<PassKind>(kind);
  pass.first_access = static_cast<Index>(plan.accesses.size());
  pass.access_count = static_cast<Index>(uses.size());
  for (const Use& use : uses) {
    dsl::Access access;
    access.resource = dsl::ResourceId{size_t{use.resource}}, access.mode = use.mode, access.role = use.role, access.age = use.age;
    if (use.clear) access.clear.emplace();
    source.accesses.push_back(access);
    Access listed;
    listed.ref = {use.resource, use.age}, listed.layout = use.layout, listed.writes = use.mode != dsl::Mode::read;
    plan.accesses.push_back(listed);
  }
  const auto index = static_cast<uint32_t>(plan.passes.size());
  plan.passes.push_back(pass);
  if (kind == dsl::PassKind::raster) add_rendering(uses);
  plan.program_pass.push_back(static_cast<uint32_t>(graph().passes.add(source).value));
  plan.steps.push_back({StepKind::pass, index});
  plan.batches[0].step_count = static_cast<Index>(plan.steps.size());
  return index;
}

void TinyFrame::group(std::initializer_list<MemoryBarrier> memory, std::initializer_list<ImageBarrier> images) {
  BarrierGroup group;
  group.first_memory = static_cast<Index>(plan.memory_barriers.size()), group.memory_count = static_cast<Index>(memory.size());
  group.first_image = static_cast<Index>(plan.image_barriers.size()), group.image_count = static_cast<Index>(images.size());
  plan.memory_barriers.insert(plan.memory_barriers.end(), memory);
  plan.image_barriers.insert(plan.image_barriers.end(), images);
  plan.groups.push_back(group);
  plan.steps.push_back({StepKind::barriers, static_cast<Index>(plan.groups.size() - 1)});
  plan.batches[0].step_count = static_cast<Index>(plan.steps.size());
}
void TinyFrame::memory(const MemoryBarrier& barrier) { group({barrier}, {}); }
void TinyFrame::images(std::initializer_list<ImageBarrier> barriers) { group({}, barriers); }

void TinyFrame::boundary(const Boundary& state) {
  plan.entry.push_back(state);
  plan.exit.push_back(state);
}

std::vector<machine::Divergence> TinyFrame::run(const machine::MachineOptions& options) const {
  return machine::run_adversarially(program, dsl::GraphId{0}, {}, plan.view(), plan.program_pass, plan.program_resource, options);
}

}  // namespace rg::test
