// What must hold of a plan before anything can be replayed, and valid usage that needs no replay.
#pragma once

#include "compiler/verify/model.h"

namespace rg::verify {

// True if every index, span and mapping of the plan is in bounds, and every pass belongs to this configuration, once. Nothing else may look at a plan
// where this fails.
bool check_indices(const Input& input, Report& report);
// Masks, layouts and ranges of barriers by Vulkan's valid usage; guards, declared orders, attachments.
void check_usage(const Model& model, Report& report);

}  // namespace rg::verify
