// error: use of deleted function .*rg::Required
// A resource the engine forgets to bring.
#include "recorders.h"

recorders::Imports imports(rg::ImportedImage backbuffer, rg::ImportedBuffer lights, rg::ImportedBuffer vertices) {
  return {
      .scene_lights = lights,
#ifdef RG_RIGHT
      .scene_vertices = vertices,
#endif
      .backbuffer = backbuffer,
  };
}
