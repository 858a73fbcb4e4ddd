// Memory that transients may share: are the hand-offs right for every placement the plan allows?
//
//   ... last users of A ...   | group of B's acquire: src |= release of A |   first users of B ...
//
// Split so that the cost is that of resources, not of pairs or placements: each release covers everything its resource leaves behind, each clock
// tells the truth (both in release_track.h); each acquire stands before every first use and covers it. Together they make every hand-off right that
// points and clocks allow.
#pragma once

#include "compiler/verify/sync_replay.h"

namespace rg::verify {

// By plan resource: whether its bytes may ever be another's, before or after.
std::vector<bool> may_share(const Plan& plan);

void check_aliases(const Model& model, const SyncResult& sync, Report& report);
}  // namespace rg::verify
