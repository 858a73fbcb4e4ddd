#include "compiler/alias_clocks.h"

#include <algorithm>
#include <map>

#include "compiler/access_table.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

// For each queue the last point known to have completed, plus one, so that 0 is nothing: of this frame, then of the frame before.
using Clock = std::vector<Index>;

void join(Clock& into, const Clock& other) {
  for (size_t i = 0; i < into.size(); ++i) into[i] = std::max(into[i], other[i]);
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
  // From waits of which `counts` accepts the stages.
  template <class Counts>
  Clock gathered(Counts counts) const {
    Clock result = empty_;
    for (const auto& [stages, clock] : by_stages_)
      if (counts(stages)) join(result, clock);
    return result;
  }
  void age() {
    for (auto& [stages, clock] : by_stages_) clock = aged(clock);
  }

 private:
  Clock empty_;
  std::map<Stages, Clock> by_stages_;
};

class Finder {
 public:
  Finder(PlanData& plan, const OverAt& over_at) : plan_(plan), over_at_(over_at), queues_(plan.queues.size()), releases_(queues_), last_point_(queues_), batch_of_(queues_) {
    for (size_t b = 0; b < plan.batches.size(); ++b)
      if (plan.batches[b].signal_count > 0) batch_of_[plan.batches[b].queue].push_back(b);
  }

  void run() {
    number_points();
    for (const Release& release : plan_.releases) releases_[release.queue].push_back(&release);
    for (auto& rows : releases_) std::sort(rows.begin(), rows.end(), [](const Release* a, const Release* b) { return a->point < b->point; });
    // Twice, so that the second frame finds what the first has learnt.
    std::vector<Knowledge> known(queues_, Knowledge(queues_));
    signalled_.assign(plan_.batches.size(), Clock(2 * queues_));
    for (const bool second : {false, true}) walk_frame(known, second);
  }

