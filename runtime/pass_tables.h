// Per pass: what it covers and records at given extents.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

Status create_pass_tables(const Context& context, const Objects& objects, Sized& sized);

// PassRow of every pass, once all tables are filled.
void fill_rows(const Context& context, const Objects& objects, Sized& sized);

// What a pass covers, at the extents and image sizes that are set now. Allocates nothing.
void resize_pass(const Context& context, Sized& sized, Index pass);

}  // namespace rg
