// error: could not convert|no viable conversion
// A buffer where an image is expected.
#include "recorders.h"

#ifdef RG_RIGHT
using Brought = rg::ImportedImage;
#else
using Brought = rg::ImportedBuffer;
#endif

recorders::Imports imports(Brought backbuffer, rg::ImportedBuffer lights, rg::ImportedBuffer vertices) {
  return {.scene_lights = lights, .scene_vertices = vertices, .backbuffer = backbuffer};
}
