#include "g.glsl"
#include "g.glsl"
