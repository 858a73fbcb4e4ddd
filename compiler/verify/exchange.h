// Whether anybody can tell in which order two passes ran. Judged from the program alone.
#pragma once

#include <vector>

#include "dsl/program.h"

namespace rg::verify {

// `first` and `second` run one right after the other, in either order, then `rest` in this one. True only if, whatever the host decides, each access
// finds the same and what outlives the frame ends as the same. All are indices of `graph.passes`.
bool may_exchange(const dsl::Program& program, const dsl::Graph& graph, uint32_t first, uint32_t second, const std::vector<uint32_t>& rest);

}  // namespace rg::verify
