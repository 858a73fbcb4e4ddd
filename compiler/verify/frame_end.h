// What one frame leaves to the next, in a form that can be compared: facts without proofs, copies by age, signals counted from the frame's own.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/verify/replay.h"

namespace rg::verify {

using FrameEnd = std::vector<uint64_t>;  // a fingerprint a cell

// After leave(): every used cell has taken all barriers into account.
FrameEnd end_of_frame(const Replay& replay);

}  // namespace rg::verify
