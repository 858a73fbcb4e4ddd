// Set 1 of every pass, and the ring that parameter blocks and updates are written to.
//
// A pass has as many sets as there are combinations of physical copies it can see: the least common multiple of the history copies,
// and of the frames in flight only where it sees memory that the host touches or objects that the engine may exchange.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Lays out a section: every parameter block, then every update transfer of `sized.passes`, which get their offsets here.
Status create_ring(const Context& context, Sized& sized);

// Views, sets and their contents; leaves imported bindings to update_imported_bindings.
Status create_sets(const Context& context, const Objects& objects, Sized& sized);

// Writes what is imported into the sets that this frame uses, where it differs from what they hold.
void update_imported_bindings(const Context& context, Sized& sized, const std::vector<Import>& imports, uint64_t frame);

}  // namespace rg
