// The life of each cell as a row of epochs: uses that need no barrier between them.
//
//   pass       A        B         C         D          E
//   cell       write    sampled   sampled   storage    storage, sharing with D
//   epoch      [ A ]    [ B         C ]     [ D          E ]
//
// Passes of one rendering use their attachments as one pass would.
//
// A line is a cell across all ages of its resource, in the order time passes for one copy: this frame's epochs, then those of the copy when it is one
// frame old, and so on; after the last age it is this frame's again. Other lifetimes have one age. Consecutive reads in one layout form one epoch
// even across a frame boundary, so the barrier before the first of them covers them all.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/frame.h"
#include "compiler/make_schedule.h"

namespace rg::compiler {

struct Event {  // a use as barriers see it
  uint32_t segment = 0;
  Stages stages = 0;
  uint32_t pass = 0;
  Stages read_stages = 0;
  Accesses reads = 0;
  bool earlier_frame = false;  // as seen from a barrier
  uint32_t queue = 0;
  Effect effect = {};
};

struct Epoch {
  uint32_t age = 0;
  uint32_t first_segment = 0, last_segment = 0;
  Effect effect;       // of all its uses
  Effect covered;      // what a barrier into it must make ready: also reads that continue it after a frame boundary
  bool needs = false;  // some use depends on earlier contents
  bool writes = false;
  Share share = Share::none;
  std::vector<Event> events;
  uint32_t queue = 0;  // of all its events; kSeveralQueues if they differ
};
inline constexpr uint32_t kSeveralQueues = UINT32_MAX;

struct Line {
  uint32_t cell = 0;  // at age 0
  std::vector<Epoch> epochs;
};

// Lines with at least one use, by cell. O(uses).
std::vector<Line> find_epochs(const Frame& frame, const Schedule& schedule);

// Merges `other` into `effect`; layouts must agree.
void merge(Effect& effect, const Effect& other);

// True if the reads of `later` may follow those of `earlier` without a barrier, once a barrier has covered both: reads of one layout on one queue.
bool continues(const Epoch& earlier, const Epoch& later);

}  // namespace rg::compiler
