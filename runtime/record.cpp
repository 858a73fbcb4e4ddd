#include "runtime/record.h"

#include <algorithm>

#include "runtime/barriers.h"
#include "runtime/inputs.h"
#include "runtime/queues.h"
#include "runtime/record_rows.h"
#include "runtime/render_pass.h"
#include "runtime/resolve.h"
#include "runtime/transfers.h"

namespace rg {

namespace {

void begin_statistics(const FrameRecording& r, Index pass) {
  if (r.statistics != VK_NULL_HANDLE) r.vk.CmdBeginQuery(r.commands, r.statistics, pass, 0);
}
void end_statistics(const FrameRecording& r, Index pass) {
  if (r.statistics != VK_NULL_HANDLE) r.vk.CmdEndQuery(r.commands, r.statistics, pass);
}

void write_timestamp(const FrameRecording& r, VkPipelineStageFlags2 stage, Index query) {
  if (r.queries != VK_NULL_HANDLE) r.vk.CmdWriteTimestamp2(r.commands, stage, r.queries, query);
}

void bind_engine_set(const FrameRecording& r, const Pass& pass, const PassObjects& objects) {
  const auto role = static_cast<uint32_t>(r.state.context.plan.engine_sets[pass.engine_set].role);
  r.vk.CmdBindDescriptorSets(r.commands, objects.bind_point, objects.layout.get(), role, 1, &r.inputs.engine_sets[pass.engine_set], 0, nullptr);
}

VkDescriptorSet bind_pass_set(const FrameRecording& r, const PassObjects& objects, PassTable& table) {
  const VkDescriptorSet set = table.set.sets[row_of(r.frame, table.set.period)];
  for (size_t i = 0; i < table.set.block_offsets.size(); ++i) table.set.dynamic_offsets[i] = r.section + table.set.block_offsets[i];
  r.vk.CmdBindDescriptorSets(r.commands, objects.bind_point, objects.layout.get(), 1, 1, &set,
                             static_cast<uint32_t>(table.set.dynamic_offsets.size()), table.set.dynamic_offsets.data());
  return set;
}

BufferSpan work_buffer(const FrameRecording& r, Ref ref, VkDeviceSize offset) {
  return buffer_at(*r.state.sized, r.state.imports, r.state.context.plan, ref, {offset, VK_WHOLE_SIZE}, r.frame);
}

// Without the feature every draw is a call of its own.
template <class Draw>
void draw_indirect(const FrameRecording& r, Draw draw, const Work& work, const PassTable& table) {
  const BufferSpan arguments = work_buffer(r, work.arguments, table.arguments_offset);
  if (r.state.context.device.multi_draw_indirect || work.max_draws <= 1)
    return draw(r.commands, arguments.buffer, arguments.offset, work.max_draws, work.stride);
  for (uint32_t i = 0; i < work.max_draws; ++i) draw(r.commands, arguments.buffer, arguments.offset + VkDeviceSize{i} * work.stride, 1, work.stride);
}

template <class Draw>
void draw_indirect_count(const FrameRecording& r, Draw draw, const Work& work, const PassTable& table) {
  const BufferSpan arguments = work_buffer(r, work.arguments, table.arguments_offset), counts = work_buffer(r, work.counts, 0);
  draw(r.commands, arguments.buffer, arguments.offset, counts.buffer, counts.offset, work.max_draws, work.stride);
}

void bind_buffers(const FrameRecording& r, const Work& work, const DrawTable& draw) {
  for (Index i = 0; i < work.vertex_buffer_count; ++i) {
    const VertexBuffer& row = r.state.context.plan.vertex_buffers[work.first_vertex_buffer + i];
    const BufferSpan vertices = work_buffer(r, row.ref, draw.vertex_offsets[i]);
    r.vk.CmdBindVertexBuffers(r.commands, i, 1, &vertices.buffer, &vertices.offset);
  }
  if (work.indices.resource == kNone) return;
  const BufferSpan indices = work_buffer(r, work.indices, draw.indices_offset);
  r.vk.CmdBindIndexBuffer(r.commands, indices.buffer, indices.offset, work.index_bytes == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
}

void dispatch(const FrameRecording& r, const PassTable& table) {
  if (table.x != 0 && table.y != 0 && table.z != 0) r.vk.CmdDispatch(r.commands, table.x, table.y, table.z);
}

void dispatch_indirect(const FrameRecording& r, const Work& work, const PassTable& table) {
  const BufferSpan arguments = work_buffer(r, work.arguments, table.arguments_offset);
  r.vk.CmdDispatchIndirect(r.commands, arguments.buffer, arguments.offset);
}

void call_host(const FrameRecording& r, const PassRow& row, const PassTable& table, VkDescriptorSet set) {
  Recording recording{r.vk, r.commands, table.info, set};
  r.inputs.callbacks[row.host_slot](r.inputs.user, recording);
}

void record_work(const FrameRecording& r, const Pass& pass, const PassTable& table) {
  const DeviceFunctions& vk = r.vk;
  bind_buffers(r, pass.work, table.draw);
  switch (pass.work.kind) {
    case WorkKind::none:
    case WorkKind::host:
      return;
    case WorkKind::draw:
      return vk.CmdDraw(r.commands, table.x, table.y, table.draw.first, 0);
    case WorkKind::draw_indexed:
      return vk.CmdDrawIndexed(r.commands, table.x, table.y, table.draw.first, table.draw.vertex_offset, 0);
    case WorkKind::draw_indirect:
      return draw_indirect(r, vk.CmdDrawIndirect, pass.work, table);
    case WorkKind::draw_indexed_indirect:
      return draw_indirect(r, vk.CmdDrawIndexedIndirect, pass.work, table);
    case WorkKind::draw_indirect_count:
      return draw_indirect_count(r, vk.CmdDrawIndirectCount, pass.work, table);
    case WorkKind::draw_indexed_indirect_count:
      return draw_indirect_count(r, vk.CmdDrawIndexedIndirectCount, pass.work, table);
    case WorkKind::dispatch:
      return dispatch(r, table);
    case WorkKind::dispatch_indirect:
      return dispatch_indirect(r, pass.work, table);
    case WorkKind::transfers:
      for (const TransferTable& transfer : table.transfers)
        record_transfer(r.state.context, *r.state.sized, r.state.imports, transfer, r.commands, r.frame);
      return;
  }
}

// Each pass of a rendering by itself, with its contents in memory between them: a submit each, or something to read in between.
bool stands_alone(const FrameRecording& r, Index pass) {
  if (r.state.context.serial || r.state.context.submit_per_pass) return true;
  const Plan& plan = r.state.context.plan;
  for (const DumpRequest& dump : r.state.dumps)
    if (!dump.recorded && plan.passes[dump.pass].rendering == plan.passes[pass].rendering) return true;
  return false;
}

void begin_attachments(const FrameRecording& r, const PassRow& row, RenderingTable& table) {
  if (row.classic || !row.fixed_views)
    begin_rendering(r.state.context, *r.state.sized, table, r.commands, r.frame);
  else
    r.vk.CmdBeginRendering(r.commands, &table.info);
}

// A callback of the pass before may have left others.
void cover_target(const FrameRecording& r, PassTable& table) {
  r.vk.CmdSetViewport(r.commands, 0, 1, &table.rendering.viewport);
  r.vk.CmdSetScissor(r.commands, 0, 1, &table.rendering.area);
}

void end_attachments(FrameRecording& r, const PassRow& row) {
  r.in_rendering = false;
  row.classic ? r.vk.CmdEndRenderPass(r.commands) : r.vk.CmdEndRendering(r.commands);
}

// The one that the features of the frame select, where they do.
void bind_pipeline(const FrameRecording& r, Index index, const PassRow& row, const PassObjects& objects, PassTable& table) {
  VkPipeline pipeline = row.pipeline;
  if (!objects.choices.empty()) {
    pipeline = objects.choices[selected_choice(r.state.context.plan, r.state.context.plan.passes[index], r.inputs)];
    table.info.pipeline = pipeline;
  }
  r.vk.CmdBindPipeline(r.commands, objects.bind_point, pipeline);
}

void record_covered(const FrameRecording& r, Index index, const PassRow& row) {
  if (row.has_rendering) cover_target(r, r.state.sized->passes[index]);
  record_body(r, index);
}

// A pass with a rendering of its own, or with none. A query that begins outside a rendering must not end inside.
void record_alone(FrameRecording& r, Index index, const PassRow& row, bool runs) {
  begin_statistics(r, index);
  if (runs && row.has_rendering) begin_attachments(r, row, r.state.sized->passes[index].rendering);
  if (runs) record_covered(r, index, row);
  if (runs && row.has_rendering) end_attachments(r, row);
  end_statistics(r, index);
}

// One of several in a rendering: the first begins it, the last ends it, whether that runs or not. None runs where the first does not.
void record_shared(FrameRecording& r, Index index, const PassRow& row, bool runs) {
  if (runs && !r.in_rendering) begin_attachments(r, row, r.state.sized->passes[index].whole_rendering), r.in_rendering = true;
  begin_statistics(r, index);
  if (runs) record_covered(r, index, row);
  end_statistics(r, index);
  if (r.in_rendering && row.ends_rendering) end_attachments(r, row);
}

bool has_open_dumps(const GraphInstance::State& state) {
  return std::any_of(state.dumps.begin(), state.dumps.end(), [](const DumpRequest& dump) { return !dump.recorded; });
}

// Whether anything but the frame, its labels and timestamps is recorded, or not in the usual form.
bool is_watched(const FrameRecording& r) {
  const GraphInstance::State& state = r.state;
  if (r.statistics != VK_NULL_HANDLE) return true;
  if (state.context.serial || state.context.submit_per_pass || state.context.device.classic_render_passes) return true;
  return has_open_dumps(state);
}

}  // namespace

void record_body(const FrameRecording& r, Index index) {
  const PassRow& row = r.state.sized->rows[index];
  PassTable& table = r.state.sized->passes[index];
  const PassObjects& objects = r.state.objects.passes[index];
  if (row.pipeline != VK_NULL_HANDLE) bind_pipeline(r, index, row, objects, table);
  if (row.has_engine_set) bind_engine_set(r, r.state.context.plan.passes[index], objects);
  const VkDescriptorSet set = row.has_set ? bind_pass_set(r, objects, table) : VkDescriptorSet(VK_NULL_HANDLE);
  if (row.work == WorkKind::host)
    call_host(r, row, table, set);
  else if (row.work != WorkKind::none)
    record_work(r, r.state.context.plan.passes[index], table);
}

void record_pass(FrameRecording& r, Index index) {
  const PassRow& row = r.state.sized->rows[index];
  const bool labels = r.vk.CmdBeginDebugUtilsLabelEXT != nullptr;
  const PassObjects& objects = r.state.objects.passes[index];
  if (labels && r.module != objects.module_number) change_module(r, objects);
  if (labels) r.vk.CmdBeginDebugUtilsLabelEXT(r.commands, &objects.label);
  write_timestamp(r, VK_PIPELINE_STAGE_2_NONE, 2 * index);
  const bool runs = row.runs && (row.guard & ~r.inputs.conditions) == 0;
  const bool alone = !row.shares_rendering || stands_alone(r, index);
  if (!alone)
    record_shared(r, index, row, runs);
  else
    record_alone(r, index, row, runs);
  write_timestamp(r, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 2 * index + 1);
  if (!r.state.dumps.empty()) record_dumps(r, index);
  if (labels) r.vk.CmdEndDebugUtilsLabelEXT(r.commands);
  if (r.state.context.serial || (alone && row.shares_rendering && !row.ends_rendering)) wait_for_all(r);
}

void wait_for_all(const FrameRecording& r) {
  const VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,   nullptr,
                                 VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                                 VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  r.vk.CmdPipelineBarrier2(r.commands, &info);
}

FrameRecording start_recording(GraphInstance::State& state, const FrameInputs& inputs, const FrameSlot& slot, VkCommandBuffer commands, Index queue) {
  const Context& context = state.context;
  const DeviceQueue& row = queue_of(context, queue);
  const bool can_reset = context.device.host_query_reset || queue == context.plan.batches[0].queue;
  const bool timed = can_reset && row.timestamp_bits != 0 && (context.device.host_query_reset || (row.flags & VK_QUEUE_COMPUTE_BIT) != 0);
  const bool counted = can_reset && (row.flags & VK_QUEUE_GRAPHICS_BIT) != 0;
  return {state, inputs, commands, state.frame, timed ? slot.queries.get() : VkQueryPool(VK_NULL_HANDLE),
          counted ? slot.statistics.get() : VkQueryPool(VK_NULL_HANDLE), 0, context.vk(),
          static_cast<uint32_t>(state.frame % context.frames_in_flight * state.sized->ring.section), false,
          // A dump may read in between what an event makes ready for others.
          slot.events.empty() || has_open_dumps(state) ? nullptr : slot.events.data()};
}

void reset_queries(const FrameRecording& r) {
  if (r.state.context.device.host_query_reset) return;
  const auto passes = static_cast<uint32_t>(r.state.context.plan.passes.size());
  if (r.queries != VK_NULL_HANDLE) r.vk.CmdResetQueryPool(r.commands, r.queries, 0, 2 * passes);
  if (r.statistics != VK_NULL_HANDLE) r.vk.CmdResetQueryPool(r.commands, r.statistics, 0, passes);
}

void change_module(FrameRecording& r, const PassObjects& pass) {
  close_module(r);
  if (pass.module_number != 0) r.vk.CmdBeginDebugUtilsLabelEXT(r.commands, &pass.module_label);
  r.module = pass.module_number;
}

void close_module(FrameRecording& r) {
  if (r.module != 0) r.vk.CmdEndDebugUtilsLabelEXT(r.commands);
  r.module = 0;
}

void record_group(const FrameRecording& r, Index group) {
  const Sized& sized = *r.state.sized;
  const GroupRow& row = sized.group_rows[group];
  if (row.poison != kNone) record_poison(r.state.context, sized, sized.poisons[row.poison], r.commands);
  if (row.infos == nullptr) return;
  const VkDependencyInfo* info = row.infos + row_of(r.frame, row.period);
  const Index event = r.state.context.plan.groups[group].event;
  if (event == kNone || r.events == nullptr) return r.vk.CmdPipelineBarrier2(r.commands, info);
  const VkEvent awaited = r.events[event].get();
  r.vk.CmdWaitEvents2(r.commands, 1, &awaited, info);
}

void record_set(const FrameRecording& r, Index group) {
  const GroupRow& row = r.state.sized->group_rows[group];
  if (row.infos == nullptr || r.events == nullptr) return;
  r.vk.CmdSetEvent2(r.commands, r.events[r.state.context.plan.groups[group].event].get(), row.infos + row_of(r.frame, row.period));
}

namespace {

void record_step(FrameRecording& r, const Step& step) {
  switch (step.kind) {
    case StepKind::pass:
      return record_pass(r, step.index);
    case StepKind::barriers:
      return record_group(r, step.index);
    case StepKind::set:
      return record_set(r, step.index);
  }
}

}  // namespace

void record_steps(FrameRecording& r, std::span<const Step> steps) {
  if (is_watched(r)) {
    for (const Step& step : steps) record_step(r, step);
    return;
  }
  const Sized& sized = *r.state.sized;
  const auto first = static_cast<size_t>(steps.data() - r.state.context.plan.steps.data());
  const Index begin = sized.row_of_step[first], end = sized.row_of_step[first + steps.size()];
  record_rows(r, std::span(sized.step_rows).subspan(begin, end - begin));
}

}  // namespace rg
