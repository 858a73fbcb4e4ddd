#include "compiler/machine/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "dsl/check_macro.h"

namespace rg::machine {
namespace {

constexpr Accesses kEverything = access::memory_read | access::memory_write;

bool intersects(const Region& a, const Region& b) {
  for (const Piece& x : a)
    for (const Piece& y : b)
      if (x.aspect == y.aspect && x.x0 < y.x1 && y.x0 < x.x1 && x.y0 < y.y1 && y.y0 < x.y1) return true;
  return false;
}

struct Unroller {
  const Subject& in;
  Timeline out = {};
  uint32_t frame = 0, queue = 0;
  bool first_in_rendering = true, last_in_rendering = true;
  uint32_t renderings = 0;                          // begun
  std::vector<std::vector<uint32_t>> left_by = {};  // by program resource: events of the engine after the last frame
  struct Signalled {
    Index queue;
    uint32_t frame;
    uint64_t value;
    uint32_t event;
  };
  std::vector<Signalled> signals = {};  // of all frames
  // A split group is two events an element: the first has its first scope and the transition, the second its second scope.
  enum class Part : uint8_t { whole, set, awaited } part = Part::whole;
  std::map<Index, std::vector<uint32_t>> set = {};  // by plan group: first events that are not awaited yet
  std::vector<bool> begun = {};                     // by program resource: used in this frame
  std::vector<bool> used = {};                      // by program resource: by some pass of the plan

  const ResourceCells& cells_of(uint32_t resource) const { return in.cells.resources[resource]; }
  const dsl::Resource& row(uint32_t resource) const { return in.graph.resources.rows[resource]; }

  uint32_t agent(Stages stage, Accesses access) {
    const Agent wanted{stage == stage::host ? kNone : queue, stage, access};  // there is one host
    const auto found = std::find(out.agents.begin(), out.agents.end(), wanted);
    if (found != out.agents.end()) return static_cast<uint32_t>(found - out.agents.begin());
    out.agents.push_back(wanted);
    RG_CHECK(out.agents.size() <= kMaxAgents, "too many queues, stages and accesses");
    return static_cast<uint32_t>(out.agents.size() - 1);
  }

  std::vector<uint32_t> physical(uint32_t resource, const Region& region, uint32_t age) const {
    std::vector<uint32_t> result;
    for (const uint32_t piece : pieces_in(cells_of(resource), region)) result.push_back(physical_cell(cells_of(resource), piece, age, frame));
    return result;
  }
  Region whole_region(uint32_t resource) const { return region_of(cells_of(resource), Range{}); }

  Event& add(Event event) {
    event.frame = frame;
    event.queue = queue;
    out.events.push_back(std::move(event));
    return out.events.back();
  }

  Event touch_event(const Touch& touch, uint32_t resource, std::vector<uint32_t> cells, const std::string& who) {
    Event event;
    event.kind = touch.writes ? EventKind::write : EventKind::read;
    event.label = fmt::format("{} {} `{}` in frame {} (stage {:#x})", who, touch.writes ? "writes" : "reads", row(resource).name, frame, touch.stage);
    event.resource = resource;
    event.cells = std::move(cells);
    event.stages = touch.stage;
    event.partial = touch.partial;
    event.agent = agent(touch.stage, touch.access);
    event.image = row(resource).kind == dsl::ResourceKind::image;
    event.family = family(resource, queue);
    return event;
  }

  // kNone: shared by all families, or there is but one.
  uint32_t family(uint32_t resource, Index on) const {
    if (in.options.united || on >= in.plan.queues.size()) return kNone;
    return in.plan.resources[cells_of(resource).plan_resource].concurrent ? kNone : static_cast<uint32_t>(in.plan.queues[on].kind);
  }

  // ---- passes ----

