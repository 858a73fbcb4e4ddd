// A look at a glTF file's JSON before tinygltf parses it: what tinygltf reports without saying where is said here with a name.
#pragma once

#include <filesystem>

namespace rg::demo {

// Throws GltfError: not JSON, a required extension that is not supported, a reference or size out of range, a missing buffer file.
void check_outline(const std::filesystem::path& path);

}  // namespace rg::demo
