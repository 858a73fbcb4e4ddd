#include "compiler/gather_parts.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace rg::compiler {
namespace {

// Everything but the part and the place in the frame.
auto meaning(const Frame& frame, const CellBarrier& b, uint32_t batch) {
  const Cell& cell = frame.cells[b.cell];
  return std::tuple(cell.resource, cell.age, b.range.aspects, b.src_stages, b.src_accesses, b.dst_stages, b.dst_accesses, b.old_layout, b.tag, batch);
}

class Gatherer {
 public:
  Gatherer(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, SyncPlan& sync)
      : frame_(frame), schedule_(schedule), sync_(sync), uses_(frame.cells.size()) {
    for (const Line& line : lines) {
      const uint32_t cells = frame.grids[frame.cells[line.cell].resource].cells_per_age();
      for (const Epoch& epoch : line.epochs)
        for (const Event& event : epoch.events) uses_[line.cell + epoch.age * cells].push_back(event.segment);
    }
    for (std::vector<uint32_t>& segments : uses_) std::sort(segments.begin(), segments.end());
  }

  void run() {
    for (uint32_t segment = 0; segment < schedule_.segments; ++segment) {
      std::vector<CellBarrier>& group = sync_.groups[schedule_.slot_before(segment)];
      size_t kept = 0;
      for (CellBarrier& b : group) {
        const uint32_t target = earlier_place(b, segment);
        if (target == segment)
          group[kept++] = std::move(b);
        else
          sync_.groups[schedule_.slot_before(target)].push_back(std::move(b));
      }
      group.resize(kept);
    }
  }

 private:
  // The segment in front of whose passes the barrier can stand as well; `segment` if there is none.
  uint32_t earlier_place(const CellBarrier& b, uint32_t segment) {
    if (b.old_layout != b.new_layout || b.src_queue != b.dst_queue || b.is_acquire || b.wraps || b.changes_queue) return segment;
    const std::vector<uint32_t>& uses = uses_[b.cell];
    const auto next = std::lower_bound(uses.begin(), uses.end(), segment);
    if (next == uses.begin()) return segment;
    std::vector<uint32_t>& places = places_[meaning(frame_, b, schedule_.batch_of[segment])];
    const auto place = std::upper_bound(places.begin(), places.end(), *(next - 1));
    if (place != places.end()) return *place;
    places.push_back(segment);
    return segment;
  }

  const Frame& frame_;
  const Schedule& schedule_;
  SyncPlan& sync_;
  std::vector<std::vector<uint32_t>> uses_;  // by cell: segments
  std::map<decltype(meaning(std::declval<const Frame&>(), std::declval<const CellBarrier&>(), 0)), std::vector<uint32_t>> places_;  // segments
};

}  // namespace

void gather_parts(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, SyncPlan& sync) {
  const auto parts = [&](const Line& line) { return frame.grids[frame.cells[line.cell].resource].cells_per_age() > 1; };
  if (std::any_of(lines.begin(), lines.end(), parts)) Gatherer(frame, schedule, lines, sync).run();
}

}  // namespace rg::compiler
