// Parts of one resource that become visible to the same readers at different times.
//
//   written by   a, in parts 0 1 2             group 1: 0        group 1: 0 1 2       one barrier where the parts are neighbours
//   read by      b: 0   c: 1   d: 2            group 2: 1
//                                              group 3: 2
//
// A barrier of one part moves to an earlier group that has a barrier with the same stages and accesses on another part of the resource, if nobody
// uses the part in between. That loses nothing: the earlier group waits for the same stages anyway, whatever part they touched, and the later group
// waits for less. Only barriers that change neither layout nor owner, within one batch.
#pragma once

#include "compiler/synchronise.h"

namespace rg::compiler {

// O(barriers log + uses).
void gather_parts(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, SyncPlan& sync);

}  // namespace rg::compiler
