#include "h.glsl"
#include "h.glsl"
