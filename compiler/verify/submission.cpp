#include "compiler/verify/submission.h"

#include <algorithm>

namespace rg::verify {
namespace {

// ---- timelines --------------------------------------------------------------------------------------------------

struct Timelines {
  const Plan& plan;
  Report& report;
  std::vector<uint64_t> signalled;  // by queue, so far
  std::vector<uint64_t> total;      // by queue
  bool good = true;

  void expect(bool condition, uint32_t batch, const std::string& text) {
    if (condition) return;
    good = false;
    report.add({Hazard::submission, "", "", "", "batch " + std::to_string(batch) + ": " + text});
  }
};

void check_waits(Timelines& lines, uint32_t index, const Batch& batch) {
  for (const Wait& wait : lines.plan.waits.subspan(batch.first_wait, batch.wait_count)) {
    const bool known = wait.queue < lines.total.size();
    lines.expect(known, index, "it waits for a queue that is not there");
    if (!known) continue;
    const std::string what = "it waits for value " + std::to_string(wait.value) + " of queue " + std::to_string(wait.queue);
    lines.expect(wait.value >= 1 && wait.value <= lines.total[wait.queue], index, what + ", which is never signalled");
    lines.expect(wait.frames_ago <= 1, index, what + " of more than one frame ago");
    lines.expect(wait.stages != 0, index, what + " in no stage");
    const bool answered = wait.frames_ago > 0 || wait.value <= lines.signalled[wait.queue];
    lines.expect(answered, index, what + ", which only a later batch signals: with one queue it waits for ever");
  }
}

// VUID-VkSubmitInfo2-semaphore-03882: the values of a timeline ascend.
void check_signals(Timelines& lines, uint32_t index, const Batch& batch) {
  for (const Signal& signal : lines.plan.signals.subspan(batch.first_signal, batch.signal_count)) {
    lines.expect(signal.value == lines.signalled[batch.queue] + 1, index, "the values its queue signals do not count up from 1");
    lines.expect(signal.stages != 0, index, "it signals after no stage");
    ++lines.signalled[batch.queue];
  }
}

bool check_slices(Timelines& lines) {
  for (uint32_t i = 0; i < lines.plan.batches.size(); ++i) {
    const Batch& batch = lines.plan.batches[i];
    lines.expect(batch.queue < lines.plan.queues.size(), i, "its queue is not there");
    lines.expect(uint64_t{batch.first_wait} + batch.wait_count <= lines.plan.waits.size(), i, "its waits reach beyond their table");
    lines.expect(uint64_t{batch.first_signal} + batch.signal_count <= lines.plan.signals.size(), i, "its signals reach beyond their table");
  }
  return lines.good;
}

// The frame retires when every queue has signalled its last batch.
void check_last_batches(Timelines& lines) {
  if (lines.plan.queues.size() < 2) return;
  std::vector<uint32_t> last(lines.plan.queues.size(), kNone);
  for (uint32_t i = 0; i < lines.plan.batches.size(); ++i) last[lines.plan.batches[i].queue] = i;
  for (const uint32_t i : last)
    if (i != kNone) lines.expect(lines.plan.batches[i].signal_count != 0, i, "it is the last of its queue and signals nothing");
}

// ---- queues -----------------------------------------------------------------------------------------------------

using Kind = QueueKind;

struct Submission {
  const Model& model;
  Report& report;
  Kind kind(uint32_t queue) const { return model.input->plan.queues[queue].kind; }
};

void report_pass(const Submission& submission, const PassNode& node, const std::string& text) {
  const std::string pass = submission.model.pass_name(node.plan_pass);
  submission.report.add({Hazard::submission, "", pass, "", "`" + pass + "` on " + submission.model.queue_name(node.queue) + ": " + text});
}

// "Supported Queue Types" of vkCmdBlitImage2, vkCmdResolveImage2, vkCmdClear*Image.
bool needs_more_than_transfer(const Submission& submission, const PassNode& node) {
  const Pass& pass = submission.model.input->plan.passes[node.plan_pass];
  const auto all = submission.model.input->plan.transfers;
  if (pass.work.kind != WorkKind::transfers || uint64_t{pass.work.first_transfer} + pass.work.transfer_count > all.size()) return false;
  for (const Transfer& row : all.subspan(pass.work.first_transfer, pass.work.transfer_count)) {
    const bool graphics = row.kind == TransferKind::blit || row.kind == TransferKind::resolve || row.kind == TransferKind::clear_depth_stencil;
    if (graphics && submission.kind(node.queue) != Kind::graphics) return true;
    if (row.kind == TransferKind::clear_color && submission.kind(node.queue) == Kind::transfer) return true;
  }
  return false;
}

bool can_run(const Submission& submission, const PassNode& node) {
  const Kind kind = submission.kind(node.queue);
  switch (submission.model.pass(node.plan_pass).kind) {
    case dsl::PassKind::raster:
      return kind == Kind::graphics;
    case dsl::PassKind::compute:
      return kind != Kind::transfer;
    default:
      return !needs_more_than_transfer(submission, node);
  }
}

// `queue compute` is an order where the plan has such a queue; with `may`, a permission to leave the graphics queue.
bool is_permitted(const Submission& submission, const PassNode& node) {
  const dsl::Pass& pass = submission.model.pass(node.plan_pass);
  const auto wanted = static_cast<Kind>(static_cast<uint8_t>(pass.queue));
  const Kind kind = submission.kind(node.queue);
  if (kind == wanted || (pass.queue_may && kind == Kind::graphics)) return true;
  const auto& queues = submission.model.input->plan.queues;
  return std::none_of(queues.begin(), queues.end(), [&](const Queue& queue) { return queue.kind == wanted; });
}

// VUID-vkCmdPipelineBarrier2-srcStageMask-03849 and -dstStageMask-03850; VUID-vkQueueSubmit2-stageMask-03869 and -03870.
StageSet supported_stages(Kind kind) {
  const StageSet transfer = stage_bit(kCopy) | stage_bit(kResolve) | stage_bit(kBlit) | stage_bit(kClear) | stage_bit(kHost);
  if (kind == Kind::graphics) return kAllStages;
  return kind == Kind::compute ? transfer | stage_bit(kDrawIndirect) | stage_bit(kComputeShader) : transfer;
}

std::string words(const Model& model, const Scope& scope) {
  const char* kinds[] = {"memory barrier ", "image barrier ", "buffer barrier ", "wait ", "signal "};
  return std::string(kinds[static_cast<size_t>(scope.kind)]) + std::to_string(scope.index) + " on " + model.queue_name(scope.queue);
}

void check_scope(const Submission& submission, const Scope& scope) {
  const StageSet foreign = (scope.src | scope.dst) & ~supported_stages(submission.kind(scope.queue));
  const bool everything = (scope.raw_src | scope.raw_dst) & stage::all_commands;
  if (foreign && !everything)
    submission.report.add(
        {Hazard::invalid_barrier, "", "", "", words(submission.model, scope) + " names " + stages_text(foreign) + ", which its queue lacks"});
  if (scope.kind != ScopeKind::signal && scope.kind != ScopeKind::wait) return;
  // Only the signal that retires the frame may stand for all.
  const bool retires = scope.kind == ScopeKind::signal && scope.value == submission.model.signals_on[scope.queue];
  if (((scope.raw_src | scope.raw_dst) & (stage::all_commands | stage::all_graphics | stage::bottom_of_pipe)) && !retires)
    submission.report.add({Hazard::invalid_barrier, "", "", "", words(submission.model, scope) + " is wider than any plan may use"});
}

// ---- order ------------------------------------------------------------------------------------------------------

// A wait for something else than the plan says; value 0: for nothing.
struct OtherWait {
  uint32_t index = kNone;
  uint64_t value = 0;
};

// By batch and queue: how many batches of that queue are over before it begins.
std::vector<std::vector<uint32_t>> batches_before(const Plan& plan, const OtherWait& other = {}) {
  std::vector<std::vector<uint32_t>> before(plan.batches.size(), std::vector<uint32_t>(plan.queues.size(), 0));
  std::vector<std::vector<uint32_t>> on(plan.queues.size());  // batches so far
  struct Signalled {
    uint64_t value;
    uint32_t batch;
  };
  std::vector<std::vector<Signalled>> signals(plan.queues.size());
  const auto join = [](std::vector<uint32_t>& into, const std::vector<uint32_t>& from) {
    for (size_t q = 0; q < into.size(); ++q) into[q] = std::max(into[q], from[q]);
  };
  std::vector<uint32_t> position(plan.batches.size());
  for (uint32_t i = 0; i < plan.batches.size(); ++i) {
    const Batch& batch = plan.batches[i];
    if (!on[batch.queue].empty()) join(before[i], before[on[batch.queue].back()]);
    before[i][batch.queue] = static_cast<uint32_t>(on[batch.queue].size());
    for (uint32_t w = batch.first_wait; w < batch.first_wait + batch.wait_count; ++w)
      if (const Wait& wait = plan.waits[w]; wait.frames_ago == 0)
        for (const Signalled& signal : signals[wait.queue])
          if (signal.value == (w == other.index ? other.value : wait.value)) {
            join(before[i], before[signal.batch]);
            before[i][wait.queue] = std::max(before[i][wait.queue], position[signal.batch] + 1);
          }
    position[i] = static_cast<uint32_t>(on[batch.queue].size());
    on[batch.queue].push_back(i);
    for (const Signal& signal : plan.signals.subspan(batch.first_signal, batch.signal_count)) signals[batch.queue].push_back({signal.value, i});
  }
  return before;
}

struct DeclaredOrder {
  uint32_t first = 0, second = 0;  // batches of different queues
  uint32_t before = 0, after = 0;  // program passes
};
std::vector<DeclaredOrder> orders_across_queues(const Model& model) {
  std::vector<DeclaredOrder> orders;
  if (model.queue_count < 2) return orders;
  std::vector<uint32_t> batch_of(model.input->graph.passes.size(), kNone);
  for (const StepNode& step : model.steps)
    if (step.is_pass) batch_of[model.passes[step.index].program_pass] = step.batch;
  for (const PassNode& node : model.passes)
    for (const dsl::PassId before : model.pass(node.plan_pass).after) {
      const uint32_t first = batch_of[before.value], second = batch_of[node.program_pass];
      if (first != kNone && second != kNone && model.input->plan.batches[first].queue != node.queue)
        orders.push_back({first, second, before.value, node.program_pass});
    }
  return orders;
}

bool is_kept(const Plan& plan, const DeclaredOrder& order, const std::vector<std::vector<uint32_t>>& before) {
  const uint32_t queue = plan.batches[order.first].queue;
  uint32_t position = 0;
  for (uint32_t i = 0; i < order.first; ++i) position += plan.batches[i].queue == queue;
  return before[order.second][queue] > position;
}

void check_after_across_queues(const Submission& submission) {
  const Model& model = submission.model;
  const Plan& plan = model.input->plan;
  const std::vector<DeclaredOrder> orders = orders_across_queues(model);
  if (orders.empty()) return;
  const auto before = batches_before(plan);
  for (const DeclaredOrder& order : orders) {
    if (is_kept(plan, order, before)) continue;
    const std::string &first = model.input->graph.passes.rows[order.before].name, &second = model.input->graph.passes.rows[order.after].name;
    submission.report.add({Hazard::order, "", first, second,
                           "`" + second + "` is declared to follow `" + first + "`, but no wait of " +
                               model.queue_name(plan.batches[order.second].queue) + " is for " + model.queue_name(plan.batches[order.first].queue) +
                               " after it"});
  }
}

}  // namespace

bool check_timelines(const Plan& plan, Report& report) {
  Timelines lines{plan, report, std::vector<uint64_t>(plan.queues.size()), std::vector<uint64_t>(plan.queues.size())};
  if (!check_slices(lines)) return false;
  for (const Batch& batch : plan.batches) lines.total[batch.queue] += batch.signal_count;
  for (uint32_t i = 0; i < plan.batches.size(); ++i) {
    check_waits(lines, i, plan.batches[i]);
    check_signals(lines, i, plan.batches[i]);
  }
  check_last_batches(lines);
  return lines.good;
}

void check_submission(const Model& model, Report& report) {
  const Submission submission{model, report};
  for (const PassNode& node : model.passes) {
    if (!can_run(submission, node)) report_pass(submission, node, "the queue cannot run it");
    if (!is_permitted(submission, node)) report_pass(submission, node, "the program does not permit this queue");
  }
  for (const Scope& scope : model.scopes) check_scope(submission, scope);
  check_after_across_queues(submission);
}

void require_declared_order(const Model& model, std::vector<bool>& required) {
  const Plan& plan = model.input->plan;
  const std::vector<DeclaredOrder> orders = orders_across_queues(model);
  if (orders.empty()) return;
  const auto is_needed = [&](const OtherWait& instead) {
    const auto before = batches_before(plan, instead);
    return !std::all_of(orders.begin(), orders.end(), [&](const DeclaredOrder& order) { return is_kept(plan, order, before); });
  };
  for (uint32_t id = 0; id < model.scopes.size(); ++id) {
    const Scope& wait = model.scopes[id];
    if (wait.kind != ScopeKind::wait || wait.frames_ago != 0 || !is_needed({wait.index, 0})) continue;
    required[atom_of(id, AtomField::whole)] = true;
    if (wait.value > 1 && !is_needed({wait.index, wait.value - 1})) continue;
    required[atom_of(id, AtomField::value)] = true;
    for (uint32_t other = 0; other < model.scopes.size(); ++other)
      if (model.scopes[other].kind == ScopeKind::signal && model.scopes[other].queue == wait.other && model.scopes[other].value == wait.value)
        required[atom_of(other, AtomField::whole)] = true;
  }
}

}  // namespace rg::verify
