// The fast way through a frame: where nothing watches it, every row of Sized::step_rows is its barriers and one call of a function made for its
// shape.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Sized::step_rows, once all other tables are filled.
void fill_step_rows(const Context& context, const Objects& objects, Sized& sized);

void record_rows(FrameRecording& recording, std::span<const StepRow> rows);

// How each row is recorded, at the extents that are set now. Allocates nothing.
void choose_step_rows(const Objects& objects, Sized& sized);

}  // namespace rg
