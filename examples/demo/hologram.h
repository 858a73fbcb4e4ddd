// A pipeline of the application's own, built from what the graph says about a pass.
#pragma once

#include "runtime/device.h"
#include "runtime/graph.h"
#include "runtime/handles.h"
#include "runtime/result.h"

namespace rg::demo {

constexpr uint32_t kHologramVertices = 2 * 48 * (12 + 7);
Result<UniquePipeline> make_hologram_pipeline(Device& device, const PassInfo& pass);

}  // namespace rg::demo
