#include "compiler/verify/sync_update.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace rg::verify {
namespace {

const Proof kNoProof;

const Proof& relative_proof(const Reach& reach, Site site) {
  for (const auto& [s, proof] : reach.proofs)
    if (s == site) return proof;
  return kNoProof;
}
const Proof& relative_proof(const WriteRecord& write, Site site, uint32_t access) {
  for (const VisibleTo& v : write.proofs)
    if (v.site == site && v.access == access) return v.proof;
  return kNoProof;
}

void merge(Reach& reach, uint32_t queue, const NewReach& next) {
  const StageSet bit = stage_bit(next.stage);
  QueueReach& on = reach.queues.at(queue);
  if (on.settled & bit) return;
  const Site site = site_of(queue, next.stage);
  auto at = std::find_if(reach.proofs.begin(), reach.proofs.end(), [&](const auto& entry) { return entry.first == site; });
  if (!(on.stages & bit))
    at = reach.proofs.insert(reach.proofs.end(), {site, next.proof});
  else
    intersect(at->second, next.proof);
  on.stages |= bit;
  if (!at->second.empty()) return;
  reach.proofs.erase(at);
  on.settled |= bit;
}

void merge(WriteRecord& write, uint32_t queue, const NewVisible& next) {
  const AccessSet bit = access_bit(next.access);
  const Site site = site_of(queue, next.stage);
  AccessSet& visible = write.visible.at(queue).to[next.stage];
  if (!(visible & bit)) {
    visible |= bit;
    if (!next.proof.empty()) write.proofs.push_back({site, next.access, next.proof});
    return;
  }
  const auto at =
      std::find_if(write.proofs.begin(), write.proofs.end(), [&](const VisibleTo& v) { return v.site == site && v.access == next.access; });
  if (at == write.proofs.end()) return;
  intersect(at->proof, next.proof);
  if (at->proof.empty()) write.proofs.erase(at);
}

uint32_t queue_of(Site site) { return site / kStageCount; }

// What the root already says.
void drop_root(Reach& reach, uint32_t queue) {
  QueueReach& on = reach.queues.at(queue);
  std::erase_if(reach.proofs, [&](auto& entry) {
    auto& [site, proof] = entry;
    if (queue_of(site) != queue) return false;
    subtract(proof, on.root);
    if (proof.empty()) on.settled |= stage_bit(site % kStageCount);
    return proof.empty();
  });
}
void drop_root(WriteRecord& write, uint32_t queue) {
  drop_root(write.reach, queue);
  std::erase_if(write.proofs, [&](VisibleTo& v) {
    if (queue_of(v.site) != queue) return false;
    subtract(v.proof, write.reach.root(queue));
    return v.proof.empty();
  });
}

// Something is settled on the queue, so that its proofs have nothing in common beyond the root.
bool is_settled_in_part(const WriteRecord& write, uint32_t queue) {
  size_t open = 0, all = 0;
  for (const VisibleTo& v : write.proofs) open += queue_of(v.site) == queue;
  for (uint32_t s = 0; s < kStageCount; ++s) all += static_cast<size_t>(std::popcount(write.visible_to(queue, s)));
  return open != all;
}

void add_proofs(const Reach& reach, uint32_t queue, Alternatives& common) {
  for (const auto& [site, proof] : reach.proofs)
    if (queue_of(site) == queue) common.add(proof);
}

void extend_root(Reach& reach, uint32_t queue, const Alternatives& common) {
  if (common.proof && !common.proof->empty()) set_root(reach, queue, unite(reach.root(queue), *common.proof));
}

}  // namespace

Proof proof_of_reach(const Reach& reach, Site site) { return unite(reach.root(queue_of(site)), relative_proof(reach, site)); }
Proof proof_of_visible(const WriteRecord& write, Site site, uint32_t access) {
  return unite(write.reach.root(queue_of(site)), relative_proof(write, site, access));
}

Proof stage_atom(uint32_t scope, AtomField field, Stages raw, uint32_t stage) {
  const uint32_t bit = raw_bit_of_stage(raw, stage);
  return bit == kNone ? Proof{} : Proof{atom_of(scope, field, bit)};
}
Proof access_atom(uint32_t scope, AtomField field, Accesses raw, uint32_t access) {
  const uint32_t bit = raw_bit_of_access(raw, access);
  return bit == kNone ? Proof{} : Proof{atom_of(scope, field, bit)};
}

