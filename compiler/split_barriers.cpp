#include "compiler/split_barriers.h"

#include <algorithm>

#include "compiler/access_table.h"

namespace rg::compiler {
namespace {

constexpr Stages kAnyRaster = stage::index_input | stage::vertex_attribute_input | stage::vertex_shader | stage::tess_control_shader |
                              stage::tess_eval_shader | stage::geometry_shader | stage::early_fragment_tests | stage::fragment_shader |
                              stage::late_fragment_tests | stage::color_attachment_output;

// Stages in which the pass has work, whatever it accesses there. Reading the arguments of a draw or dispatch is none that is worth an event.
Stages work_of(const Frame& frame, uint32_t pass) {
  const dsl::PassKind kind = frame.pass(pass).kind;
  if (kind == dsl::PassKind::raster) return kAnyRaster;
  if (kind == dsl::PassKind::compute) return stage::compute_shader;
  Stages stages = 0;  // copies do not wait for clears
  for (const Use& use : frame.uses_of(pass)) stages |= use.effect.stages() & ~stage::host;
  return stages;
}

class Splitter {
 public:
  Splitter(const Frame& frame, const Schedule& schedule, const PlanOptions& options, SyncPlan& sync)
      : frame_(frame), schedule_(schedule), options_(options), sync_(sync), work_(schedule.slots()) {
    for (const uint32_t pass : schedule.order) work_[schedule.slot_before(schedule.segment_of[pass])] |= work_of(frame, pass);
  }

  void run() {
    const std::vector<uint32_t> queues = schedule_.queues_of_slots();
    for (uint32_t slot = 0; slot < sync_.groups.size(); ++slot) {
      if (schedule_.queues[queues[slot]] == dsl::QueueKind::transfer) continue;
      std::vector<CellBarrier>& group = sync_.groups[slot];
      for (CellBarrier& barrier : group) barrier.whole = why_whole(barrier, slot);
      while (keep_in_vain(group)) continue;
      take(group, slot);
    }
  }

 private:
  std::string_view why_whole(const CellBarrier& b, uint32_t slot) const {
    if (b.is_acquire) return "memory changes hands in it";
    if (b.src_queue != b.dst_queue) return "it changes the owner";
    if (b.src_stages == 0) return "it waits for nothing on its queue";
    if (b.dst_stages == 0) return "nothing on its queue waits for it";
    if (((b.src_stages | b.dst_stages) & stage::host) != 0) return "events do not order the host";
    if (options_.no_split.contains(frame_.resource_of(b.cell).name)) return "`--no-split` names it";
    if (b.set.slot == slot) return "its sources stand right in front of its users";
    return has_work_between(b, slot) ? "" : "nothing in between would be waited for";
  }

  // That a whole barrier would wait for.
  bool has_work_between(const CellBarrier& b, uint32_t slot) const {
    const Stages waited = with_earlier(b.src_stages);
    return std::any_of(work_.begin() + b.set.slot, work_.begin() + slot, [&](Stages work) { return (work & waited) != 0; });
  }

  static bool waits_anyway(const CellBarrier& other, Stages src, Stages dst) {
    return !other.whole.empty() && (with_earlier(other.src_stages) & src) != 0 && (with_later(other.dst_stages) & dst) != 0;
  }
  // Whatever stage it waits for in whatever other stage, a whole barrier of the group does so, too.
  static bool is_in_vain(const CellBarrier& b, const std::vector<CellBarrier>& group) {
    for (Stages sources = b.src_stages; sources != 0; sources &= sources - 1)
      for (Stages users = b.dst_stages; users != 0; users &= users - 1) {
        const Stages src = sources & ~(sources - 1), dst = users & ~(users - 1);
        if (std::none_of(group.begin(), group.end(), [&](const CellBarrier& other) { return waits_anyway(other, src, dst); })) return false;
      }
    return true;
  }
  static bool keep_in_vain(std::vector<CellBarrier>& group) {
    bool changed = false;
    for (CellBarrier& barrier : group)
      if (barrier.whole.empty() && is_in_vain(barrier, group))
        barrier.whole = "another barrier of the group makes the same stages wait", changed = true;
    return changed;
  }

  void take(std::vector<CellBarrier>& group, uint32_t slot) {
    const auto first = static_cast<ptrdiff_t>(sync_.splits.size());
    std::vector<CellBarrier> whole;
    for (CellBarrier& barrier : group) {
      if (!barrier.whole.empty()) {
        whole.push_back(std::move(barrier));
        continue;
      }
      const auto same =
          std::find_if(sync_.splits.begin() + first, sync_.splits.end(), [&](const SplitGroup& split) { return split.set == barrier.set; });
      SplitGroup& split = same == sync_.splits.end() ? sync_.splits.emplace_back(SplitGroup{barrier.set, slot, {}}) : *same;
      split.barriers.push_back(std::move(barrier));
    }
    group = std::move(whole);
  }

  const Frame& frame_;
  const Schedule& schedule_;
  const PlanOptions& options_;
  SyncPlan& sync_;
  std::vector<Stages> work_;  // by slot: of the segment behind it
};

}  // namespace

void split_barriers(const Frame& frame, const Schedule& schedule, const PlanOptions& options, SyncPlan& sync) {
  if (!frame.program->split_barriers || !options.split || schedule.segments == 0) return;
  Splitter(frame, schedule, options, sync).run();
}

}  // namespace rg::compiler
