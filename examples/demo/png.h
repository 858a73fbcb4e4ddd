// Pictures as files.
#pragma once

#include <filesystem>

#include "examples/demo/renderer.h"
#include "runtime/result.h"

namespace rg::demo {

// Writes beside the target first and renames, so that a full disk leaves an earlier picture as it was.
Status write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace rg::demo
