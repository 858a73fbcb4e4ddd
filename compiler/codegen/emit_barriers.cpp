// Barriers, boundaries and hand-offs of memory, each barrier with the passes it stands between.
#include <algorithm>

#include "compiler/codegen/plan_emitter.h"

namespace rg::compiler {
namespace {

size_t step_of_group(const Plan& plan, Index group) {
  for (size_t i = 0; i < plan.steps.size(); ++i)
    if (plan.steps[i].kind == StepKind::barriers && plan.steps[i].index == group) return i;
  return plan.steps.size();
}

bool touches(const Plan& plan, Index pass, const Ref& ref) {
  const Pass& row = plan.passes[pass];
  const auto accesses = plan.accesses.subspan(row.first_access, row.access_count);
  return std::any_of(accesses.begin(), accesses.end(), [&](const Access& access) { return access.ref == ref; });
}

}  // namespace

// "gbuffer -> deferred_light": the last pass before the barrier and the first one after it that touch the resource.
std::string PlanEmitter::flow(const Ref& ref, size_t step) const {
  std::string from = "frame start", to = "frame end";
  for (size_t i = step; i-- > 0;) {
    if (plan_.steps[i].kind != StepKind::pass || !touches(plan_, plan_.steps[i].index, ref)) continue;
    from = plan_.passes[plan_.steps[i].index].name;
    break;
  }
  for (size_t i = step; i < plan_.steps.size(); ++i) {
    if (plan_.steps[i].kind != StepKind::pass || !touches(plan_, plan_.steps[i].index, ref)) continue;
    to = plan_.passes[plan_.steps[i].index].name;
    break;
  }
  return from + " -> " + to;
}

std::string PlanEmitter::group_comment(Index group) const {
  for (size_t i = step_of_group(plan_, group); i < plan_.steps.size(); ++i)
    if (plan_.steps[i].kind == StepKind::pass) {
      const std::string place = origin(text_.files, text_.passes[plan_.steps[i].index]);
      return "before " + std::string(plan_.passes[plan_.steps[i].index].name) + (place.empty() ? "" : "  " + place);
    }
  return "at the end of the frame";
}

void PlanEmitter::barriers() {
  std::vector<std::string> image_flow(plan_.image_barriers.size()), buffer_flow(plan_.buffer_barriers.size());
  for (Index g = 0; g < plan_.groups.size(); ++g) {
    const BarrierGroup& group = plan_.groups[g];
    const size_t step = step_of_group(plan_, g);
    for (Index i = group.first_image; i < group.first_image + group.image_count; ++i) image_flow[i] = flow(plan_.image_barriers[i].image, step);
    for (Index i = group.first_buffer; i < group.first_buffer + group.buffer_count; ++i) buffer_flow[i] = flow(plan_.buffer_barriers[i].buffer, step);
  }
  table("MemoryBarrier", "kMemoryBarriers", plan_.memory_barriers,
        [&](const MemoryBarrier& b, size_t) { return scopes({}, b.src_stages, b.src_accesses, b.dst_stages, b.dst_accesses, b.tag); });
  table("ImageBarrier", "kImageBarriers", plan_.image_barriers, [&](const ImageBarrier& b, size_t i) {
    Row row;
    row.nested("image", ref(b.image)).nested("range", range(b.range)).field("src_stages", stages_text(b.src_stages));
    if (b.src_accesses != 0) row.field("src_accesses", accesses_text(b.src_accesses));
    row.field("dst_stages", stages_text(b.dst_stages));
    if (b.dst_accesses != 0) row.field("dst_accesses", accesses_text(b.dst_accesses));
    row.field("old_layout", layout_text(b.old_layout)).field("new_layout", layout_text(b.new_layout));
    index(row, "src_queue", b.src_queue);
    index(row, "dst_queue", b.dst_queue);
    return scopes(std::move(row), 0, 0, 0, 0, b.tag).comment(image_flow[i]);
  });
  table("BufferBarrier", "kBufferBarriers", plan_.buffer_barriers, [&](const BufferBarrier& b, size_t i) {
    Row row;
    row.nested("buffer", ref(b.buffer)).nested("bytes", bytes(b.bytes));
    row = scopes(std::move(row), b.src_stages, b.src_accesses, b.dst_stages, b.dst_accesses, BarrierTag::hazard);
    index(row, "src_queue", b.src_queue);
    index(row, "dst_queue", b.dst_queue);
    return scopes(std::move(row), 0, 0, 0, 0, b.tag).comment(buffer_flow[i]);
  });
  table("BarrierGroup", "kGroups", plan_.groups, [&](const BarrierGroup& g, size_t i) {
    Row row;
    slice(row, "first_memory", g.first_memory, "memory_count", g.memory_count);
    slice(row, "first_image", g.first_image, "image_count", g.image_count);
    slice(row, "first_buffer", g.first_buffer, "buffer_count", g.buffer_count);
    index(row, "event", g.event);
    return row.comment(group_comment(static_cast<Index>(i)));
  });
}

void PlanEmitter::boundaries() {
  const auto boundary = [&](const Boundary& b, size_t) {
    Row row;
    row.nested("ref", ref(b.ref)).nested("range", range(b.range));
    if (b.stages != 0) row.field("stages", stages_text(b.stages));
    if (b.accesses != 0) row.field("accesses", accesses_text(b.accesses));
    if (b.layout != Layout::undefined) row.field("layout", layout_text(b.layout));
    index(row, "queue", b.queue);
    return row.flag("discard", b.discard).nested("bytes", bytes(b.bytes));
  };
  table("Boundary", "kEntry", plan_.entry, boundary);
  table("Boundary", "kExit", plan_.exit, boundary);
  table("Acquire", "kAcquires", plan_.acquires, [&](const Acquire& a, size_t) {
    Row row;
    row.field("resource", resource(a.resource));
    index(row, "group", a.group);
    index(row, "image_barrier", a.image_barrier);
    row.number("image_barriers", a.image_barriers);
    if (a.stages != 0) row.field("stages", stages_text(a.stages));
    if (a.accesses != 0) row.field("accesses", accesses_text(a.accesses));
    row.number("queue", a.queue).number("point", a.point);
    return index(row, "first_clock", a.first_clock);
  });
  table("Release", "kReleases", plan_.releases, [&](const Release& r, size_t) {
    Row row;
    row.field("resource", resource(r.resource));
    if (r.stages != 0) row.field("stages", stages_text(r.stages));
    if (r.accesses != 0) row.field("accesses", accesses_text(r.accesses));
    return row.number("queue", r.queue).number("point", r.point);
  });
  list(out_, "Index", "kAliasClocks", numbers(plan_.alias_clocks));
}

}  // namespace rg::compiler
