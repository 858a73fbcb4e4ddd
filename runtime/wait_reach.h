// Which batches of other queues have ended when a batch begins, by the waits of the plan alone.
#pragma once

#include <vector>

#include "runtime/plan.h"

namespace rg {

class WaitReach {
 public:
  explicit WaitReach(const Plan& plan);
  // The group comes after the pass, of this frame or the one before, because something waits for it; false for passes of the group's own queue.
  bool comes_after(Index group, Index pass) const;

 private:
  std::vector<Index> batch_of_pass_, batch_of_group_, queue_of_;  // queue: by batch
  std::vector<std::vector<bool>> after_;                          // [batch][batch]: in this frame or the one before
};

}  // namespace rg
