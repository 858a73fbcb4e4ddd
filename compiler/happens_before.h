// Who comes after whom on the GPU, over all queues of one frame, as the plan's barriers, waits and signals have it now.
//
//   source ──barrier──> stages of its queue ──signal──> queue ──wait──> stages of the other queue ──barrier──> target
//
// A source is an access of one stage, a layout transition, or what is pending when the frame starts. What comes after it spreads forward over the
// points of the frame: a barrier goes on from where its first scope, with logically earlier stages, is met, to its second scope with logically later
// ones, on its own queue; barriers of one point do not chain. Writes become available where a barrier on their range, or a signal, names them, and
// are seen in exactly the second scope of a barrier on their range, or of a wait. Half a change of owner leads nowhere: within one family it is not
// recorded.
//
// A derivation is what one such way from a source to a target rests on: single atoms (a barrier, a wait, one stage or access of one). The facts of a
// plan hold as long as each has a derivation, so an atom that none rests on can go (justifications as in Doyle 1979, "A truth maintenance system").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/frame.h"
#include "compiler/make_schedule.h"
#include "compiler/synchronise.h"

namespace rg::compiler {

enum class SyncKind : uint8_t { barrier, wait, signal };
struct SyncScope {
  SyncKind kind = SyncKind::barrier;
  uint32_t point = 0, queue = 0;
  Stages src = 0, dst = 0;
  Accesses src_accesses = 0, dst_accesses = 0;
  bool changes = false, transfers = false;  // layout or owner; owner
  Layout old_layout = Layout::undefined, new_layout = Layout::undefined;
  bool everything = false;       // the signal that ends the frame of its queue
  uint32_t from_queue = 0;       // of a wait
  int64_t number = 0;            // batch waited for, or that signals; -1: the frame before
  uint32_t slot = 0, index = 0;  // a barrier's place; a wait's batch and place there; a signal's batch
  bool gone = false;
  Stages src_earlier = 0, dst_later = 0;  // completed
  void complete();
};

enum class AtomField : uint8_t { whole, src_stage, src_access, dst_stage, dst_access, value };
struct SyncAtom {
  uint32_t scope = 0;
  AtomField field = AtomField::whole;
  uint8_t bit = 0;
  friend bool operator==(const SyncAtom&, const SyncAtom&) = default;
};

struct SyncSource {
  enum class Kind : uint8_t { read, write, transition, settled, batch } kind = Kind::read;
  uint32_t cell = 0, queue = 0;  // cell kNone: of whatever resource
  uint32_t after = 0;            // it happens after all points below
  Stages stage = 0;              // one bit; read, write
  Accesses access = 0;
  uint32_t scope = 0;                                // transition
  bool signalled = false;                            // before the frame, so that the last signals of the frame before come after it
  std::vector<std::pair<uint32_t, Stages>> reached;  // settled: stages that come after it, by queue
};

struct SyncFact {
  // sees: `stages` of `queue` (one bit) see the write in `access`. follows: one of `stages` of `queue` comes after the source. feeds: the barrier or
  // signal `scope` has the source in its first scope. host: the host sees the write, on whatever queue. All hold before the point `before`, which
  // counts on through the frames after that of the source.
  enum class Kind : uint8_t { sees, follows, feeds, host } kind = Kind::sees;
  uint32_t source = 0, before = 0, queue = 0;
  Stages stages = 0;
  Accesses access = 0;
  uint32_t scope = 0;
  uint32_t also = UINT32_MAX;  // or the fact of this number in `alternatives` holds
  bool optional = false;       // kept where it holds, but nothing is wrong where it does not
};

class HappensBefore {
 public:
  HappensBefore(const Frame& frame, const Schedule& schedule, const SyncPlan& sync);

  std::vector<SyncScope> scopes;  // by point; barriers as they stand in their group
  std::vector<SyncSource> sources;
  std::vector<SyncFact> alternatives;

