// Barriers in two halves, vkCmdSetEvent2 and vkCmdWaitEvents2: what the first scope holds is decided where the event is set, and the second scope
// begins where it is awaited. What is recorded in between is in neither.
//
// Source of the rules: Vulkan 1.3, "Events".
#include <algorithm>

#include "compiler/verify/sync_update.h"

namespace rg::verify {
namespace {

const Held* find_held(const Reach& reach, uint32_t group) {
  const auto found = std::find_if(reach.held.begin(), reach.held.end(), [&](const auto& held) { return held->group == group; });
  return found == reach.held.end() ? nullptr : found->get();
}

template <class Record>
void await(const History& history, const GroupNode& group, const Reach& reach, Record& record) {
  const Held* held = find_held(reach, group.set_by);
  if (held == nullptr) return;
  const Updates updates = held->updates;
  forget_root(record, group.queue);
  commit(history, updates, record);
  if (history.proofs) grow_root(record, group.queue);
}

void let_go(Reach& reach, uint32_t group) {
  std::erase_if(reach.held, [&](const auto& held) { return held->group == group; });
}

}  // namespace

void hold(uint32_t group, Updates updates, Reach& reach) {
  let_go(reach, group);
  reach.held.push_back(std::make_shared<const Held>(Held{group, std::move(updates)}));
}

void hold(const History& history, uint32_t index, ReadFate& fate) {
  const GroupNode& group = history.model.groups[index];
  const StageSet own = own_stage(group, fate);
  let_go(fate.reach, index);
  if (!concerns(group, fate.reach, own)) return;
  forget_root(fate.reach, group.queue);
  Updates updates;
  updates.queue = group.queue;
  for (const ExecutionClass& execution : group.classes) chain(history, execution, fate.reach, own, updates);
  hold(index, std::move(updates), fate.reach);
}

void hold(const History& history, uint32_t index, const std::vector<uint32_t>& local, WriteRecord& write) {
  const GroupNode& group = history.model.groups[index];
  forget_root(write, group.queue);
  hold(index, effects(history, group, local, false, write), write.reach);
}

void await(const History& history, const GroupNode& group, ReadFate& fate) {
  await(history, group, fate.reach, fate.reach);
  let_go(fate.reach, group.set_by);
}

void await(const History& history, const GroupNode& group, WriteRecord& write) {
  await(history, group, write.reach, write);
  let_go(write.reach, group.set_by);
}

}  // namespace rg::verify