  bool plan_runs(const Pass& pass) const {
    for (uint32_t bit = 0; bit < in.plan.conditions.size(); ++bit) {
      if (((pass.guard >> bit) & 1) == 0) continue;
      for (uint32_t i = 0; i < in.program.conditions.size(); ++i)
        if (in.program.conditions.rows[i].name == in.plan.conditions[bit] && ((conditions_in(in.options, frame) >> i) & 1) == 0) return false;
    }
    for (const MipLimit& limit : in.plan.mip_limits.subspan(pass.first_mip_limit, pass.mip_limit_count)) {
      const uint32_t image = in.program_resource[limit.image];
      if (limit.mip >= mips_at(in.program, row(image), in.cells.extents)) return false;
    }
    return true;
  }

  const Attachment* find_attachment(const Pass& pass, const dsl::Access& access, const Region& region) const {
    if (pass.rendering == kNone) return nullptr;
    const Rendering& rendering = in.plan.renderings[pass.rendering];
    const auto matches = [&](const Attachment& attachment) {
      const uint32_t resource = in.program_resource[attachment.ref.resource];
      return resource == access.resource.value && attachment.ref.age == access.age &&
             intersects(region_of(cells_of(resource), attachment.range), region);
    };
    for (const Attachment& color : in.plan.attachments.subspan(rendering.first_color, rendering.color_count))
      if (access.role == dsl::Role::color && matches(color)) return &color;
    const Index index = access.role == dsl::Role::stencil ? rendering.stencil : rendering.depth;
    if (access.role == dsl::Role::color || index == kNone) return nullptr;
    return matches(in.plan.attachments[index]) ? &in.plan.attachments[index] : nullptr;
  }

  Layout listed_layout(const Pass& pass, const dsl::Access& access, const Region& region) const {
    Layout layout = kUnusable;
    for (const Access& listed : in.plan.accesses.subspan(pass.first_access, pass.access_count)) {
      const uint32_t resource = in.program_resource[listed.ref.resource];
      if (resource != access.resource.value || listed.ref.age != access.age || !intersects(region_of(cells_of(resource), listed.range), region))
        continue;
      if (layout == kUnusable || listed.writes == (access.mode != dsl::Mode::read)) layout = listed.layout;
    }
    return layout;
  }

  // What the plan's load and store operations do beside the draws.
  static bool drops_before(const dsl::Pass& pass, const dsl::Access& access, const Attachment& attachment) {
    const bool clears = access.clear && access.mode != dsl::Mode::read && !access.covers;
    const bool slice_only = is_slice(access) && (access.clear || access.covers);  // the operation stays within the slices, which it may drop
    const bool drops = needs_contents(pass, access) && !slice_only && attachment.load != LoadOp::load;
    return drops || (clears && attachment.load != LoadOp::clear);
  }
  // What may live on the chip is there no longer than a rendering, whatever that says.
  bool drops_after(const dsl::Access& access, const Attachment& attachment) const {
    return access.mode != dsl::Mode::read && (attachment.store != StoreOp::store || in.plan.resources[attachment.ref.resource].lazy);
  }
  static bool rewrites(const dsl::Access& access, const Attachment& attachment) {
    return access.mode == dsl::Mode::read &&
           (attachment.load == LoadOp::clear || attachment.load == LoadOp::dont_care || attachment.store != StoreOp::none);
  }

  // What an earlier pass of the rendering found, its load operation has decided.
  bool destroys(const Attachment& attachment) const {
    return (first_in_rendering && attachment.load != LoadOp::load) || attachment.store == StoreOp::dont_care;
  }

