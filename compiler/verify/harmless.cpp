#include "compiler/verify/harmless.h"

#include <algorithm>

#include "compiler/verify/roles.h"

namespace rg::verify {
namespace {

constexpr Accesses kWriting = access::shader_write | access::shader_storage_write | access::color_attachment_write |
                              access::depth_stencil_attachment_write | access::transfer_write | access::host_write;

bool reads(const Access& row) { return !row.writes || (row.accesses & ~kWriting) != 0; }

bool meet(uint32_t begin, uint32_t count, uint32_t other, uint32_t other_count) {
  const uint64_t end = count == kRemaining ? UINT64_MAX : uint64_t{begin} + count;
  const uint64_t other_end = other_count == kRemaining ? UINT64_MAX : uint64_t{other} + other_count;
  return begin < other_end && other < end;
}
bool meet(const Range& x, const Range& y) {
  if (x.aspects == 0 && y.aspects == 0) return true;  // buffers
  return (x.aspects & y.aspects) != 0 && meet(x.mip, x.mips, y.mip, y.mips) && meet(x.layer, x.layers, y.layer, y.layers);
}

}  // namespace

// ---- barriers -------------------------------------------------------------------------------------------------------------

std::string Harmless::without_contents(const ImageBarrier& barrier) {
  const Accesses reading = access::shader_sampled_read | access::shader_storage_read | access::shader_read | access::color_attachment_read |
                           access::depth_stencil_attachment_read | access::input_attachment_read | access::transfer_read | access::memory_read;
  // A depth write brings its test along.
  const Accesses test = barrier.dst_accesses & access::depth_stencil_attachment_write ? access::depth_stencil_attachment_read : Accesses{0};
  return (barrier.dst_accesses & reading & ~test) == 0 && barrier.dst_accesses != 0 ? "contents that the next pass may overwrite" : "";
}

std::string Harmless::narrower(Index image_barrier, uint32_t mip, uint32_t layer) const {
  const ImageBarrier& barrier = plan_.image_barriers[image_barrier];
  if (barrier.src_queue != barrier.dst_queue) return "";
  if (barrier.old_layout == barrier.new_layout && barrier.src_accesses == 0 && barrier.dst_accesses == 0)
    return "range of a barrier that only orders";
  return barrier.old_layout == Layout::undefined && leaves_layout(image_barrier, mip, layer) ? "part of a discard whose layout stays" : "";
}

// Barriers are wide where neighbours need the same: of a part that is in the new layout anyway, others may say all there is to say.
bool Harmless::leaves_layout(Index image_barrier, uint32_t mip, uint32_t layer) const {
  const ImageBarrier& barrier = plan_.image_barriers[image_barrier];
  const auto holds = [&](const Ref& ref, const Range& range) {
    return ref == barrier.image && meet(range, {barrier.range.aspects, mip, 1, layer, 1});
  };
  Layout before = Layout::undefined;
  for (const Boundary& entry : plan_.entry)
    if (holds(entry.ref, entry.range)) before = entry.layout;
  for (const Step& step : plan_.steps) {
    if (step.kind != StepKind::barriers) continue;
    const BarrierGroup& group = plan_.groups[step.index];
    for (Index i = group.first_image; i < group.first_image + group.image_count; ++i) {
      if (i == image_barrier) return before == barrier.new_layout;
      if (holds(plan_.image_barriers[i].image, plan_.image_barriers[i].range)) before = plan_.image_barriers[i].new_layout;
    }
  }
  return false;
}

bool Harmless::names(const BarrierGroup& group, const Access& access) const {
  for (const ImageBarrier& barrier : plan_.image_barriers.subspan(group.first_image, group.image_count))
    if (barrier.image == access.ref && meet(barrier.range, access.range)) return true;
  for (const BufferBarrier& barrier : plan_.buffer_barriers.subspan(group.first_buffer, group.buffer_count))
    if (barrier.buffer == access.ref) return true;
  return group.memory_count != 0;
}

// What uses nothing that the group's barriers name is ordered by others, and readers may be: any barrier goes on from their stages.
std::string Harmless::moved(Index group, Index first_step, Index last_step, bool sets) const {
  bool over_readers = false;
  for (Index s = first_step; s <= last_step; ++s) {
    if (plan_.steps[s].kind != StepKind::pass) continue;
    for (const Access& access : accesses_of(plan_.steps[s].index)) {
      if (!names(plan_.groups[group], access)) continue;
      if (!sets || access.writes) return "";
      over_readers = true;
    }
  }
  return over_readers ? "event set in front of readers that other barriers order as well" : "event moved over passes that it is not about";
}

// ---- contents and memory --------------------------------------------------------------------------------------------------

bool Harmless::draws_to(const Pass& pass, Index attachment) const {
  if (pass.rendering == kNone) return false;
  const Rendering& rendering = plan_.renderings[pass.rendering];
  return rendering.depth == attachment || rendering.stencil == attachment ||
         (attachment >= rendering.first_color && attachment < rendering.first_color + rendering.color_count);
}

// Where the next writer may be skipped, contents are kept for whoever comes after it, be it only another writer.
std::string Harmless::not_stored(Index attachment) const {
  const Attachment& row = plan_.attachments[attachment];
  bool found = false;
  for (const Step& step : plan_.steps) {
    if (step.kind != StepKind::pass) continue;
    const Pass& pass = plan_.passes[step.index];
    if (draws_to(pass, attachment)) found = true;
    if (!found || draws_to(pass, attachment)) continue;
    for (const Access& access : accesses_of(step.index)) {
      if (!access.writes || access.ref != row.ref || !meet(access.range, row.range)) continue;
      if (pass.guard != 0 || pass.mip_limit_count != 0) return "contents kept over a pass that may be skipped";
      if (access.range == row.range || reads(access)) return "";  // else the next writer of the rest counts
    }
  }
  return "";
}

std::string Harmless::released_earlier(Index release) const {
  const Release& row = plan_.releases[release];
  const auto elsewhere = [&](const Release& other) { return other.resource == row.resource && other.queue != row.queue; };
  return std::any_of(plan_.releases.begin(), plan_.releases.end(), elsewhere) ? "release behind users for which another queue waits" : "";
}

// ---- order ----------------------------------------------------------------------------------------------------------------

std::string Harmless::exchanged(Index first_step, Index second_step) const {
  const bool matters = depend(plan_.steps[first_step].index, plan_.steps[second_step].index, second_step + 1);
  return matters ? "" : "exchanged passes that do not depend on each other";
}

// `after`: the first step behind both.
bool Harmless::depend(Index a, Index b, Index after) const {
  for (const Access& x : accesses_of(a))
    for (const Access& y : accesses_of(b))
      if (x.ref == y.ref && (x.writes || y.writes) && meet(x.range, y.range) && x.bytes == y.bytes && is_read(x.ref) &&
          !(commutes_in(a, x.ref) && commutes_in(b, x.ref)) && !is_overwritten(a, b, x, y, after))
        return true;
  return false;
}

// Both write only, and so do all who come to it next, until one that always runs writes all of it: neither is missed.
bool Harmless::is_overwritten(Index a, Index b, const Access& x, const Access& y, Index after) const {
  if (needs_contents(a, x.ref) || needs_contents(b, x.ref)) return false;
  for (Index s = after; s < plan_.steps.size(); ++s) {
    if (plan_.steps[s].kind != StepKind::pass) continue;
    for (const Access& row : accesses_of(plan_.steps[s].index)) {
      if (row.ref != x.ref || (!meet(row.range, x.range) && !meet(row.range, y.range))) continue;
      if (needs_contents(plan_.steps[s].index, x.ref)) return false;
      if (row.range == x.range && row.range == y.range && row.bytes == x.bytes && runs_always(plan_.steps[s].index)) return true;
    }
  }
  return false;
}

// By the program: in the plan, an attachment is loaded as well where the pass may be skipped.
bool Harmless::needs_contents(Index pass, Ref ref) const {
  const auto& accesses = graph_.passes.rows[program_pass_[pass]].accesses;
  return std::any_of(accesses.begin(), accesses.end(), [&](const dsl::Access& access) {
    return access.resource.value == program_resource_[ref.resource] && access.age == ref.age && access.mode != dsl::Mode::write;
  });
}

bool Harmless::runs_always(Index pass) const {
  const dsl::Pass& row = graph_.passes.rows[program_pass_[pass]];
  return row.conditions.empty() && row.mip_limits.empty();
}

// All that the pass does to the resource is declared to commute.
bool Harmless::commutes_in(Index pass, Ref ref) const {
  if (pass >= program_pass_.size() || program_pass_[pass] >= graph_.passes.size()) return false;
  const auto& accesses = graph_.passes.rows[program_pass_[pass]].accesses;
  return std::all_of(accesses.begin(), accesses.end(),
                     [&](const dsl::Access& access) { return access.resource.value != program_resource_[ref.resource] || commutes(access); });
}

// Two writers of contents that nobody reads may follow each other in any order.
bool Harmless::is_read(Ref ref) const {
  if (plan_.resources[ref.resource].lifetime != Lifetime::transient) return true;
  return std::any_of(plan_.accesses.begin(), plan_.accesses.end(),
                     [&](const Access& row) { return row.ref == ref && (row.accesses & ~kWriting) != 0; });
}

}  // namespace rg::verify