void add_meeting_sources(const Scope& scope, uint32_t scope_id, uint32_t stage, const Proof& premise, Alternatives& result) {
  for (uint32_t s = 0; s < kStageCount; ++s)
    if ((scope.src & stage_bit(s)) && (with_earlier(stage_bit(s)) & stage_bit(stage)))
      result.add(unite(premise, stage_atom(scope_id, AtomField::src_stage, scope.raw_src, s)));
}

void add_chained_sources(const Scope& scope, uint32_t scope_id, const Reach& reach, Alternatives& result) {
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (reach.stages(scope.queue) & scope.src_earlier & stage_bit(d))
      add_meeting_sources(scope, scope_id, d, relative_proof(reach, site_of(scope.queue, d)), result);
}

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
  return write.stage < kStageCount && write.queue == scope.queue && (scope.src & stage_bit(write.stage)) &&
         (scope.src_accesses & access_bit(write.access));
}

Proof availability_proof(const Scope& scope, uint32_t scope_id, const WriteRecord& write) {
  return unite(stage_atom(scope_id, AtomField::src_stage, scope.raw_src, write.stage),
               access_atom(scope_id, AtomField::src_access, scope.raw_src_accesses, write.access));
}

void see(const History& history, uint32_t scope_id, const WriteRecord& write, const Alternatives& source, Updates& updates) {
  if (!source.proof) return;
  const Scope& scope = history.model.scopes[scope_id];
  updates.reach |= scope.dst_later;
  for (uint32_t d = 0; d < kStageCount; ++d)
    if (scope.dst & stage_bit(d)) updates.visible.to[d] |= scope.dst_accesses & supported(d);
  if (!history.proofs) return;
  add_reach(scope, scope_id, *source.proof, write.reach.queues.get(scope.queue).settled, updates.new_reach);
  add_visible(scope, scope_id, *source.proof, updates.new_visible);
}

void commit(const History& history, const Updates& updates, Reach& reach) {
  if (!history.proofs) {
    if (updates.reach == 0) return;
    QueueReach& on = reach.queues.at(updates.queue);
    on.settled = on.stages |= updates.reach;
    return;
  }
  for (const NewReach& next : updates.new_reach) merge(reach, updates.queue, next);
}

void commit(const History& history, const Updates& updates, WriteRecord& write) {
  write.available = write.available || updates.available;
  commit(history, updates, write.reach);
  if (!history.proofs && updates.reach != 0)
    for (uint32_t d = 0; d < kStageCount; ++d) write.visible.at(updates.queue).to[d] |= updates.visible.to[d];
  for (const NewVisible& next : updates.new_visible) merge(write, updates.queue, next);
}

void set_root(Reach& reach, uint32_t queue, Proof root) {
  reach.queues.at(queue).root = std::move(root);
  reach.quiet = 0;
}

void forget_root(Reach& reach, uint32_t queue) {
  QueueReach& on = reach.queues.at(queue);
  if (on.root.empty()) return;
  for (auto& [site, proof] : reach.proofs)
    if (queue_of(site) == queue) proof = unite(proof, on.root);
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (on.settled & stage_bit(s)) reach.proofs.emplace_back(site_of(queue, s), on.root);
  on.settled = 0;
  set_root(reach, queue, {});
}

void forget_root(WriteRecord& write, uint32_t queue) {
  if (write.reach.root(queue).empty()) return;
  std::vector<VisibleTo> proofs;
  for (uint32_t s = 0; s < kStageCount; ++s)
    for (uint32_t a = 0; a < kAccessCount; ++a)
      if (write.visible_to(queue, s) & access_bit(a)) proofs.push_back({site_of(queue, s), a, proof_of_visible(write, site_of(queue, s), a)});
  std::erase_if(write.proofs, [&](const VisibleTo& v) { return queue_of(v.site) == queue; });
  write.proofs.insert(write.proofs.end(), std::make_move_iterator(proofs.begin()), std::make_move_iterator(proofs.end()));
  forget_root(write.reach, queue);
}

void grow_root(Reach& reach, uint32_t queue) {
  if (reach.queues.get(queue).settled != 0) return;
  Alternatives common;
  add_proofs(reach, queue, common);
  extend_root(reach, queue, common);
  drop_root(reach, queue);
}

void grow_root(WriteRecord& write, uint32_t queue) {
  if (write.reach.queues.get(queue).settled != 0 || is_settled_in_part(write, queue)) return;
  Alternatives common;
  add_proofs(write.reach, queue, common);
  for (const VisibleTo& v : write.proofs)
    if (queue_of(v.site) == queue) common.add(v.proof);
  extend_root(write.reach, queue, common);
  drop_root(write, queue);
}

}  // namespace rg::verify
