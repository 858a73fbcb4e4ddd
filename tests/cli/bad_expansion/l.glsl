#include "m.glsl"
#include "m.glsl"
