#include "compiler/verify/release_track.h"

#include <algorithm>

#include "compiler/verify/alias.h"
#include "compiler/verify/replay.h"

namespace rg::verify {
namespace {

const Plan& plan_of(const Replay& replay) { return replay.model.input->plan; }

void report_alias(Replay& replay, uint32_t plan_resource, const std::string& text) {
  const std::string name(plan_of(replay).resources[plan_resource].name);
  replay.report.add({Hazard::alias_race, name, "", "", "memory of `" + name + "`: " + text});
}

// ---- what a release waits for -----------------------------------------------------------------------------------

bool waits_for(const Release& release, const ReadRecord& read) {
  const StageSet stages = with_earlier(expand_stages(release.stages));
  const StageSet own = read.queue == release.queue ? stage_bit(read.stage) : 0;
  return ((read.reach().stages(release.queue) | own) & stages) != 0;
}

bool waits_for(const Release& release, const WriteRecord& write) {
  const StageSet stages = expand_stages(release.stages);
  const bool named = write.stage < kStageCount && write.queue == release.queue && (stages & stage_bit(write.stage)) &&
                     (expand_accesses(release.accesses) & access_bit(write.access));
  return named || (write.available && (write.reach.stages(release.queue) & with_earlier(stages)) != 0);
}

void visit_cells(Replay& replay, uint32_t plan_resource, auto visit) {
  const uint32_t r = replay.model.input->program_resource[plan_resource];
  for (uint32_t c = 0; c < replay.model.resources[r].partition.cell_count(); ++c) {
    CellState& state = replay.cells[replay.physical(r, 0, c)];
    advance(replay.history, state);
    visit(state);
  }
}

// Bits that wait for the record by themselves. Another may do so as well: a hand-off joins the states of all last users, and is tagged for it.
void use_bits(const Release& release, const auto& record, Release& used) {
  const auto waits = [&](Stages stages, Accesses accesses) {
    Release only = release;
    only.stages = stages, only.accesses = accesses;
    return waits_for(only, record);
  };
  for (Stages rest = release.stages; rest != 0; rest &= rest - 1)
    if (waits(rest & ~(rest - 1), release.accesses)) used.stages |= rest & ~(rest - 1);
  for (Accesses rest = release.accesses; rest != 0; rest &= rest - 1)
    if (waits(release.stages, rest & ~(rest - 1)) && !waits(release.stages, 0)) used.accesses |= rest & ~(rest - 1);
}

void mark_released(Replay& replay, ReleaseTrack& track, uint32_t index) {
  const Release& release = plan_of(replay).releases[index];
  const auto mark = [&](auto& record) {
    if (!waits_for(release, record)) return;
    record.released = true;
    if (replay.history.proofs) use_bits(release, record, track.used[index]);
  };
  visit_cells(replay, release.resource, [&](CellState& state) {
    for (ReadRecord& read : state.reads) mark(read);
    for (WriteRecord& write : state.writes) mark(write);
  });
}

// ---- following a release ----------------------------------------------------------------------------------------

FollowedRelease follow(Replay& replay, uint32_t index) {
  const Release& release = plan_of(replay).releases[index];
  FollowedRelease followed{index, {}, {}};
  const StageSet stages = expand_stages(release.stages);
  const AccessSet writes = expand_accesses(release.accesses) & kAllWrites;
  for (uint32_t s = 0; s < kStageCount; ++s) {
    if (!(stages & stage_bit(s))) continue;
    followed.stages.push_back(make_read(replay.history, site_of(release.queue, s), kNone, replay.frame, 0));
    for (uint32_t a = 0; a < kAccessCount; ++a) {
      if (!(writes & supported(s) & access_bit(a))) continue;
      WriteRecord write(release.queue);
      write.stage = s, write.access = a, write.pass = kNone, write.seen = replay.now();
      followed.writes.push_back(std::move(write));
    }
  }
  return followed;
}

// Commands of `queue` in what comes after `sources` come after the release.
bool is_over(const Replay& replay, FollowedRelease& followed, uint32_t queue, StageSet sources) {
  for (ReadRecord& read : followed.stages) {
    advance(replay.history, *read.fate);
    if (!(read.reach().stages(queue) & sources)) return false;
  }
  for (WriteRecord& write : followed.writes) {
    advance(replay.history, write);
    if (!write.available || !(write.reach.stages(queue) & sources)) return false;
  }
  return true;
}

// The point of the first release of `from` that is not over, kNone if all are. Only grows.
uint32_t first_not_over(Replay& replay, ReleaseTrack& track, bool before, uint32_t from, uint32_t queue, StageSet sources) {
  FollowedQueue& releases = (before ? track.before : track.now)[from];
  size_t& next = track.over[{before, from, queue, sources}];
  while (next < releases.size() && is_over(replay, releases[next], queue, sources)) ++next;
  return next == releases.size() ? kNone : plan_of(replay).releases[releases[next].release].point;
}

// Memory may change hands because the release is over: what that rests on is needed.
void rely_on(Replay& replay, const FollowedRelease& followed, uint32_t queue, StageSet sources) {
  const auto require = [&](const Reach& reach) {
    Alternatives ways;
    for (uint32_t s = 0; s < kStageCount; ++s)
      if (reach.stages(queue) & sources & stage_bit(s)) ways.add(proof_of_reach(reach, site_of(queue, s)));
    if (ways.proof) replay.require(*ways.proof);
  };
  for (const ReadRecord& read : followed.stages) require(read.reach());
  for (const WriteRecord& write : followed.writes) require(write.reach);
}
void rely_on_all(Replay& replay, ReleaseTrack& track, bool before, uint32_t from, uint32_t queue, StageSet sources, Index clock) {
  if (!replay.history.proofs || clock == kNone) return;
  const FollowedQueue& releases = (before ? track.before : track.now)[from];
  size_t& next = track.relied[{before, from, queue, sources}];
  for (; next < releases.size() && plan_of(replay).releases[releases[next].release].point <= clock; ++next)
    rely_on(replay, releases[next], queue, sources);
}

// Releases of this frame that are not reached in listed order are not over.
uint32_t first_to_come(const ReleaseTrack& track, uint32_t queue) {
  for (uint32_t p = track.points[queue]; p < track.at_point[queue].size(); ++p)
    if (!track.at_point[queue][p].empty()) return p;
  return kNone;
}

// ---- clocks -----------------------------------------------------------------------------------------------------

bool claims(Index clock, uint32_t point) { return clock != kNone && point != kNone && clock >= point; }

void report_clock(Replay& replay, const Acquire& acquire, uint32_t queue, uint32_t point, bool before) {
  report_alias(replay, acquire.resource,
               "its clock counts point " + std::to_string(point) + " of " + replay.model.queue_name(queue) + (before ? " in the frame before" : "") +
                   " as over, but no wait of " + replay.model.queue_name(acquire.queue) + " leads from there to its acquire");
}

void check_clock(Replay& replay, ReleaseTrack& track, const Acquire& acquire) {
  const Plan& plan = plan_of(replay);
  const Index* clocks = &plan.alias_clocks[acquire.first_clock];
  // The hand-off's first scope, where users on other queues are concerned: the waits must lead there.
  const StageSet sources = with_earlier(expand_stages(acquire.stages));
  for (uint32_t q = 0; q < replay.model.queue_count; ++q) {
    const Index own = clocks[q], previous = clocks[replay.model.queue_count + q];
    if (q == acquire.queue) {
      if (claims(own, acquire.point + 1)) report_clock(replay, acquire, q, own, false);
      continue;
    }
    const uint32_t open = std::min(first_not_over(replay, track, false, q, acquire.queue, sources), first_to_come(track, q));
    if (claims(own, open)) report_clock(replay, acquire, q, open, false);
    rely_on_all(replay, track, false, q, acquire.queue, sources, own);
    if (replay.frame == 0) continue;
    const uint32_t left = first_not_over(replay, track, true, q, acquire.queue, sources);
    if (claims(previous, left)) report_clock(replay, acquire, q, left, true);
    rely_on_all(replay, track, true, q, acquire.queue, sources, previous);
  }
}

}  // namespace

ReleaseTrack make_release_track(const Model& model) {
  const Plan& plan = model.input->plan;
  ReleaseTrack track;
  track.active = std::any_of(plan.acquires.begin(), plan.acquires.end(), [](const Acquire& acquire) { return acquire.first_clock != kNone; });
  if (!track.active) return track;
  track.at_point.resize(model.queue_count);
  for (uint32_t i = 0; i < plan.releases.size(); ++i) {
    auto& points = track.at_point[plan.releases[i].queue];
    if (points.size() <= plan.releases[i].point) points.resize(plan.releases[i].point + 1);
    points[plan.releases[i].point].push_back(i);
  }
  track.acquires_of_group.resize(plan.groups.size());
  for (uint32_t i = 0; i < plan.acquires.size(); ++i)
    if (plan.acquires[i].group != kNone && plan.acquires[i].first_clock != kNone) track.acquires_of_group[plan.acquires[i].group].push_back(i);
  track.now.resize(model.queue_count);
  track.gives = may_share(plan);
  track.used.resize(plan.releases.size());
  return track;
}

void begin_frame(Replay& replay, ReleaseTrack& track) {
  if (!track.active) return;
  track.before = std::move(track.now);
  track.now.assign(replay.model.queue_count, {});
  track.points.assign(replay.model.queue_count, 0);
  track.over.clear(), track.relied.clear();
}

void pass_point(Replay& replay, ReleaseTrack& track, const GroupNode& group) {
  if (!track.active || group.kind == GroupKind::waits || group.kind == GroupKind::set || group.kind == GroupKind::awaited) return;
  const uint32_t point = track.points[group.queue];
  if (point < track.at_point[group.queue].size())
    for (const uint32_t index : track.at_point[group.queue][point]) {
      mark_released(replay, track, index);
      if (replay.model.queue_count > 1) track.now[group.queue].push_back(follow(replay, index));
    }
  ++track.points[group.queue];
  if (group.plan_group == kNone) return;
  for (const uint32_t index : track.acquires_of_group[group.plan_group]) {
    const Acquire& acquire = plan_of(replay).acquires[index];
    if (acquire.queue != group.queue || acquire.point != point)
      report_alias(replay, acquire.resource, "its acquire names another queue or point than its group has");
    if (acquire.queue == group.queue) check_clock(replay, track, acquire);
  }
}

void end_frame(Replay& replay, const ReleaseTrack& track) {
  if (!track.active) return;
  for (uint32_t p = 0; p < plan_of(replay).resources.size(); ++p) {
    if (!track.gives[p] || replay.result.first_use[replay.model.input->program_resource[p]] == kNone) continue;
    visit_cells(replay, p, [&](const CellState& state) {
      for (const ReadRecord& read : state.reads)
        if (!read.released) report_alias(replay, p, "no release waits for the read by " + who(replay, read));
      for (const WriteRecord& write : state.writes)
        if (!write.released) report_alias(replay, p, "no release waits for the write by " + who(replay, write) + " and makes it available");
    });
  }
}

void check_release_redundancy(const Model& model, const std::vector<Release>& used, Report& report) {
  for (size_t i = 0; i < used.size(); ++i) {
    const Release& release = model.input->plan.releases[i];
    const std::string name(model.input->plan.resources[release.resource].name);
    const StageSet stages = expand_stages(release.stages & ~used[i].stages);
    if (stages) report.add({Hazard::redundant, name, "", "", "release of `" + name + "`: " + stages_text(stages) + " can be removed"});
    if (release.accesses & ~used[i].accesses)
      report.add({Hazard::redundant, name, "", "", "release of `" + name + "`: accesses can be removed that are no writes of its last users"});
  }
}

}  // namespace rg::verify
