// Renders on while its plan is edited.
#pragma once

#include <functional>

#include "examples/demo/options.h"
#include "examples/demo/renderer.h"

namespace rg::demo {

// Takes a picture with `take`, and again whenever the plan file of the options was replaced by one that fits; says why where it does not, and goes on
// with the old plan. Returns after SIGINT or SIGTERM, or after DemoOptions::reloads attempts.
Status watch(Renderer& renderer, const DemoOptions& options, const std::function<Status()>& take);

}  // namespace rg::demo
