#include "compiler/verify/harmless.h"

#include <algorithm>

#include "compiler/verify/exchange.h"

namespace rg::verify {
namespace {

constexpr Accesses kWriting = access::shader_write | access::shader_storage_write | access::color_attachment_write |
                              access::depth_stencil_attachment_write | access::transfer_write | access::host_write;

constexpr Stages kTests = stage::early_fragment_tests | stage::late_fragment_tests;
constexpr const char* kOwnClear = "tests against the pass's own clear";

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

// Early tests come before late ones, which have to be named only where they have to see a write.
std::string Harmless::unseen(Index image_barrier, Stages stage, Accesses access) const {
  const ImageBarrier& barrier = plan_.image_barriers[image_barrier];
  const bool follows = stage == stage::late_fragment_tests && (barrier.dst_stages & stage::early_fragment_tests) != 0 &&
                       (barrier.dst_accesses & access::depth_stencil_attachment_write) == 0;
  if (follows || access == access::depth_stencil_attachment_read)
    return is_cleared_first(image_barrier, aspect_depth | aspect_stencil) ? kOwnClear : "";
  return access == access::color_attachment_read && is_cleared_first(image_barrier, aspect_color) ? "blending with what the rendering drew" : "";
}

// Whoever tests, or blends, behind a clear waits for that, be it skipped or not, and so for what was before.
bool Harmless::is_cleared_first(Index image_barrier, uint32_t aspects) const {
  const ImageBarrier& barrier = plan_.image_barriers[image_barrier];
  const Resource& image = plan_.resources[barrier.image.resource];
  const auto step = std::find_if(plan_.steps.begin(), plan_.steps.end(), [&](const Step& each) { return holds(each, image_barrier); });
  bool all = (barrier.range.aspects & aspects) != 0;
  for (const uint32_t aspect : {aspect_color, aspect_depth, aspect_stencil})
    for (uint32_t mip = barrier.range.mip; mip - barrier.range.mip < barrier.range.mips && mip < image.mips; ++mip)
      for (uint32_t layer = barrier.range.layer; layer - barrier.range.layer < barrier.range.layers && layer < image.layers; ++layer)
        if (barrier.range.aspects & aspects & aspect) all = all && is_cleared_first(step, barrier.image, {aspect, mip, 1, layer, 1});
  return all;
}

bool Harmless::is_cleared_first(std::span<const Step>::iterator from, const Ref& image, const Range& spot) const {
  for (; from != plan_.steps.end(); ++from) {
    if (from->kind != StepKind::pass || plan_.passes[from->index].rendering == kNone) continue;
    const Rendering& rendering = plan_.renderings[plan_.passes[from->index].rendering];
    std::vector<Index> attachments{rendering.depth, rendering.stencil};
    for (Index i = 0; i < rendering.color_count; ++i) attachments.push_back(rendering.first_color + i);
    for (const Index attachment : attachments)
      if (attachment != kNone && plan_.attachments[attachment].ref == image && meet(plan_.attachments[attachment].range, spot))
        return plan_.attachments[attachment].load != LoadOp::load;
  }
  return plan_.resources[image.resource].lifetime == Lifetime::transient;
}

std::string Harmless::narrower(Index image_barrier, uint32_t mip, uint32_t layer) const {
  const ImageBarrier& barrier = plan_.image_barriers[image_barrier];
  if (barrier.src_queue != barrier.dst_queue) return "";
  if (barrier.old_layout == barrier.new_layout && barrier.src_accesses == 0 && barrier.dst_accesses == 0)
    return "range of a barrier that only orders";
  if (barrier.old_layout == barrier.new_layout && is_waited_for(image_barrier, mip, layer))
    return "part of a barrier for which a semaphore has waited";
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

// `sources`: in its first scope, else in its second.
bool Harmless::names(const BarrierGroup& group, const Access& access, bool sources) const {
  const auto meets = [&](const auto& barrier) { return ((sources ? barrier.src_stages : barrier.dst_stages) & access.stages) != 0; };
  for (const ImageBarrier& barrier : plan_.image_barriers.subspan(group.first_image, group.image_count))
    if (barrier.image == access.ref && meet(barrier.range, access.range) && (meets(barrier) || barrier.old_layout != barrier.new_layout)) return true;
  for (const BufferBarrier& barrier : plan_.buffer_barriers.subspan(group.first_buffer, group.buffer_count))
    if (barrier.buffer == access.ref && meets(barrier)) return true;
  return group.memory_count != 0;
}

// What uses nothing that the group's barriers name, in their stages, is ordered by others, and readers may be: any barrier goes on from their stages.
std::string Harmless::moved(Index group, Index first_step, Index last_step, bool sets) const {
  bool over_readers = false;
  for (Index s = first_step; s <= last_step; ++s) {
    if (plan_.steps[s].kind != StepKind::pass) continue;
    for (const Access& access : accesses_of(plan_.steps[s].index)) {
      if (!names(plan_.groups[group], access, sets)) continue;
      if (!sets || access.writes) return "";
      over_readers = true;
    }
  }
  return over_readers ? "event set in front of readers that other barriers order as well" : "event moved over passes that it is not about";
}

// ---- semaphores -----------------------------------------------------------------------------------------------------------

// What the frame has done to the part since its first write is behind a signal, and a wait leads from there to this barrier's second scope.
bool Harmless::is_waited_for(Index image_barrier, uint32_t mip, uint32_t layer) const {
  const ImageBarrier& barrier = plan_.image_barriers[image_barrier];
  const Range part{barrier.range.aspects, mip, 1, layer, 1};
  std::vector<std::pair<Index, Stages>> users;  // batches, and in which stages
  for (Index b = 0; b < plan_.batches.size(); ++b)
    for (const Step& step : plan_.steps.subspan(plan_.batches[b].first_step, plan_.batches[b].step_count)) {
      if (holds(step, image_barrier)) {
        const auto leads_here = [&](const auto& user) { return leads(user.first, user.second, b, barrier.dst_stages); };
        return !users.empty() && std::all_of(users.begin(), users.end(), leads_here);
      }
      if (step.kind == StepKind::barriers && !users.empty() && moves(plan_.groups[step.index], barrier.image, part)) return false;
      if (step.kind != StepKind::pass) continue;
      for (const Access& access : accesses_of(step.index)) {
        if (access.ref != barrier.image || !meet(access.range, part)) continue;
        if (users.empty() && (!access.writes || may_skip(step.index, access.ref, mip))) return false;  // who came before the frame counts, too
        users.emplace_back(b, access.stages);
      }
    }
  return false;
}

bool Harmless::holds(const Step& step, Index image_barrier) const {
  if (step.kind != StepKind::barriers) return false;
  const BarrierGroup& group = plan_.groups[step.index];
  return image_barrier >= group.first_image && image_barrier - group.first_image < group.image_count;
}

// To another layout, or queue.
bool Harmless::moves(const BarrierGroup& group, const Ref& image, const Range& part) const {
  const auto barriers = plan_.image_barriers.subspan(group.first_image, group.image_count);
  return std::any_of(barriers.begin(), barriers.end(), [&](const ImageBarrier& barrier) {
    const bool changes = barrier.old_layout != barrier.new_layout || barrier.src_queue != barrier.dst_queue;
    return barrier.image == image && meet(barrier.range, part) && changes;
  });
}

// Though the image has the mip.
bool Harmless::may_skip(Index pass, const Ref& image, uint32_t mip) const {
  const Pass& row = plan_.passes[pass];
  const auto limits = plan_.mip_limits.subspan(row.first_mip_limit, row.mip_limit_count);
  const auto is_other = [&](const MipLimit& limit) { return limit.image != image.resource || limit.mip > mip; };
  return row.guard != 0 || std::any_of(limits.begin(), limits.end(), is_other);
}

// Signals of everything that ran in the stages, or of all commands, that others wait for in turn. What follows in logical order alone does not count.
bool Harmless::leads(Index from, Stages stages, Index to, Stages second) const {
  std::vector<std::pair<Index, Stages>> reached{{from, stages}};  // batches, and which of their stages
  for (size_t i = 0; i < reached.size(); ++i) {
    const auto [first, held] = reached[i];
    const Index queue = plan_.batches[first].queue;
    uint64_t signalled = 0;
    for (Index b = first; b < to; ++b) {
      const Batch &batch = plan_.batches[b], &next = plan_.batches[b + 1];
      for (const Signal& signal : plan_.signals.subspan(batch.first_signal, batch.queue == queue ? batch.signal_count : 0))
        if (signalled == 0 && ((held & ~signal.stages) == 0 || (signal.stages & stage::all_commands) != 0)) signalled = signal.value;
      for (const Wait& wait : plan_.waits.subspan(next.first_wait, next.wait_count)) {
        if (signalled == 0 || wait.queue != queue || wait.frames_ago != 0 || wait.value < signalled) continue;
        if (next.queue == plan_.batches[to].queue && (second & ~wait.stages) == 0) return true;
        const std::pair<Index, Stages> more{b + 1, wait.stages};
        if (std::find(reached.begin(), reached.end(), more) == reached.end()) reached.push_back(more);
      }
    }
  }
  return false;
}

// Tests of what is cleared behind the wait need nothing from before. The clear waits where an earlier stage does, or behind a barrier that comes
// after a stage that waits.
std::string Harmless::unwaited(Index wait, Stages stage) const {
  constexpr Stages kBefore = stage::draw_indirect | stage::index_input | stage::vertex_attribute_input | stage::vertex_shader |
                             stage::tess_control_shader | stage::tess_eval_shader | stage::geometry_shader;
  const Stages before = stage == stage::late_fragment_tests ? kBefore | stage::early_fragment_tests : kBefore,
               others = plan_.waits[wait].stages & ~stage;
  if ((stage & kTests) == 0) return "";
  bool follows = (others & before) != 0;
  Index queue = kNone;
  std::vector<Attachment> cleared;
  for (const Batch& batch : plan_.batches) {
    if (wait >= batch.first_wait && wait - batch.first_wait < batch.wait_count) queue = batch.queue;
    for (const Step& step : plan_.steps.subspan(batch.first_step, batch.queue == queue ? batch.step_count : 0)) {
      if (step.kind == StepKind::barriers)
        follows = follows || leads_to_tests(plan_.groups[step.index], others);
      else if (step.kind == StepKind::pass && !is_cleared_first(plan_.passes[step.index], follows, cleared))
        return "";
    }
  }
  return cleared.empty() ? "" : kOwnClear;
}

bool Harmless::leads_to_tests(const BarrierGroup& group, Stages from) const {
  const auto barriers = plan_.image_barriers.subspan(group.first_image, group.image_count);
  return std::any_of(barriers.begin(), barriers.end(), [&](const ImageBarrier& barrier) {
    return barrier.src_queue == barrier.dst_queue && (barrier.src_stages & from) != 0 && (barrier.dst_stages & stage::early_fragment_tests) != 0;
  });
}

// What the pass tests has been cleared, or it clears that itself. Adds to `cleared`.
bool Harmless::is_cleared_first(const Pass& pass, bool may_clear, std::vector<Attachment>& cleared) const {
  if (pass.rendering == kNone) return true;
  for (const Index attachment : {plan_.renderings[pass.rendering].depth, plan_.renderings[pass.rendering].stencil}) {
    if (attachment == kNone) continue;
    const Attachment& row = plan_.attachments[attachment];
    const auto same = [&](const Attachment& other) { return other.ref == row.ref && other.range == row.range; };
    if (row.load == LoadOp::load ? std::none_of(cleared.begin(), cleared.end(), same) : !may_clear) return false;
    cleared.push_back(row);
  }
  return true;
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

std::string Harmless::exchanged(Index step) const {
  std::vector<uint32_t> passes;
  for (Index s = step; s < plan_.steps.size(); ++s)
    if (plan_.steps[s].kind == StepKind::pass) passes.push_back(program_pass_[plan_.steps[s].index]);
  const std::vector<uint32_t> rest(passes.begin() + 2, passes.end());
  return may_exchange(program_, graph_, passes[0], passes[1], rest) ? "exchanged passes that do not depend on each other" : "";
}

}  // namespace rg::verify
