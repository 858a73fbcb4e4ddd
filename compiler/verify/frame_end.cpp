#include "compiler/verify/frame_end.h"

#include <algorithm>

namespace rg::verify {
namespace {

class Fingerprint {
 public:
  void add(uint64_t value) {
    hash_ = (hash_ ^ value) * 0x9E3779B97F4A7C15u;
    hash_ ^= hash_ >> 29;
  }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 0x2545F4914F6CDD1Du;
};

void add_reach(const Replay& replay, const Reach& reach, Fingerprint& print) {
  for (uint32_t q = 0; q < replay.model.queue_count; ++q) {
    print.add(reach.stages(q));
    const int64_t end = static_cast<int64_t>(replay.frame + 1) * replay.model.signals_on[q];
    int64_t first = INT64_MAX;
    for (const SignalReach& signal : reach.signals)
      if (signal.queue == q) first = std::min(first, signal.number);
    // The next frame waits for this one's first signal at the earliest.
    const int64_t oldest = end - replay.model.signals_on[q] + 1;
    print.add(first == INT64_MAX ? UINT64_MAX : static_cast<uint64_t>(std::max(first, oldest) - end + replay.model.signals_on[q]));
  }
}

uint64_t print_of(const Replay& replay, const ReadRecord& read) {
  Fingerprint print;
  print.add(site_of(read.queue, read.stage));
  add_reach(replay, read.reach(), print);
  return print.value();
}

uint64_t print_of(const Replay& replay, const WriteRecord& write) {
  Fingerprint print;
  print.add(site_of(write.queue, write.stage));
  print.add(write.access * 4u + (write.available ? 2u : 0u) + (write.read_since ? 1u : 0u));
  add_reach(replay, write.reach, print);
  for (uint32_t q = 0; q < replay.model.queue_count; ++q)
    for (uint32_t s = 0; s < kStageCount; ++s) print.add(write.visible_to(q, s));
  return print.value();
}

// Records are a set: commuting writers of older frames stay beside those of newer ones.
template <class Record>
void add_set(const Replay& replay, const std::vector<Record>& records, Fingerprint& print) {
  std::vector<uint64_t> prints;
  for (const Record& record : records) prints.push_back(print_of(replay, record));
  std::sort(prints.begin(), prints.end());
  prints.erase(std::unique(prints.begin(), prints.end()), prints.end());
  print.add(prints.size());
  for (const uint64_t value : prints) print.add(value);
}

uint64_t print_of(const Replay& replay, const CellState& state, bool exclusive) {
  Fingerprint print;
  add_set(replay, state.reads, print);
  add_set(replay, state.writes, print);
  for (const uint64_t value : {uint64_t{static_cast<uint32_t>(state.layout)}, uint64_t{exclusive ? state.owner : kNone}, uint64_t{state.released_by}})
    print.add(value);
  return print.value();
}

}  // namespace

FrameEnd end_of_frame(const Replay& replay) {
  FrameEnd end(replay.cells.size());
  for (uint32_t r = 0; r < replay.model.resources.size(); ++r) {
    const ResourceNode& node = replay.model.resources[r];
    // The engine, or the host, sees to it that these start afresh.
    const dsl::Lifetime lifetime = replay.model.resource(r).lifetime;
    if (lifetime == dsl::Lifetime::imported || lifetime == dsl::Lifetime::readback || replay.result.first_use[r] == kNone) continue;
    for (uint32_t age = 0; age < node.copies; ++age)
      for (uint32_t c = 0; c < node.partition.cell_count(); ++c)
        end[replay.at_frame_zero(r, age, c)] = print_of(replay, replay.cells[replay.physical(r, age, c)], replay.model.is_exclusive(r));
  }
  return end;
}

}  // namespace rg::verify
