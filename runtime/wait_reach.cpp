#include "runtime/wait_reach.h"

namespace rg {

namespace {

using Set = std::vector<bool>;  // of batches

void add(Set& all, const Set& more) {
  for (size_t i = 0; i < all.size(); ++i) all[i] = all[i] || more[i];
}

// The batch whose signal the wait is for: the first of its queue that signals as much.
Index awaited(const Plan& plan, const Wait& wait) {
  for (Index b = 0; b < plan.batches.size(); ++b) {
    const Batch& batch = plan.batches[b];
    if (batch.queue != wait.queue) continue;
    for (const Signal& signal : plan.signals.subspan(batch.first_signal, batch.signal_count))
      if (signal.value >= wait.value) return b;
  }
  return kNone;
}

// The batch before it on its queue, in this frame.
Index previous(const Plan& plan, Index batch) {
  for (Index b = batch; b-- > 0;)
    if (plan.batches[b].queue == plan.batches[batch].queue) return b;
  return kNone;
}
Index last_of(const Plan& plan, Index queue) {
  for (Index b = static_cast<Index>(plan.batches.size()); b-- > 0;)
    if (plan.batches[b].queue == queue) return b;
  return kNone;
}

// What each batch comes after within its frame. Batches are listed in an order in which every wait is for something before it.
std::vector<Set> within_frame(const Plan& plan) {
  std::vector<Set> after(plan.batches.size(), Set(plan.batches.size()));
  for (Index b = 0; b < plan.batches.size(); ++b) {
    const auto follow = [&](Index other) {
      if (other == kNone) return;
      add(after[b], after[other]);
      after[b][other] = true;
    };
    follow(previous(plan, b));
    for (const Wait& wait : plan.waits.subspan(plan.batches[b].first_wait, plan.batches[b].wait_count))
      if (wait.frames_ago == 0) follow(awaited(plan, wait));
  }
  return after;
}

}  // namespace

WaitReach::WaitReach(const Plan& plan)
    : batch_of_pass_(plan.passes.size(), kNone), batch_of_group_(plan.groups.size(), kNone), after_(within_frame(plan)) {
  for (Index b = 0; b < plan.batches.size(); ++b) {
    const Batch& batch = plan.batches[b];
    queue_of_.push_back(batch.queue);
    for (const Step& step : plan.steps.subspan(batch.first_step, batch.step_count))
      (step.kind == StepKind::pass ? batch_of_pass_ : batch_of_group_)[step.index] = b;
  }
  const std::vector<Set> within = after_;
  std::vector<Set> before(plan.batches.size(), Set(plan.batches.size()));  // of the frame before
  for (Index b = 0; b < plan.batches.size(); ++b) {
    const auto follow = [&](Index other) {
      if (other == kNone) return;
      add(before[b], within[other]);
      before[b][other] = true;
    };
    if (previous(plan, b) == kNone) follow(last_of(plan, plan.batches[b].queue));
    for (const Wait& wait : plan.waits.subspan(plan.batches[b].first_wait, plan.batches[b].wait_count))
      if (wait.frames_ago != 0) follow(awaited(plan, wait));
    for (Index other = 0; other < b; ++other)
      if (within[b][other]) add(before[b], before[other]);
    add(after_[b], before[b]);
  }
}

bool WaitReach::comes_after(Index group, Index pass) const {
  const Index to = batch_of_group_[group], from = batch_of_pass_[pass];
  return to != kNone && from != kNone && queue_of_[to] != queue_of_[from] && after_[to][from];
}

}  // namespace rg
