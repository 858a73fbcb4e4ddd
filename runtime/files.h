// Files as a whole: read up to a bound, and replaced in one step.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/result.h"

namespace rg {

// `io` where `path` is missing, no regular file or longer than `most`; `kind` says in the message what it then is not.
Result<std::vector<std::byte>> read_file(const std::string& path, size_t most, std::string_view kind);

// Writes `parts`, one behind the other, under a name of its own beside `path`, and renames that: whoever reads sees the old file or the new one.
// `io`, with the old file as it was and nothing beside it, where that fails. Not forced to the disk: a reader has to recognise what a fall of power
// leaves.
Status replace_file(const std::string& path, std::span<const std::span<const std::byte>> parts);

}  // namespace rg
