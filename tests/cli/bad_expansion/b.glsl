#include "c.glsl"
#include "c.glsl"
