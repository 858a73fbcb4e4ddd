// What the synchronisation of a plan has to achieve, as facts about who comes after whom and who sees what, see happens_before.h.
//
// Each copy of each cell is followed through one frame, from its entry rows to its exit rows: whoever reads sees what was written before; whoever
// writes, or changes the layout, comes after those who read and write before; at the end, what is pending is within the exit rows. Rows say all that
// the next frame relies on, so facts of one frame are enough for all. What a skipped pass leaves behind stays beside what it writes. A write after
// readers that always run and saw the write before them waits for these alone. Changes of owner have to be right also where both queues are of one
// family: then the release is left out.
#pragma once

#include <map>
#include <vector>

#include "compiler/epochs.h"
#include "compiler/happens_before.h"

namespace rg::compiler {

struct Obligations {
  std::vector<SyncFact> facts;
  // Transitions that discard contents and leave the layout of all their cells as it is: what has to hold instead where there is none.
  std::map<uint32_t, std::vector<SyncFact>> without;
  std::vector<uint32_t> last_uses;  // of transients in the frame: sources
};
// Adds to the sources of `order`, which stands for `sync`. O(uses * stages * accesses of neighbouring uses).
Obligations find_obligations(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, const SyncPlan& sync,
                             HappensBefore& order);

}  // namespace rg::compiler
