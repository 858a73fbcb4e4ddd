// Procedural textures of the plaza: every layer tiles, and is the same on every machine.
#pragma once

#include <vector>

#include "examples/demo/scene.h"

namespace rg::demo {

namespace layer {
enum : uint32_t {
  flat,
  granite,
  plaster,
  brick,
  marble,
  dark_marble,
  planks,
  roof,
  sandstone,
  mosaic,
  hammered,
  rug,
  leaves,
  verdigris,
  terracotta,
  mist,     // where fog is thick
  lattice,  // what a screen in front of a lamp lets through
  roses,    // a window of coloured glass
  embers,   // what glows in a screen
  count
};
}

std::vector<TextureLayer> make_plaza_textures();

// All mips of one layer, mip 0 first, tightly packed; sRGB colours are averaged as light.
std::vector<uint8_t> make_mips(const std::vector<uint8_t>& mip0, bool srgb);

}  // namespace rg::demo
