// Text as a terminal may have it: what sources and file names hold is somebody else's.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rg::dsl {

// Characters of UTF-8; a byte that is part of none counts as one.
size_t code_points(std::string_view text);

// What would drive a terminal or turn the direction of text becomes `?`, as does every byte that is no UTF-8: as many characters as before.
// Tabs stay; line breaks only where they are `kept`.
enum class LineBreaks { replaced, kept };
std::string visible(std::string_view text, LineBreaks breaks = LineBreaks::replaced);

}  // namespace rg::dsl
