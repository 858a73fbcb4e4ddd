#include "compiler/verify/sync_state.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace rg::verify {
namespace {

Proof unite(const Proof& a, const Proof& b) {
  Proof result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}
void intersect(Proof& a, const Proof& b) {
  Proof result;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  a = std::move(result);
}

void subtract(Proof& a, const Proof& b) {
  Proof result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  a = std::move(result);
}

// Intersection of alternative derivations; none yet means the fact does not hold.
struct Alternatives {
  std::optional<Proof> proof;
  void add(Proof next) {
    if (!proof)
      proof = std::move(next);
    else
      intersect(*proof, next);
  }
};

Proof stage_atom(uint32_t scope, AtomField field, Stages raw, uint32_t stage) {
  const uint32_t bit = raw_bit_of_stage(raw, stage);
  return bit == kNone ? Proof{} : Proof{atom_of(scope, field, bit)};
}
Proof access_atom(uint32_t scope, AtomField field, Accesses raw, uint32_t access) {
  const uint32_t bit = raw_bit_of_access(raw, access);
  return bit == kNone ? Proof{} : Proof{atom_of(scope, field, bit)};
}

const Proof kNoProof;

const Proof& relative_proof(const Reach& reach, uint32_t stage) {
  for (const auto& [s, proof] : reach.proofs)
    if (s == stage) return proof;
  return kNoProof;
}
const Proof& relative_proof(const WriteRecord& write, uint32_t stage, uint32_t access) {
  for (const VisibleTo& v : write.proofs)
    if (v.stage == stage && v.access == access) return v.proof;
  return kNoProof;
}

// The source stages of `scope` that meet `stage`, as alternatives on top of `premise`.
void add_meeting_sources(const Scope& scope, uint32_t scope_id, uint32_t stage, const Proof& premise, Alternatives& result) {
  for (uint32_t s = 0; s < kStageCount; ++s)
    if ((scope.src & stage_bit(s)) && (with_earlier(stage_bit(s)) & stage_bit(stage)))
      result.add(unite(premise, stage_atom(scope_id, AtomField::src_stage, scope.raw_src, s)));
}

void add_chained_sources(const Scope& scope, uint32_t scope_id, const Reach& reach, Alternatives& result) {
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (reach.stages & scope.src_earlier & stage_bit(d)) add_meeting_sources(scope, scope_id, d, relative_proof(reach, d), result);
}

// A derivation waiting to be merged once all barriers of a group have seen the state before the group.
struct NewReach {
  uint32_t stage;
  Proof proof;
};
struct NewVisible {
  uint32_t stage, access;
  Proof proof;
};

void add_reach(const Scope& scope, uint32_t scope_id, const Proof& source, StageSet settled, std::vector<NewReach>& result) {
  const Proof base = unite(source, Proof{atom_of(scope_id, AtomField::whole)});
  for (uint32_t d = 0; d < kStageCount; ++d) {
    if (!(scope.dst_later & ~settled & stage_bit(d))) continue;
    Alternatives targets;
    for (uint32_t t = 0; t < kStageCount; ++t)
      if ((scope.dst & stage_bit(t)) && (with_later(stage_bit(t)) & stage_bit(d)))
        targets.add(stage_atom(scope_id, AtomField::dst_stage, scope.raw_dst, t));
    result.push_back({d, unite(base, *targets.proof)});
  }
}

void merge(Reach& reach, const NewReach& next) {
  const StageSet bit = stage_bit(next.stage);
  if (reach.settled & bit) return;
  const auto at = std::find_if(reach.proofs.begin(), reach.proofs.end(), [&](const auto& entry) { return entry.first == next.stage; });
  if (!(reach.stages & bit))
    reach.proofs.emplace_back(next.stage, next.proof);
  else
    intersect(at->second, next.proof);
  reach.stages |= bit;
  const auto now = std::find_if(reach.proofs.begin(), reach.proofs.end(), [&](const auto& entry) { return entry.first == next.stage; });
  if (!now->second.empty()) return;
  reach.proofs.erase(now);
  reach.settled |= bit;
}

void merge(WriteRecord& write, const NewVisible& next) {
  const AccessSet bit = access_bit(next.access);
  const auto at =
      std::find_if(write.proofs.begin(), write.proofs.end(), [&](const VisibleTo& v) { return v.stage == next.stage && v.access == next.access; });
  if (!(write.visible[next.stage] & bit)) {
    write.visible[next.stage] |= bit;
    if (!next.proof.empty()) write.proofs.push_back({next.stage, next.access, next.proof});
    return;
  }
  if (at == write.proofs.end()) return;
  intersect(at->proof, next.proof);
  if (at->proof.empty()) write.proofs.erase(at);
}

void extend_plain(Reach& reach, StageSet next) { reach.settled = reach.stages |= next; }

void add_visible(const Scope& scope, uint32_t scope_id, const Proof& source, std::vector<NewVisible>& result) {
  const Proof base = unite(source, Proof{atom_of(scope_id, AtomField::whole)});
  for (uint32_t d = 0; d < kStageCount; ++d) {
    if (!(scope.dst & stage_bit(d))) continue;
    const Proof with_stage = unite(base, stage_atom(scope_id, AtomField::dst_stage, scope.raw_dst, d));
    for (uint32_t a = 0; a < kAccessCount; ++a)
      if (scope.dst_accesses & supported(d) & access_bit(a))
        result.push_back({d, a, unite(with_stage, access_atom(scope_id, AtomField::dst_access, scope.raw_dst_accesses, a))});
  }
}

bool makes_available(const Scope& scope, const WriteRecord& write) {
  return write.stage < kStageCount && (scope.src & stage_bit(write.stage)) && (scope.src_accesses & access_bit(write.access));
}

struct Updates {
  StageSet reach = 0;
  AccessSet visible[kStageCount] = {};
  bool available = false;
  std::vector<NewReach> new_reach;
  std::vector<NewVisible> new_visible;
};

// Execution after what `reach` and `own` cover goes on through the class.
void chain(const History& history, const ExecutionClass& execution, const Reach& reach, StageSet own, Updates& updates) {
  const Scope& scope = history.model.scopes[execution.scope];
  if (!((reach.stages | own) & scope.src_earlier)) return;
  updates.reach |= scope.dst_later;
  if (!history.proofs || !(scope.dst_later & ~reach.settled)) return;
  Alternatives sources;
  for (uint32_t s = 0; s < kStageCount && own != 0; ++s)
    if (own & stage_bit(s)) add_meeting_sources(scope, execution.scope, s, kNoProof, sources);
  add_chained_sources(scope, execution.scope, reach, sources);
  if (execution.sole) return add_reach(scope, execution.scope, *sources.proof, reach.settled, updates.new_reach);
  std::erase_if(*sources.proof, [&](Atom atom) { return scope_of(atom) == execution.scope; });
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (scope.dst_later & ~reach.settled & stage_bit(d)) updates.new_reach.push_back({d, *sources.proof});
}

Proof availability_proof(const Scope& scope, uint32_t scope_id, const WriteRecord& write) {
  return unite(stage_atom(scope_id, AtomField::src_stage, scope.raw_src, write.stage),
               access_atom(scope_id, AtomField::src_access, scope.raw_src_accesses, write.access));
}

// The memory dependency of a scope that covers the cell. `source`: how the write comes before it.
void see(const History& history, uint32_t scope_id, const WriteRecord& write, const Alternatives& source, Updates& updates) {
  if (!source.proof) return;
  const Scope& scope = history.model.scopes[scope_id];
  updates.reach |= scope.dst_later;
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (scope.dst & stage_bit(d)) updates.visible[d] |= scope.dst_accesses & supported(d);
  if (!history.proofs) return;
  add_reach(scope, scope_id, *source.proof, write.reach.settled, updates.new_reach);
  add_visible(scope, scope_id, *source.proof, updates.new_visible);
}

// Proofs no longer share a root: there is a second beginning.
void forget_root(Reach& reach) {
  for (auto& [stage, proof] : reach.proofs) proof = unite(proof, reach.root);
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (reach.settled & stage_bit(s)) reach.proofs.emplace_back(s, reach.root);
  reach.settled = 0;
  reach.root.clear();
}
void forget_root(WriteRecord& write) {
  if (write.reach.root.empty()) return;
  std::vector<VisibleTo> proofs;
  for (uint32_t s = 0; s < kStageCount; ++s)
    for (uint32_t a = 0; a < kAccessCount; ++a)
      if (write.visible[s] & access_bit(a)) proofs.push_back({s, a, proof_of_visible(write, s, a)});
  write.proofs = std::move(proofs);
  forget_root(write.reach);
}

void commit(const History& history, const Updates& updates, WriteRecord& write) {
  write.available = write.available || updates.available;
  if (!history.proofs) {
    extend_plain(write.reach, updates.reach);
    for (uint32_t d = 0; d < kStageCount; ++d) write.visible[d] |= updates.visible[d];
    return;
  }
  for (const NewReach& next : updates.new_reach) merge(write.reach, next);
  for (const NewVisible& next : updates.new_visible) merge(write, next);
}

bool is_local(const std::vector<uint32_t>& local, uint32_t scope) { return std::find(local.begin(), local.end(), scope) != local.end(); }

// A group without effects on the record can be skipped without a look at its barriers.
bool concerns(const GroupNode& group, const Reach& reach, StageSet own) {
  return ((reach.stages | own) & group.src_earlier) && (group.dst_later & ~reach.settled) != 0;
}

// What the root already says.
void drop_root(Reach& reach) {
  for (auto& [stage, proof] : reach.proofs) subtract(proof, reach.root);
  for (const auto& [stage, proof] : reach.proofs)
    if (proof.empty()) reach.settled |= stage_bit(stage);
  std::erase_if(reach.proofs, [](const auto& entry) { return entry.second.empty(); });
}
void drop_root(WriteRecord& write) {
  drop_root(write.reach);
  for (VisibleTo& v : write.proofs) subtract(v.proof, write.reach.root);
  std::erase_if(write.proofs, [](const VisibleTo& v) { return v.proof.empty(); });
}

// At the beginning all proofs go through the one barrier: what they have in common stays in all that follow.
void grow_root(Reach& reach) {
  Alternatives common;
  for (const auto& [stage, proof] : reach.proofs) common.add(proof);
  if (common.proof) reach.root = unite(reach.root, *common.proof);
  drop_root(reach);
}
void grow_root(WriteRecord& write) {
  Alternatives common;
  for (const auto& [stage, proof] : write.reach.proofs) common.add(proof);
  for (const VisibleTo& v : write.proofs) common.add(v.proof);
  if (common.proof) write.reach.root = unite(write.reach.root, *common.proof);
  drop_root(write);
}

// Where one barrier of the group alone makes the write available for the first time, all later proofs grow from it.
bool is_rooted(const History& history, const std::vector<uint32_t>& covering, WriteRecord& write) {
  const auto makes = [&](uint32_t id) { return makes_available(history.model.scopes[id], write); };
  const auto count = std::count_if(covering.begin(), covering.end(), makes);
  if (write.available && count > 0) forget_root(write);
  if (write.available || count != 1) return false;
  const uint32_t id = *std::find_if(covering.begin(), covering.end(), makes);
  write.reach.root = unite(availability_proof(history.model.scopes[id], id, write), {atom_of(id, AtomField::whole)});
  return true;
}

void apply(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, WriteRecord& write) {
  std::vector<uint32_t> covering = group.memory;
  covering.insert(covering.end(), local.begin(), local.end());
  Updates updates;
  const bool rooted = history.proofs && is_rooted(history, covering, write);
  for (const uint32_t id : covering) {
    const Scope& scope = history.model.scopes[id];
    const bool first = makes_available(scope, write);
    Alternatives source;
    if (write.available && (write.reach.stages & scope.src_earlier)) add_chained_sources(scope, id, write.reach, source);
    if (first) source.add(rooted ? Proof{} : availability_proof(scope, id, write));
    updates.available = updates.available || first;
    see(history, id, write, source, updates);
  }
  if (write.available && concerns(group, write.reach, 0))
    for (const ExecutionClass& execution : group.classes)
      if (!execution.sole || !is_local(local, execution.scope)) chain(history, execution, write.reach, 0, updates);
  commit(history, updates, write);
  if (rooted) grow_root(write);
}

// Where one barrier of the group alone waits for the read for the first time, all later proofs grow from it.
bool is_rooted(const History& history, const GroupNode& group, ReadFate& read) {
  const StageSet own = stage_bit(read.stage);
  if (!(own & group.src_earlier)) return false;
  const auto waits = [&](const ExecutionClass& execution) { return (history.model.scopes[execution.scope].src_earlier & own) != 0; };
  if (!read.reach.root.empty()) forget_root(read.reach);
  if (read.reach.stages != 0 || std::count_if(group.classes.begin(), group.classes.end(), waits) != 1) return false;
  const ExecutionClass& only = *std::find_if(group.classes.begin(), group.classes.end(), waits);
  if (!only.sole) return false;
  Alternatives sources;
  add_meeting_sources(history.model.scopes[only.scope], only.scope, read.stage, kNoProof, sources);
  read.reach.root = unite(*sources.proof, {atom_of(only.scope, AtomField::whole)});
  return true;
}

void apply(const History& history, const GroupNode& group, ReadFate& read) {
  const StageSet own = stage_bit(read.stage);
  const bool rooted = history.proofs && is_rooted(history, group, read);
  if (!concerns(group, read.reach, own)) return;
  Updates updates;
  for (const ExecutionClass& execution : group.classes) chain(history, execution, read.reach, own, updates);
  if (!history.proofs) return extend_plain(read.reach, updates.reach);
  for (const NewReach& next : updates.new_reach) merge(read.reach, next);
  if (rooted) grow_root(read.reach);
}

void advance(const History& history, ReadFate& fate) {
  for (; fate.seen < history.groups.size(); ++fate.seen) {
    if (fate.reach.settled == kAllStages && fate.reach.root.empty()) {
      fate.seen = static_cast<uint32_t>(history.groups.size());
      return;
    }
    apply(history, history.model.groups[history.groups[fate.seen]], fate);
  }
}

}  // namespace

