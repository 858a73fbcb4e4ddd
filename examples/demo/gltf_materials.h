// Materials and textures of a glTF file as layers of the scene's texture arrays.
#pragma once

#include "examples/demo/gltf_read.h"
#include "examples/demo/scene.h"

namespace rg::demo {

// Fills materials and textures. The last material is glTF's default one. Textures beyond the layers a scene has room for fall back on
// their factors. Images are resampled to kTextureSize squared.
void convert_materials(const tinygltf::Model& model, Scene& scene);
bool is_blended(const tinygltf::Model& model, int material);

}  // namespace rg::demo
