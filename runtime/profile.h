// What a frame took, as files for other programs. Tools: they allocate.
#pragma once

#include <string>
#include <vector>

#include "runtime/graph.h"

namespace rg {

// frame.profile.json, measured costs for the planner (docs/planner.md): { "schema": "rgc-profile-1", "graph": ..., "passes_us": { pass: microseconds
// } }. Of the last finished frame; on drivers whose timestamps do not separate passes, of an instance with GraphOptions::submit_per_pass.
std::string profile_json(GraphInstance& graph);

// A trace in the format of chrome://tracing and Perfetto: a track a queue of the plan, a slice a pass with its module and, where they were asked for,
// its pipeline statistics. Frames lie one after the other.
class ChromeTrace {
 public:
  // The last finished frame of `graph`; call it after every frame that is to be seen (it waits for it).
  void add(GraphInstance& graph);
  std::string json() const;  // of all that was added, for a file

 private:
  struct Slice {
    std::string name, module;
    Index queue = 0;
    double begin_us = 0, duration_us = 0;
    PassStatistics statistics;
  };
  std::vector<Slice> slices_;
  std::vector<std::string> queues_;      // names of the tracks
  std::vector<double> frames_us_ = {0};  // where frames begin, and the end
};

}  // namespace rg
