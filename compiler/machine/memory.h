// Memory and caches of the machine, and what one event does to them.
#pragma once

#include <vector>

#include "compiler/machine/timeline.h"

namespace rg::machine {

enum class Caches : uint8_t {
  hoard,  // write back only when an availability operation says so; refill as early as allowed and keep the line
  none,   // write through, read memory
};

// A write that is in some cache and not in memory.
struct Dirty {
  uint32_t event = 0, cell = 0;
  Version version;      // of a sharing write: what it leaves if it comes right after the version it expects
  uint64_t addend = 0;  // of a sharing write
  bool shares = false;
};

struct Mismatch {
  uint32_t event = 0, cell = 0;
  Version expected, found;
};

struct Line {
  Version version;
  uint32_t store = 0;  // which store to the cell it shows
};

struct Memory {
  // By cell.
  std::vector<Version> contents;
  std::vector<Layout> layouts;
  std::vector<uint32_t> stores;       // how often contents changed
  std::vector<uint32_t> seen_by;      // event that read the contents as they are; kNone: nobody
  std::vector<bool> shared;           // contents come from a sharing write
  std::vector<uint32_t> owners;       // queue family; kNone: whoever comes first
  std::vector<uint32_t> released_by;  // event whose acquire has not come; kNone: none

  std::vector<Line> lines;   // by agent, cell
  std::vector<Dirty> dirty;  // in the order executed
  std::vector<Mismatch> mismatches;
};

Memory initial_memory(const Subject& subject, const Timeline& timeline);
void execute(Memory& memory, const Cells& cells, const Timeline& timeline, uint32_t event, Caches caches);
// Writes of events before `end` reach memory, as they do when a semaphore or fence is signalled.
void write_back(Memory& memory, const Cells& cells, uint32_t end);

}  // namespace rg::machine
