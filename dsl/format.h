// `rgc fmt`: one style. Line breaks stay the author's; indentation, spacing, columns and blank lines do not.
//
//   image depth:d32f view   // a          image  depth : d32f view        // a
//   buffer tiles : u32[8] // b      ->    buffer tiles : u32[8]           // b
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dsl/diagnostics.h"

namespace rg::dsl {

// nullopt, and the reason in `diagnostics`, if `text` does not parse. Idempotent; changes nothing but blanks.
std::optional<std::string> format(FileId file, std::string_view text, Diagnostics& diagnostics);

}  // namespace rg::dsl
