// What the host brings to a frame. Allocates nothing unless something is wrong.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Sizes and presence of everything, against the plan. Nothing has happened where it fails. `inputs` gets a value for every feature, the device's
// where it decides, and the conditions that follow from them.
Status check_inputs(GraphInstance::State& state, FrameInputs& inputs);

// The combination of feature values that `inputs` selects for `pass`; see Plan::pipeline_choices. Values are within their bounds.
uint32_t selected_choice(const Plan& plan, const Pass& pass, const FrameInputs& inputs);

// Puts imports into barriers, views and sets; copies parameters and updates into the slot's section of the ring.
Status take_inputs(GraphInstance::State& state, const FrameInputs& inputs);

}  // namespace rg
