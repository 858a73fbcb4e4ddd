// Memory that transients may share: are the hand-offs right for every placement the plan allows?
//
//   ... last users of A ...   | group of B's acquire: src |= release of A |   first users of B ...
//
// Split so that the cost is that of resources plus pairs, not of placements: each release covers everything its resource leaves behind;
// each acquire stands before every first use and covers it; each pair is in order. Together they make every hand-off right.
#pragma once

#include "compiler/verify/sync_replay.h"

namespace rg::verify {

void check_aliases(const Model& model, const SyncResult& sync, Report& report);
// Release bits that no last user needs.
void check_release_redundancy(const Model& model, const SyncResult& sync, Report& report);

}  // namespace rg::verify
