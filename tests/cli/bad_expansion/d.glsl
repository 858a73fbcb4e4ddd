#include "e.glsl"
#include "e.glsl"
