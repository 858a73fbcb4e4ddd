#include "compiler/reduce_waits.h"

#include <algorithm>
#include <bit>
#include <climits>
#include <tuple>

#include "compiler/access_table.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

class Reducer {
 public:
  explicit Reducer(const Schedule& schedule)
      : queues_(schedule.queues.size()),
        sync_(schedule.batches),
        queue_(schedule.batches),
        index_(schedule.batches),
        previous_(schedule.batches, kNone),
        batches_of_(queues_) {
    std::vector<uint32_t> count(queues_), last(queues_, kNone);
    for (uint32_t segment = 0; segment < schedule.segments; ++segment) {
      const uint32_t batch = schedule.batch_of[segment], queue = schedule.queue_of[segment];
      if (segment > 0 && schedule.batch_of[segment - 1] == batch) continue;
      queue_[batch] = queue, index_[batch] = count[queue]++, previous_[batch] = last[queue], last[queue] = batch;
      batches_of_[queue].push_back(batch);
    }
    known_.assign(schedule.batches, std::vector<uint32_t>(queues_));
    knows_before_.assign(schedule.batches, std::vector<bool>(queues_));
  }

  std::vector<BatchSync> run(const std::vector<Need>& needs) {
    std::vector<std::vector<const Need*>> by_batch(sync_.size());
    for (const Need& need : needs) by_batch[need.to_batch].push_back(&need);
    for (uint32_t batch = 0; batch < sync_.size(); ++batch) {
      inherit(batch);
      add_waits(batch, by_batch[batch]);
    }
    // Needs that leave a choice come after those that leave none, those of the frame before last.
    std::vector<const Need*> order;
    for (const Need& need : needs) order.push_back(&need);
    const auto key = [&](const Need* need) {
      return std::tuple(!rests_on_one_wait(*need), need->chains, need->from_batch == kNone, need->any_from,
                        need->chains ? -std::popcount(with_later(need->to_stages)) : 0);
    };
    std::stable_sort(order.begin(), order.end(), [&](const Need* a, const Need* b) { return key(a) < key(b); });
    for (const Need* need : order) realise(*need);
    return std::move(sync_);
  }

 private:
  void inherit(uint32_t batch) {
    if (previous_[batch] == kNone) return;
    known_[batch] = known_[previous_[batch]], knows_before_[batch] = knows_before_[previous_[batch]];
  }

  void add_waits(uint32_t batch, const std::vector<const Need*>& needs) {
    std::vector<uint32_t> cell(queues_);
    std::vector<uint32_t> wanted(queues_);  // how many batches of each queue must have completed
    for (const Need* need : needs)
      if (need->from_batch != kNone && index_[need->from_batch] + 1 > wanted[need->from_queue])
        wanted[need->from_queue] = index_[need->from_batch] + 1, cell[need->from_queue] = need->cell;
    for (uint32_t queue = 0; queue < queues_; ++queue)
      if (wanted[queue] > known_[batch][queue] && !implied_by_another(wanted, queue))
        wait(batch, queue, batch_at(queue, wanted[queue] - 1), cell[queue]);
    for (const Need* need : needs) {
      if (need->from_batch != kNone || knows_before_[batch][need->from_queue]) continue;
      sync_[batch].waits.push_back({need->from_queue, kNone, 0, need->cell});
      knows_before_[batch][need->from_queue] = true;
    }
  }

  bool implied_by_another(const std::vector<uint32_t>& wanted, uint32_t queue) const {
    for (uint32_t other = 0; other < queues_; ++other)
      if (other != queue && wanted[other] > 0 && known_[batch_at(other, wanted[other] - 1)][queue] >= wanted[queue]) return true;
    return false;
  }

  // Whoever waits for a batch of this frame has waited for all that its queue did before.
  void wait(uint32_t batch, uint32_t queue, uint32_t from, uint32_t cell) {
    RG_CHECK(from < batch, "batches are listed in a legal serial order");
    sync_[batch].waits.push_back({queue, from, 0, cell});
    for (uint32_t q = 0; q < queues_; ++q) {
      known_[batch][q] = std::max(known_[batch][q], known_[from][q]);
      knows_before_[batch][q] = knows_before_[batch][q] || knows_before_[from][q];
    }
    known_[batch][queue] = std::max(known_[batch][queue], index_[from] + 1);
    knows_before_[batch][queue] = true;
  }

