// What the executor records inside passes: the plan's transfers, resolves, clears and indirect arguments against the declared ones.
#pragma once

#include "compiler/verify/model.h"

namespace rg::verify {

// `extents` are those the model was made with.
void check_work(const Model& model, const std::vector<int64_t>& extents, Report& report);

}  // namespace rg::verify
