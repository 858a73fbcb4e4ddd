// The tables that recording walks: one row a pass.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Everything that depends on extents and comes before the ring and the sets: attachments, group counts, regions, PassInfo.
Status create_pass_tables(const Context& context, const Objects& objects, Sized& sized);

}  // namespace rg
