// glTF 2.0 files as scenes: meshes, node transforms, metallic-roughness materials with textures, cameras, punctual lights.
//
// tinygltf parses; everything it returns is checked again here before it is used, because it does not promise valid indices.
// A scene is scaled and moved so that it fits a sphere of six metres above the origin, and lit by a few lamps where it brings none.
#pragma once

#include <filesystem>

#include "examples/demo/scene.h"
#include "runtime/result.h"

namespace rg::demo {

// Errors name file, object and reason: "`a.gltf`: accessor 3: byte range 0..96 does not fit buffer view 1 of 72 bytes".
Result<Scene> load_gltf(const std::filesystem::path& path);

}  // namespace rg::demo
