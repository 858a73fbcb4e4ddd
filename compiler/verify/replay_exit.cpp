#include <algorithm>
#include <optional>

#include "compiler/verify/replay.h"

namespace rg::verify {
namespace {

void check_host_reads(Replay& replay, uint32_t r, uint32_t c) {
  const CellState& state = replay.cells[replay.physical(r, 0, c)];
  for (const WriteRecord& write : state.writes) {
    if (write.visible[kHost] & access_bit(kHostRead))
      replay.require(proof_of_visible(write, kHost, kHostRead));
    else
      replay.report.add(
          {Hazard::read_after_write, replay.model.resource(r).name, pass_or_empty(replay, write.pass), "",
           "the host reads " + replay.model.place(r, c) + " after " + who(replay, write) + ": no barrier makes the write visible to host host_read"});
  }
}

const Reach& reach_of(const ReadRecord& read) { return read.reach(); }
const Reach& reach_of(const WriteRecord& write) { return write.reach; }

// That one of `stages` comes after the record: what all ways to it use.
template <class Record>
void require_one_of(Replay& replay, const Record& record, StageSet stages) {
  std::optional<Proof> common;
  for (uint32_t s = 0; s < kStageCount; ++s) {
    if (!(reach_of(record).stages & stages & stage_bit(s))) continue;
    const Proof proof = proof_of_reach(record, s);
    if (!common) common = proof;
    std::erase_if(*common, [&](Atom atom) { return !std::binary_search(proof.begin(), proof.end(), atom); });
  }
  if (common) replay.require(*common);
}

void require_write(Replay& replay, const WriteRecord& write, const Pending& pending) {
  // Were it not available, it would be among the writes the state names.
  if (write.stage < kStageCount && (pending.accesses[write.stage] & access_bit(write.access))) return;
  StageSet writers = 0;
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (pending.accesses[s] & kAllWrites) writers |= stage_bit(s);
  if (writers != 0) return require_one_of(replay, write, with_earlier(writers));
  for (uint32_t s = 0; s < kStageCount; ++s) {
    if (pending.stages & stage_bit(s)) require_one_of(replay, write, with_earlier(stage_bit(s)));
    for (uint32_t a = 0; a < kAccessCount && !pending.discard; ++a)
      if (pending.accesses[s] & kAllReads & write.visible[s] & access_bit(a)) replay.require(proof_of_visible(write, s, a));
  }
}

// What the exit state promises rests on these proofs.
void require_all(Replay& replay, const CellState& state, const Pending& pending) {
  for (const ReadRecord& read : state.reads)
    if (!(with_earlier(pending.stages) & stage_bit(read.stage))) require_one_of(replay, read, with_earlier(pending.stages));
  for (const WriteRecord& write : state.writes)
    if (write.available) require_write(replay, write, pending);
  if (state.layout_scope != kNone && pending.layout != Layout::undefined) replay.require({atom_of(state.layout_scope, AtomField::whole)});
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
    if (why.empty() && !imported && exit.stages == 0 && !state.writes.empty()) why = "the exit state names nothing";
  }
  require_all(replay, state, exit);
  if (why.empty()) return;
  std::string last = "the state before the frame";
  if (!state.writes.empty()) last = who(replay, state.writes.front());
  replay.report.add({Hazard::boundary_mismatch, replay.model.resource(r).name, "", "",
                     "at the end of the frame " + replay.model.place(r, c) + " (last written by " + last +
                         (age ? ", age " + std::to_string(age) : "") + ") is not within the exit state: " + why});
}

void check_after_state(Replay& replay, uint32_t r, uint32_t c) {
  const dsl::Resource& resource = replay.model.resource(r);
  const Partition& partition = replay.model.resources[r].partition;
  if (resource.after.role == dsl::Role::undefined) return;
  const Pending wanted = pending_of(resource.after, partition.shape.image, aspect_of_cell(partition, c));
  const CellState& state = replay.cells[replay.physical(r, 0, c)];
  std::string why = resource.after.wrote ? "" : why_not_visible(state, wanted);
  for (const WriteRecord& write : state.writes)
    for (uint32_t s = 0; s < kStageCount; ++s)
      for (uint32_t a = 0; a < kAccessCount; ++a)
        if (wanted.accesses[s] & access_bit(a)) replay.require(proof_of_visible(write, s, a));
  if (state.layout_scope != kNone) replay.require({atom_of(state.layout_scope, AtomField::whole)});
  if (partition.shape.image && state.layout != wanted.layout && state.layout != Layout::undefined)
    why = "layout is " + layout_name(state.layout) + ", not " + layout_name(wanted.layout);
  if (!why.empty())
    replay.report.add(
        {Hazard::boundary_mismatch, resource.name, "", "", replay.model.place(r, c) + " is not handed back in the declared `after` state: " + why});
}

}  // namespace

std::string who(const Replay& replay, const WriteRecord& write) {
  const Model& model = replay.model;
  if (write.scope != kNone) {
    const Scope& scope = model.scopes[write.scope];
    return "the transition to " + layout_name(scope.new_layout) + " (image barrier " + std::to_string(scope.index) + ")";
  }
  const std::string by = write.pass == kNone ? "the state before the frame" : "`" + model.pass_name(write.pass) + "`";
  if (write.stage == kStageCount) return by;
  return by + " (" + stage_name(write.stage) + " " + access_name(write.access) + ")";
}
std::string who(const Replay& replay, const ReadRecord& read) {
  const std::string by = read.pass == kNone ? "the state before the frame" : "`" + replay.model.pass_name(read.pass) + "`";
  return by + " (" + stage_name(read.stage) + ")";
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
        if (lifetime == dsl::Lifetime::imported) check_after_state(replay, r, c);
      }
  }
}

}  // namespace rg::verify
