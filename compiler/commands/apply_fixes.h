// `rgc check --fix`.
#pragma once

#include <string>

#include "dsl/diagnostics.h"

namespace rg::commands {

struct Fixed {
  std::string text;
  size_t count = 0;
};
// Applies to `file` every fix of the errors and warnings, and of their notes, that overlaps no earlier one.
Fixed apply_fixes(const dsl::Diagnostics& diagnostics, const dsl::SourceFiles& files, dsl::FileId file);

}  // namespace rg::commands
