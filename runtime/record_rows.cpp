#include "runtime/record_rows.h"

#include <utility>

#include "runtime/record.h"

namespace rg {

namespace {

// What a pass has for attachments.
enum class Target : uint8_t {
  none,
  own,    // a rendering that is the same in every frame
  first,  // of several passes in a rendering, all of which run: begins it
  middle,
  last
};

template <Target target>
void begin(const FrameRecording& r, const StepRow& row) {
  if constexpr (target == Target::none) return;
  if constexpr (target == Target::own || target == Target::first) r.vk.CmdBeginRendering(r.commands, row.begun);
  // A callback of the pass before may have left others.
  r.vk.CmdSetViewport(r.commands, 0, 1, row.viewport);
  r.vk.CmdSetScissor(r.commands, 0, 1, row.area);
}
template <Target target>
void end(const FrameRecording& r) {
  if constexpr (target == Target::own || target == Target::last) r.vk.CmdEndRendering(r.commands);
}

// A pass whose callback records all of it.
template <Target target>
void record_host(FrameRecording& r, const StepRow& row) {
  if ((row.guard & ~r.inputs.conditions) != 0) return;
  begin<target>(r, row);
  Recording recording{r.vk, r.commands, *row.info, VK_NULL_HANDLE};
  r.inputs.callbacks[row.host_slot](r.inputs.user, recording);
  end<target>(r);
}

// A pass with a pipeline, sets or work of its own.
template <Target target>
void record_own(FrameRecording& r, const StepRow& row) {
  if ((row.guard & ~r.inputs.conditions) != 0) return;
  begin<target>(r, row);
  record_body(r, row.pass);
  end<target>(r);
}

void record_nothing(FrameRecording&, const StepRow&) {}

// Whatever is left goes the way that instruments go, with barriers and labels of its own.
void record_any(FrameRecording& r, const StepRow& row) {
  if (row.group != kNone) record_group(r, row.group);
  if (row.pass != kNone) record_pass(r, row.pass);
}

template <Target target>
RecordRow row_function(const PassRow& pass) {
  const bool callback_alone = pass.work == WorkKind::host && pass.pipeline == VK_NULL_HANDLE && !pass.has_set && !pass.has_engine_set;
  return callback_alone ? record_host<target> : record_own<target>;
}

void set_event(FrameRecording& r, const StepRow& row) { record_set(r, row.group); }

RecordRow function_of(const Sized& sized, const StepRow& row) {
  if (row.sets) return set_event;
  if (row.awaits) return record_any;
  if (row.group != kNone && sized.group_rows[row.group].poison != kNone) return record_any;
  if (row.pass == kNone) return record_nothing;
  const PassRow& pass = sized.rows[row.pass];
  if (!pass.has_rendering) return pass.runs ? row_function<Target::none>(pass) : record_nothing;
  if (!pass.fixed_views || pass.classic) return record_any;
  if (!pass.shares_rendering) return pass.runs ? row_function<Target::own>(pass) : record_nothing;
  return pass.begins_rendering ? row_function<Target::first>(pass)
         : pass.ends_rendering ? row_function<Target::last>(pass)
                               : row_function<Target::middle>(pass);
}

// Passes [begin, end) of one rendering: if each of them runs whatever the frame, and none goes the way of instruments, nobody has to ask whether it
// has begun.
bool all_run(const Sized& sized, size_t begin, size_t end) {
  for (size_t i = begin; i < end; ++i) {
    const PassRow& pass = sized.rows[sized.step_rows[i].pass];
    if (!pass.runs || pass.guard != 0 || function_of(sized, sized.step_rows[i]) == record_any) return false;
  }
  return true;
}

size_t end_of_rendering(const Sized& sized, size_t begin) {
  size_t end = begin + 1;
  while (!sized.rows[sized.step_rows[end - 1].pass].ends_rendering) ++end;
  return end;
}

void choose_row(const Objects& objects, const Sized& sized, bool any, StepRow& row) {
  row.record = any ? record_any : function_of(sized, row);
  const bool by_itself = row.record == record_any || row.sets;
  const GroupRow group = row.group == kNone || by_itself ? GroupRow() : sized.group_rows[row.group];
  row.infos = group.infos, row.period = group.period;
  row.labels = row.pass == kNone || by_itself ? nullptr : &objects.passes[row.pass];
}

StepRow make_row(const Context& context, const Sized& sized, Index group, Index pass) {
  StepRow row;
  row.group = group, row.pass = pass;
  row.awaits = group != kNone && context.plan.groups[group].event != kNone;
  if (pass == kNone) return row;
  const PassTable& table = sized.passes[pass];
  row.guard = context.plan.passes[pass].guard, row.host_slot = context.plan.passes[pass].host_slot;
  row.info = &table.info;
  row.begun = sized.rows[pass].shares_rendering ? &table.whole_rendering.info : &table.rendering.info;
  row.viewport = &table.rendering.viewport, row.area = &table.rendering.area;
  return row;
}

}  // namespace

void fill_step_rows(const Context& context, const Objects& objects, Sized& sized) {
  const Plan& plan = context.plan;
  std::vector<bool> ends_batch(plan.steps.size() + 1);
  for (const Batch& batch : plan.batches) ends_batch[batch.first_step + batch.step_count] = true;
  Index group = kNone;  // waits for its pass
  for (Index s = 0; s < plan.steps.size(); ++s) {
    sized.row_of_step.push_back(static_cast<Index>(sized.step_rows.size()));
    const Step& step = plan.steps[s];
    const bool split = step.kind != StepKind::pass && plan.groups[step.index].event != kNone;
    if (step.kind == StepKind::pass)
      sized.step_rows.push_back(make_row(context, sized, std::exchange(group, kNone), step.index));
    else if (split || ends_batch[s + 1] || plan.steps[s + 1].kind != StepKind::pass)
      sized.step_rows.push_back(make_row(context, sized, step.index, kNone));
    else
      group = step.index;
    if (step.kind == StepKind::set) sized.step_rows.back().sets = true, sized.step_rows.back().awaits = false;
  }
  sized.row_of_step.push_back(static_cast<Index>(sized.step_rows.size()));
  choose_step_rows(objects, sized);
}

void choose_step_rows(const Objects& objects, Sized& sized) {
  for (size_t i = 0; i < sized.step_rows.size();) {
    const Index pass = sized.step_rows[i].pass;
    const bool shared = pass != kNone && sized.rows[pass].shares_rendering;
    const size_t end = shared ? end_of_rendering(sized, i) : i + 1;
    const bool any = shared && !all_run(sized, i, end);
    for (; i < end; ++i) choose_row(objects, sized, any, sized.step_rows[i]);
  }
}

namespace {

template <bool labelled, bool timed>
void walk(FrameRecording& r, std::span<const StepRow> rows) {
  const DeviceFunctions& vk = r.vk;  // known here to stay the same over the calls
  const VkCommandBuffer commands = r.commands;
  for (const StepRow& row : rows) {
    if (row.infos != nullptr) vk.CmdPipelineBarrier2(commands, row.infos + row_of(r.frame, row.period));
    if (labelled && row.labels != nullptr) {
      if (r.module != row.labels->module_number) change_module(r, *row.labels);
      vk.CmdBeginDebugUtilsLabelEXT(commands, &row.labels->label);
    }
    if (timed && row.labels != nullptr) vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_NONE, r.queries, 2 * row.pass);
    row.record(r, row);
    if (timed && row.labels != nullptr) vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, r.queries, 2 * row.pass + 1);
    if (labelled && row.labels != nullptr) vk.CmdEndDebugUtilsLabelEXT(commands);
  }
}

}  // namespace

void record_rows(FrameRecording& r, std::span<const StepRow> rows) {
  const bool labelled = r.vk.CmdBeginDebugUtilsLabelEXT != nullptr, timed = r.queries != VK_NULL_HANDLE;
  if (labelled)
    timed ? walk<true, true>(r, rows) : walk<true, false>(r, rows);
  else
    timed ? walk<false, true>(r, rows) : walk<false, false>(r, rows);
}

}  // namespace rg
