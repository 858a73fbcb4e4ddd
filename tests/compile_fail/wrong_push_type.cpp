// error: could not convert|cannot convert
// Push constants of another pass's struct.
#include "recorders.h"

void record(recorders::MeshesPass& pass) {
#ifdef RG_RIGHT
  pass.push(recorders::Draw{.model = 1});
#else
  pass.push(recorders::Blur{.radius = 1});
#endif
}
