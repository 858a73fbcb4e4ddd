#include "compiler/verify/sync_state.h"

#include <algorithm>

#include "compiler/verify/sync_update.h"

namespace rg::verify {
namespace {

const Proof kNoProof;

bool is_local(const std::vector<uint32_t>& local, uint32_t scope) { return std::find(local.begin(), local.end(), scope) != local.end(); }

}  // namespace

void chain(const History& history, const ExecutionClass& execution, const Reach& reach, StageSet own, Updates& updates) {
  const Scope& scope = history.model.scopes[execution.scope];
  const QueueReach& on = reach.queues.get(scope.queue);
  if (!((on.stages | own) & scope.src_earlier)) return;
  updates.reach |= scope.dst_later;
  if (!history.proofs || !(scope.dst_later & ~on.settled)) return;
  Alternatives sources;
  for (uint32_t s = 0; s < kStageCount && own != 0; ++s)
    if (own & stage_bit(s)) add_meeting_sources(scope, execution.scope, s, kNoProof, sources);
  add_chained_sources(scope, execution.scope, reach, sources);
  if (execution.sole) return add_reach(scope, execution.scope, *sources.proof, on.settled, updates.new_reach);
  std::erase_if(*sources.proof, [&](Atom atom) { return scope_of(atom) == execution.scope; });
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (scope.dst_later & ~on.settled & stage_bit(d)) updates.new_reach.push_back({d, *sources.proof});
}

bool concerns(const GroupNode& group, const Reach& reach, StageSet own) {
  const QueueReach& on = reach.queues.get(group.queue);
  return ((on.stages | own) & group.src_earlier) && (group.dst_later & ~on.settled) != 0;
}

namespace {

// ---- writes -----------------------------------------------------------------------------------------------------

// Where one barrier of the group alone makes the write available for the first time, all later proofs grow from it.
bool is_rooted(const History& history, const std::vector<uint32_t>& covering, WriteRecord& write) {
  const auto makes = [&](uint32_t id) { return makes_available(history.model.scopes[id], write); };
  const auto count = std::count_if(covering.begin(), covering.end(), makes);
  if (write.available && count > 0) forget_root(write, write.queue);
  if (write.available || count != 1) return false;
  const uint32_t id = *std::find_if(covering.begin(), covering.end(), makes);
  set_root(write.reach, write.queue, unite(availability_proof(history.model.scopes[id], id, write), {atom_of(id, AtomField::whole)}));
  return true;
}

std::vector<uint32_t> covering(const GroupNode& group, const std::vector<uint32_t>& local) {
  std::vector<uint32_t> scopes = group.memory;
  scopes.insert(scopes.end(), local.begin(), local.end());
  return scopes;
}

}  // namespace

Updates effects(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, bool rooted, const WriteRecord& write) {
  Updates updates;
  updates.queue = group.queue;
  for (const uint32_t id : covering(group, local)) {
    const Scope& scope = history.model.scopes[id];
    const bool first = makes_available(scope, write);
    const bool chained = write.available && (write.reach.stages(group.queue) & scope.src_earlier);
    if (!first && !chained) continue;
    Alternatives source;
    if (!history.proofs) source.add({});
    if (history.proofs && chained) add_chained_sources(scope, id, write.reach, source);
    if (history.proofs && first) source.add(rooted ? Proof{} : availability_proof(scope, id, write));
    updates.available = updates.available || first;
    see(history, id, write, source, updates);
  }
  if (write.available && concerns(group, write.reach, 0))
    for (const ExecutionClass& execution : group.classes)
      if (!execution.sole || !is_local(local, execution.scope)) chain(history, execution, write.reach, 0, updates);
  return updates;
}

namespace {

void apply(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, WriteRecord& write) {
  const bool rooted = history.proofs && is_rooted(history, covering(group, local), write);
  commit(history, effects(history, group, local, rooted, write), write);
  if (rooted) grow_root(write, group.queue);
}

// ---- reads ------------------------------------------------------------------------------------------------------

// Where one barrier of the group alone waits for the read for the first time, all later proofs grow from it.
bool is_rooted(const History& history, const GroupNode& group, StageSet own, ReadFate& read) {
  if (!(own & group.src_earlier)) return false;
  const auto waits = [&](const ExecutionClass& execution) { return (history.model.scopes[execution.scope].src_earlier & own) != 0; };
  forget_root(read.reach, group.queue);
  if (read.reach.stages(group.queue) != 0 || std::count_if(group.classes.begin(), group.classes.end(), waits) != 1) return false;
  const ExecutionClass& only = *std::find_if(group.classes.begin(), group.classes.end(), waits);
  if (!only.sole) return false;
  Alternatives sources;
  add_meeting_sources(history.model.scopes[only.scope], only.scope, read.stage, kNoProof, sources);
  set_root(read.reach, group.queue, unite(*sources.proof, {atom_of(only.scope, AtomField::whole)}));
  return true;
}

void apply(const History& history, const GroupNode& group, ReadFate& read) {
  const StageSet own = own_stage(group, read);
  const bool rooted = history.proofs && is_rooted(history, group, own, read);
  if (!concerns(group, read.reach, own)) return;
  Updates updates;
  updates.queue = group.queue;
  for (const ExecutionClass& execution : group.classes) chain(history, execution, read.reach, own, updates);
  commit(history, updates, read.reach);
  if (rooted) grow_root(read.reach, group.queue);
}

bool is_settled(const History& history, const Reach& reach) {
  for (uint32_t q = 0; q < history.model.queue_count; ++q)
    if (reach.queues.get(q).settled != kAllStages || !reach.root(q).empty()) return false;
  return true;
}

}  // namespace

History::History(const Model& m, bool with_proofs)
    : model(m), proofs(with_proofs), executed_on(m.queue_count), newest(size_t{m.queue_count} * kStageCount) {}

int64_t number_of(const Model& model, const Scope& signal, uint32_t frame) {
  return static_cast<int64_t>(frame) * model.signals_on[signal.queue] + static_cast<int64_t>(signal.value);
}

bool in_source(const Scope& scope, uint32_t scope_id, const ReadRecord& read, Proof& proof) {
  const StageSet own = read.queue == scope.queue ? stage_bit(read.stage) : 0;
  if (!((read.reach().stages(scope.queue) | own) & scope.src_earlier)) return false;
  Alternatives alternatives;
  add_chained_sources(scope, scope_id, read.reach(), alternatives);
  if (alternatives.proof) alternatives.proof = unite(*alternatives.proof, read.reach().root(scope.queue));
  if (own) add_meeting_sources(scope, scope_id, read.stage, kNoProof, alternatives);
  proof = std::move(*alternatives.proof);
  return true;
}

bool in_source(const Scope& scope, uint32_t scope_id, const WriteRecord& write, Proof& proof) {
  Alternatives alternatives;
  if (write.available) add_chained_sources(scope, scope_id, write.reach, alternatives);
  if (alternatives.proof) alternatives.proof = unite(*alternatives.proof, write.reach.root(scope.queue));
  if (makes_available(scope, write)) alternatives.add(availability_proof(scope, scope_id, write));
  if (!alternatives.proof) return false;
  proof = std::move(*alternatives.proof);
  return true;
}

void advance(const History& history, ReadFate& fate) {
  for (; fate.seen < history.executed.size(); ++fate.seen) {
    if (is_settled(history, fate.reach)) {
      fate.seen = static_cast<uint32_t>(history.executed.size());
      return;
    }
    const Executed& executed = history.executed[fate.seen];
    const GroupNode& group = history.model.groups[executed.group];
    if (group.kind == GroupKind::barriers)
      apply(history, group, fate);
    else if (group.kind == GroupKind::set)
      hold(history, executed.group, fate);
    else if (group.kind == GroupKind::awaited)
      await(history, group, fate);
    else if (!is_quiet(fate.reach, group))
      apply_semaphores(history, executed, fate);
  }
}

void advance(const History& history, WriteRecord& write) {
  for (; write.seen < history.executed.size(); ++write.seen) {
    const Executed& executed = history.executed[write.seen];
    const GroupNode& group = history.model.groups[executed.group];
    if (group.kind == GroupKind::waits || group.kind == GroupKind::signals) {
      if (!is_quiet(write.reach, group)) apply_semaphores(history, executed, write);
      continue;
    }
    if (group.kind == GroupKind::awaited) {
      await(history, group, write);
      continue;
    }
    const bool chained = write.available && concerns(group, write.reach, 0);
    if (group.memory.empty() && !chained) continue;
    if (group.kind == GroupKind::set)
      hold(history, executed.group, {}, write);
    else
      apply(history, group, {}, write);
  }
}

void advance(const History& history, CellState& state) {
  for (ReadRecord& read : state.reads) advance(history, *read.fate);
  for (WriteRecord& write : state.writes) advance(history, write);
  for (ReadRecord& read : state.without.reads) advance(history, *read.fate);
  for (WriteRecord& write : state.without.writes) advance(history, write);
}

void apply_to_writes(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, CellState& state) {
  const auto index = static_cast<uint32_t>(&group - history.model.groups.data());
  for (WriteRecord& write : state.writes) {
    if (group.kind == GroupKind::set)
      hold(history, index, local, write);
    else
      apply(history, group, local, write);
    ++write.seen;
  }
}

ReadRecord make_read(History& history, Site site, uint32_t pass, uint32_t frame, uint64_t order) {
  const uint32_t queue = site / kStageCount, stage = site % kStageCount;
  std::shared_ptr<ReadFate>& newest = history.newest[site];
  if (!newest || newest->born != history.executed_on[queue])
    newest =
        std::make_shared<ReadFate>(ReadFate{queue, stage, history.executed_on[queue], static_cast<uint32_t>(history.executed.size()), Reach(queue)});
  return {queue, stage, pass, frame, order, false, newest};
}

WriteRecord transition_record(const History& history, const GroupNode& group, uint32_t scope_id) {
  const Scope& scope = history.model.scopes[scope_id];
  WriteRecord write(scope.queue);
  write.scope = scope_id;
  write.available = true;
  write.pass = kNone;
  Updates updates;
  updates.queue = scope.queue;
  updates.reach = scope.dst_later;
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (scope.dst & stage_bit(d)) updates.visible.to[d] = scope.dst_accesses & supported(d);
  if (history.proofs) {
    add_reach(scope, scope_id, {}, 0, updates.new_reach);
    add_visible(scope, scope_id, {}, updates.new_visible);
  }
  if (group.kind == GroupKind::set) {
    hold(static_cast<uint32_t>(&group - history.model.groups.data()), std::move(updates), write.reach);
    return write;
  }
  commit(history, updates, write);
  if (history.proofs) {
    set_root(write.reach, scope.queue, {atom_of(scope_id, AtomField::whole)});
    grow_root(write, scope.queue);
  }
  return write;
}

}  // namespace rg::verify
