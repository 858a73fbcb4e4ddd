// Names that reach shaders cannot be words of GLSL.
#pragma once

#include <string_view>

namespace rg::dsl {

bool reserved_in_glsl(std::string_view name);

}  // namespace rg::dsl