  void add_access(const Pass& pass, Index index, uint32_t number) {
    const uint32_t program_pass = in.program_pass[index];
    const dsl::Pass& source = in.graph.passes.rows[program_pass];
    const dsl::Access& access = source.accesses[number];
    const uint32_t resource = access.resource.value;
    const Region region = region_of(in.program, in.graph, in.cells, access);
    const std::vector<uint32_t> cells = physical(resource, region, access.age);
    const Attachment* attachment = is_attachment(access.role) ? find_attachment(pass, access, region) : nullptr;
    Layout layout = attachment ? attachment->layout : is_attachment(access.role) ? kUnusable : listed_layout(pass, access, region);
    if (!permits(layout, access.role, access.mode != dsl::Mode::read)) layout = kUnusable;

    std::vector<Touch> touches = touches_of(source, access);
    const bool rewritten = attachment && rewrites(access, *attachment);
    if (rewritten) touches.push_back({touches.back().stage, touches.back().access << 1, true, false});  // each attachment write follows its read
    const auto& effects = in.reference.effects[frame][program_pass];
    for (const Touch& touch : touches) {
      Event event = touch_event(touch, resource, cells, fmt::format("`{}`", source.name));
      event.pass = index;
      event.layout = layout;
      event.shares = commutes(access);
      event.rendering = attachment ? renderings : 0;
      event.lost = attachment && first_in_rendering && drops_before(source, access, *attachment);
      if (attachment && touch.writes && last_in_rendering)
        event.lost = event.lost || drops_after(access, *attachment) || (rewritten && destroys(*attachment));
      event.expected = effects.empty() ? std::vector<Version>(cells.size()) : effects[number].before;
      event.result = effects.empty() ? std::vector<Version>(cells.size(), {version::poison, 0}) : effects[number].after;
      if (touch.partial) event.result.assign(cells.size(), {version::partial, 0});
      add(std::move(event));
    }
  }

  void add_pass(Index index) {
    const Pass& pass = in.plan.passes[index];
    if (!plan_runs(pass)) return;
    const std::vector<dsl::Access>& accesses = in.graph.passes.rows[in.program_pass[index]].accesses;
    const size_t first = out.events.size();
    for (uint32_t i = 0; i < accesses.size(); ++i) add_access(pass, index, i);
    // Contents of transient buffers start with the frame's first pass; nothing marks that in the plan.
    for (size_t e = first; e < out.events.size(); ++e) out.events[e].takes = begins(out.events[e].resource);
    for (const dsl::Access& access : accesses) begun[access.resource.value] = true;
  }
  bool begins(uint32_t resource) const {
    return !begun[resource] && row(resource).lifetime == dsl::Lifetime::transient && row(resource).kind == dsl::ResourceKind::buffer;
  }

  // ---- synchronisation ----

  Event scope_event(std::string label, Stages src, Accesses src_accesses, Stages dst, Accesses dst_accesses) {
    Event event;
    event.label = std::move(label);
    event.src_exact = expand_stages(src);
    event.dst_exact = expand_stages(dst);
    event.src = with_earlier(event.src_exact);
    event.dst = with_later(event.dst_exact);
    event.src_accesses = expand_accesses(src_accesses);
    event.dst_accesses = expand_accesses(dst_accesses);
    return event;
  }

  template <class Barrier>
  Event barrier_event(const Barrier& barrier, Index group, const std::string& what) {
    Event event = scope_event(fmt::format("barrier of group {} on {} in frame {}", group, what, frame), barrier.src_stages, barrier.src_accesses,
                              barrier.dst_stages, barrier.dst_accesses);
    event.group = group;
    if (part == Part::set) event.dst = event.dst_exact = event.dst_accesses = 0;
    if (part == Part::awaited) event.src = event.src_exact = event.src_accesses = 0;
    return event;
  }

  // In the order of the group's elements, so that the second events find their first ones.
  void add_element(Event event, Index group) {
    if (part == Part::awaited) {
      event.after = {set[group].front()};
      set[group].erase(set[group].begin());
      event.image = false;  // the layout has changed
    }
    add(std::move(event));
    if (part == Part::set) set[group].push_back(static_cast<uint32_t>(out.events.size() - 1));
  }

  // False if the barrier is not recorded.
  template <class Barrier>
  bool take_half(const Barrier& barrier, Event& event) const {
    if (barrier.src_queue == barrier.dst_queue) return true;
    const bool release = barrier.src_queue == queue;
    const bool one_family = in.options.united || in.plan.queues[barrier.src_queue].kind == in.plan.queues[barrier.dst_queue].kind;
    if (one_family) return !release;
    event.half = release ? Half::release : Half::acquire;
    event.other_queue = release ? barrier.dst_queue : barrier.src_queue;
    return true;
  }

