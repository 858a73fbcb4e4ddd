// Passes of a model: uses of cells with what the plan says of them. Private to model.h.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/verify/model.h"

namespace rg::verify {

// Fills Model::passes[index]. Reports accesses the plan does not list or lists differently.
void add_pass(Model& model, const std::vector<int64_t>& extents, uint32_t index, Report& report);
// Passes that follow each other with one rendering and no barrier in between are one rendering.
void number_renderings(Model& model);
// Numbers runs of commuting writers in program order, per cell.
void number_orders(Model& model);

}  // namespace rg::verify
