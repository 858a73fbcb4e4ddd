// Capability profiles in the JSON format of the Vulkan Profiles schema: what a program may rely on, and what it asks beyond that.
#pragma once

#include "compiler/shaders/shaders.h"
#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::compiler {

// Every row of Program::profiles names a file; it becomes a row for each profile in it: features and limits that all its capabilities promise, of
// alternatives what they have in common. Reports files that cannot be read or are no profiles. Limits that a file does not name keep Vulkan's own
// minimum.
dsl::Program read_profiles(dsl::Program program, const ReadFile& read, dsl::Diagnostics& diagnostics);

// Reports, once at its use, every feature a graph needs that some profile does not promise, and every limit it goes over at the maximal extents.
// Without profiles only the shared memory of shaders is judged, by Vulkan's minimum: other limits show in the text, this one in no declaration.
void judge_profiles(const dsl::Program& program, dsl::GraphId graph, const ShaderBundle& shaders, dsl::Diagnostics& diagnostics);

// What the profile promises of a limit, or Vulkan's own minimum where it does not name it; 0 for a limit that the language cannot run into.
double limit_of(const dsl::Profile& profile, const char* name);

// Reports resources of the plan, imported ones are the engine's, of which one copy is larger at the maximal extents than any memory is promised to
// hold in one piece.
void judge_memory(const dsl::Program& program, dsl::GraphId graph, dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
