// Samplers of a plan: they depend on nothing but it.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// One sampler a row of Plan::samplers.
Status create_samplers(const Context& context, Objects& objects);

}  // namespace rg
