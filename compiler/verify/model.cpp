#include "compiler/verify/model.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "compiler/verify/alias.h"
#include "compiler/verify/model_passes.h"

namespace rg::verify {
namespace {

using Extents = std::vector<int64_t>;

void add_boxes_of_program(const Input& input, const std::vector<Shape>& shapes, const Extents& extents, std::vector<std::vector<Box>>& boxes) {
  for (const dsl::Pass& pass : input.graph.passes)
    for (const dsl::Access& access : pass.accesses) {
      const Shape& shape = shapes[access.resource.value];
      boxes[access.resource.value].push_back(box_of(input.program, shape, effective_range(access, shape.aspects), extents));
    }
}

void add_ranks(const Partition& partition, const Box& box, std::vector<uint32_t>& ranks) {
  const auto rank = [&](const std::vector<uint64_t>& cuts, uint64_t at) {
    ranks.push_back(static_cast<uint32_t>(std::lower_bound(cuts.begin(), cuts.end(), at) - cuts.begin()));
  };
  rank(partition.mip_cuts, box.mip_begin), rank(partition.mip_cuts, box.mip_end);
  rank(partition.layer_cuts, box.layer_begin), rank(partition.layer_cuts, box.layer_end);
}

struct BoxSink {
  const Input& input;
  const std::vector<Shape>& shapes;
  const Extents& extents;
  std::vector<std::vector<Box>>& boxes;
  void add(Ref ref, const Range& range) {
    const uint32_t resource = input.program_resource[ref.resource];
    if (shapes[resource].image) boxes[resource].push_back(box_of(shapes[resource], range));
  }
  void add(Ref ref, const Bytes& bytes) {
    const uint32_t resource = input.program_resource[ref.resource];
    if (!shapes[resource].image) boxes[resource].push_back(box_of(input.plan.exprs, shapes[resource], bytes, extents));
  }
};

void add_boxes_of_plan(BoxSink sink) {
  const Plan& plan = sink.input.plan;
  for (const ImageBarrier& barrier : plan.image_barriers) sink.add(barrier.image, barrier.range);
  for (const BufferBarrier& barrier : plan.buffer_barriers) sink.add(barrier.buffer, barrier.bytes);
  for (const std::span<const Boundary>& rows : {plan.entry, plan.exit})
    for (const Boundary& boundary : rows) {
      sink.add(boundary.ref, boundary.range);
      sink.add(boundary.ref, boundary.bytes);
    }
  for (const Attachment& attachment : plan.attachments) sink.add(attachment.ref, attachment.range);
  for (const Access& row : plan.accesses) {
    sink.add(row.ref, row.range);
    sink.add(row.ref, row.bytes);
  }
}

std::vector<uint32_t> cells_of(const Model& model, Ref ref, const Range& range) {
  const Partition& partition = model.resources[model.input->program_resource[ref.resource]].partition;
  if (!partition.shape.image) return cells_in(partition, Box{1, 0, partition.shape.mips, 0, 1});
  return cells_in(partition, box_of(partition.shape, range));
}

void add_resources(Model& model, std::vector<Partition> partitions) {
  const auto& rows = model.input->graph.resources.rows;
  model.resources.resize(rows.size());
  for (uint32_t r = 0; r < rows.size(); ++r) {
    ResourceNode& node = model.resources[r];
    node.partition = std::move(partitions[r]);
    node.copies = rows[r].lifetime == dsl::Lifetime::history ? rows[r].history + 1 : 1;
    node.first_cell = model.cell_count;
    model.cell_count += node.copies * node.partition.cell_count();
    if (rows[r].lifetime == dsl::Lifetime::history) model.history = std::max(model.history, rows[r].history);
  }
  for (uint32_t p = 0; p < model.input->plan.resources.size(); ++p) model.resources[model.input->program_resource[p]].plan = p;
}

template <class Barrier>
Scope common_scope(const Barrier& barrier, ScopeKind kind, uint32_t index, uint32_t group, uint32_t queue) {
  Scope scope;
  scope.kind = kind;
  scope.index = index;
  scope.group = group;
  scope.queue = queue;
  scope.tag = barrier.tag;
  scope.raw_src = barrier.src_stages, scope.raw_dst = barrier.dst_stages;
  scope.raw_src_accesses = barrier.src_accesses, scope.raw_dst_accesses = barrier.dst_accesses;
  scope.src = expand_stages(barrier.src_stages), scope.dst = expand_stages(barrier.dst_stages);
  scope.src_earlier = with_earlier(scope.src), scope.dst_later = with_later(scope.dst);
  scope.src_accesses = expand_accesses(barrier.src_accesses), scope.dst_accesses = expand_accesses(barrier.dst_accesses);
  return scope;
}

void add_scope(Model& model, Scope scope) {
  GroupNode& group = model.groups.back();
  group.src_earlier |= scope.src_earlier;
  group.dst_later |= scope.dst_later;
  const auto id = static_cast<uint32_t>(model.scopes.size());
  if (scope.kind == ScopeKind::memory) group.memory.push_back(id);
  group.scopes.push_back(id);
  const auto same = std::find_if(group.classes.begin(), group.classes.end(), [&](const ExecutionClass& other) {
    return model.scopes[other.scope].raw_src == scope.raw_src && model.scopes[other.scope].raw_dst == scope.raw_dst;
  });
  // Half a change of owner orders nothing but itself: its other scope does not apply (VkImageMemoryBarrier2, release and acquire operations).
  const bool orders = scope.transfer == Ownership::none;
  if (orders && same != group.classes.end())
    same->sole = false;
  else if (orders && scope.src != 0 && scope.dst != 0)
    group.classes.push_back({id, true});
  model.scopes.push_back(std::move(scope));
}

// False if the barrier is not recorded: releases within one family.
template <class Barrier>
bool take_transfer(const Model& model, const Barrier& barrier, Scope& scope) {
  if (barrier.src_queue == barrier.dst_queue) return true;
  const bool release = barrier.src_queue == scope.queue;
  scope.other = release ? barrier.dst_queue : barrier.src_queue;
  if (model.family[barrier.src_queue] == model.family[barrier.dst_queue]) return !release;
  scope.transfer = release ? Ownership::release : Ownership::acquire;
  return true;
}

void add_image_scope(Model& model, uint32_t i, uint32_t group) {
  const ImageBarrier& barrier = model.input->plan.image_barriers[i];
  Scope scope = common_scope(barrier, ScopeKind::image, i, group, model.groups.back().queue);
  scope.resource = model.input->program_resource[barrier.image.resource];
  scope.age = barrier.image.age;
  scope.cells = cells_of(model, barrier.image, barrier.range);
  scope.old_layout = barrier.old_layout, scope.new_layout = barrier.new_layout;
  if (take_transfer(model, barrier, scope)) add_scope(model, std::move(scope));
}

void add_buffer_scope(Model& model, const Extents& extents, uint32_t i, uint32_t group) {
  const BufferBarrier& barrier = model.input->plan.buffer_barriers[i];
  Scope scope = common_scope(barrier, ScopeKind::buffer, i, group, model.groups.back().queue);
  scope.resource = model.input->program_resource[barrier.buffer.resource];
  scope.age = barrier.buffer.age;
  const Partition& partition = model.resources[scope.resource].partition;
  scope.cells = cells_in(partition, box_of(model.input->plan.exprs, partition.shape, barrier.bytes, extents));
  if (take_transfer(model, barrier, scope)) add_scope(model, std::move(scope));
}

void add_group(Model& model, const Extents& extents, uint32_t index, uint32_t queue) {
  const Plan& plan = model.input->plan;
  const BarrierGroup& group = plan.groups[index];
  model.groups.emplace_back();
  model.groups.back().queue = queue;
  if (group.event == kNone) model.groups.back().plan_group = index;
  for (uint32_t i = group.first_memory; i < group.first_memory + group.memory_count; ++i)
    add_scope(model, common_scope(plan.memory_barriers[i], ScopeKind::memory, i, index, queue));
  for (uint32_t i = group.first_image; i < group.first_image + group.image_count; ++i) add_image_scope(model, i, index);
  for (uint32_t i = group.first_buffer; i < group.first_buffer + group.buffer_count; ++i) add_buffer_scope(model, extents, i, index);
}

// The second half of a split group: one of the groups of this batch is the first.
void add_awaited(Model& model, uint32_t set_by, uint32_t queue) {
  model.groups.emplace_back();
  model.groups.back().kind = GroupKind::awaited;
  model.groups.back().queue = queue;
  model.groups.back().set_by = set_by;
}

void add_waits(Model& model, uint32_t index, const Batch& batch) {
  model.groups.emplace_back();
  model.groups.back().kind = GroupKind::waits;
  model.groups.back().queue = batch.queue;
  for (uint32_t i = batch.first_wait; i < batch.first_wait + batch.wait_count; ++i) {
    const Wait& wait = model.input->plan.waits[i];
    Scope scope = common_scope(MemoryBarrier{0, 0, wait.stages, 0}, ScopeKind::wait, i, index, batch.queue);
    scope.dst_accesses = kAllReads | kAllWrites;
    scope.other = wait.queue, scope.value = wait.value, scope.frames_ago = wait.frames_ago;
    add_scope(model, std::move(scope));
  }
}

void add_signals(Model& model, uint32_t index, const Batch& batch) {
  model.groups.emplace_back();
  model.groups.back().kind = GroupKind::signals;
  model.groups.back().queue = batch.queue;
  model.signals_on[batch.queue] += batch.signal_count;
  for (uint32_t i = batch.first_signal; i < batch.first_signal + batch.signal_count; ++i) {
    const Signal& signal = model.input->plan.signals[i];
    Scope scope = common_scope(MemoryBarrier{signal.stages, 0, 0, 0}, ScopeKind::signal, i, index, batch.queue);
    scope.src_accesses = kAllReads | kAllWrites;
    scope.value = signal.value;
    add_scope(model, std::move(scope));
  }
}

void add_batch(Model& model, const Extents& extents, uint32_t index) {
  const Plan& plan = model.input->plan;
  const Batch& batch = plan.batches[index];
  const auto add_step = [&](bool is_pass, size_t at) { model.steps.push_back({is_pass, static_cast<uint32_t>(at), index}); };
  std::map<uint32_t, uint32_t> set;  // by plan group: its first half
  if (batch.wait_count != 0) add_waits(model, index, batch), add_step(false, model.groups.size() - 1);
  for (uint32_t s = batch.first_step; s < batch.first_step + batch.step_count; ++s) {
    const Step& step = plan.steps[s];
    if (step.kind != StepKind::pass) {
      const bool split = plan.groups[step.index].event != kNone;
      if (split && step.kind == StepKind::barriers)
        add_awaited(model, set.at(step.index), batch.queue);
      else
        add_group(model, extents, step.index, batch.queue);
      if (split && step.kind == StepKind::set)
        model.groups.back().kind = GroupKind::set, set[step.index] = static_cast<uint32_t>(model.groups.size() - 1);
      add_step(false, model.groups.size() - 1);
      continue;
    }
    model.passes[step.index].queue = batch.queue;
    add_step(true, step.index);
  }
  // Ends of batches are points of their queue, with or without a signal.
  add_signals(model, index, batch), add_step(false, model.groups.size() - 1);
}

void number_alike(Model& model) {
  using Row = std::tuple<uint32_t, Stages, Stages>;
  std::map<std::tuple<GroupKind, uint32_t, std::vector<Row>>, uint32_t> numbers;
  for (GroupNode& group : model.groups) {
    if (group.kind != GroupKind::waits && group.kind != GroupKind::signals) continue;
    std::vector<Row> rows;
    for (const uint32_t id : group.scopes) rows.emplace_back(model.scopes[id].other, model.scopes[id].raw_src, model.scopes[id].raw_dst);
    group.alike = numbers.try_emplace({group.kind, group.queue, std::move(rows)}, static_cast<uint32_t>(numbers.size())).first->second;
  }
}

// Memory changes hands in the group of the new owner's acquire. Images are rewritten by their transition; buffers are noted here.
void note_hand_overs(Model& model) {
  const Plan& plan = model.input->plan;
  const std::vector<bool> takes = may_share(plan);
  std::vector<std::vector<uint32_t>> by_group(plan.groups.size());
  for (uint32_t i = 0; i < plan.acquires.size(); ++i) {
    const Acquire& acquire = plan.acquires[i];
    if (acquire.group != kNone && takes[acquire.resource] && plan.resources[acquire.resource].kind == ResourceKind::buffer)
      by_group[acquire.group].push_back(i);
  }
  for (GroupNode& group : model.groups)
    if (group.plan_group != kNone) group.handed_over = by_group[group.plan_group];
}

std::vector<BoundaryNode> make_boundaries(const Model& model, const Extents& extents, std::span<const Boundary> rows) {
  std::vector<BoundaryNode> nodes;
  for (const Boundary& row : rows) {
    BoundaryNode node;
    node.resource = model.input->program_resource[row.ref.resource];
    node.age = row.ref.age;
    const Partition& partition = model.resources[node.resource].partition;
    node.cells = cells_in(
        partition, partition.shape.image ? box_of(partition.shape, row.range) : box_of(model.input->plan.exprs, partition.shape, row.bytes, extents));
    node.stages = expand_stages(row.stages);
    node.accesses = expand_accesses(row.accesses);
    node.layout = row.layout;
    node.queue = row.queue;
    node.discard = row.discard;
    nodes.push_back(std::move(node));
  }
  return nodes;
}

}  // namespace

std::string Model::pass_name(uint32_t plan_pass) const { return pass(plan_pass).name; }

bool Model::may_skip(uint32_t plan_pass, uint32_t resource_index, uint32_t cell_index) const {
  const dsl::Pass& row = pass(plan_pass);
  if (!row.conditions.empty()) return true;
  return std::any_of(row.mip_limits.begin(), row.mip_limits.end(), [&](const dsl::MipLimit& limit) {
    return limit.image.value != resource_index || first_mip_of_cell(resources[resource_index].partition, cell_index) < limit.mip;
  });
}

std::string Model::place(uint32_t resource_index, uint32_t cell) const {
  const std::string part = cell_text(resources[resource_index].partition, cell);
  return "`" + resource(resource_index).name + "`" + (part.empty() ? "" : " " + part);
}

std::string Model::queue_name(uint32_t queue) const {
  const char* kinds[] = {"graphics", "compute", "transfer"};
  return "queue " + std::to_string(queue) + " (" + kinds[static_cast<size_t>(input->plan.queues[queue].kind)] + ")";
}

Cut make_cut(const Input& input, const std::vector<int64_t>& extents) {
  const auto& rows = input.graph.resources.rows;
  std::vector<Shape> shapes;
  for (const dsl::Resource& row : rows) shapes.push_back(shape_of(input.program, row, extents));
  std::vector<std::vector<Box>> boxes(rows.size());
  add_boxes_of_program(input, shapes, extents, boxes);
  add_boxes_of_plan({input, shapes, extents, boxes});
  Cut cut;
  for (size_t r = 0; r < rows.size(); ++r) {
    cut.partitions.push_back(make_partition(shapes[r], boxes[r]));
    for (const Box& box : boxes[r]) add_ranks(cut.partitions.back(), box, cut.ranks);
  }
  return cut;
}

Model make_model(const Input& input, const std::vector<int64_t>& extents, std::vector<Partition> partitions, const std::vector<uint32_t>& family,
                 Report& report) {
  Model model;
  model.input = &input;
  model.queue_count = static_cast<uint32_t>(input.plan.queues.size());
  model.signals_on.assign(model.queue_count, 0);
  model.family = family;
  add_resources(model, std::move(partitions));
  model.passes.resize(input.plan.passes.size());
  for (uint32_t i = 0; i < input.plan.passes.size(); ++i) add_pass(model, extents, i, report);
  for (uint32_t i = 0; i < input.plan.batches.size(); ++i) add_batch(model, extents, i);
  note_hand_overs(model);
  number_alike(model);
  number_renderings(model);
  number_orders(model);
  model.entry = make_boundaries(model, extents, input.plan.entry);
  model.exit = make_boundaries(model, extents, input.plan.exit);
  return model;
}

}  // namespace rg::verify
