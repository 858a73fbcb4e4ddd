// What a command is about to write, judged before it writes anything.
#pragma once

#include <string>
#include <vector>

#include "compiler/codegen/generate.h"
#include "dsl/diagnostics.h"

namespace rg::commands {

struct Output {
  std::string what, path;  // "the plan file"
};

// The paths of a folder's files, its manifest among them.
std::vector<Output> outputs_in(const std::string& folder, const std::vector<compiler::GeneratedFile>& files);

// False after reporting what is one of the files that were `read`, stands twice among the outputs, or, of those that are named one by one, cannot be
// replaced. Files are compared, not names: links and `./` make no difference.
bool may_write(const std::vector<Output>& named, const std::vector<Output>& generated, const std::vector<std::string>& read,
               dsl::Diagnostics& diagnostics);

}  // namespace rg::commands
