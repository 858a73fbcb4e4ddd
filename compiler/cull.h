// Which passes reach something observable.
//
// Roots: last writers of everything that outlives the frame (imported, history, persistent, read back), of `output` resources, and passes marked
// `keep`. From there backwards through every version a live pass depends on.
#pragma once

#include <vector>

#include "compiler/build_graph.h"
#include "compiler/frame.h"

namespace rg::compiler {

struct Liveness {
  std::vector<bool> live;            // by pass of the frame
  std::vector<std::string> reasons;  // by pass: why it is kept or culled
};

// `graph` holds all passes. O(passes + dependencies).
Liveness cull(const Frame& frame, const Graph& graph);

}  // namespace rg::compiler
