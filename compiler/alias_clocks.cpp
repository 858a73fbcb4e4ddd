#include "compiler/alias_clocks.h"

#include <algorithm>
#include <map>
#include <optional>

#include "compiler/access_table.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

// What is known to have completed of a queue: all points below `end`, by the signal of `batch`.
struct Known {
  Index end = 0;
  Index batch = kNone;
};
// For each queue: of this frame, then of the frame before.
using Clock = std::vector<Known>;

void join(Clock& into, const Clock& other) {
  for (size_t i = 0; i < into.size(); ++i)
    if (into[i].end < other[i].end) into[i] = other[i];
}

// What was this frame's becomes the frame before's.
Clock aged(const Clock& clock) {
  const size_t queues = clock.size() / 2;
  Clock result(clock.size());
  std::copy_n(clock.begin(), queues, result.begin() + static_cast<ptrdiff_t>(queues));
  return result;
}

// What a queue has learnt from its waits, by the stages that wait.
class Knowledge {
 public:
  explicit Knowledge(size_t queues) : empty_(2 * queues) {}
  void learn(Stages stages, const Clock& clock) { join(by_stages_.try_emplace(with_later(stages), empty_).first->second, clock); }
  // To what has `stages` for its first scope: it goes on after the waits that this scope meets.
  Clock known_to(Stages stages) const {
    Clock result = empty_;
    const Stages scope = with_earlier(stages);
    for (const auto& [waited, clock] : by_stages_)
      if ((waited & scope) != 0 || (stages & stage::all_commands) != 0) join(result, clock);
    return result;
  }
  void age() {
    for (auto& [stages, clock] : by_stages_) clock = aged(clock);
  }

 private:
  Clock empty_;
  std::map<Stages, Clock> by_stages_;
};

// Releases of one queue that none of its signals has come after, grouped by what they lack.
class Uncovered {
 public:
  void add(const Release& release, Index over_at) { keep({release.stages, release.accesses != 0, over_at}, release.point); }
  // The signal of `batch`. Writes become available only in stages that it names; what merely has to be over may be in earlier ones.
  void name(Stages stages, Index batch) {
    std::map<Lack, Index> before;
    before.swap(first_);
    for (const auto& [row, point] : before) {
      Lack lack = row;
      lack.stages &= ~(lack.writes ? stages : with_earlier(stages));
      if (lack.stages != 0 && batch < lack.over_at && (stages & stage::all_commands) == 0) keep(lack, point);
    }
  }
  // What a signal would have to name for all of them.
  Stages missing() const {
    Stages writes = 0, reads = 0;
    for (const auto& [lack, point] : first_) (lack.writes ? writes : reads) |= lack.stages;
    return writes | latest_stages(reads & ~with_earlier(writes));
  }
  std::optional<Index> first_point() const {
    std::optional<Index> first;
    for (const auto& [lack, point] : first_) first = std::min(first.value_or(point), point);
    return first;
  }

 private:
  struct Lack {
    Stages stages = 0;
    bool writes = false;
    Index over_at = kNone;  // the signal of this batch is known to come after them
    auto operator<=>(const Lack&) const = default;
  };
  void keep(const Lack& lack, Index point) {
    Index& first = first_.try_emplace(lack, point).first->second;
    first = std::min(first, point);
  }
  std::map<Lack, Index> first_;  // by what they lack: the first of their points
};

class Finder {
 public:
  Finder(PlanData& plan, const OverAt& over_at)
      : plan_(plan),
        over_at_(over_at),
        queues_(plan.queues.size()),
        releases_(queues_),
        last_point_(queues_),
        batch_of_(queues_),
        covered_(plan.batches.size()),
        signalled_(plan.batches.size(), Clock(2 * queues_)),
        relied_(plan.batches.size()) {
    for (size_t b = 0; b < plan.batches.size(); ++b)
      if (plan.batches[b].signal_count > 0) batch_of_[plan.batches[b].queue].push_back(b);
    number_points();
    for (const Release& release : plan_.releases) releases_[release.queue].push_back(&release);
    for (auto& rows : releases_) std::sort(rows.begin(), rows.end(), [](const Release* a, const Release* b) { return a->point < b->point; });
  }

  // `visit(batch, uncovered)` may name further stages before each signal counts.
  template <class Visit>
  void run(Visit visit) {
    for (size_t queue = 0; queue < queues_; ++queue) cover(queue, visit);
    // Twice, so that the second frame finds what the first has learnt.
    std::vector<Knowledge> known(queues_, Knowledge(queues_));
    for (const bool second : {false, true}) walk_frame(known, second);
  }
  // Some clock counts as far as the signal of this batch covers.
  bool is_relied_on(size_t batch) const { return relied_[batch]; }

 private:
  void number_points() {
    std::vector<Index> points(queues_), queue_of_group(plan_.groups.size()), point_of_group(plan_.groups.size());
    std::vector<std::vector<Index>> last_use(queues_, std::vector<Index>(plan_.resources.size(), kNone));
    for (const Batch& batch : plan_.batches) {
      Index& point = points[batch.queue];
      for (Index s = batch.first_step; s < batch.first_step + batch.step_count; ++s) {
        const Step& step = plan_.steps[s];
        if (step.kind != StepKind::pass) {
          if (step.kind == StepKind::barriers && plan_.groups[step.index].event == kNone)
            queue_of_group[step.index] = batch.queue, point_of_group[step.index] = point++;
          continue;
        }
        const Pass& pass = plan_.passes[step.index];
        for (Index a = pass.first_access; a < pass.first_access + pass.access_count; ++a)
          last_use[batch.queue][plan_.accesses[a].ref.resource] = point;
      }
      end_of_batch_.push_back(point++);
      last_point_[batch.queue] = end_of_batch_.back();
    }
    for (Release& release : plan_.releases) {
      release.point = last_use[release.queue][release.resource];
      RG_CHECK(release.point != kNone, "a release is by a queue that uses the resource");
    }
    for (Acquire& acquire : plan_.acquires) acquire.queue = queue_of_group[acquire.group], acquire.point = point_of_group[acquire.group];
  }

