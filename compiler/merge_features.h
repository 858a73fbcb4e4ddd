// Features that only remove passes become conditions: one plan that skips passes, instead of one a value.
//
//   feature bloom : bool
//   when bloom { pass down ..  pass up .. }        two plans: with `down` and `up`, without        ->    one plan, both `if bloom=on`
//
// A feature is merged if, whatever the others, one of its values has every pass that any of its values has: then frames with the other values are
// frames of that plan in which some passes are skipped. Passes that only feed skipped ones are skipped with them. Features that swap passes, or
// without which other passes become superfluous, keep plans of their own. Memory of what a value does not need stays allocated.
#pragma once

#include <string>
#include <vector>

#include "dsl/program.h"

namespace rg::compiler {

// The program whose graph runs those passes under conditions of the feature (dsl::Condition::feature) and no longer asks for it in guards. Features
// in `fixed` ("NAME=VALUE") are left alone, and so are all once the combinations are too many to look at, or the program has 64 conditions.
// O(features * combinations * planning's first phases).
dsl::Program merge_features(dsl::Program program, dsl::GraphId graph, const std::vector<std::string>& fixed);
dsl::Program merge_features(dsl::Program program, const std::vector<std::string>& fixed);  // all graphs

// Features that conditions of passes of the graph follow from.
std::vector<bool> features_of_conditions(const dsl::Program& program, const dsl::Graph& graph);

}  // namespace rg::compiler
