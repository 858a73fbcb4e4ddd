// Signals and waits. A signal's first scope is everything submitted before it on its queue, limited to its stages and what comes logically before
// them; signals of one queue follow each other. A wait's second scope is everything submitted after it on its queue, limited likewise. Both are
// memory dependencies on all accesses of their stages.
#include <algorithm>

#include "compiler/verify/sync_update.h"

namespace rg::verify {
namespace {

// What comes after the record now has one more signal. The proof of a number is that of any signal up to it.
void add_signal(const History& history, Reach& reach, uint32_t queue, int64_t number, Proof proof) {
  const auto last = std::find_if(reach.signals.rbegin(), reach.signals.rend(), [&](const SignalReach& s) { return s.queue == queue; });
  if (last != reach.signals.rend()) {
    if (!history.proofs) return;
    intersect(proof, last->proof);
    if (proof == last->proof) return;
  }
  reach.signals.push_back({queue, number, std::move(proof)});
}

const Proof* signalled_by(const Reach& reach, uint32_t queue, int64_t number) {
  const Proof* best = nullptr;
  for (const SignalReach& signal : reach.signals)
    if (signal.queue == queue && signal.number <= number) best = &signal.proof;
  return best;
}

// How a wait comes after the record; it may name a later signal than it needs.
Alternatives source_of_wait(const History& history, const Executed& executed, uint32_t id, const Reach& reach) {
  const Scope& wait = history.model.scopes[id];
  Alternatives source;
  // Before the first frame there may have been a frame of another plan, whose last signals take the place of all.
  const bool first = executed.frame < wait.frames_ago;
  const int64_t number =
      first ? 0 : static_cast<int64_t>(executed.frame - wait.frames_ago) * history.model.signals_on[wait.other] + static_cast<int64_t>(wait.value);
  const Proof* now = signalled_by(reach, wait.other, number);
  if (!now) return source;
  source.proof = *now;
  if (!history.proofs) return source;
  Proof value{atom_of(id, AtomField::value)};
  const Proof* before = first ? nullptr : signalled_by(reach, wait.other, number - 1);
  if (before) intersect(value, *before);
  source.proof = unite(*source.proof, value);
  return source;
}

// Reads and writes alike: what they have of signals leads to the waits' second scopes.
template <class Record>
bool wait(const History& history, const Executed& executed, const Reach& reach, Record& record, Updates& updates, auto then) {
  const GroupNode& group = history.model.groups[executed.group];
  updates.queue = group.queue;
  std::vector<std::pair<uint32_t, Proof>> sources;
  for (const uint32_t id : group.scopes) {
    Alternatives source = source_of_wait(history, executed, id, reach);
    if (source.proof) sources.emplace_back(id, std::move(*source.proof));
  }
  for (const auto& [id, source] : sources)
    if (!contains(source, reach.root)) forget_root(record);
  for (auto& [id, source] : sources) {
    subtract(source, reach.root);
    then(id, Alternatives{std::move(source)});
  }
  return !sources.empty();
}

void signal(const History& history, const Executed& executed, ReadFate& fate) {
  const GroupNode& group = history.model.groups[executed.group];
  const StageSet own = fate.queue == group.queue ? stage_bit(fate.stage) : 0;
  for (const uint32_t id : group.scopes) {
    const Scope& scope = history.model.scopes[id];
    if (!((fate.reach.stages(group.queue) | own) & scope.src_earlier)) continue;
    Alternatives source;
    if (history.proofs) {
      add_chained_sources(scope, id, fate.reach, source);
      if (source.proof) source.proof = unite(*source.proof, fate.reach.root);
      if (own) add_meeting_sources(scope, id, fate.stage, {}, source);
      source.proof = unite(*source.proof, {atom_of(id, AtomField::whole)});
    }
    add_signal(history, fate.reach, group.queue, number_of(history.model, scope, executed.frame), source.proof.value_or(Proof{}));
  }
}

void signal(const History& history, const Executed& executed, WriteRecord& write) {
  const GroupNode& group = history.model.groups[executed.group];
  for (const uint32_t id : group.scopes) {
    const Scope& scope = history.model.scopes[id];
    const bool first = makes_available(scope, write);
    // The transition of a barrier that leads nowhere belongs to no stage; only all commands hold it.
    const bool transition = write.scope != kNone && write.queue == group.queue && (scope.raw_src & stage::all_commands);
    Alternatives source;
    if (write.available) add_chained_sources(scope, id, write.reach, source);
    if (source.proof) source.proof = unite(*source.proof, write.reach.root);
    if (first) source.add(availability_proof(scope, id, write));
    if (transition) source.add({atom_of(write.scope, AtomField::whole)});
    if (!source.proof) continue;
    write.available = true;
    add_signal(history, write.reach, group.queue, number_of(history.model, scope, executed.frame),
               unite(*source.proof, {atom_of(id, AtomField::whole)}));
  }
}

}  // namespace

void apply_semaphores(const History& history, const Executed& executed, ReadFate& fate) {
  const GroupNode& group = history.model.groups[executed.group];
  if (group.kind == GroupKind::signals) return signal(history, executed, fate);
  if (fate.reach.signals.empty()) return;
  Updates updates;
  wait(history, executed, fate.reach, fate.reach, updates, [&](uint32_t id, const Alternatives& source) {
    const Scope& scope = history.model.scopes[id];
    updates.reach |= scope.dst_later;
    if (history.proofs) add_reach(scope, id, *source.proof, fate.reach.queues.get(group.queue).settled, updates.new_reach);
  });
  commit(history, updates, fate.reach);
}

void apply_semaphores(const History& history, const Executed& executed, WriteRecord& write) {
  if (history.model.groups[executed.group].kind == GroupKind::signals) return signal(history, executed, write);
  if (write.reach.signals.empty()) return;
  Updates updates;
  updates.available = wait(history, executed, write.reach, write, updates,
                           [&](uint32_t id, const Alternatives& source) { see(history, id, write, source, updates); });
  commit(history, updates, write);
}

}  // namespace rg::verify