  uint32_t batch_at(uint32_t queue, uint32_t index) const { return batches_of_[queue][index]; }

  bool satisfies(const BatchWait& wait, const Need& need) const {
    if (wait.queue != need.from_queue) return false;
    return need.from_batch == kNone || (wait.batch != kNone && index_[wait.batch] >= index_[need.from_batch]);
  }
  bool leads_to(const BatchWait& wait, const Need& need) const {
    if (wait.batch == kNone) return false;
    return need.from_batch == kNone ? knows_before_[wait.batch][need.from_queue] : known_[wait.batch][need.from_queue] > index_[need.from_batch];
  }

  static Stages lacking(const BatchWait& wait, const Need& need) { return need.to_stages & ~(need.chains ? with_later(wait.stages) : wait.stages); }
  static void signal(Stages& stages, const Need& need) {
    if (!need.any_from)
      stages |= need.from_stages;
    else if ((stages & need.from_stages) == 0)
      stages |= need.from_stages & ~(need.from_stages - 1);
  }

  // The frame before ends with a signal of everything, which any later signal of the queue comes after.
  bool rests_on_one_wait(const Need& need) const {
    for (uint32_t batch = need.to_batch; batch != kNone; batch = previous_[batch])
      for (const BatchWait& wait : sync_[batch].waits)
        if (satisfies(wait, need)) return true;
    return false;
  }

  // Of the waits that satisfy the need, the one that lacks the fewest stages; among equals the latest.
  BatchWait* cheapest(const Need& need) {
    BatchWait* best = nullptr;
    int least = INT_MAX;
    for (uint32_t batch = need.to_batch; batch != kNone; batch = previous_[batch])
      for (BatchWait& wait : sync_[batch].waits) {
        if (!satisfies(wait, need)) continue;
        const Stages signal = need.from_batch == kNone ? need.from_stages : sync_[wait.batch].signal;
        const int lacks = std::popcount(lacking(wait, need)) + std::popcount(need.from_stages & ~signal);
        if (lacks < least) best = &wait, least = lacks;
      }
    return best;
  }

  // Adds the need's stages to the waits and signals it rests on: a wait of its batch or an earlier one of the queue, or a chain over a third queue.
  void realise(const Need& need) {
    if (BatchWait* wait = cheapest(need)) {
      wait->stages |= lacking(*wait, need);
      if (need.from_batch != kNone) signal(sync_[wait->batch].signal, need);
      return;
    }
    for (uint32_t batch = need.to_batch; batch != kNone; batch = previous_[batch])
      for (BatchWait& wait : sync_[batch].waits)
        if (leads_to(wait, need)) {
          wait.stages |= lacking(wait, need);
          return chain(need, wait.batch);
        }
    RG_CHECK(false, "every need has a wait it rests on");
  }

  // The middle queue's signal has to come after what its wait lets through.
  void chain(const Need& need, uint32_t over) {
    Need inner = need;
    inner.to_batch = over, inner.to_stages = 0;
    BatchWait* wait = cheapest(inner);
    if (!wait) return realise(inner);
    realise(inner);
    Stages& signal = sync_[over].signal;
    if ((signal & with_later(wait->stages)) == 0) signal |= wait->stages & ~(wait->stages - 1);
  }

  size_t queues_;
  std::vector<BatchSync> sync_;
  std::vector<uint32_t> queue_, index_, previous_;  // by batch: its queue, its number there, the one before it there
  std::vector<std::vector<uint32_t>> batches_of_;   // by queue
  std::vector<std::vector<uint32_t>> known_;        // by batch, by queue: how many batches of that queue have completed before it
  std::vector<std::vector<bool>> knows_before_;     // by batch, by queue: what that queue did in the frame before has completed
};

}  // namespace

std::vector<BatchSync> reduce_waits(const Schedule& schedule, const std::vector<Need>& needs) { return Reducer(schedule).run(needs); }

}  // namespace rg::compiler