Proof proof_of_reach(const ReadRecord& read, uint32_t stage) { return unite(read.reach().root, relative_proof(read.reach(), stage)); }
Proof proof_of_reach(const WriteRecord& write, uint32_t stage) { return unite(write.reach.root, relative_proof(write.reach, stage)); }
Proof proof_of_visible(const WriteRecord& write, uint32_t stage, uint32_t access) {
  return unite(write.reach.root, relative_proof(write, stage, access));
}

bool in_source(const Scope& scope, uint32_t scope_id, const ReadRecord& read, Proof& proof) {
  if (!((read.reach().stages | stage_bit(read.stage)) & scope.src_earlier)) return false;
  Alternatives alternatives;
  add_chained_sources(scope, scope_id, read.reach(), alternatives);
  if (alternatives.proof) alternatives.proof = unite(*alternatives.proof, read.reach().root);
  add_meeting_sources(scope, scope_id, read.stage, kNoProof, alternatives);
  proof = std::move(*alternatives.proof);
  return true;
}

bool in_source(const Scope& scope, uint32_t scope_id, const WriteRecord& write, Proof& proof) {
  Alternatives alternatives;
  if (write.available) add_chained_sources(scope, scope_id, write.reach, alternatives);
  if (alternatives.proof) alternatives.proof = unite(*alternatives.proof, write.reach.root);
  if (makes_available(scope, write)) alternatives.add(availability_proof(scope, scope_id, write));
  if (!alternatives.proof) return false;
  proof = std::move(*alternatives.proof);
  return true;
}

