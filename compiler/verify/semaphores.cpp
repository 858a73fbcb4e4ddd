// Signals and waits. A signal's first scope is everything submitted before it on its queue, limited to its stages and what comes logically before
// them; signals of one queue follow each other. A wait's second scope is everything submitted after it on its queue, limited likewise. Both are
// memory dependencies on all accesses of their stages.
#include <algorithm>

#include "compiler/verify/sync_update.h"

namespace rg::verify {
namespace {

const SignalReach* last_signal(const Reach& reach, uint32_t queue) {
  const auto last = std::find_if(reach.signals.rbegin(), reach.signals.rend(), [&](const SignalReach& s) { return s.queue == queue; });
  return last == reach.signals.rend() ? nullptr : &*last;
}

// What comes after the record now has one more signal. The proof of a number is that of any signal up to it.
void add_signal(const History& history, Reach& reach, uint32_t queue, int64_t number, Proof proof) {
  if (const SignalReach* last = last_signal(reach, queue)) {
    if (!history.proofs) return;
    intersect(proof, last->proof);
    if (proof == last->proof) return;
  }
  reach.signals.push_back({queue, number, std::move(proof)});
  reach.quiet = 0;
}

void become_quiet(Reach& reach, const GroupNode& group) {
  if (group.alike < 64) reach.quiet |= uint64_t{1} << group.alike;
}

const Proof* signalled_by(const Reach& reach, uint32_t queue, int64_t number) {
  const Proof* best = nullptr;
  for (const SignalReach& signal : reach.signals)
    if (signal.queue == queue && signal.number <= number) best = &signal.proof;
  return best;
}

// The number a wait is for, counted like number_of. Before the first frame there may have been a frame of another plan, whose last signals take
// the place of all.
int64_t number_waited_for(const Model& model, const Executed& executed, const Scope& wait) {
  if (executed.frame < wait.frames_ago) return 0;
  return static_cast<int64_t>(executed.frame - wait.frames_ago) * model.signals_on[wait.other] + static_cast<int64_t>(wait.value);
}

bool is_waited_for(const Model& model, const Executed& executed, const Reach& reach, const Scope& wait) {
  const int64_t number = number_waited_for(model, executed, wait);
  return std::any_of(reach.signals.begin(), reach.signals.end(), [&](const SignalReach& s) { return s.queue == wait.other && s.number <= number; });
}

// The facts alone.
void wait_plainly(const History& history, const Executed& executed, const Reach& reach, Updates& updates) {
  const GroupNode& group = history.model.groups[executed.group];
  updates.queue = group.queue;
  for (const uint32_t id : group.scopes) {
    const Scope& scope = history.model.scopes[id];
    if (!is_waited_for(history.model, executed, reach, scope)) continue;
    updates.reach |= scope.dst_later, updates.available = true;
    for (uint32_t d = 0; d < kStageCount; ++d)
      if (scope.dst & stage_bit(d)) updates.visible.to[d] |= supported(d);
  }
}

// Another signal of the queue has no smaller proof. `begins`: one that does not come after what is on the queue already.
bool has_signalled(const History& history, const Reach& reach, uint32_t queue, bool begins) {
  const SignalReach* last = last_signal(reach, queue);
  return last && (!history.proofs || last->proof.empty() || (!begins && last->proof == reach.root(queue)));
}

// Nor has any wait of the group: what is settled on its queue rests on nothing that all signals could do without.
bool rests_on_signals(const History& history, const GroupNode& group, const Reach& reach) {
  return std::all_of(group.scopes.begin(), group.scopes.end(), [&](uint32_t id) {
    const SignalReach* last = last_signal(reach, history.model.scopes[id].other);
    return !last || contains(last->proof, reach.root(group.queue));
  });
}

// How a wait comes after the record; it may name a later signal than it needs.
Alternatives source_of_wait(const History& history, const Executed& executed, uint32_t id, const Reach& reach) {
  const Scope& wait = history.model.scopes[id];
  Alternatives source;
  const bool first = executed.frame < wait.frames_ago;
  const int64_t number = number_waited_for(history.model, executed, wait);
  const Proof* now = signalled_by(reach, wait.other, number);
  if (!now) return source;
  source.proof = *now;
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
    if (!contains(source, reach.root(group.queue))) forget_root(record, group.queue);
  for (auto& [id, source] : sources) {
    subtract(source, reach.root(group.queue));
    then(id, Alternatives{std::move(source)});
  }
  return !sources.empty();
}

void signal(const History& history, const Executed& executed, ReadFate& fate) {
  const GroupNode& group = history.model.groups[executed.group];
  const StageSet own = fate.queue == group.queue ? stage_bit(fate.stage) : 0;
  bool quiet = true;
  for (const uint32_t id : group.scopes) {
    const Scope& scope = history.model.scopes[id];
    if (has_signalled(history, fate.reach, group.queue, (own & scope.src_earlier) != 0)) continue;
    quiet = false;
    if (!((fate.reach.stages(group.queue) | own) & scope.src_earlier)) continue;
    Alternatives source;
    if (history.proofs) {
      add_chained_sources(scope, id, fate.reach, source);
      if (source.proof) source.proof = unite(*source.proof, fate.reach.root(group.queue));
      if (own) add_meeting_sources(scope, id, fate.stage, {}, source);
      source.proof = unite(*source.proof, {atom_of(id, AtomField::whole)});
    }
    add_signal(history, fate.reach, group.queue, number_of(history.model, scope, executed.frame), source.proof.value_or(Proof{}));
  }
  if (quiet) become_quiet(fate.reach, group);
}

void signal(const History& history, const Executed& executed, WriteRecord& write) {
  const GroupNode& group = history.model.groups[executed.group];
  bool quiet = true;
  for (const uint32_t id : group.scopes) {
    const Scope& scope = history.model.scopes[id];
    const bool first = makes_available(scope, write);
    // The transition of a barrier that leads nowhere belongs to no stage; only all commands hold it.
    const bool transition = write.scope != kNone && write.queue == group.queue && (scope.raw_src & stage::all_commands);
    if (write.available && has_signalled(history, write.reach, group.queue, first || transition)) continue;
    quiet = false;
    const bool chained = write.available && (write.reach.stages(group.queue) & scope.src_earlier);
    if (!first && !transition && !chained) continue;
    write.available = true;
    Alternatives source;
    if (!history.proofs) source.add({});
    if (history.proofs && chained) add_chained_sources(scope, id, write.reach, source);
    if (source.proof) source.proof = unite(*source.proof, write.reach.root(group.queue));
    if (history.proofs && first) source.add(availability_proof(scope, id, write));
    if (history.proofs && transition) source.add({atom_of(write.scope, AtomField::whole)});
    add_signal(history, write.reach, group.queue, number_of(history.model, scope, executed.frame),
               unite(*source.proof, {atom_of(id, AtomField::whole)}));
  }
  if (quiet) become_quiet(write.reach, group);
}

// Nothing that the waits of the group could add, and nothing that still depends on single atoms.
bool is_seen_by_all(const History& history, const GroupNode& group, const WriteRecord& write) {
  if (!write.available || (group.dst_later & ~write.reach.queues.get(group.queue).settled) != 0) return false;
  StageSet stages = 0;
  for (const uint32_t id : group.scopes) stages |= history.model.scopes[id].dst;
  for (uint32_t d = 0; d < kStageCount; ++d)
    if ((stages & stage_bit(d)) && (supported(d) & ~write.visible_to(group.queue, d))) return false;
  const auto is_open = [&](const VisibleTo& v) { return v.site / kStageCount == group.queue && (stages & stage_bit(v.site % kStageCount)); };
  return std::none_of(write.proofs.begin(), write.proofs.end(), is_open) && rests_on_signals(history, group, write.reach);
}

}  // namespace

void apply_semaphores(const History& history, const Executed& executed, ReadFate& fate) {
  const GroupNode& group = history.model.groups[executed.group];
  if (group.kind == GroupKind::signals) return signal(history, executed, fate);
  if (fate.reach.signals.empty()) return;
  if ((group.dst_later & ~fate.reach.queues.get(group.queue).settled) == 0 && rests_on_signals(history, group, fate.reach))
    return become_quiet(fate.reach, group);
  Updates updates;
  if (!history.proofs) {
    wait_plainly(history, executed, fate.reach, updates);
    return commit(history, updates, fate.reach);
  }
  wait(history, executed, fate.reach, fate.reach, updates, [&](uint32_t id, const Alternatives& source) {
    const Scope& scope = history.model.scopes[id];
    add_reach(scope, id, *source.proof, fate.reach.queues.get(group.queue).settled, updates.new_reach);
  });
  commit(history, updates, fate.reach);
  grow_root(fate.reach, group.queue);
}

void apply_semaphores(const History& history, const Executed& executed, WriteRecord& write) {
  const GroupNode& group = history.model.groups[executed.group];
  if (group.kind == GroupKind::signals) return signal(history, executed, write);
  if (write.reach.signals.empty()) return;
  Updates updates;
  if (is_seen_by_all(history, group, write)) return become_quiet(write.reach, group);
  if (!history.proofs) {
    wait_plainly(history, executed, write.reach, updates);
    return commit(history, updates, write);
  }
  updates.available = wait(history, executed, write.reach, write, updates,
                           [&](uint32_t id, const Alternatives& source) { see(history, id, write, source, updates); });
  commit(history, updates, write);
  grow_root(write, group.queue);
}

}  // namespace rg::verify
