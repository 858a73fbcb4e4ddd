// TEXT -> PROGRAM: reads a root file and its imports, lexes, parses, checks.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::dsl {

// Reads `path`; nullopt and `why` on failure. Imports never leave the root file's folder.
using ReadSource = std::function<std::optional<std::string>(const std::string& path, std::string& why)>;

struct FrontEndResult {
  SourceFiles files;  // files[0] is the root
  Program program;    // valid only if no error was reported
};
FrontEndResult load_program(const std::string& root_path, const ReadSource& read, Diagnostics& diagnostics);

}  // namespace rg::dsl
