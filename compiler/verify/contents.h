// Follows what every cell holds, in program order and in the plan, and compares: each read must find the version program order gives it,
// and so must everything observable at the end of each frame.
//
// A version is a name: (pass, frame), or the initial contents. Poison is no version. By induction over reads, equal names mean equal values.
// Commuting writers add their names, so their order does not matter. Runs once for each chosen outcome of conditions and mip counts.
#pragma once

#include "compiler/verify/model.h"

namespace rg::verify {

// `extents` are those the model was made with.
void replay_contents(const Model& model, const std::vector<int64_t>& extents, Report& report);

}  // namespace rg::verify
