// Pieces of JSON, for the files that tools write.
#pragma once

#include <string>
#include <string_view>

namespace rg {

std::string json_quoted(std::string_view text);
std::string json_number(double value, int decimals = 3);

}  // namespace rg