 private:
  void number_points() {
    std::vector<Index> points(queues_), queue_of_group(plan_.groups.size()), point_of_group(plan_.groups.size());
    std::vector<std::vector<Index>> last_use(queues_, std::vector<Index>(plan_.resources.size(), kNone));
    for (const Batch& batch : plan_.batches) {
      Index& point = points[batch.queue];
      for (Index s = batch.first_step; s < batch.first_step + batch.step_count; ++s) {
        const Step& step = plan_.steps[s];
        if (step.kind == StepKind::barriers) {
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
    const Stages stages = plan_.signals[batch.first_signal].stages;
    Clock clock = known.gathered([&](Stages waited) { return (waited & stages) != 0 || (stages & stage::all_commands) != 0; });
    clock[batch.queue] = std::max(clock[batch.queue], covered(b) + 1);
    clock[queues_ + batch.queue] = last_point_[batch.queue] + 1;  // the frame before ended with a signal of everything
    return clock;
  }

  // The largest point up to the end of batch `b` such that its signal, or an earlier one of the queue, covers all releases before it. Writes become
  // available only in stages that a signal names.
  Index covered(size_t b) const {
    const Batch& batch = plan_.batches[b];
    Index point = end_of_batch_[b];
    const std::vector<const Release*>& releases = releases_[batch.queue];
    size_t next = releases.size();
    Stages stages = 0;  // of the signals from here on
    const std::vector<size_t>& signals = batch_of_[batch.queue];
    for (size_t s = plan_.signals[batch.first_signal].value; s-- > 0;) {
      stages |= plan_.signals[plan_.batches[signals[s]].first_signal].stages;
      const Index begin = s == 0 ? 0 : end_of_batch_[signals[s - 1]] + 1;  // releases since the signal before
      if (stages & stage::all_commands) return point;
      for (; next > 0 && releases[next - 1]->point >= begin; --next) {
        const Release& release = *releases[next - 1];
        if (release.point > end_of_batch_[b]) continue;
        if (is_over_at(release, b)) continue;
        if ((release.stages & ~(release.accesses ? stages : with_earlier(stages))) != 0) point = release.point - 1;  // a group stands before any user
      }
    }
    return point;
  }

  bool is_over_at(const Release& release, size_t b) const {
    const auto found = over_at_.find({plan_.program_resource[release.resource], release.queue});
    return found != over_at_.end() && found->second <= b;
  }

  void note(Acquire& acquire, const Knowledge& known) {
    Clock clock = known.gathered([&](Stages waited) { return (acquire.stages & ~waited) == 0; });
    clock[acquire.queue] = acquire.point + 1;
    clock[queues_ + acquire.queue] = last_point_[acquire.queue] + 1;
    acquire.first_clock = static_cast<Index>(plan_.alias_clocks.size());
    for (const Index point : clock) plan_.alias_clocks.push_back(point == 0 ? kNone : point - 1);
  }

  PlanData& plan_;
  const OverAt& over_at_;
  size_t queues_;
  std::vector<std::vector<const Release*>> releases_;  // by queue, by point
  std::vector<Index> end_of_batch_, last_point_;       // point by batch, by queue
  std::vector<std::vector<size_t>> batch_of_;          // by queue: the batch of each signal value, from 1
  std::vector<Clock> signalled_;                       // by batch: what has completed when its signal has
};

// Of releases on the batch's queue since the signal before.
Stages unnamed_stages(const PlanData& plan, size_t of) {
  const uint32_t queue = plan.batches[of].queue;
  const Stages named = plan.signals[plan.batches[of].first_signal].stages;
  if (named & stage::all_commands) return 0;
  Index point = 0, since = 0, end = 0;  // points passed so far; the first since the signal before; that of the end of the batch
  for (size_t b = 0; b <= of; ++b) {
    const Batch& batch = plan.batches[b];
    if (batch.queue != queue) continue;
    for (Index s = batch.first_step; s < batch.first_step + batch.step_count; ++s) point += plan.steps[s].kind == StepKind::barriers;
    end = point++;
    if (batch.signal_count > 0 && b < of) since = point;
  }
  Stages stages = 0;
  for (const Release& release : plan.releases)
    if (release.queue == queue && release.point >= since && release.point <= end)
      stages |= release.accesses ? release.stages & ~named : latest_stages(release.stages & ~with_earlier(named));
  return stages;
}

}  // namespace

void find_alias_clocks(PlanData& plan, const OverAt& over_at) {
  plan.alias_clocks.clear();
  Finder(plan, over_at).run();
}

std::vector<Stages> silent_stages(const PlanData& made) {
  constexpr size_t kMostWork = 1'000'000;  // about a second; signals of larger plans stay as they are
  if (made.signals.size() * made.steps.size() > kMostWork) return {};
  PlanData plan = made;
  std::vector<Stages> silent(plan.batches.size());
  for (size_t b = 0; b < plan.batches.size(); ++b)
    if (plan.batches[b].signal_count > 0) plan.signals[plan.batches[b].first_signal].stages |= silent[b] = unnamed_stages(plan, b);
  find_alias_clocks(plan);
  if (plan.alias_clocks == made.alias_clocks) return {};
  // What no clock rests on goes again.
  const std::vector<Index> most = plan.alias_clocks;
  const auto drop = [&](size_t b, Stages stages) {
    Stages& signal = plan.signals[plan.batches[b].first_signal].stages;
    signal &= ~stages;
    find_alias_clocks(plan);
    const bool same = plan.alias_clocks == most;
    if (!same) signal |= stages;
    return same;
  };
  for (size_t b = 0; b < silent.size(); ++b) {
    if (silent[b] != 0 && drop(b, silent[b])) silent[b] = 0;
    for (Stages rest = silent[b]; rest; rest &= rest - 1)
      if (const Stages one = rest & ~(rest - 1); silent[b] != one && drop(b, one)) silent[b] &= ~one;
  }
  return silent;
}

}  // namespace rg::compiler