  template <class Visit>
  void cover(size_t queue, Visit visit) {
    Uncovered uncovered;
    size_t next = 0;
    for (const size_t b : batch_of_[queue]) {
      for (; next < releases_[queue].size() && releases_[queue][next]->point <= end_of_batch_[b]; ++next)
        uncovered.add(*releases_[queue][next], over_at(*releases_[queue][next]));
      visit(b, uncovered);
      uncovered.name(plan_.signals[plan_.batches[b].first_signal].stages, static_cast<Index>(b));
      covered_[b] = uncovered.first_point().value_or(end_of_batch_[b] + 1);  // a group stands before any user
    }
  }
  Index over_at(const Release& release) const {
    const auto found = over_at_.find({plan_.program_resource[release.resource], release.queue});
    return found == over_at_.end() ? kNone : found->second;
  }

  void walk_frame(std::vector<Knowledge>& known, bool emit) {
    for (Knowledge& each : known) each.age();
    std::vector<std::vector<Acquire*>> by_group(plan_.groups.size());
    for (Acquire& acquire : plan_.acquires) by_group[acquire.group].push_back(&acquire);
    std::vector<Clock> signalled = signalled_;
    for (size_t b = 0; b < plan_.batches.size(); ++b) {
      const Batch& batch = plan_.batches[b];
      for (Index w = batch.first_wait; w < batch.first_wait + batch.wait_count; ++w) {
        const Wait& wait = plan_.waits[w];
        const size_t from = batch_of_[wait.queue][wait.value - 1];
        known[batch.queue].learn(wait.stages, wait.frames_ago ? aged(signalled_[from]) : signalled[from]);
      }
      if (batch.signal_count > 0) signalled[b] = at_signal(b, known[batch.queue]);
      if (!emit) continue;
      for (Index s = batch.first_step; s < batch.first_step + batch.step_count; ++s)
        if (plan_.steps[s].kind == StepKind::barriers)
          for (Acquire* acquire : by_group[plan_.steps[s].index]) note(*acquire, known[batch.queue]);
    }
    signalled_ = std::move(signalled);
  }

  Clock at_signal(size_t b, const Knowledge& known) const {
    const Batch& batch = plan_.batches[b];
    Clock clock = known.known_to(plan_.signals[batch.first_signal].stages);
    if (clock[batch.queue].end < covered_[b]) clock[batch.queue] = {covered_[b], static_cast<Index>(b)};
    clock[queues_ + batch.queue] = {last_point_[batch.queue] + 1, kNone};  // the frame before ended with a signal of everything
    return clock;
  }

  void note(Acquire& acquire, const Knowledge& known) {
    Clock clock = known.known_to(acquire.stages);
    clock[acquire.queue] = {acquire.point + 1, kNone};
    clock[queues_ + acquire.queue] = {last_point_[acquire.queue] + 1, kNone};
    acquire.first_clock = static_cast<Index>(plan_.alias_clocks.size());
    for (const Known& each : clock) {
      plan_.alias_clocks.push_back(each.end == 0 ? kNone : each.end - 1);
      if (each.batch != kNone) relied_[each.batch] = true;
    }
  }

  PlanData& plan_;
  const OverAt& over_at_;
  size_t queues_;
  std::vector<std::vector<const Release*>> releases_;  // by queue, by point
  std::vector<Index> end_of_batch_, last_point_;       // point by batch, by queue
  std::vector<std::vector<size_t>> batch_of_;          // by queue: the batch of each signal value, from 1
  std::vector<Index> covered_;                         // by batch: its signal comes after all releases at points below
  std::vector<Clock> signalled_;                       // by batch: what has completed when its signal has
  std::vector<bool> relied_;                           // by batch
};

}  // namespace

void find_alias_clocks(PlanData& plan, const OverAt& over_at) {
  plan.alias_clocks.clear();
  Finder(plan, over_at).run([](size_t, const Uncovered&) {});
}

std::vector<MemorySignal> memory_signals(const PlanData& made) {
  // Every signal names what its queue has released, so that clocks count as far as they can ...
  PlanData plan = made;
  const OverAt nothing;
  const auto signal_of = [&](size_t b) -> Stages& { return plan.signals[plan.batches[b].first_signal].stages; };
  plan.alias_clocks.clear();
  Finder most(plan, nothing);
  most.run([&](size_t b, const Uncovered& uncovered) { signal_of(b) |= uncovered.missing(); });
  if (plan.alias_clocks == made.alias_clocks) return {};
  // ... and then only those that clocks rest on: a release is named by the last signal that can, which does the most others the same service.
  plan.signals = made.signals, plan.alias_clocks.clear();
  std::vector<MemorySignal> result(plan.batches.size());
  Finder(plan, nothing).run([&](size_t b, const Uncovered& uncovered) {
    if (!most.is_relied_on(b)) return;
    result[b] = {true, uncovered.missing()};
    signal_of(b) |= result[b].stages;
  });
  return result;
}

}  // namespace rg::compiler
