// Byte ranges that depend on extents, cut where they begin and end, if that is in one order at all extents.
#pragma once

#include "compiler/expressions.h"
#include "compiler/frame.h"
#include "dsl/symbolic.h"

namespace rg::compiler {

// Fills Grid::cuts, places and bytes. False where the order is not proved: then the buffer stays whole.
bool cut_bytes(dsl::Formulas& formulas, const dsl::Resource& buffer, const std::vector<dsl::Range>& ranges, Grid& grid);

// Of a buffer from one cut to another; numbers of Grid::bytes.
Bytes bytes_between(const Grid& grid, uint64_t begin, uint64_t end, Expressions& exprs);

}  // namespace rg::compiler
