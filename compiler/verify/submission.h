// How the plan is submitted: queues, batches, waits and signals, as far as that can be judged without contents.
#pragma once

#include "compiler/verify/model.h"
#include "compiler/verify/proof.h"

namespace rg::verify {

// Everything that replays rely on: indices, values of the timelines, waits that a signal answers.
bool check_timelines(const Plan& plan, Report& report);
// Passes on queues that can run them and that the program permits, masks that the queues support, declared order across queues.
void check_submission(const Model& model, Report& report);
// Marks in `required`, by Atom, waits and signals without which a declared order across queues would not hold. O(waits * batches) where there is one.
void require_declared_order(const Model& model, std::vector<bool>& required);

}  // namespace rg::verify
