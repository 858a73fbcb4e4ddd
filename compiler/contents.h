// What each use finds in its cell and whether anybody wants what it leaves: the facts behind load and store operations.
#pragma once

#include <vector>

#include "compiler/epochs.h"
#include "compiler/frame.h"

namespace rg::compiler {

struct Contents {
  bool defined_before = false;  // some earlier pass or frame wrote it
  bool needed_after = false;    // some later use, frame or the host depends on it
};
using ContentsOfUses = std::vector<Contents>;  // by index of Frame::uses

ContentsOfUses find_contents(const Frame& frame, const std::vector<Line>& lines);

}  // namespace rg::compiler