  uint32_t point_of_slot(uint32_t slot) const { return point_of_slot_[slot]; }
  uint32_t end() const { return static_cast<uint32_t>(points_.size()); }
  // Barriers on the cell, in order.
  std::span<const uint32_t> on_cell(uint32_t cell) const { return on_cell_[cell]; }
  // After the masks of a scope have changed.
  void refresh(uint32_t scope);
  // A scope and what its point sums up, to be as they were.
  struct Saved {
    SyncScope scope;
    Stages src_earlier = 0, dst_later = 0;
  };
  Saved save(uint32_t scope) const;
  void restore(uint32_t scope, const Saved& saved);

  // True if the fact holds; `atoms` then receives one derivation. O(points between source and target * barriers of those that go on).
  bool derive(const SyncFact& fact, std::vector<SyncAtom>& atoms);

 private:
  struct Point {
    SyncKind kind = SyncKind::barrier;
    uint32_t queue = 0, first = 0, count = 0;
    Stages src_earlier = 0, dst_later = 0;  // of all
  };
  // How a stage of a queue came to be reached, or a signal to come after the source: through `scope`, from `from`.
  struct Reason {
    uint32_t scope = UINT32_MAX;  // UINT32_MAX: the source itself
    uint8_t from = kSource;       // a stage of the scope's queue, or:
  };
  static constexpr uint8_t kSource = 255, kSignal = 254, kOwnScope = 253;  // the source; the signal waited for; the transition that is the source
  static constexpr size_t kStages = 40;
  struct Lane {
    Stages reached = 0;
    int64_t signalled = INT64_MAX;
    Reason signal;
    std::array<Reason, kStages> reasons;
  };
  struct Fresh {
    Stages stages = 0;
    Reason reason;
  };

  void add_point(SyncKind kind, uint32_t queue);
  void add_scope(SyncScope scope);
  void add_barriers(const Frame& frame, uint32_t slot, const std::vector<CellBarrier>& group);
  void note_cells(const Frame& frame, const CellBarrier& barrier, uint32_t scope);

  // Of those on the cell, the ones at or after point `first` and before `end`. O(log barriers on the cell).
  std::span<const uint32_t> on_cell_between(uint32_t cell, uint32_t first, uint32_t end) const;
  bool derive_directly(const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms);
  bool derive_alone(const SyncFact& fact, std::vector<SyncAtom>& atoms);
  void start(const SyncSource& source);
  void start_frame(uint32_t cell, uint32_t point);
  int64_t number_waited_for(const SyncScope& wait) const;
  bool can_begin(const SyncFact& fact, const SyncSource& source) const;
  bool can_sink(const SyncFact& fact, const SyncSource& source) const;
  bool step(const Point& point, const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms);
  bool pass_barriers(const Point& point, const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms);
  bool pass_waits(const Point& point, const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms);
  void pass_signal(const Point& point, const SyncSource& source);
  bool enters(const SyncScope& scope, bool covers, const SyncSource& source, uint8_t& from) const;
  bool followed(const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms) const;
  bool fed(const SyncFact& fact, const SyncSource& source, std::vector<SyncAtom>& atoms) const;
  void reach(uint32_t queue, Stages stages, const Reason& reason);
  void add_sink(uint32_t scope, const SyncFact& fact, std::vector<SyncAtom>& atoms) const;
  void explain(const Reason& reason, const SyncSource& source, std::vector<SyncAtom>& atoms) const;
  void explain_stage(uint32_t queue, uint8_t stage, const SyncSource& source, std::vector<SyncAtom>& atoms) const;

  std::vector<Point> points_;
  std::vector<uint32_t> point_of_slot_;
  std::vector<std::vector<uint32_t>> on_cell_;
  std::vector<uint32_t> next_cell_;              // what the copy is in the next frame, one frame older
  std::vector<std::vector<uint32_t>> waits_on_;  // by queue: scopes
  std::vector<int64_t> last_signal_;             // by queue: its number in the frame
  std::vector<Lane> lanes_;
  std::vector<Fresh> fresh_;  // of the point being passed
  bool available_ = false;    // the write that is the source
  uint32_t frame_ = 0;        // after that of the source
  int64_t batches_ = 0;
  std::span<const uint32_t> local_;  // barriers on its cell still to come
};

}  // namespace rg::compiler