namespace {
void advance(const History& history, WriteRecord& write) {
  for (; write.seen < history.groups.size(); ++write.seen) {
    const GroupNode& group = history.model.groups[history.groups[write.seen]];
    const bool chained = write.available && concerns(group, write.reach, 0);
    if (!group.memory.empty() || chained) apply(history, group, {}, write);
  }
}

}  // namespace

void advance(const History& history, CellState& state) {
  for (ReadRecord& read : state.reads) advance(history, *read.fate);
  for (WriteRecord& write : state.writes) advance(history, write);
  for (ReadRecord& read : state.without.reads) advance(history, *read.fate);
  for (WriteRecord& write : state.without.writes) advance(history, write);
}

void apply_to_writes(const History& history, const GroupNode& group, const std::vector<uint32_t>& local, CellState& state) {
  for (WriteRecord& write : state.writes) {
    apply(history, group, local, write);
    ++write.seen;
  }
}

ReadRecord make_read(History& history, uint32_t stage, uint32_t pass, uint64_t order) {
  const auto now = static_cast<uint32_t>(history.groups.size());
  std::shared_ptr<ReadFate>& newest = history.newest[stage];
  if (!newest || newest->born != now) newest = std::make_shared<ReadFate>(ReadFate{stage, now, now, {}});
  return {stage, pass, order, newest};
}

CellState frozen(const CellState& state) {
  CellState copy = state;
  for (ReadRecord& read : copy.reads) read.fate = std::make_shared<ReadFate>(*read.fate);
  return copy;
}

WriteRecord transition_record(const History& history, const Scope& scope, uint32_t scope_id) {
  WriteRecord write;
  write.scope = scope_id;
  write.available = true;
  write.pass = kNone;
  Updates updates;
  updates.reach = scope.dst_later;
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (scope.dst & stage_bit(d)) updates.visible[d] = scope.dst_accesses & supported(d);
  if (history.proofs) {
    add_reach(scope, scope_id, {}, 0, updates.new_reach);
    add_visible(scope, scope_id, {}, updates.new_visible);
  }
  commit(history, updates, write);
  if (history.proofs) {
    write.reach.root = {atom_of(scope_id, AtomField::whole)};
    grow_root(write);
  }
  return write;
}

}  // namespace rg::verify
