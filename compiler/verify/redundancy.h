// Atoms that nothing needs: barriers, stage bits and access bits whose removal leaves every proof of sync_replay.h standing.
#pragma once

#include <vector>

#include "compiler/verify/sync_replay.h"

namespace rg::verify {

// Only barriers tagged `hazard` have to justify themselves. Buffers whose ranges may lie otherwise to one another at other extents are not judged.
void check_redundancy(const Model& model, const std::vector<int64_t>& extents, const std::vector<bool>& required, Report& report);

}  // namespace rg::verify
