// What storing a value in an image and loading it again makes of it, as GLSL: the formats' conversions for values that stay in registers.
#pragma once

#include <string>

#include "dsl/program.h"

namespace rg::compiler {

// "float", "uvec2", "vec4": what holds a texel; of depth and stencil images that of the aspects.
std::string texel_type(dsl::Format format, uint32_t aspects);

// `name = rg_to_r16f(name);` with texel_type(format), or empty where nothing is lost.
std::string conversion_call(dsl::Format format, const std::string& name);
// How images of 16-bit floats round what is stored in them. Vulkan leaves it to the device: lavapipe cuts off, GPUs round to the nearest.
enum class HalfRounding : uint8_t { zero, nearest };
// The functions that conversion_call names, for `format`; empty where it is. Floats of 10 and 11 bits are cut off.
std::string conversion_text(dsl::Format format, HalfRounding rounding);

}  // namespace rg::compiler
