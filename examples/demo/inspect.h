// What a look into a frame leaves behind: dumps, traces, profiles.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "examples/demo/options.h"
#include "examples/demo/renderer.h"

namespace rg::demo {

// Of the options: one dump as "PASS.resource".
struct DumpPoint {
  Index pass = kNone, resource = kNone;
};
// An error names the passes or resources there are.
Result<DumpPoint> find_dump(const Plan& plan, const std::string& text);

// Renders frames of one shot with `draw` and writes what the options ask for. Prints the names of the files.
Status inspect(Renderer& renderer, const DemoOptions& options, const std::function<Status()>& draw);

}  // namespace rg::demo
