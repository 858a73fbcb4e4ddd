#include "compiler/verify/structure.h"

#include <algorithm>
#include <string>

#include "compiler/verify/submission.h"

namespace rg::verify {
namespace {

struct Bounds {
  Report& report;
  bool good = true;
  void expect(bool condition, const std::string& text) {
    if (condition) return;
    good = false;
    report.add({Hazard::invalid_plan, "", "", "", text});
  }
  void slice(uint64_t first, uint64_t count, size_t size, const std::string& what) {
    expect(first + count <= size, what + " reach beyond their table");
  }
};

void check_mappings(const Input& input, Bounds& bounds) {
  const auto unique = [](std::vector<uint32_t> values) {
    std::sort(values.begin(), values.end());
    return std::adjacent_find(values.begin(), values.end()) == values.end();
  };
  bounds.expect(input.program_pass.size() == input.plan.passes.size() && unique(input.program_pass),
                "plan passes and program passes do not correspond");
  bounds.expect(input.program_resource.size() == input.plan.resources.size() && unique(input.program_resource),
                "plan resources and program resources do not correspond");
  for (const uint32_t pass : input.program_pass) bounds.expect(pass < input.graph.passes.size(), "a plan pass has no program pass");
  for (const uint32_t resource : input.program_resource)
    bounds.expect(resource < input.graph.resources.size(), "a plan resource has no program resource");
  if (!bounds.good) return;
  for (uint32_t r = 0; r < input.plan.resources.size(); ++r) {
    const dsl::Resource& source = input.graph.resources.rows[input.program_resource[r]];
    const uint32_t copies = source.lifetime == dsl::Lifetime::history ? source.history + 1 : 1;
    bounds.expect(input.plan.resources[r].copies == copies, "`" + source.name + "` needs " + std::to_string(copies) + " copies");
    bounds.expect((input.plan.resources[r].kind == ResourceKind::image) == (source.kind == dsl::ResourceKind::image),
                  "`" + source.name + "` is planned as another kind");
    bounds.expect(static_cast<uint32_t>(input.plan.resources[r].lifetime) == static_cast<uint32_t>(source.lifetime),
                  "`" + source.name + "` is planned with another lifetime");
  }
}

void check_refs(const Input& input, Bounds& bounds) {
  const Plan& plan = input.plan;
  const auto ref = [&](Ref r, const char* what) {
    bounds.expect(r.resource < plan.resources.size() && r.age < plan.resources[r.resource].copies, std::string(what) + " names no resource");
  };
  for (const ImageBarrier& barrier : plan.image_barriers) ref(barrier.image, "an image barrier");
  for (const BufferBarrier& barrier : plan.buffer_barriers) ref(barrier.buffer, "a buffer barrier");
  for (const Boundary& boundary : plan.entry) ref(boundary.ref, "an entry state");
  for (const Boundary& boundary : plan.exit) ref(boundary.ref, "an exit state");
  const auto queue = [&](Index q, const char* what) { bounds.expect(q == kNone || q < plan.queues.size(), std::string(what) + " names no queue"); };
  const auto transfer = [&](const auto& barrier) {
    queue(barrier.src_queue, "a barrier"), queue(barrier.dst_queue, "a barrier");
    bounds.expect((barrier.src_queue == kNone) == (barrier.dst_queue == kNone), "a barrier transfers ownership from or to nobody");
  };
  for (const ImageBarrier& barrier : plan.image_barriers) transfer(barrier);
  for (const BufferBarrier& barrier : plan.buffer_barriers) transfer(barrier);
  for (const Boundary& boundary : plan.entry) queue(boundary.queue, "an entry state");
  for (const Boundary& boundary : plan.exit) queue(boundary.queue, "an exit state");
  for (const Attachment& attachment : plan.attachments) ref(attachment.ref, "an attachment");
  for (const Access& access : plan.accesses) ref(access.ref, "an access");
  for (const Acquire& acquire : plan.acquires)
    bounds.expect(acquire.resource < plan.resources.size() && (acquire.group == kNone || acquire.group < plan.groups.size()),
                  "an acquire names no resource or group");
  for (const Acquire& acquire : plan.acquires)
    bounds.expect(acquire.first_clock == kNone || (acquire.queue < plan.queues.size() && acquire.group != kNone &&
                                                   uint64_t{acquire.first_clock} + 2 * plan.queues.size() <= plan.alias_clocks.size()),
                  "an acquire has no clock");
  for (const Release& release : plan.releases)
    bounds.expect(release.resource < plan.resources.size() && release.queue < plan.queues.size(), "a release names no resource or queue");
}

// Byte ranges may name expressions.
void check_bytes(const Plan& plan, Bounds& bounds) {
  const auto good = [&](const Bytes& bytes) {
    return (bytes.offset == kNone || bytes.offset < plan.exprs.size()) && (bytes.size == kNone || bytes.size < plan.exprs.size());
  };
  const auto check = [&](const Bytes& bytes) { bounds.expect(good(bytes), "a byte range names no expression"); };
  for (const BufferBarrier& row : plan.buffer_barriers) check(row.bytes);
  for (const Access& row : plan.accesses) check(row.bytes);
  for (const Boundary& row : plan.entry) check(row.bytes);
  for (const Boundary& row : plan.exit) check(row.bytes);
  for (const Transfer& row : plan.transfers) check(row.src_bytes), check(row.dst_bytes);
}

void check_tables(const Plan& plan, Bounds& bounds) {
  for (const BarrierGroup& group : plan.groups) {
    bounds.slice(group.first_memory, group.memory_count, plan.memory_barriers.size(), "memory barriers of a group");
    bounds.slice(group.first_image, group.image_count, plan.image_barriers.size(), "image barriers of a group");
    bounds.slice(group.first_buffer, group.buffer_count, plan.buffer_barriers.size(), "buffer barriers of a group");
  }
  for (const Pass& pass : plan.passes) {
    bounds.slice(pass.first_access, pass.access_count, plan.accesses.size(), "accesses of a pass");
    bounds.expect(pass.rendering == kNone || pass.rendering < plan.renderings.size(), "a pass names no rendering");
  }
  for (const Rendering& rendering : plan.renderings) {
    bounds.slice(rendering.first_color, rendering.color_count, plan.attachments.size(), "attachments of a rendering");
    bounds.expect(rendering.depth == kNone || rendering.depth < plan.attachments.size(), "a depth attachment is missing");
    bounds.expect(rendering.stencil == kNone || rendering.stencil < plan.attachments.size(), "a stencil attachment is missing");
  }
}

// Events are for graphics and compute queues (VUID-vkCmdSetEvent2-commandBuffer-cmdpool) and do not order the host
// (VUID-vkCmdSetEvent2-srcStageMask-03827). Both halves stand in one batch, no owner changes between them, and the runtime adds nothing to them.
void check_events(const Plan& plan, Bounds& bounds) {
  std::vector<bool> taken(plan.groups.size());
  const auto check_masks = [&](const auto& row) {
    bounds.expect(((row.src_stages | row.dst_stages) & stage::host) == 0, "an event orders the host");
    if constexpr (requires { row.src_queue; }) bounds.expect(row.src_queue == row.dst_queue, "an event changes an owner");
  };
  for (const BarrierGroup& group : plan.groups) {
    if (group.event == kNone) continue;
    bounds.expect(group.event < taken.size() && !taken[group.event], "two groups have one event, or there are not so many");
    if (!bounds.good) return;
    taken[group.event] = true;
    std::ranges::for_each(plan.memory_barriers.subspan(group.first_memory, group.memory_count), check_masks);
    std::ranges::for_each(plan.image_barriers.subspan(group.first_image, group.image_count), check_masks);
    std::ranges::for_each(plan.buffer_barriers.subspan(group.first_buffer, group.buffer_count), check_masks);
  }
  for (const Acquire& acquire : plan.acquires)
    bounds.expect(acquire.group == kNone || acquire.group >= plan.groups.size() || plan.groups[acquire.group].event == kNone,
                  "memory changes hands in a group that is split");
}

void check_halves(const Plan& plan, Bounds& bounds) {
  std::vector<uint32_t> set_in(plan.groups.size(), kNone), awaited_in(plan.groups.size(), kNone);  // by group: batch
  for (uint32_t b = 0; b < plan.batches.size(); ++b)
    for (const Step& step : plan.steps.subspan(plan.batches[b].first_step, plan.batches[b].step_count)) {
      if (step.kind == StepKind::pass) continue;
      const bool split = plan.groups[step.index].event != kNone;
      bounds.expect(step.kind == StepKind::barriers || split, "a group that is not split is set");
      if (!split) continue;
      uint32_t& half = (step.kind == StepKind::set ? set_in : awaited_in)[step.index];
      bounds.expect(half == kNone, "a half of a split group stands twice");
      bounds.expect(step.kind == StepKind::set || set_in[step.index] == b, "an event is awaited that its batch has not set");
      bounds.expect(plan.queues[plan.batches[b].queue].kind != QueueKind::transfer, "a transfer queue knows no events");
      half = b;
    }
  bounds.expect(set_in == awaited_in, "an event is set and not awaited");
}

void check_steps(const Plan& plan, Bounds& bounds) {
  std::vector<uint32_t> passes(plan.passes.size()), groups(plan.groups.size());
  for (const Batch& batch : plan.batches) {
    bounds.slice(batch.first_step, batch.step_count, plan.steps.size(), "steps of a batch");
    if (!bounds.good) return;
    for (uint32_t s = batch.first_step; s < batch.first_step + batch.step_count; ++s) {
      const Step& step = plan.steps[s];
      std::vector<uint32_t>& counts = step.kind == StepKind::pass ? passes : groups;
      bounds.expect(step.index < counts.size(), "a step names nothing");
      if (!bounds.good) return;
      counts[step.index] += step.kind != StepKind::set;
    }
  }
  bounds.expect(std::all_of(passes.begin(), passes.end(), [](uint32_t n) { return n == 1; }), "a pass is not executed exactly once");
  bounds.expect(std::all_of(groups.begin(), groups.end(), [](uint32_t n) { return n <= 1; }), "a barrier group is executed twice");
}

void check_configuration(const Input& input, Bounds& bounds) {
  for (const uint32_t index : input.program_pass) {
    const dsl::Pass& pass = input.graph.passes.rows[index];
    bounds.expect(is_selected(pass.guard, input.configuration), "`" + pass.name + "` does not belong to this configuration");
  }
}

// ---- valid usage ------------------------------------------------------------------------------------------------

struct Usage {
  const Model& model;
  Report& report;
};

std::string scope_text(const Model& model, const Scope& scope) {
  const char* kinds[] = {"memory barrier ", "image barrier ", "buffer barrier ", "wait ", "signal "};
  std::string text = kinds[static_cast<size_t>(scope.kind)] + std::to_string(scope.index);
  if (scope.has_range()) text += " on `" + model.resource(scope.resource).name + "`";
  return text;
}

void report_scope(const Usage& usage, const Scope& scope, const std::string& text) {
  const std::string resource = scope.kind == ScopeKind::memory ? "" : usage.model.resource(scope.resource).name;
  usage.report.add({Hazard::invalid_barrier, resource, "", "", scope_text(usage.model, scope) + ": " + text});
}

constexpr Stages kTooWideStages = stage::all_commands | stage::all_graphics | stage::bottom_of_pipe;
constexpr Accesses kTooWideAccesses = access::memory_read | access::memory_write;

// VUID-*-srcAccessMask-* and -dstAccessMask-*: an access needs a stage that can perform it.
void check_masks(const Usage& usage, const Scope& scope) {
  if (unknown_stages((scope.raw_src | scope.raw_dst) & ~stage::bottom_of_pipe) || unknown_accesses(scope.raw_src_accesses | scope.raw_dst_accesses))
    report_scope(usage, scope, "its masks have unknown bits");
  if (scope.src_accesses & ~supported_by_any(scope.src)) report_scope(usage, scope, "no source stage supports its source accesses");
  if (scope.dst_accesses & ~supported_by_any(scope.dst)) report_scope(usage, scope, "no destination stage supports its destination accesses");
  const bool wide = ((scope.raw_src | scope.raw_dst) & kTooWideStages) || ((scope.raw_src_accesses | scope.raw_dst_accesses) & kTooWideAccesses);
  if (wide && scope.tag != BarrierTag::workaround) report_scope(usage, scope, "its masks are wider than any plan may use");
}

// VUID-VkImageMemoryBarrier2-image-04071, -srcQueueFamilyIndex-04070, -None-09053; both halves belong to the queues they name.
void check_queues(const Usage& usage, const Scope& scope, Index src, Index dst, bool concurrent) {
  if (src == dst) return;
  if (concurrent) report_scope(usage, scope, "it transfers ownership of a resource that is shared");
  if (scope.queue != src && scope.queue != dst) report_scope(usage, scope, "it transfers ownership between two queues other than its own");
}

// VUID-VkImageMemoryBarrier2-newLayout-01198, -oldLayout-012xx, -subresourceRange-014xx.
void check_image_scope(const Usage& usage, const Scope& scope) {
  const ResourceNode& node = usage.model.resources[scope.resource];
  const ImageBarrier& barrier = usage.model.input->plan.image_barriers[scope.index];
  const Resource& image = usage.model.input->plan.resources[barrier.image.resource];
  if (!node.partition.shape.image) return report_scope(usage, scope, "it names a buffer");
  const Box box = box_of(node.partition.shape, barrier.range);
  if (box.empty() || box.mip_end > node.partition.shape.mips || box.layer_end > node.partition.shape.layers)
    report_scope(usage, scope, "its range is outside the image");
  if (box.aspects & ~node.partition.shape.aspects) report_scope(usage, scope, "its aspects are not those of the format");
  if (scope.new_layout == Layout::undefined) report_scope(usage, scope, "its new layout is undefined");
  // Of imported images the engine decides the usage.
  const uint32_t allowed = image.lifetime == Lifetime::imported ? 0 : image.usage;
  for (const Layout layout : {scope.old_layout, scope.new_layout})
    if (usage_for(layout) != 0 && allowed != 0 && !(usage_for(layout) & allowed))
      report_scope(usage, scope, "the image's usage does not allow layout " + layout_name(layout));
  check_queues(usage, scope, barrier.src_queue, barrier.dst_queue, image.concurrent);
}

void check_buffer_scope(const Usage& usage, const Scope& scope) {
  const BufferBarrier& barrier = usage.model.input->plan.buffer_barriers[scope.index];
  if (usage.model.resources[scope.resource].partition.shape.image) return report_scope(usage, scope, "it names an image");
  const auto varies = [&](Index expr) { return expr != kNone && usage.model.input->plan.exprs[expr].op != ExprOp::constant; };
  const bool sometimes = varies(barrier.bytes.offset) || varies(barrier.bytes.size);  // the runtime leaves it out where it is empty
  if (scope.cells.empty() && !sometimes) report_scope(usage, scope, "its range is empty");
  check_queues(usage, scope, barrier.src_queue, barrier.dst_queue, usage.model.input->plan.resources[barrier.buffer.resource].concurrent);
}

std::vector<std::string> conditions_of_plan(const Model& model, const Pass& pass) {
  std::vector<std::string> names;
  for (uint32_t bit = 0; bit < 64; ++bit)
    if (pass.guard >> bit & 1)
      names.emplace_back(bit < model.input->plan.conditions.size() ? model.input->plan.conditions[bit] : std::string_view("?"));
  std::sort(names.begin(), names.end());
  return names;
}
std::vector<std::string> conditions_of_program(const Model& model, const dsl::Pass& pass) {
  std::vector<std::string> names;
  for (const dsl::ConditionId condition : pass.conditions) names.push_back(model.input->program.conditions[condition].name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

using Limits = std::vector<std::pair<uint32_t, uint32_t>>;
Limits limits_of_plan(const Model& model, const Pass& pass) {
  Limits limits;
  for (uint32_t i = pass.first_mip_limit; i < pass.first_mip_limit + pass.mip_limit_count && i < model.input->plan.mip_limits.size(); ++i) {
    const MipLimit& limit = model.input->plan.mip_limits[i];
    limits.emplace_back(limit.image < model.input->program_resource.size() ? model.input->program_resource[limit.image] : kNone, limit.mip);
  }
  std::sort(limits.begin(), limits.end());
  return limits;
}
Limits limits_of_program(const dsl::Pass& pass) {
  Limits limits;
  for (const dsl::MipLimit& limit : pass.mip_limits) limits.emplace_back(limit.image.value, limit.mip);
  std::sort(limits.begin(), limits.end());
  return limits;
}

void check_guards(const Usage& usage, const PassNode& node) {
  const Pass& plan = usage.model.input->plan.passes[node.plan_pass];
  const dsl::Pass& program = usage.model.pass(node.plan_pass);
  const bool same = conditions_of_plan(usage.model, plan) == conditions_of_program(usage.model, program) &&
                    limits_of_plan(usage.model, plan) == limits_of_program(program);
  if (!same) usage.report.add({Hazard::invalid_plan, "", program.name, "", "`" + program.name + "` runs under other conditions than declared"});
}

// Attachments are written by fixed function while shaders run: the same element may be in no other role, unless both only read.
void check_feedback(const Usage& usage, const PassNode& node) {
  for (const Use& a : node.uses)
    for (const Use& b : node.uses) {
      if (!a.attachment || !a.writes || &a == &b || a.resource != b.resource || a.age != b.age) continue;
      const dsl::Role role = usage.model.pass(node.plan_pass).accesses[b.access].role;
      if (role == dsl::Role::resolve_src) continue;
      std::vector<uint32_t> both;
      std::set_intersection(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(), std::back_inserter(both));
      if (both.empty()) continue;
      const std::string pass = usage.model.pass_name(node.plan_pass);
      usage.report.add({Hazard::read_after_write, usage.model.resource(a.resource).name, pass, pass,
                        "`" + pass + "` uses " + usage.model.place(a.resource, both.front()) +
                            " as an attachment it writes and in a second role at once: a feedback loop"});
    }
}

// Memory that is there only while a rendering is: nobody may expect anything of it before or after.
void check_lazy(const Model& model, Report& report) {
  const Input& input = *model.input;
  const auto refuse = [&](Index r, const std::string& text) {
    report.add(
        {Hazard::lost_contents, model.resource(r).name, "", "", "`" + model.resource(r).name + "` is in lazily allocated memory, and " + text});
  };
  for (Index r = 0; r < input.plan.resources.size(); ++r) {
    if (!input.plan.resources[r].lazy) continue;
    const dsl::Resource& source = input.graph.resources.rows[input.program_resource[r]];
    if (source.kind != dsl::ResourceKind::image || source.lifetime != dsl::Lifetime::transient || source.is_output)
      refuse(r, "is no image that only this frame sees");
    for (const Attachment& row : input.plan.attachments) {
      const bool loads = row.load == LoadOp::load, stores = row.store == StoreOp::store;
      if (row.ref.resource == r && (loads || stores)) refuse(r, loads ? "a rendering loads it" : "a rendering stores it");
      if (row.resolve.resource == r) refuse(r, "a rendering resolves to it");
    }
    for (const PassNode& node : model.passes)
      for (const dsl::Access& access : model.pass(node.plan_pass).accesses) {
        const bool drawn = access.role == dsl::Role::color || access.role == dsl::Role::depth || access.role == dsl::Role::depth_readonly ||
                           access.role == dsl::Role::stencil;
        if (access.resource.value == input.program_resource[r] && !drawn)
          refuse(r, "`" + model.pass_name(node.plan_pass) + "` uses it otherwise than as an attachment");
      }
  }
}

void check_declared_order(const Model& model, Report& report) {
  std::vector<uint32_t> position(model.input->graph.passes.size(), kNone);
  for (uint32_t s = 0; s < model.steps.size(); ++s)
    if (model.steps[s].is_pass) position[model.passes[model.steps[s].index].program_pass] = s;
  for (uint32_t p = 0; p < position.size(); ++p) {
    const dsl::Pass& pass = model.input->graph.passes.rows[p];
    if (position[p] == kNone) continue;
    for (const dsl::PassId after : pass.after)
      if (position[after.value] != kNone && position[after.value] > position[p])
        report.add({Hazard::order, "", model.input->graph.passes[after].name, pass.name,
                    "`" + pass.name + "` runs before `" + model.input->graph.passes[after].name + "`, which it is declared to follow"});
  }
}

void check_kept(const Model& model, Report& report) {
  std::vector<bool> planned(model.input->graph.passes.size());
  for (const PassNode& node : model.passes) planned[node.program_pass] = true;
  for (uint32_t p = 0; p < planned.size(); ++p) {
    const dsl::Pass& pass = model.input->graph.passes.rows[p];
    if (pass.keep && is_selected(pass.guard, model.input->configuration) && !planned[p])
      report.add({Hazard::missing_pass, "", pass.name, "", "`" + pass.name + "` is declared `keep` but is not planned"});
  }
}

}  // namespace

bool check_indices(const Input& input, Report& report) {
  Bounds bounds{report};
  check_mappings(input, bounds);
  if (bounds.good) check_refs(input, bounds);
  if (bounds.good) check_tables(input.plan, bounds);
  if (bounds.good) check_bytes(input.plan, bounds);
  if (bounds.good) bounds.good = check_timelines(input.plan, report);
  if (bounds.good) check_steps(input.plan, bounds);
  if (bounds.good) check_events(input.plan, bounds);
  if (bounds.good) check_halves(input.plan, bounds);
  if (bounds.good) check_configuration(input, bounds);
  return bounds.good;
}

void check_usage(const Model& model, Report& report) {
  const Usage usage{model, report};
  for (const Scope& scope : model.scopes) {
    if (scope.kind != ScopeKind::wait && scope.kind != ScopeKind::signal) check_masks(usage, scope);
    if (scope.kind == ScopeKind::image) check_image_scope(usage, scope);
    if (scope.kind == ScopeKind::buffer) check_buffer_scope(usage, scope);
  }
  for (const PassNode& node : model.passes) {
    check_guards(usage, node);
    check_feedback(usage, node);
  }
  check_lazy(model, report);
  check_declared_order(model, report);
  check_kept(model, report);
}

}  // namespace rg::verify
