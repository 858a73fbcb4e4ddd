#include <algorithm>

#include "compiler/verify/replay.h"

namespace rg::verify {
namespace {

void check_host_reads(Replay& replay, uint32_t r, uint32_t c) {
  const CellState& state = replay.cells[replay.physical(r, 0, c)];
  for (const WriteRecord& write : state.writes) {
    bool seen = false;  // the host waits for all queues
    write.visible.each([&](uint32_t queue, const Visible& visible) {
      if (seen || !(visible.to[kHost] & access_bit(kHostRead))) return;
      seen = true;
      replay.require(proof_of_visible(write, site_of(queue, kHost), kHostRead));
    });
    if (!seen)
      replay.report.add(
          {Hazard::read_after_write, replay.model.resource(r).name, pass_or_empty(replay, write.pass), "",
           "the host reads " + replay.model.place(r, c) + " after " + who(replay, write) + ": no barrier makes the write visible to host host_read"});
  }
}

// That one of `stages` of `queue` comes after: what all ways to it use.
void add_ways(const Reach& reach, uint32_t queue, StageSet stages, Alternatives& ways) {
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (reach.stages(queue) & stages & stage_bit(s)) ways.add(proof_of_reach(reach, site_of(queue, s)));
}
void require_one_of(Replay& replay, const Alternatives& ways) {
  if (ways.proof) replay.require(*ways.proof);
}

void require_read(Replay& replay, const ReadRecord& read, const Pending& pending) {
  Alternatives ways;
  bool named = false;
  pending.on.each([&](uint32_t queue, const PendingOn& on) {
    named = named || (read.queue == queue && (with_earlier(on.stages) & stage_bit(read.stage)));
    add_ways(read.reach(), queue, with_earlier(on.stages), ways);
  });
  if (!named) require_one_of(replay, ways);
}

void require_write(Replay& replay, const WriteRecord& write, const Pending& pending) {
  // Were it not available, it would be among the writes the state names.
  if (write.stage < kStageCount && (pending.on.get(write.queue).accesses[write.stage] & access_bit(write.access))) return;
  if (pending.has_writes()) {
    Alternatives ways;
    pending.on.each([&](uint32_t queue, const PendingOn& on) {
      StageSet writers = 0;
      for (uint32_t s = 0; s < kStageCount; ++s)
        if (on.accesses[s] & kAllWrites) writers |= stage_bit(s);
      add_ways(write.reach, queue, with_earlier(writers), ways);
    });
    return require_one_of(replay, ways);
  }
  pending.on.each([&](uint32_t queue, const PendingOn& on) {
    for (uint32_t s = 0; s < kStageCount; ++s) {
      Alternatives ways;
      if (on.stages & stage_bit(s)) add_ways(write.reach, queue, with_earlier(stage_bit(s)), ways);
      require_one_of(replay, ways);
      for (uint32_t a = 0; a < kAccessCount && !pending.discard; ++a)
        if (on.accesses[s] & kAllReads & write.visible_to(queue, s) & access_bit(a)) replay.require(proof_of_visible(write, site_of(queue, s), a));
    }
  });
}

// What the exit state promises rests on these proofs.
void require_all(Replay& replay, const CellState& state, const Pending& pending) {
  for (const ReadRecord& read : state.reads) require_read(replay, read, pending);
  for (const WriteRecord& write : state.writes)
    if (write.available) require_write(replay, write, pending);
  if (state.layout_scope != kNone && pending.layout != Layout::undefined) replay.require({atom_of(state.layout_scope, AtomField::whole)});
  for (const uint32_t scope : state.owner_scopes)
    if (!pending.discard) replay.require({atom_of(scope, AtomField::whole)});
}

std::string why_not_owned(const Replay& replay, uint32_t r, const CellState& state, const Pending& exit) {
  if (!replay.model.is_exclusive(r) || exit.discard) return "";
  if (state.released_by != kNone) return "its release is not followed by an acquire";
  if (state.owner == kNone || exit.owner == kNone || replay.model.family[state.owner] == replay.model.family[exit.owner]) return "";
  return replay.model.queue_name(state.owner) + " owns it, not " + replay.model.queue_name(exit.owner);
}

void check_exit_cell(Replay& replay, uint32_t r, uint32_t age, uint32_t c, const Pending& exit) {
  const CellState& state = replay.cells[replay.physical(r, age, c)];
  const bool imported = replay.model.resource(r).lifetime == dsl::Lifetime::imported;
  std::string why;
  if (!exit.stated) {
    if (state.reads.empty() && state.writes.empty()) return;
    why = "no exit state is given";
  } else {
    why = why_not_covered(state, exit);
    if (why.empty() && !imported && exit.is_free() && !state.writes.empty()) why = "the exit state names nothing";
    if (why.empty()) why = why_not_owned(replay, r, state, exit);
  }
  require_all(replay, state, exit);
  if (why.empty()) return;
  std::string last = "the state before the frame";
  if (!state.writes.empty()) last = who(replay, state.writes.front());
  replay.report.add({Hazard::boundary_mismatch, replay.model.resource(r).name, "", "",
                     "at the end of the frame " + replay.model.place(r, c) + " (last written by " + last +
                         (age ? ", age " + std::to_string(age) : "") + ") is not within the exit state: " + why});
}

void check_after_state(Replay& replay, uint32_t r, uint32_t c, const Pending& exit) {
  const dsl::Resource& resource = replay.model.resource(r);
  const Partition& partition = replay.model.resources[r].partition;
  if (resource.after.role == dsl::Role::undefined) return;
  const uint32_t queue = exit.owner == kNone ? 0 : exit.owner;
  const Pending wanted = pending_of(resource.after, partition.shape.image, aspect_of_cell(partition, c), queue);
  const CellState& state = replay.cells[replay.physical(r, 0, c)];
  std::string why = resource.after.wrote ? "" : why_not_visible(state, wanted);
  for (const WriteRecord& write : state.writes)
    for (uint32_t s = 0; s < kStageCount; ++s)
      for (uint32_t a = 0; a < kAccessCount; ++a)
        if (wanted.on.get(queue).accesses[s] & access_bit(a)) replay.require(proof_of_visible(write, site_of(queue, s), a));
  if (state.layout_scope != kNone) replay.require({atom_of(state.layout_scope, AtomField::whole)});
  if (partition.shape.image && state.layout != wanted.layout && state.layout != Layout::undefined)
    why = "layout is " + layout_name(state.layout) + ", not " + layout_name(wanted.layout);
  if (!why.empty())
    replay.report.add(
        {Hazard::boundary_mismatch, resource.name, "", "", replay.model.place(r, c) + " is not handed back in the declared `after` state: " + why});
}

std::string on_queue(const Model& model, uint32_t queue) { return model.queue_count > 1 ? ", " + model.queue_name(queue) : ""; }

}  // namespace

std::string who(const Replay& replay, const WriteRecord& write) {
  const Model& model = replay.model;
  if (write.scope != kNone) {
    const Scope& scope = model.scopes[write.scope];
    if (scope.transfer == Ownership::release) return "the release to " + model.queue_name(scope.other);
    if (scope.transfer == Ownership::acquire) return "the acquire from " + model.queue_name(scope.other);
    return "the transition to " + layout_name(scope.new_layout) + " (image barrier " + std::to_string(scope.index) + ")";
  }
  const std::string by = write.pass == kNone ? "the state before the frame" : "`" + model.pass_name(write.pass) + "`";
  if (write.stage == kStageCount) return by;
  return by + " (" + stage_name(write.stage) + " " + access_name(write.access) + on_queue(model, write.queue) + ")";
}
std::string who(const Replay& replay, const ReadRecord& read) {
  const std::string by = read.pass == kNone ? "the state before the frame" : "`" + replay.model.pass_name(read.pass) + "`";
  return by + " (" + stage_name(read.stage) + on_queue(replay.model, read.queue) + ")";
}
std::string pass_or_empty(const Replay& replay, uint32_t pass) { return pass == kNone ? "" : replay.model.pass_name(pass); }

void leave(Replay& replay, const std::vector<Pending>& exit) {
  for (uint32_t r = 0; r < replay.model.resources.size(); ++r) {
    const ResourceNode& node = replay.model.resources[r];
    const dsl::Lifetime lifetime = replay.model.resource(r).lifetime;
    if (node.plan == kNone || replay.result.first_use[r] == kNone) continue;
    for (uint32_t age = 0; age < node.copies; ++age)
      for (uint32_t c = 0; c < node.partition.cell_count(); ++c) {
        advance(replay.history, replay.cells[replay.physical(r, age, c)]);
        if (lifetime == dsl::Lifetime::readback)
          check_host_reads(replay, r, c);
        else
          check_exit_cell(replay, r, age, c, exit[replay.at_frame_zero(r, age, c)]);
        if (lifetime == dsl::Lifetime::imported) check_after_state(replay, r, c, exit[replay.at_frame_zero(r, age, c)]);
      }
  }
}

}  // namespace rg::verify