  template <class Barrier>
  void add_ranged(const Barrier& barrier, Index group, uint32_t resource, std::vector<uint32_t> cells, Layout from, Layout to) {
    Event event = barrier_event(barrier, group, "`" + row(resource).name + "`");
    event.resource = resource;
    event.image = row(resource).kind == dsl::ResourceKind::image;
    event.cells = std::move(cells);
    event.old_layout = from, event.new_layout = to;
    event.family = family(resource, queue);
    if (take_half(barrier, event)) add_element(std::move(event), group);
  }

  void add_group(const Step& step) {
    const Index index = step.index;
    const BarrierGroup& group = in.plan.groups[index];
    part = group.event == kNone ? Part::whole : step.kind == StepKind::set ? Part::set : Part::awaited;
    for (const MemoryBarrier& barrier : in.plan.memory_barriers.subspan(group.first_memory, group.memory_count))
      add_element(barrier_event(barrier, index, "all memory"), index);
    for (const BufferBarrier& barrier : in.plan.buffer_barriers.subspan(group.first_buffer, group.buffer_count)) {
      const uint32_t resource = in.program_resource[barrier.buffer.resource];
      add_ranged(barrier, index, resource, physical(resource, region_of(in.plan, in.cells, cells_of(resource), barrier.bytes), barrier.buffer.age),
                 Layout::undefined, Layout::undefined);
    }
    for (const ImageBarrier& barrier : in.plan.image_barriers.subspan(group.first_image, group.image_count)) {
      const uint32_t resource = in.program_resource[barrier.image.resource];
      add_ranged(barrier, index, resource, physical(resource, region_of(cells_of(resource), barrier.range), barrier.image.age), barrier.old_layout,
                 barrier.new_layout);
    }
  }

  void add_wait(const Wait& wait) {
    if (wait.frames_ago > frame) return;  // there was no such frame
    Event event = scope_event(fmt::format("wait for queue {} in frame {}", wait.queue, frame), 0, 0, wait.stages, kEverything);
    for (const Signalled& signal : signals)
      if (signal.queue == wait.queue && signal.frame == frame - wait.frames_ago && signal.value == wait.value) event.after.push_back(signal.event);
    add(std::move(event));
  }
  // Signals of one queue follow each other.
  void add_signal(const Signal& signal) {
    Event event = scope_event(fmt::format("signal of queue {} in frame {}", queue, frame), signal.stages, kEverything, 0, 0);
    event.all_commands = (signal.stages & stage::all_commands) != 0;
    for (const Signalled& earlier : signals)
      if (earlier.queue == queue) event.after.push_back(earlier.event);
    add(std::move(event));
    signals.push_back({queue, frame, signal.value, static_cast<uint32_t>(out.events.size() - 1)});
  }

  // Passes that follow each other with one rendering and no barrier between them are one rendering: it loads before the first and stores after the
  // last.
  bool same_rendering(const Batch& batch, Index step, Index other) const {
    if (other < batch.first_step || other >= batch.first_step + batch.step_count) return false;
    const Step &a = in.plan.steps[step], &b = in.plan.steps[other];
    if (a.kind != StepKind::pass || b.kind != StepKind::pass) return false;
    return in.plan.passes[a.index].rendering != kNone && in.plan.passes[a.index].rendering == in.plan.passes[b.index].rendering;
  }

  void add_batch(const Batch& batch) {
    queue = batch.queue;
    for (const Wait& wait : in.plan.waits.subspan(batch.first_wait, batch.wait_count)) add_wait(wait);
    for (Index s = batch.first_step; s < batch.first_step + batch.step_count; ++s) {
      const Step& step = in.plan.steps[s];
      first_in_rendering = !same_rendering(batch, s, s - 1), last_in_rendering = !same_rendering(batch, s, s + 1);
      if (first_in_rendering) ++renderings;
      step.kind == StepKind::pass ? add_pass(step.index) : add_group(step);
    }
    for (const Signal& signal : in.plan.signals.subspan(batch.first_signal, batch.signal_count)) add_signal(signal);
    queue = 0;
  }

