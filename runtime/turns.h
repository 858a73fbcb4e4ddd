// Instances that follow each other, and extents that follow the load.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// GraphInstance::continue_from.
Status follow(GraphInstance::State& state, const GraphInstance::State& other);

// GraphInstance::set_active, with extents that were checked.
void activate(const Context& context, const Objects& objects, Sized& sized, std::span<const int64_t> extents);

}  // namespace rg
