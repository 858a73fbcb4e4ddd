// How the plan is submitted: queues, batches, waits and signals, as far as that can be judged without contents.
#pragma once

#include "compiler/verify/model.h"

namespace rg::verify {

// Everything that replays rely on: indices, values of the timelines, waits that a signal answers.
bool check_timelines(const Plan& plan, Report& report);
// Passes on queues that can run them and that the program permits, masks that the queues support, declared order across queues.
void check_submission(const Model& model, Report& report);

}  // namespace rg::verify