  // ---- the engine, before and after the frame ----

  // Depth and stencil may have a row each.
  Layout boundary_layout(std::span<const Boundary> boundaries, uint32_t resource, dsl::Role role) const {
    Layout layout = kUnusable;
    for (const Boundary& boundary : boundaries)
      if (in.program_resource[boundary.ref.resource] == resource && (role == dsl::Role::undefined || permits(boundary.layout, role, false)))
        layout = layout == kUnusable ? boundary.layout : layout_of_both(layout, boundary.layout);
    return layout == kUnusable && role == dsl::Role::undefined ? Layout::undefined : layout;
  }
  Stages boundary_stages(uint32_t resource) const {
    Stages stages = 0;
    for (const Boundary& boundary : in.plan.entry)
      if (in.program_resource[boundary.ref.resource] == resource) stages |= expand_stages(boundary.stages);
    return stages;
  }

  void bring(uint32_t resource) {
    const dsl::BoundaryState& before = row(resource).before;
    const Index named = boundary_queue(in.plan.entry, resource);
    queue = named == kNone ? 0 : named;
    Event event;
    event.kind = EventKind::bring;
    event.label = fmt::format("the engine brings `{}` in frame {}", row(resource).name, frame);
    event.resource = resource;
    event.image = row(resource).kind == dsl::ResourceKind::image;
    event.cells = physical(resource, whole_region(resource), 0);
    event.result.assign(event.cells.size(), imported_version(in.graph, resource, frame));
    event.layout = boundary_layout(in.plan.entry, resource, before.role);
    event.pending = before.wrote;
    event.before_all = !changes_outside(in.graph, resource);
    for (const Touch& touch : touches_of(before)) {
      event.stages |= touch.stage;
      event.agent = agent(touch.stage, touch.access);
      event.dst_agents.set(event.agent);
    }
    event.family = family(resource, named);
    if (event.stages == 0) event.stages = boundary_stages(resource);
    event.before_all = event.before_all || event.stages == 0;        // nothing to wait for: the engine was done before
    if (!row(resource).is_surface) event.after = left_by[resource];  // the next frame gets another image
    add(std::move(event));
    queue = 0;
  }

  // Before it goes on, the engine waits for the stages the exit state names.
  void wait_for_exit(uint32_t resource) {
    for (const Boundary& boundary : in.plan.exit) {
      if (in.program_resource[boundary.ref.resource] != resource || boundary.stages == 0) continue;
      queue = boundary.queue < in.plan.queues.size() ? boundary.queue : 0;
      add(scope_event(fmt::format("the engine waits for `{}` in frame {}", row(resource).name, frame), boundary.stages, 0, 0, 0));
      left_by[resource].push_back(static_cast<uint32_t>(out.events.size() - 1));
    }
    queue = 0;
  }

  void leave(uint32_t resource) {
    const Index named = boundary_queue(in.plan.exit, resource);
    queue = named == kNone ? 0 : named;
    left_by[resource].clear();
    const bool readback = row(resource).lifetime == dsl::Lifetime::readback;
    const dsl::BoundaryState after = readback ? dsl::BoundaryState{dsl::Role::host_read, 0, false} : row(resource).after;
    std::vector<Touch> touches = touches_of({after.role, after.stages, false});
    const bool present = after.role == dsl::Role::present;
    if (present) touches = {{stage::bottom_of_pipe, access::none, false, false}};
    for (const Touch& touch : touches) {
      Event event = touch_event({touch.stage, touch.access, false, false}, resource, {}, readback ? "the host" : "the engine");
      event.family = readback ? kNone : family(resource, named);  // the host is of no family
      event.through_semaphore = present;
      event.after_all = present || readback;
      event.layout = boundary_layout(in.plan.exit, resource, after.role);
      for (const uint32_t piece : pieces_left(resource)) {
        event.cells.push_back(physical_cell(cells_of(resource), piece, 0, frame));
        event.expected.push_back(in.reference.finals[frame][resource][piece]);
      }
      add(std::move(event));
      left_by[resource].push_back(static_cast<uint32_t>(out.events.size() - 1));
    }
    queue = 0;
  }

