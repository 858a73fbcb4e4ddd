// Which passes reach something observable.
//
// Roots: last writers of imported, read-back and `output` resources, and passes marked `keep`. From there backwards through every version a live
// pass depends on. Contents that cross the frame boundary count where a live pass reads them: the last writers of a persistent resource, and of
// a history resource's current copy.
#pragma once

#include <vector>

#include "compiler/build_graph.h"
#include "compiler/frame.h"

namespace rg::compiler {

struct Liveness {
  std::vector<bool> live;       // by pass of the frame
  std::vector<std::string> reasons;  // by pass: why it is kept or culled
};

// `graph` holds all passes. O(passes + dependencies).
Liveness cull(const Frame& frame, const Graph& graph);

}  // namespace rg::compiler
