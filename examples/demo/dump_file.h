// Contents of a resource as files that other programs open.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/graph.h"

namespace rg::demo {

struct FloatPicture {  // four channels a texel, rows from the top
  uint32_t width = 0, height = 0;
  std::vector<float> texels;
};

// Layers and slices one below the other. Missing channels are 0, alpha 1. `unsupported` for formats whose texels are not 8, 16 or 32 bits a channel
// or a packed float.
Result<FloatPicture> decode_dump(const Dump& dump);

// OpenEXR, 32-bit floats, uncompressed: the values as they are.
Status write_exr(const std::filesystem::path& path, const FloatPicture& picture);

// `<folder>/<name>.exr` and `.png` (values from 0 to 1), or `.bin` for buffers. Returns what was written.
Result<std::vector<std::string>> write_dump(const std::filesystem::path& folder, const std::string& name, const Dump& dump);

}  // namespace rg::demo