  // What the frame uses; the rest stays between the engine and itself.
  Pieces pieces_left(uint32_t resource) const {
    const ResourceCells& cells = cells_of(resource);
    std::vector<bool> left(cells.pieces.size(), row(resource).lifetime == dsl::Lifetime::readback);
    for (const Boundary& boundary : in.plan.exit) {
      if (in.program_resource[boundary.ref.resource] != resource || boundary.ref.age != 0) continue;
      for (const uint32_t piece : pieces_in(cells, region_of(in.plan, in.cells, cells, boundary))) left[piece] = true;
    }
    Pieces pieces;
    for (uint32_t piece = 0; piece < left.size(); ++piece)
      if (left[piece]) pieces.push_back(piece);
    return pieces;
  }

  // Where the plan expects and leaves what the engine brings.
  Index boundary_queue(std::span<const Boundary> boundaries, uint32_t resource) const {
    for (const Boundary& boundary : boundaries)
      if (in.program_resource[boundary.ref.resource] == resource && boundary.queue < in.plan.queues.size()) return boundary.queue;
    return kNone;
  }

  void add_frame() {
    begun.assign(in.graph.resources.size(), false);
    for (uint32_t i = 0; i < in.graph.resources.size(); ++i)
      if (row(i).lifetime == dsl::Lifetime::imported && cells_of(i).exists && (frame == 0 || changes_outside(in.graph, i))) bring(i);
    for (const Batch& batch : in.plan.batches) add_batch(batch);
    for (uint32_t i = 0; i < in.graph.resources.size(); ++i) {
      const bool imported = row(i).lifetime == dsl::Lifetime::imported;
      if ((!imported && row(i).lifetime != dsl::Lifetime::readback) || !cells_of(i).exists || !used[i]) continue;
      leave(i);
      if (imported) wait_for_exit(i);
    }
  }

  void find_agents(Event& event) const {
    for (uint32_t i = 0; i < out.agents.size(); ++i) {
      const Agent& agent = out.agents[i];
      if (agent.queue != event.queue && agent.queue != kNone) continue;
      if ((agent.stage & event.src_exact) && (agent.access & event.src_accesses)) event.src_agents.set(i);
      if ((agent.stage & event.dst_exact) && (agent.access & event.dst_accesses)) event.dst_agents.set(i);
    }
  }

  void initial_states() {
    frame = 0;
    for (const Boundary& boundary : in.plan.entry) {
      const uint32_t resource = in.program_resource[boundary.ref.resource];
      const std::vector<uint32_t> cells = physical(resource, region_of(in.plan, in.cells, cells_of(resource), boundary), boundary.ref.age);
      for (const uint32_t cell : cells) {
        if (row(resource).kind == dsl::ResourceKind::image) out.initial_layouts.push_back({cell, boundary.layout});
        if (!boundary.discard && boundary.queue != kNone) out.initial_owners.push_back({cell, family(resource, boundary.queue)});
      }
    }
  }
};

}  // namespace

Timeline unroll(const Subject& subject) {
  Unroller unroller{subject};
  unroller.left_by.resize(subject.graph.resources.size());
  unroller.used.resize(subject.graph.resources.size());
  for (const uint32_t pass : subject.program_pass)
    for (const dsl::Access& access : subject.graph.passes.rows[pass].accesses) unroller.used[access.resource.value] = true;
  for (; unroller.frame < subject.options.frames; ++unroller.frame) unroller.add_frame();
  unroller.initial_states();
  for (Event& event : unroller.out.events)
    if (event.kind == EventKind::barrier) unroller.find_agents(event);
  return std::move(unroller.out);
}

}  // namespace rg::machine
