// Do the inputs of a fragment shader fit what the vertex shader before it writes, and its outputs the attachments?
#pragma once

#include "compiler/shaders/shader_work.h"

namespace rg::compiler {

// Variables between stages, as locations see them: a matrix, an array or a block takes a row for each of its vectors.
struct StageSlot {
  std::string name;
  uint32_t location = 0, component = 0;
  std::string type;  // "vec3", "ivec2", "uint", "dvec2"
  uint32_t components = 1;
  friend bool operator==(const StageSlot&, const StageSlot&) = default;
};
// Of inputs or outputs that the module really uses, by location and component. The module has names.
std::vector<StageSlot> stage_slots(const Words& words, bool inputs);

// Reports the first input of `fragment` that nothing writes, or that is written as another type. Vectors may be written longer than they are read.
// False after a report.
bool check_stage_interface(const PassContext& context, const ShaderUse& vertex, const Words& vertex_words, const ShaderUse& fragment,
                           const Words& fragment_words, ShaderPlaces& places, dsl::Diagnostics& diagnostics);

// Reports what the fragment shader writes to locations that no colour attachment of the pass has. False after a report.
bool check_own_outputs(const PassContext& context, const ShaderUse& fragment, const Words& words, ShaderPlaces& places,
                       dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
