// Releases and clocks of shared memory, checked while the commands are replayed.
//
// A release must wait for everything its resource leaves behind. A clock of an acquire claims that all releases of a queue up to a point are over;
// every release is followed like an access of its own, and because clocks and what is over only grow, one index into the releases of a queue, sorted
// by point, answers each acquire: linear in releases and acquires.
//
//   queue 0   ..R1..|p3 ..R2..|p4 signal──┐                    R1, R2: releases at points 3 and 4
//   queue 1                        wait ──┴─|group of A|       clock of A: {queue 0: 4}
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "compiler/verify/sync_state.h"

namespace rg::verify {

struct Replay;

// One release in one frame, as accesses that later commands may or may not come after.
struct FollowedRelease {
  uint32_t release = 0;  // in the plan
  std::vector<ReadRecord> stages;
  std::vector<WriteRecord> writes;
};
// Of one queue and one frame, in the order of points.
using FollowedQueue = std::vector<FollowedRelease>;

struct ReleaseTrack {
  bool active = false;                                                      // some resource may take over memory
  std::vector<std::vector<std::vector<uint32_t>>> at_point;                 // releases by queue and point
  std::vector<std::vector<uint32_t>> acquires_of_group;                     // by plan group
  std::vector<uint32_t> points;                                             // by queue: how many of this frame have passed
  std::vector<FollowedQueue> now, before;                                   // by queue: of this frame and of the one before
  std::map<std::tuple<bool, uint32_t, uint32_t, StageSet>, size_t> over;    // (before, of queue, at queue, first scope): so many are over
  std::map<std::tuple<bool, uint32_t, uint32_t, StageSet>, size_t> relied;  // the same: of so many a clock says that they are over
  std::vector<Release> used;                                                // by release: bits that wait for something
  std::vector<bool> gives;                                                  // by plan resource: its memory may be given away
};
ReleaseTrack make_release_track(const Model& model);

void begin_frame(Replay& replay, ReleaseTrack& track);
// A barrier group or the end of a batch: `group` is about to be executed.
void pass_point(Replay& replay, ReleaseTrack& track, const GroupNode& group);
// All records of memory that may be given away have met a release that waits for them.
void end_frame(Replay& replay, const ReleaseTrack& track);

// Bits of releases that wait for nothing. `used` as ReleaseTrack kept it.
void check_release_redundancy(const Model& model, const std::vector<Release>& used, Report& report);

}  // namespace rg::verify
